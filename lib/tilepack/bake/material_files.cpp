#include "tilepack/bake/material_files.h"

#include "tilepack/error/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>

namespace tilepack {
namespace {

struct Ending {
  std::string_view text; // lower case, without '_', '-' and '.'
  std::string_view name;
  Role role;
  int rank = 0; // of two files for one map the one of lower rank is taken; equal ranks are an error
};

constexpr Ending endings[] = {
    {"albedo", "color", Role::color},
    {"basecolor", "color", Role::color},
    {"color", "color", Role::color},
    {"col", "color", Role::color},
    {"diff", "color", Role::color},
    {"diffuse", "color", Role::color},
    {"normalgl", "normal", Role::normal, 0},
    {"normgl", "normal", Role::normal, 0},
    {"norgl", "normal", Role::normal, 0},
    {"nrmgl", "normal", Role::normal, 0},
    {"normal", "normal", Role::normal, 1},
    {"norm", "normal", Role::normal, 1},
    {"nor", "normal", Role::normal, 1},
    {"nrm", "normal", Role::normal, 1},
    {"normaldx", "normal", Role::normal, 2},
    {"normdx", "normal", Role::normal, 2},
    {"nordx", "normal", Role::normal, 2},
    {"nrmdx", "normal", Role::normal, 2},
    {"roughness", "roughness", Role::roughness},
    {"rough", "roughness", Role::roughness},
    {"height", "height", Role::height},
    {"disp", "height", Role::height},
    {"displacement", "height", Role::height},
    {"bump", "height", Role::height},
    {"ao", "ao", Role::data},
    {"ambientocclusion", "ao", Role::data},
    {"occlusion", "ao", Role::data},
    {"orm", "orm", Role::data},
    {"arm", "arm", Role::data},
    {"rma", "rma", Role::data},
    {"metal", "metal", Role::data},
    {"metallic", "metal", Role::data},
    {"metalness", "metal", Role::data},
    {"gloss", "gloss", Role::data},
    {"glossiness", "gloss", Role::data},
    {"spec", "specular", Role::data},
    {"specular", "specular", Role::data},
    {"mask", "mask", Role::data},
    {"opacity", "opacity", Role::data},
    {"alpha", "opacity", Role::data},
};

bool is_separator(char c) {
  return c == '_' || c == '-' || c == '.';
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

// "4k", "1k-jpg", "2048": what libraries of materials put behind the kind of the map.
bool is_resolution(std::string_view part) {
  const std::size_t digits = part.find_first_not_of("0123456789");
  return digits > 0 && (digits == std::string_view::npos || part.substr(digits) == "k");
}

struct Recognised {
  std::string material; // what stands before the ending
  const Ending* ending;
};

// The kind of a map is the last part of the stem, or the last two written as one ("base_color", "nor_gl").
std::optional<Recognised> recognised(std::string_view file_name) {
  const std::size_t dot = file_name.rfind('.');
  if (dot == std::string_view::npos) return std::nullopt;
  const std::string extension = lower(file_name.substr(dot + 1));
  static const std::set<std::string> image_extensions{"png", "jpg", "jpeg", "tif", "tiff", "exr"};
  if (image_extensions.count(extension) == 0) return std::nullopt;

  std::string_view stem = file_name.substr(0, dot);
  const auto last_part = [](std::string_view text) {
    std::size_t start = text.size();
    while (start > 0 && !is_separator(text[start - 1])) --start;
    return start;
  };
  const auto before = [](std::string_view text, std::size_t start) {
    return text.substr(0, start == 0 ? 0 : start - 1);
  };
  std::size_t start = last_part(stem);
  if (start > 0 && is_resolution(lower(stem.substr(start)))) {
    stem = before(stem, start);
    start = last_part(stem);
  }
  const auto find = [](const std::string& text) {
    return std::find_if(std::begin(endings), std::end(endings),
                        [&](const Ending& e) { return e.text == text; });
  };
  const std::string_view rest = before(stem, start);
  const std::size_t second = last_part(rest);
  const std::string last = lower(stem.substr(start));
  if (!rest.empty())
    if (const auto* both = find(lower(rest.substr(second)) + last); both != std::end(endings))
      return Recognised{std::string(before(rest, second)), both};
  if (const auto* one = find(last); one != std::end(endings)) return Recognised{std::string(rest), one};
  return std::nullopt;
}

int place_of(const MaterialFile& file) {
  return static_cast<int>(file.role); // color, normal, roughness, height, data
}

} // namespace

std::vector<MaterialFile> material_files(std::span<const std::string> file_names, const std::string& prefix,
                                         const std::string& folder) {
  const auto fail = [&](const std::string& what) { throw Error(ErrorKind::invalid_content, folder, what); };
  // Sorted, so that nothing depends on the order in which a file system lists its files.
  std::vector<std::string> sorted(file_names.begin(), file_names.end());
  std::sort(sorted.begin(), sorted.end());
  std::map<std::string, std::map<std::string_view, std::pair<const Ending*, std::string>>> materials;
  for (const std::string& file : sorted) {
    const auto found = recognised(file);
    if (!found || (!prefix.empty() && found->material != prefix)) continue;
    auto [place, is_new] = materials[found->material].try_emplace(found->ending->name, found->ending, file);
    auto& [ending, taken] = place->second;
    if (is_new || ending->rank < found->ending->rank) continue;
    if (ending->rank == found->ending->rank)
      fail(fmt::format("'{}' and '{}' are both the {} map; keep one, or name the maps with {}", taken, file,
                       found->ending->name, field("map")));
    place->second = {found->ending, file};
  }
  // A folder may hold more than materials: without a color map there is nothing to start from.
  std::vector<std::string> names;
  for (const auto& [name, maps] : materials)
    if (maps.count("color") != 0) names.push_back(name);
  if (names.empty())
    fail("holds no color map by its name; call it like rock_albedo.png, or give the image itself as SAMPLE");
  if (names.size() > 1)
    fail(fmt::format("holds several materials: {}; add the name of one to the path", fmt::join(names, ", ")));
  std::vector<MaterialFile> files;
  for (const auto& [name, found] : materials[names.front()])
    files.push_back({std::string(name), found.first->role, found.second});
  std::sort(files.begin(), files.end(), [](const MaterialFile& a, const MaterialFile& b) {
    return std::tuple(place_of(a), a.name) < std::tuple(place_of(b), b.name);
  });
  return files;
}

std::optional<MaterialFile> map_by_name(const std::string& file) {
  const auto found = recognised(std::string_view(file).substr(file.rfind('/') + 1));
  if (!found) return std::nullopt;
  return MaterialFile{std::string(found->ending->name), found->ending->role, file};
}

} // namespace tilepack
