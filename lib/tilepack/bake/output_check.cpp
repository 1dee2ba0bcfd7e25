#include "tilepack/bake/output_check.h"

#include "tilepack/bake/material_names.h"
#include "tilepack/error/error.h"
#include "tilepack/image/image_format.h"
#include "tilepack/image/staged_file.h"
#include "tilepack/pack/pack_folder.h"
#include "tilepack/pack/pack_read.h"
#include "tilepack/pack/pack_write.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <sys/stat.h>

namespace tilepack {
namespace {

namespace fs = std::filesystem;

// What a name stands for: the file that is there, by whatever name, or the one that could be.
class NamedPlace {
public:
  explicit NamedPlace(const std::string& of) : file(of), id(id_behind(one_spelling(of).string())) {}

  bool is(const std::string& other) const {
    const std::optional<FileId> its = id_behind(other);
    if (id || its) return id == its;
    return one_spelling(file) == one_spelling(other);
  }

private:
  const std::string& file;
  std::optional<FileId> id;
};

[[noreturn]] void refuse_output(const OutputFile& output, const std::string& why) {
  throw Error(ErrorKind::usage, output.where, fmt::format("'{}' {}; choose another name", output.file, why));
}

void refuse_inputs(const OutputFile& output, std::span<const std::string> inputs) {
  const NamedPlace place(output.file);
  for (const std::string& input : inputs)
    if (place.is(input)) refuse_output(output, "would replace a file that is worked from");
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

std::optional<FileId> id_behind(const std::string& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) return std::nullopt;
  return FileId{status.st_dev, status.st_ino};
}

fs::path pack_of_file(const std::string& file) {
  std::error_code fault;
  if (!fs::is_regular_file(file, fault)) return {};
  const fs::path path = one_spelling(file), json = path.parent_path() / "pack.json";
  if (path == json) return path.parent_path();
  if (!fs::is_regular_file(json, fault)) return {};
  try {
    const std::vector<std::string> names = read_pack_description(json).all_files();
    const bool is_named = std::find(names.begin(), names.end(), path.filename().string()) != names.end();
    return is_named ? path.parent_path() : fs::path();
  } catch (const Error&) { // no pack
    return {};
  }
}

void check_outputs(std::span<const OutputFile> outputs, std::span<const std::string> inputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const OutputFile& output = outputs[i];
    if (output.file.empty()) continue;
    refuse_inputs(output, inputs);
    const NamedPlace place(output.file);
    for (const OutputFile& other : outputs.first(i))
      if (!other.file.empty() && place.is(other.file))
        refuse_output(output, fmt::format("is what {} writes too", other.where));
    if (const fs::path pack = pack_of_file(output.file); !pack.empty())
      refuse_output(output, fmt::format("would replace a file of the pack '{}'", pack.filename().string()));
  }
}

void check_text_name(const OutputFile& output) {
  if (!has_readable_ending(output.file) && !has_other_image_ending(output.file)) return;
  refuse_output(output, "ends as an image does, and a text would be written there");
}

void check_shader_name(const OutputFile& output) {
  check_text_name(output);
  if (file_ending(output.file) == ".json")
    refuse_output(output, "ends in '.json', and the text of a shader would be written there");
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
  refuse_inputs({field("output"), folder}, inputs);
  check_pack_folder(folder);
  std::error_code fault;
  if (!fs::exists(fs::path(folder) / "pack.json", fault)) return;
  for (const std::string& file : files_of_pack(folder)) refuse_inputs({field("output"), file}, inputs);
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
  const std::string extension = file_ending(output.file);
  std::error_code fault;
  const bool named = (extension == ".html" || extension == ".htm") && !fs::is_directory(output.file, fault);
  if (output.file.empty() || named) return;
  throw Error(ErrorKind::usage, output.where, without_ending(output.file, ".html"));
}

void check_writable(const std::string& file) {
  const StagedFile probe(file);
}

} // namespace tilepack
