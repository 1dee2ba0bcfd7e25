#include "tilepack/bake/output_check.h"

#include "tilepack/error/error.h"
#include "tilepack/image/staged_file.h"
#include "tilepack/pack/pack_folder.h"
#include "tilepack/pack/pack_read.h"
#include "tilepack/pack/pack_write.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace tilepack {
namespace {

namespace fs = std::filesystem;

bool same_file(const std::string& a, const std::string& b) {
  std::error_code fault;
  return one_spelling(a) == one_spelling(b) || fs::equivalent(a, b, fault); // hard links
}

} // namespace

fs::path one_spelling(const std::string& file) {
  std::error_code fault;
  fs::path whole = fs::absolute(file, fault);
  if (fault) whole = file; // the current folder was removed
  fs::path canonical = fs::weakly_canonical(whole, fault);
  if (fault) canonical = whole.lexically_normal();
  return canonical.filename().empty() ? canonical.parent_path() : canonical; // "pack/"
}

void check_outputs(std::span<const OutputFile> outputs, std::span<const std::string> inputs) {
  const auto refuse = [](const OutputFile& output, const std::string& why) {
    throw Error(ErrorKind::usage, output.where,
                fmt::format("'{}' {}; choose another name", output.file, why));
  };
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const OutputFile& output = outputs[i];
    if (output.file.empty()) continue;
    for (const std::string& input : inputs)
      if (same_file(output.file, input)) refuse(output, "would replace a file that is worked from");
    for (const OutputFile& other : outputs.first(i))
      if (!other.file.empty() && same_file(output.file, other.file))
        refuse(output, fmt::format("is what {} writes too", other.where));
  }
}

std::vector<std::string> files_of_pack(const std::string& pack) {
  const fs::path json = pack_json_of(pack);
  std::vector<std::string> files{json.string()};
  for (const std::string& file : read_pack_description(pack).all_files())
    files.push_back((folder_of(json) / file).string());
  return files;
}

void check_pack_folder_for(const std::string& folder, std::span<const std::string> inputs) {
  if (const fs::path outer = pack_around(folder); !outer.empty())
    throw Error(ErrorKind::usage, field("output"),
                fmt::format("'{}' lies in the pack '{}'; choose a folder outside of it", folder,
                            outer.filename().string()));
  check_pack_folder(folder);
  std::error_code fault;
  if (!fs::exists(fs::path(folder) / "pack.json", fault)) return;
  for (const std::string& file : files_of_pack(folder))
    check_outputs(std::vector<OutputFile>{{field("output"), file}}, inputs);
}

std::string without_ending(const std::string& file, const std::string& allowed) {
  const fs::path path(file);
  std::error_code fault;
  if (file.ends_with('/') || fs::is_directory(path, fault))
    return fmt::format("'{}' is a folder; name a file in it that ends in {}", file, allowed);
  if (!path.has_extension()) return fmt::format("'{}' has no ending; it must be {}", file, allowed);
  return fmt::format("'{}' ends in '{}'; it must be {}", file, path.extension().string(), allowed);
}

void check_page_name(const OutputFile& output) {
  const std::string extension = fs::path(output.file).extension().string();
  std::error_code fault;
  const bool named = (extension == ".html" || extension == ".htm") && !fs::is_directory(output.file, fault);
  if (output.file.empty() || named) return;
  throw Error(ErrorKind::usage, output.where, without_ending(output.file, ".html"));
}

void check_writable(const std::string& file) {
  const StagedFile probe(file);
}

} // namespace tilepack
