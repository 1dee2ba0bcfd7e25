#include "tilepack/batch/left_outputs.h"

#include "tilepack/batch/build_record.h"

#include <filesystem>
#include <set>
#include <string_view>
#include <system_error>

namespace tilepack {
namespace {

namespace fs = std::filesystem;

// The output whose side file that could be: "view.png" of ".view.png.build"; empty of others.
std::string output_of_side_file(const std::string& name) {
  constexpr std::string_view ending = ".build";
  if (name.size() <= ending.size() + 1 || name.front() != '.' || !name.ends_with(ending)) return "";
  return name.substr(1, name.size() - ending.size() - 1);
}

bool is_there(const fs::path& file) {
  std::error_code fault;
  return fs::exists(file, fault);
}

} // namespace

std::vector<std::string> left_outputs(const Manifest& manifest) {
  std::set<fs::path> made, folders;
  for (const BatchEntry& entry : manifest.entries) {
    const bool is_pack = entry.verb->output == BatchOutput::pack;
    made.insert(fs::path(side_file_of(entry.output, is_pack)).lexically_normal());
    const fs::path output = fs::path(entry.output).lexically_normal();
    folders.insert(output.has_filename() ? output.parent_path() : output.parent_path().parent_path());
  }
  const auto is_left = [&](const fs::path& output, bool is_pack) {
    const fs::path side = side_file_of(output.string(), is_pack);
    return !made.contains(side.lexically_normal()) && is_there(is_pack ? output / "pack.json" : output) &&
           read_record(side.string()).has_value();
  };
  std::set<std::string> left;
  for (const fs::path& folder : folders) {
    std::error_code fault;
    fs::directory_iterator at(folder.empty() ? fs::path(".") : folder, fault);
    for (; !fault && at != fs::directory_iterator(); at.increment(fault)) {
      const fs::path name = at->path().filename();
      if (const std::string output = output_of_side_file(name.string()); !output.empty()) {
        if (output != "pack.json" && is_left(folder / output, false)) left.insert((folder / output).string());
      } else if (is_left(folder / name, true)) {
        left.insert((folder / name).string());
      }
    }
  }
  return {left.begin(), left.end()};
}

} // namespace tilepack
