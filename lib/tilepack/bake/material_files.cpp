#include "tilepack/bake/material_files.h"

#include "tilepack/bake/material_names.h"
#include "tilepack/error/error.h"
#include "tilepack/image/image_format.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string_view>
#include <tuple>

namespace tilepack {

namespace fs = std::filesystem;

namespace {

// A file and the reading of its name that is gone by.
struct Candidate {
  std::string file;
  NameReading reading;
};

using Material = std::vector<Candidate>;
using Materials = std::map<std::string, Material>; // by key

bool has_color(const Material& material) {
  return std::any_of(material.begin(), material.end(),
                     [](const Candidate& c) { return c.reading.kind.kind->role == Role::color; });
}

// Pictures of the whole material, which nobody takes for a map.
bool is_picture_of_it(std::string_view word) {
  static const std::set<std::string_view> words{
      "preview", "thumb",   "thumbnail",  "icon",  "render", "rendered", "sphere",   "ball",  "cover",
      "sample",  "example", "screenshot", "plane", "cube",   "cylinder", "material", "shader"};
  return words.count(word) != 0;
}

// All readings of the images in a folder, and by them the materials.
class Folder {
public:
  Folder(std::span<const std::string> names, const std::string& asked_resolution) {
    // Sorted, so that nothing depends on the order in which a file system lists its files.
    files.assign(names.begin(), names.end());
    std::sort(files.begin(), files.end());
    std::erase_if(files, [](const std::string& file) {
      return file.empty() || file.front() == '.' ||
             !(has_readable_ending(file) || has_other_image_ending(file));
    });
    for (const std::string& file : files) {
      if (!has_readable_ending(file)) continue;
      std::vector<NameReading> found = readings_of(file);
      std::erase_if(found, [&](const NameReading& r) {
        return !asked_resolution.empty() && r.resolution != asked_resolution;
      });
      if (!found.empty()) readings.emplace_back(file, std::move(found));
    }
    collect();
  }

  std::vector<std::string> files;
  Materials materials;

private:
  void collect() {
    std::set<std::string> colored;
    for (const bool weak : {false, true}) {
      for (const auto& [file, list] : readings)
        if (list.front().weak == weak && list.front().kind.kind->role == Role::color)
          colored.insert(list.front().key);
      if (!colored.empty()) break;
    }
    for (const auto& [file, list] : readings) {
      // A shorter ending may leave the name of a material that has a color map.
      const auto fitting = std::find_if(list.begin(), list.end(),
                                        [&](const NameReading& r) { return colored.count(r.key) != 0; });
      const NameReading& reading = fitting == list.end() ? list.front() : *fitting;
      if (!reading.weak || fitting != list.end() || colored.empty())
        materials[reading.key].push_back({file, reading});
    }
    join_numbered_colors();
  }

  // "rock_col_1" and "rock_col_2" beside "rock_normal" are two colors of one material.
  void join_numbered_colors() {
    for (auto here = materials.begin(); here != materials.end();) {
      const Material& list = here->second;
      const std::string& numbers = list.front().reading.numbers;
      const bool colors_alone = std::all_of(list.begin(), list.end(), [&](const Candidate& c) {
        return c.reading.kind.kind->role == Role::color && c.reading.numbers == numbers;
      });
      const auto base = materials.find(here->first.substr(0, here->first.size() - numbers.size()));
      if (numbers.empty() || !colors_alone || base == materials.end()) {
        ++here;
        continue;
      }
      for (Candidate c : list) {
        c.reading.preference[2] += 1 + std::stoi(numbers.substr(0, 6));
        base->second.push_back(std::move(c));
      }
      here = materials.erase(here);
    }
  }

