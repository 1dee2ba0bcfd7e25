#include "tilepack/scene/scene_files.h"

#include "tilepack/bake/output_check.h"
#include "tilepack/image/image_file.h"
#include "tilepack/mip/level_size.h"
#include "tilepack/pack/pack_read.h"
#include "tilepack/scene/scene_limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace tilepack {
namespace {

// What `work` throws of a file, as an error of the place that names it.
template <class Work>
auto asked_from(const std::string& place, Work work) {
  try {
    return work();
  } catch (const Error& error) {
    throw Error(error.kind(), place,
                error.where().empty() ? error.what_happened()
                                      : fmt::format("{}: {}", error.where(), error.what_happened()));
  }
}

[[noreturn]] void refuse(const std::string& file, const std::string& what) {
  throw Error(ErrorKind::invalid_content, file, what);
}

void require_size(const std::string& file, Size found, Size size) {
  if (found == size) return;
  refuse(file, fmt::format(
                   "has {} x {} texels, and the patterns before it {} x {}; patterns of a set have one size",
                   found.width, found.height, size.width, size.height));
}

Image read_as(const std::string& file, const ReadOptions& options, Size size, int channels) {
  ImageFile read = read_image(file, options);
  require_size(file, {read.image.width(), read.image.height()}, size);
  return with_channels(std::move(read.image), channels);
}

Grid<float> read_map(const std::string& file, Size size, bool is_whole) {
  ReadOptions options;
  options.encoding = Encoding::linear;
  const ImageFile read = read_image(file, options);
  if (read.image.width() != size.width || read.image.height() != size.height || read.image.channels() != 1)
    refuse(file, "was replaced while the scene was drawn; begin again");
  const float top = !is_whole ? 1.0f : read.depth == Depth::u8 ? 255.0f : 65535.0f;
  Grid<float> cells(size);
  std::transform(read.image.data().begin(), read.image.data().end(), cells.values.begin(),
                 [&](float value) { return is_whole ? std::round(value * top) : value; });
  return cells;
}

} // namespace

Image with_channels(Image image, int channels) {
  const int there = image.channels();
  if (there == channels) return image;
  const bool is_color = there >= 3;
  const bool is_clear = there == 2 || there == 4;
  Image result(image.width(), image.height(), channels);
  for (int y = 0; y < image.height(); ++y) {
    const auto from = image.row(y);
    const auto to = result.row(y);
    for (int x = 0; x < image.width(); ++x) {
      const auto* in = &from[static_cast<std::size_t>(x * there)];
      auto* out = &to[static_cast<std::size_t>(x * channels)];
      const int colors = channels >= 3 ? 3 : 1;
      for (int c = 0; c < colors; ++c) out[c] = in[is_color ? c : 0];
      if (channels == 2 || channels == 4) out[channels - 1] = is_clear ? in[there - 1] : 1.0f;
    }
  }
  return result;
}

std::shared_ptr<std::atomic<int>> SceneFiles::used(const std::string& key, const std::string& file,
                                                   std::string_view kind) {
  Use& use = files[key];
  use.told.file = file;
  use.told.kind = kind;
  return use.openings;
}

const SceneFiles::Described& SceneFiles::pack(const std::string& path, const std::string& place) {
  if (const auto known = packs.find(path); known != packs.end()) return known->second;
  const std::string file = scene->resolved(path);
  Described described;
  described.pack = asked_from(place, [&] {
    std::error_code fault;
    if (!std::filesystem::exists(file, fault))
      throw Error(ErrorKind::cannot_read, file, "there is no such file");
    Pack read = read_pack_description(file).pack;
    if (read.layout.kind == LayoutKind::rotated)
      refuse(file,
             "has tiles that lie turned, which scenes don't take; bake it with another " + field("layout"));
    return read;
  });
  PackFacts facts;
  facts.name = path;
  facts.tile_size = described.pack.tile_size;
  facts.tiles = tile_count(described.pack.tiles);
  facts.levels = described.pack.tile_levels;
  for (const SceneMap& map : scene->maps) {
    const auto& maps = described.pack.maps;
    const auto found =
        std::find_if(maps.begin(), maps.end(), [&](const PackedMap& one) { return one.name == map.name; });
    facts.map_of.push_back(found == maps.end() ? -1 : static_cast<int>(found - maps.begin()));
    if (found != maps.end() && facts.alpha_map < 0 && has_alpha(found->role, found->channels))
      facts.alpha_map = static_cast<int>(facts.map_of.size()) - 1;
    if (found != maps.end() && found->role != map.role)
      throw Error(ErrorKind::invalid_content, place,
                  fmt::format("{}: its map \"{}\" has the role {}, and that of the scene {}", file, map.name,
                              name_of(found->role), name_of(map.role)));
  }
  if (std::all_of(facts.map_of.begin(), facts.map_of.end(), [](int map) { return map < 0; })) {
    std::string names;
    for (const PackedMap& map : described.pack.maps) names += (names.empty() ? "" : ", ") + map.name;
    throw Error(ErrorKind::invalid_content, place,
                fmt::format("{}: has none of the maps of the scene; it has {}", file, names));
  }
  const auto openings = used(path, path, "pack");
  described.source =
      std::make_shared<PatternSource>(std::move(facts), [file, place, openings](const PackRequest& request) {
        return asked_from(place, [&] {
          ++*openings;
          const Pack pack = reading_pack(file, [&](const PackFolder& folder) {
            return read_pack_levels(folder, request.map, request.first_level);
          });
          return from_level(pack, {0, request.first_level});
        });
      });
  files[path].source = described.source;
  files[path].paths = {file};
  return packs.emplace(path, std::move(described)).first->second;
}

