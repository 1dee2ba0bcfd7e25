#include "value_check.h"
#include "verb.h"

#include "tilepack/bake/output_check.h"
#include "tilepack/bake/text_file.h"
#include "tilepack/pack/pack_read.h"
#include "tilepack/report/view_page.h"
#include "tilepack/shader/shader_text.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tilepack::cli {
namespace {

struct ViewArguments {
  std::string pack;
  std::string output;
  std::optional<double> metres;
};

int run_view(const ViewArguments& a) {
  check_page_name({"--output", a.output});
  check_outputs(std::vector<OutputFile>{{"--output", a.output}}, files_of_pack(a.pack));
  const Pack pack = read_pack(a.pack);
  // The folder's own name, so that the page does not depend on where the pack lies.
  const std::string folder =
      std::filesystem::absolute(pack_json_of(a.pack)).lexically_normal().parent_path().filename().string();
  ViewPageSettings settings;
  settings.title = folder;
  settings.made_by = fmt::format("tilepack view {}", folder);
  if (a.metres) settings.made_by += fmt::format(" --metres {}", *a.metres);
  settings.content = pack_content_hash(a.pack);
  settings.metres = a.metres;
  write_text_file(a.output, view_page(pack, settings));
  return 0;
}

Action declare_view(Options& options) {
  auto a = std::make_shared<ViewArguments>();
  options.option("PACK", a->pack, "folder of a pack, or its pack.json").required();
  options.option("-o,--output", a->output, "page to write; it stands alone and needs a browser with WebGL 2")
      .required()
      .value("FILE.html");
  options.option("--metres", a->metres, "width of a tile in metres, for a scale")
      .check(positive_number(1e6, " metres a tile"))
      .value("M");
  return [a](Console&) { return run_view(*a); };
}

} // namespace

Verb view_verb() {
  return {"view", "write a page to pan, zoom and fly over the endless texture of a pack",
          "  tilepack view gravel.pack -o gravel.html\n"
          "  tilepack view rock.pack -o rock.html --metres 2.5\n",
          declare_view};
}

} // namespace tilepack::cli