  std::vector<std::pair<std::string, std::vector<NameReading>>> readings;
};

// "rock.png" beside "rock_normal.png": the color map by the name of the material alone.
void take_bare_colors(Folder& folder) {
  for (auto& [key, material] : folder.materials) {
    if (has_color(material) || key.empty()) continue;
    for (const std::string& file : folder.files) {
      if (!has_readable_ending(file) || material_key(file.substr(0, file.rfind('.'))) != key) continue;
      NameReading reading;
      reading.key = key;
      reading.shown = material.front().reading.shown;
      reading.kind = *kind_called("color");
      material.push_back({file, std::move(reading)});
    }
  }
}

std::string listed(std::span<const std::string> files) {
  constexpr std::size_t most = 8;
  const auto shown = files.first(std::min(most, files.size()));
  return fmt::format("{}{}", fmt::join(shown, ", "),
                     files.size() > most ? fmt::format(" and {} more", files.size() - most) : "");
}

std::string label_of(const KindNamed& kind) {
  return std::string(kind.kind->name);
}

// The best file for each kind of map; the others are passed over.
class Choice {
public:
  Choice(const Material& material, const std::string& place) {
    for (const Candidate& c : material) {
      auto [at, is_new] = best.try_emplace(c.reading.kind.kind, &c);
      if (is_new) continue;
      if (c.reading.preference < at->second->reading.preference) at->second = &c;
    }
    for (const Candidate& c : material) {
      const Candidate& taken = *best[c.reading.kind.kind];
      if (&c != &taken && c.reading.preference == taken.reading.preference)
        throw Error(ErrorKind::invalid_content, place,
                    fmt::format("'{}' and '{}' are both the {} map; keep one, or name the maps with {}",
                                taken.file, c.file, c.reading.kind.kind->name, field("map")));
    }
    for (const auto& [kind, candidate] : best) found.files.push_back(file_of(*candidate));
    std::sort(found.files.begin(), found.files.end(), [](const MaterialFile& a, const MaterialFile& b) {
      return std::tuple(place_of(a), a.name) < std::tuple(place_of(b), b.name);
    });
    for (const Candidate& c : material) {
      const Candidate& taken = *best[c.reading.kind.kind];
      if (&taken == &c) continue;
      found.passed_over.push_back({c.file,
                                   fmt::format("{} is the {} map", taken.file, c.reading.kind.kind->name),
                                   label_of(c.reading.kind)});
    }
  }

  static MaterialFile file_of(const Candidate& c) {
    const KindNamed& kind = c.reading.kind;
    return {std::string(kind.kind->name), kind.kind->role, c.file, kind.kind->contents, kind.normal_y};
  }

  FoundMaterial found;

private:
  static int place_of(const MaterialFile& file) { // color, normal, roughness, height, the others
    return std::min(static_cast<int>(file.role), static_cast<int>(Role::data));
  }

