#include "verb.h"

#include "tilepack/bake/output_check.h"
#include "tilepack/bake/text_file.h"
#include "tilepack/pack/pack_read.h"
#include "tilepack/shader/shader_text.h"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

namespace tilepack::cli {
namespace {

struct ShaderArguments {
  std::string pack;
  std::string language;
  std::string output;
  std::string name = "tilepack";
  std::string border = "wrap";
};

// By the pack's name, so that the text does not depend on where it lies.
std::string command_of(const ShaderArguments& a) {
  std::string command = fmt::format("tilepack shader {} --lang {}", pack_name(a.pack), a.language);
  if (a.name != "tilepack") command += " --name " + a.name;
  if (a.border != "wrap") command += " --border " + a.border;
  return command;
}

int run_shader(const ShaderArguments& a, Console& console) {
  ShaderSettings settings;
  settings.language = enum_called<ShaderLanguage>(a.language, "--lang", "language");
  settings.name = a.name;
  settings.border = enum_called<WrapMode>(a.border, "--border", "border");
  const OutputFile output{"--output", a.output};
  check_outputs(std::vector{output}, files_of_pack(a.pack));
  check_shader_name(output);
  const PackDescription description = read_pack_description(a.pack);
  const std::string text = shader_text(description.pack, settings, command_of(a), pack_content_hash(a.pack));
  if (a.output.empty()) {
    console.print(text);
    return 0;
  }
  write_text_file(a.output, text);
  console.made(fmt::format("{}: the lookup of {} in {}, {} bytes", a.output, a.pack, a.language, text.size()),
               a.output);
  return 0;
}

Action declare_shader(Options& options) {
  auto a = std::make_shared<ShaderArguments>();
  options.option("PACK", a->pack, "folder of a pack, or its pack.json").required();
  options.option("--lang", a->language, "language of the text")
      .one_of(alternatives_of<ShaderLanguage>())
      .required();
  options.option("-o,--output", a->output, "file to write (default: stdout)").value("FILE");
  options
      .option("--name", a->name,
              "what all names in the text begin with (default tilepack); a shader of several packs gives "
              "each its own")
      .value("NAME");
  options
      .option("--border", a->border, "what lies beyond the virtual texture: wrap (default), clamp or mirror")
      .value("NAME");
  return [a](Console& console) { return run_shader(*a, console); };
}

} // namespace

Verb shader_verb() {
  return {"shader", "write the lookup of a pack as an include for shaders, or for C",
          "  tilepack shader gravel.pack --lang glsl -o gravel.glsl\n"
          "  tilepack shader gravel.pack --lang wgsl --name gravel -o gravel.wgsl\n",
          declare_shader};
}

} // namespace tilepack::cli
