#include "tilepack/check/folder_checks.h"

#include "tilepack/batch/build_record.h"
#include "tilepack/check/announced_files.h"
#include "tilepack/check/structure_checks.h"
#include "tilepack/error/error.h"
#include "tilepack/image/image_file.h"
#include "tilepack/json/json_schema.h"
#include "tilepack/pack/file_name.h"
#include "tilepack/pack/pack_folder.h"
#include "tilepack/pack/pack_schema.h"
#include "tilepack/pack/texture_file.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

namespace tilepack {
namespace {

namespace fs = std::filesystem;

Rule rule_of(SchemaProblem::Kind kind) {
  switch (kind) {
  case SchemaProblem::Kind::missing:
    return Rule::field_missing;
  case SchemaProblem::Kind::unknown:
    return Rule::field_unknown;
  case SchemaProblem::Kind::type:
    return Rule::field_type;
  case SchemaProblem::Kind::range:
    return Rule::field_range;
  case SchemaProblem::Kind::no_json:
    break;
  }
  return Rule::not_json;
}

std::vector<Issue> check_document(const std::string& text, const std::string& name) {
  std::vector<Issue> issues;
  for (const SchemaProblem& problem : schema_problems(text, pack_schema()))
    issues.push_back({rule_of(problem.kind), problem.where.empty() ? name : name + ": " + problem.where,
                      problem.found, problem.expected});
  return issues;
}

// One announced file: what is wrong with it, and its image where it could be read.
struct LoadedFile {
  std::vector<Issue> issues;
  std::optional<Image> image;
  Depth depth = Depth::u8;
};

bool depth_as_announced(const AnnouncedFile& file, Depth depth) {
  if (file.kind == AnnouncedFile::Kind::index_map) return depth == Depth::u8 || depth == Depth::u16;
  return !file.depth || depth == *file.depth;
}

void check_header(const AnnouncedFile& announced, const ImageHeader& header, std::vector<Issue>& issues) {
  if (announced.size && header.size != *announced.size)
    issues.push_back({Rule::file_size, announced.file,
                      fmt::format("{} x {} texels", header.size.width, header.size.height),
                      fmt::format("{} x {}", announced.size->width, announced.size->height)});
  if (announced.channels && header.channels != *announced.channels)
    issues.push_back({Rule::file_channels, announced.file, fmt::format("{} channels", header.channels),
                      std::to_string(*announced.channels)});
  if (!depth_as_announced(announced, header.depth))
    issues.push_back({Rule::file_depth, announced.file, std::string(name_of(header.depth)),
                      announced.depth ? std::string(name_of(*announced.depth)) : "u8 or u16"});
}

LoadedFile load(const PackFolder& folder, const AnnouncedFile& announced) {
  LoadedFile loaded;
  const auto refuse = [&](Rule rule, const std::string& found, const std::string& expected) {
    loaded.issues.push_back({rule, announced.file, found, expected});
  };
  if (const std::string fault = file_name_fault(announced.file); !fault.empty()) {
    loaded.issues.push_back({Rule::file_outside, announced.where, announced.file + " " + fault,
                             "a relative name within the folder"});
    return loaded;
  }
  fs::path path;
  try {
    path = folder.file(announced.file);
  } catch (const Error& error) {
    const bool missing = error.kind() == ErrorKind::cannot_read;
    refuse(missing ? Rule::file_missing : Rule::file_outside, missing ? "no such file" : error.what(),
           "a file, named at " + announced.where);
    return loaded;
  }
  bool header_read = false;
  try {
    const ImageHeader header = read_image_header(path);
    header_read = true;
    loaded.depth = header.depth;
    check_header(announced, header, loaded.issues);
    // An image of the wrong size is not decoded: the announced size is what limits memory.
    if (!loaded.issues.empty()) return loaded;
    loaded.image = read_image(path, pack_reading(Encoding::linear)).image;
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::internal)
      throw; // no fault of the pack: no memory, a library that can't start
    const bool values = header_read && error.kind() == ErrorKind::invalid_content;
    refuse(values ? Rule::not_finite : Rule::file_unreadable, folder.named(error, announced.file).what(),
           values ? "finite numbers" : "an image");
  }
  return loaded;
}

std::vector<LoadedFile> load_all(const PackFolder& folder, const std::vector<AnnouncedFile>& files) {
  std::vector<LoadedFile> loaded(files.size());
  tbb::parallel_for(std::size_t{0}, files.size(), [&](std::size_t i) { loaded[i] = load(folder, files[i]); });
  return loaded;
}

std::vector<Issue> check_names(const std::vector<AnnouncedFile>& files, const PackFolder& folder,
                               const std::string& json_name) {
  std::vector<Issue> issues;
  std::map<std::string, std::string> where;
  // The side file is what batch knows a pack by.
  std::set<std::string> known{json_name, std::filesystem::path(side_file_of("", true)).filename().string()};
  for (const AnnouncedFile& file : files) {
    const auto [first, fresh] = where.try_emplace(file.file, file.where);
    if (!fresh)
      issues.push_back({Rule::file_shared, file.where, file.file, "a file not named at " + first->second});
    const std::size_t slash = file.file.find('/');
    known.insert(slash == std::string::npos ? file.file : file.file.substr(0, slash + 1));
  }
  for (const std::string& entry : folder.entries())
    if (!known.contains(entry)) issues.push_back({Rule::file_stray, entry, "", ""});
  return issues;
}

std::vector<int> ids_in(const LoadedFile& file) {
  const int top = file.depth == Depth::u8 ? 255 : 65535;
  std::vector<int> ids;
  ids.reserve(file.image->data().size());
  for (const float value : file.image->data()) ids.push_back(code_of(value, top));
  return ids;
}

std::vector<PackedMap>* maps_for(Pack& pack, const AnnouncedFile& file) {
  if (file.kind == AnnouncedFile::Kind::map) return &pack.maps;
  if (file.kind == AnnouncedFile::Kind::corner_map && pack.corner_pack) return &pack.corner_pack->maps;
  return nullptr;
}

// Puts what was read where the pack wants it; what could not be read stays empty.
void fill(Pack& pack, const std::vector<AnnouncedFile>& files, std::vector<LoadedFile>& loaded) {
  for (std::size_t i = 0; i < files.size(); ++i) {
    const AnnouncedFile& file = files[i];
    if (std::vector<PackedMap>* maps = maps_for(pack, file)) {
      PackedMap& map = (*maps)[static_cast<std::size_t>(file.map)];
      const bool far = file.level >= pack.tile_levels;
      std::vector<Image>& levels = far ? map.far_levels : map.levels;
      const auto level = static_cast<std::size_t>(far ? file.level - pack.tile_levels : file.level);
      levels.resize(std::max(levels.size(), level + 1));
      if (loaded[i].image) levels[level] = std::move(*loaded[i].image);
    } else if (file.kind == AnnouncedFile::Kind::index_map && loaded[i].image) {
      pack.mapping.ids = ids_in(loaded[i]);
    }
  }
}

} // namespace