  std::map<const MapKind*, const Candidate*> best;
};

// The words of a name that follow those of the material; none if it is another's.
std::optional<std::vector<std::string>> words_beyond(const std::string& key, std::string_view stem) {
  std::vector<std::string> words = material_words(stem);
  std::string joined;
  for (std::size_t taken = 0; joined.size() <= key.size(); ++taken) {
    if (joined == key) {
      words.erase(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(taken));
      return words;
    }
    if (taken == words.size()) break;
    joined += words[taken];
  }
  return std::nullopt;
}

// What of the folder looks like a map of this material and is none of the candidates.
void add_strangers(const Folder& folder, const Material& material, bool alone, FoundMaterial& found) {
  const std::string& key = material.front().reading.key;
  std::set<std::string> known;
  for (const Candidate& c : material) known.insert(c.file);
  std::map<std::string, const Candidate*> of_others;
  for (const auto& [other, list] : folder.materials)
    for (const Candidate& c : list) {
      of_others.emplace(c.file, &c);
      if (has_color(list)) known.insert(c.file); // the whole material is another
    }
  for (const std::string& file : folder.files) {
    if (known.count(file) != 0) continue;
    const std::string stem = file.substr(0, file.rfind('.'));
    const auto beyond = words_beyond(key, stem);
    const auto other = of_others.find(file);
    if (other != of_others.end()) {
      if (!beyond && !alone) continue;
      found.passed_over.push_back({file,
                                   fmt::format("its name says '{}', and that of the color map '{}'",
                                               other->second->reading.shown, material.front().reading.shown),
                                   label_of(other->second->reading.kind)});
      continue;
    }
    if (!beyond || std::any_of(beyond->begin(), beyond->end(), is_picture_of_it)) continue;
    if (!has_readable_ending(file)) {
      found.passed_over.push_back(
          {file, fmt::format("its format is not read; export it as {}", readable_formats()), ""});
      continue;
    }
    if (readings_of(file).empty() || readings_of(file).front().weak) {
      std::string word = beyond->empty() ? "map" : fmt::format("{}", fmt::join(*beyond, "_"));
      std::erase_if(word, [](char c) { return static_cast<unsigned char>(c) >= 0x80; });
      found.passed_over.push_back({file,
                                   fmt::format("no kind of map is called '{}'", fmt::join(*beyond, " ")),
                                   (word.empty() ? "map" : word) + ":data"});
    }
  }
}

// What of the folder has no word of this material's name and is no map of another: samples of their own.
void add_unlike(const Folder& folder, const Material& material, FoundMaterial& found) {
  std::set<std::string> known;
  for (const Candidate& c : material) known.insert(c.file);
  for (const PassedOver& over : found.passed_over) known.insert(over.file);
  for (const std::string& file : folder.files) {
    const std::string stem = file.substr(0, file.rfind('.'));
    const std::vector<std::string> words = material_words(stem);
    if (known.count(file) == 0 && has_readable_ending(file) &&
        !words_beyond(material.front().reading.key, stem) &&
        std::none_of(words.begin(), words.end(), is_picture_of_it))
      found.unlike.push_back(file);
  }
}

// What most of the images end in, and of its spellings (".png", ".PNG") the one that most have.
std::string commonest_ending(const std::vector<std::string>& files) {
  std::map<std::string, std::map<std::string, int>> spellings;
  for (const std::string& file : files)
    if (has_readable_ending(file)) ++spellings[file_ending(file)][file.substr(file.rfind('.'))];
  std::string best = ".png";
  int most = 0;
  for (const auto& [ending, spelled] : spellings) {
    int count = 0, most_spelled = 0;
    std::string spelling;
    for (const auto& [one, times] : spelled) {
      count += times;
      if (times < most_spelled) continue; // of equals the last, which is in small letters
      most_spelled = times;
      spelling = one;
    }
    if (count <= most) continue;
    most = count;
    best = spelling;
  }
  return best;
}

// `files` are some of those in the folder `place`.
std::string for_many_samples(const std::string& place, const std::vector<std::string>& files) {
  const std::string ending = commonest_ending(files);
  return fmt::format("for many samples, list them in a manifest of batch: \"samples\": \"{}{}*{}\"", place,
                     place.ends_with('/') ? "" : "/", ending);
}

} // namespace

std::string note_on_unlike(const FoundMaterial& found, const std::string& folder) {
  return fmt::format(
      "{} is taken as the material '{}' ({} of its images); {} {} passed over, for {} of its maps: {}",
      folder, found.name, found.files.size(), listed(found.unlike), found.unlike.size() == 1 ? "is" : "are",
      found.unlike.size() == 1 ? "it is none" : "they are none", for_many_samples(folder, found.unlike));
}

FoundMaterial material_files(std::span<const std::string> file_names, const std::string& prefix,
                             const std::string& place) {
  Folder folder(file_names, resolution_in(prefix));
  const auto fail = [&](const std::string& what) { throw Error(ErrorKind::invalid_content, place, what); };
  const bool any = std::any_of(folder.materials.begin(), folder.materials.end(),
                               [](const auto& entry) { return has_color(entry.second); });
  if (!any || !prefix.empty()) take_bare_colors(folder);
  // A folder may hold more than materials: without a color map there is nothing to start from.
  std::vector<std::string> names;
  const Material* chosen = nullptr;
  for (const auto& [key, material] : folder.materials) {
    if (!has_color(material) || (!prefix.empty() && key != material_key(prefix))) continue;
    names.push_back(material.front().reading.shown);
    chosen = &material;
  }
  if (names.empty()) {
    std::string seen = folder.files.empty() ? "there is no image" : "there are " + listed(folder.files);
    if (!folder.files.empty() && std::none_of(folder.files.begin(), folder.files.end(), has_readable_ending))
      seen += fmt::format(", of formats that are not read: export them as {}", readable_formats());
    fail(fmt::format(
        "holds no color map by its name; {}. A color map is called like rock_albedo.png ({} lists "
        "all endings), or give the image itself as SAMPLE{}",
        seen, field("list-maps"),
        folder.files.size() > 1 ? "; " + for_many_samples(place, folder.files) : ""));
  }
  if (names.size() > 1)
    fail(fmt::format("holds several materials: {}; add the name of one to the path: {}",
                     fmt::join(names, ", "), (fs::path(place) / names.front()).string()));
  FoundMaterial found = Choice(*chosen, place).found;
  add_strangers(folder, *chosen, prefix.empty(), found);
  found.name = names.front();
  if (!prefix.empty()) return found;
  add_unlike(folder, *chosen, found);
  if (found.files.size() == 1 && !found.unlike.empty())
    fail(
        fmt::format("holds images that are not maps of one material: {}, and {}; name the one to bake, or {}",
                    found.files.front().file, listed(found.unlike), for_many_samples(place, found.unlike)));
  return found;
}

std::optional<MaterialFile> map_by_name(const std::string& file) {
  const std::string name = file.substr(file.rfind('/') + 1);
  if (!has_readable_ending(name)) return std::nullopt;
  for (const NameReading& reading : readings_of(name))
    if (!reading.weak && !reading.one_letter) {
      MaterialFile map = Choice::file_of({file, reading});
      return map;
    }
  return std::nullopt;
}

} // namespace tilepack