std::shared_ptr<const PatternSource> SceneFiles::patterns(const std::vector<std::string>& paths,
                                                          const std::string& place) {
  std::string key;
  for (const std::string& path : paths) key += path + '\n';
  if (const auto known = files.find(key); known != files.end()) return known->second.source;
  std::vector<std::string> resolved;
  for (const std::string& path : paths) resolved.push_back(scene->resolved(path));
  const SceneMap& map = scene->maps.front();
  ReadOptions options;
  if (!is_light(map.role)) options.encoding = Encoding::linear;
  bool is_colored = false, is_clear = false;
  const ImageHeader first = asked_from(place, [&] {
    const ImageHeader of_all = read_image_header(resolved.front(), options);
    for (const std::string& file : resolved) {
      const ImageHeader header = read_image_header(file, options);
      require_size(file, header.size, of_all.size);
      is_colored = is_colored || header.channels >= 3;
      is_clear = is_clear || has_alpha(map.role, header.channels);
    }
    return of_all;
  });
  PackFacts facts;
  facts.name = paths.front();
  facts.tile_size = first.size;
  facts.tiles = static_cast<int>(paths.size());
  facts.levels = level_count(first.size);
  facts.map_of.assign(scene->maps.size(), -1);
  facts.map_of.front() = 0;
  if (is_clear) facts.alpha_map = 0;
  const auto openings = used(
      key, paths.size() == 1 ? paths.front() : fmt::format("{} and {} more", paths.front(), paths.size() - 1),
      "patterns");
  const MapFormat format{map.name, map.role, first.encoding, first.depth};
  options.encoding = first.encoding;
  files[key].source = std::make_shared<PatternSource>(
      std::move(facts), [=, channels = (is_colored ? 3 : 1) + (is_clear ? 1 : 0),
                         size = first.size](const PackRequest& request) {
        return asked_from(place, [&] {
          ++*openings;
          std::vector<Image> images;
          for (const std::string& file : resolved) images.push_back(read_as(file, options, size, channels));
          return from_level(pattern_pack(images, format), {0, request.first_level});
        });
      });
  files[key].paths = resolved;
  return files[key].source;
}

std::shared_ptr<const StoredMap> SceneFiles::map(const std::string& path, bool is_whole,
                                                 const std::string& place) {
  const std::string key = fmt::format("{}\n{}", path, is_whole ? "whole" : "real");
  if (const auto known = files.find(key); known != files.end()) return known->second.stored;
  const std::string file = scene->resolved(path);
  const ImageHeader header = asked_from(place, [&] {
    const ImageHeader read = read_image_header(file);
    if (read.channels != 1)
      refuse(file, fmt::format("has {} channels; a map of numbers has one (save it as grey, without alpha)",
                               read.channels));
    if (is_whole && read.depth != Depth::u8 && read.depth != Depth::u16)
      refuse(file, "holds floats; a map of whole numbers has 8 or 16 bits");
    return read;
  });
  const auto openings = used(key, path, "map");
  files[key].stored = std::make_shared<StoredMap>(header.size, [=, size = header.size] {
    return asked_from(place, [&] {
      ++*openings;
      return read_map(file, size, is_whole);
    });
  });
  files[key].paths = {file};
  return files[key].stored;
}

std::vector<std::string> SceneFiles::inputs() const {
  std::vector<std::string> all{scene->file};
  for (const auto& [key, use] : files)
    for (const std::string& path : use.paths) {
      const std::vector<std::string> some =
          use.told.kind == "pack" ? files_of_pack(path) : std::vector<std::string>{path};
      all.insert(all.end(), some.begin(), some.end());
    }
  std::sort(all.begin() + 1, all.end());
  all.erase(std::unique(all.begin() + 1, all.end()), all.end());
  return all;
}

std::vector<SceneFileUse> SceneFiles::uses() const {
  std::vector<SceneFileUse> list;
  for (const auto& [key, use] : files) {
    list.push_back(use.told);
    list.back().openings = use.openings->load();
    list.back().bytes = use.source ? use.source->bytes() : use.stored ? use.stored->bytes() : 0;
  }
  return list;
}

} // namespace tilepack
