#include "tilepack/bake/material_read.h"

#include "tilepack/error/error.h"
#include "tilepack/error/nearest_name.h"
#include "tilepack/image/image_file.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <filesystem>

namespace tilepack {

namespace fs = std::filesystem;

std::vector<MaterialFile> sample_files(const std::string& sample) {
  const fs::path path(sample);
  const bool is_folder = fs::is_directory(path);
  // What is no folder and not there may be the common beginning of several names; if it is not, reading it
  // as an image says that it is missing.
  if (!is_folder && (fs::exists(fs::symlink_status(path)) || path.has_extension()))
    return {{"color", Role::color, sample}};
  const fs::path folder = is_folder ? path : path.parent_path();
  std::vector<std::string> names;
  std::error_code fault;
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, fault), end; !fault && entry != end;
       entry.increment(fault))
    names.push_back(entry->path().filename().string());
  if (!is_folder && (fault || std::none_of(names.begin(), names.end(), [&](const std::string& name) {
                       return name.rfind(path.filename().string() + "_", 0) == 0;
                     })))
    return {{"color", Role::color, sample}};
  if (fault) throw Error(ErrorKind::cannot_read, folder.string(), fault.message());
  auto files = material_files(names, is_folder ? "" : path.filename().string(), sample);
  for (MaterialFile& f : files) f.file = (folder / f.file).string();
  return files;
}

MaterialFile parsed_map(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string label = text.substr(0, equals);
  if (equals == std::string::npos || equals + 1 == text.size() || label.empty())
    throw Error(ErrorKind::usage, field("map"),
                fmt::format("'{}' is not allowed; write ROLE=FILE or NAME:ROLE=FILE", text));
  const std::size_t colon = label.find(':');
  const std::string name = label.substr(0, colon);
  const std::string role = colon == std::string::npos ? name : label.substr(colon + 1);
  static constexpr std::array roles{Role::color, Role::normal, Role::roughness, Role::height, Role::data};
  std::vector<std::string> known;
  for (const Role r : roles) {
    if (name_of(r) == role) return {name, r, text.substr(equals + 1)};
    known.emplace_back(name_of(r));
  }
  const std::string nearest = nearest_name(role, known);
  const std::string hint = nearest.empty() ? "." : fmt::format("; did you mean '{}'?", nearest);
  throw Error(
      ErrorKind::usage, field("map"),
      fmt::format("'{}' is no role{} The roles are color, normal, roughness, height and data: any other "
                  "map is {}:data=FILE",
                  role, hint, name));
}

ReadSamples read_samples(std::span<const MaterialFile> files, const ReadOptions& options) {
  ReadOptions plain;
  plain.encoding = Encoding::linear;
  plain.alpha = AlphaReading::as_stored;
  plain.most_texels = options.most_texels;
  ReadSamples read;
  read.maps.resize(files.size());
  std::vector<std::vector<std::string>> notes(files.size());
  tbb::parallel_for(std::size_t{0}, files.size(), [&](std::size_t i) {
    const MaterialFile& f = files[i];
    ImageFile file = read_image(f.file, f.role == Role::color ? options : plain);
    notes[i] = std::move(file.notes);
    read.maps[i] = {f.name, f.role, file.encoding, file.depth, std::move(file.image), f.file};
  });
  for (std::size_t i = 0; i < files.size(); ++i)
    for (const std::string& note : notes[i]) read.notes.push_back(files[i].file + ": " + note);
  return read;
}

std::string doubt_about_color(const SampleMap& map, std::optional<Encoding> asked) {
  const std::optional<MaterialFile> named = map_by_name(map.file);
  if (map.role != Role::color || !named || named->role == Role::color || asked) return "";
  const std::string role(name_of(named->role));
  const std::string label = role == named->name ? role : named->name + ":" + role;
  const bool srgb = map.encoding == Encoding::srgb;
  return fmt::format("{} is taken as {} color, though its name says {}: beside its color map it goes as {}{}",
                     map.file, srgb ? "an sRGB" : "a linear", named->name,
                     field("map", label + "=" + map.file),
                     srgb ? "; alone, " + field("encoding", "linear") + " takes plain values" : "");
}

} // namespace tilepack