Report check_folder(const fs::path& folder_or_json, const Progress& progress) {
  return reading_pack(folder_or_json, [&](const PackFolder& folder) {
    return check_folder(folder, folder_or_json.string(), progress);
  });
}

Report check_folder(const PackFolder& folder, const std::string& called, const Progress& progress) {
  const std::string name = folder.json_path().filename().string();
  Report report{called, 0, 0, 0, {}};
  const auto add = [&](std::vector<Issue> issues) {
    report.issues.insert(report.issues.end(), issues.begin(), issues.end());
  };

  tilepack::report(progress, "reading", 0);
  const std::string& text = folder.json_text();
  add(check_document(text, name));
  std::optional<Pack> pack;
  const bool sound = report.issues.empty();
  if (sound) {
    try {
      pack = parsed_pack_json(text, name).pack;
    } catch (const Error& error) {
      report.issues.push_back({Rule::fields_disagree, name, error.what(), ""});
    }
  }

  const std::vector<AnnouncedFile> files = announced_files(text);
  add(check_names(files, folder, name));
  std::vector<LoadedFile> loaded = load_all(folder, files);
  for (const LoadedFile& file : loaded) {
    add(file.issues);
    report.levels += file.image.has_value();
  }
  if (!pack) return report;

  tilepack::report(progress, "checking", 0.5);
  report.tiles = tile_count(pack->tiles);
  report.maps = static_cast<int>(pack->maps.size());
  fill(*pack, files, loaded);
  const bool index_unread = pack->mapping.kind == MappingKind::index && pack->mapping.ids.empty();
  std::vector<Issue> issues = check_structure(*pack);
  if (index_unread) // said once: the file is missing or damaged
    std::erase_if(issues, [](const Issue& issue) { return issue.rule == Rule::index_size; });
  add(std::move(issues));
  return report;
}

} // namespace tilepack
