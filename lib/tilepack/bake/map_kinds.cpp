#include "tilepack/bake/map_kinds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace tilepack {
namespace {

constexpr std::string_view light = "light, sRGB unless the file says otherwise";
constexpr std::string_view plain = "plain values 0 to 1";

std::vector<MapKind> made_kinds() {
  using enum ChannelContent;
  return {
      {"color",
       Role::color,
       {},
       "albedo basecolor color col base basemap albedotransparency albedoopacity "
       "albedoalpha "
       "maintex bc alb | diffuse diff dif d",
       light},
      {"normal",
       Role::normal,
       {},
       "normal normals norm nor nrm nrml nml normalmap ddn ddna tangentnormal | normalbump n",
       "unit vectors as n * 0.5 + 0.5, or x and y alone; each ending also with gl, ogl, opengl (green up) or "
       "dx, "
       "directx, d3d (green down)"},
      {"roughness",
       Role::roughness,
       {},
       "roughness rough rgh r",
       "plain values 0 to 1; coarser levels take up the spread of normals"},
      {"height",
       Role::height,
       {},
       "height displacement disp displ dsp heightmap displacementmap parallax h | bump bumpmap",
       "plain values"},
      {"ao", Role::ao, {}, "ao ambientocclusion occlusion occ aomap | mixedao", plain},
      {"metallic", Role::metallic, {}, "metallic metalness metal metallicmap met m", plain},
      {"emissive",
       Role::emissive,
       {},
       "emissive emission emit emissivecolor emissioncolor glow selfillum e",
       light},
      {"opacity", Role::opacity, {}, "opacity alpha opacitymask alphamask cutout", plain},
      {"orm",
       Role::data,
       {ao, roughness, metallic},
       "orm occlusionroughnessmetallic occlusionroughnessmetalness aoroughnessmetallic aoroughmetal aorm",
       plain},
      {"arm", Role::data, {ao, roughness, metallic}, "arm", plain},
      {"rma",
       Role::data,
       {roughness, metallic, ao},
       "rma rmo roughnessmetallicao roughnessmetallicocclusion",
       plain},
      {"mra", Role::data, {metallic, roughness, ao}, "mra mro metallicroughnessao", plain},
      {"mrao", Role::data, {metallic, roughness, ao}, "mrao", plain},
      {"metallic_roughness",
       Role::data,
       {other, roughness, metallic},
       "metallicroughness metalroughness metalrough",
       plain},
      {"metallic_smoothness",
       Role::data,
       {metallic, metallic, metallic, gloss},
       "metallicsmoothness metallicgloss metalsmoothness",
       plain},
      {"mask_map", Role::data, {metallic, ao, other, gloss}, "maskmap mods", plain},
      {"gloss", Role::data, {gloss}, "gloss glossiness smoothness", plain},
      {"specular", Role::data, {}, "specular spec specularlevel refl reflection s", plain},
      {"mask", Role::data, {}, "mask", plain},
  };
}

// Calls `each(word, rank)` until it returns true.
template <typename Each>
void for_endings(const MapKind& kind, Each each) {
  int rank = 0;
  for (std::size_t at = 0; at < kind.endings.size();) {
    const std::size_t end = std::min(kind.endings.find(' ', at), kind.endings.size());
    const std::string_view word = kind.endings.substr(at, end - at);
    at = end + 1;
    if (word == "|")
      ++rank;
    else if (each(word, rank))
      return;
  }
}

std::optional<KindNamed> plainly_called(std::string_view word) {
  std::optional<KindNamed> found;
  for (const MapKind& kind : map_kinds()) {
    if (word == kind.name) return KindNamed{&kind};
    for_endings(kind, [&](std::string_view ending, int rank) {
      if (word == ending) found = KindNamed{&kind, rank};
      return found.has_value();
    });
    if (found) break;
  }
  return found;
}

struct Convention {
  std::string_view word;
  NormalY y;
};
constexpr Convention conventions[] = {
    {"opengl", NormalY::up},    {"ogl", NormalY::up},   {"gl", NormalY::up},
    {"directx", NormalY::down}, {"d3d", NormalY::down}, {"dx", NormalY::down},
};

// "R ao, G roughness, B metallic"
std::string channels_text(const MapKind& kind) {
  std::string text;
  constexpr std::string_view letters = "RGBA";
  for (std::size_t c = 0; c < kind.contents.size(); ++c)
    text += fmt::format("{}{} {}", c == 0 ? "" : ", ", letters[c], name_of(kind.contents[c]));
  return text;
}

// The endings, in lines of 100 columns that begin at `indent`, where the text stands.
void append_endings(const MapKind& kind, std::size_t indent, std::string& text) {
  constexpr std::size_t page = 100;
  std::size_t column = indent;
  for_endings(kind, [&](std::string_view word, int) {
    if (column + word.size() + 2 > page) {
      text += '\n';
      text.append(indent, ' ');
      column = indent;
    }
    text += fmt::format(" _{}", word);
    column += word.size() + 2;
    return false;
  });
}

} // namespace

std::span<const MapKind> map_kinds() {
  static const std::vector<MapKind> kinds = made_kinds();
  return kinds;
}

std::optional<KindNamed> kind_called(std::string_view given) {
  std::string word(given);
  if (const std::size_t british = word.find("olour"); british != std::string::npos)
    word.erase(british + 3, 1);
  if (const auto found = plainly_called(word)) return found;
  for (const auto& [convention, y] : conventions) {
    if (word.size() <= convention.size()) continue;
    for (const bool behind : {true, false}) {
      if (behind ? !word.ends_with(convention) : !word.starts_with(convention)) continue;
      const std::string rest =
          behind ? word.substr(0, word.size() - convention.size()) : word.substr(convention.size());
      const auto found = plainly_called(rest);
      if (!found || found->kind->role != Role::normal) continue;
      // Up before what doesn't say, that before down.
      return KindNamed{found->kind, y == NormalY::up ? found->rank - 2 : found->rank + 2, y};
    }
  }
  return std::nullopt;
}

std::string listed_kinds() {
  std::string text;
  for (const MapKind& kind : map_kinds()) text += fmt::format("{}{}", text.empty() ? "" : ", ", kind.name);
  return text;
}

std::string kind_lines() {
  std::string text;
  for (const MapKind& kind : map_kinds()) {
    text += fmt::format("  {:<19}", kind.name);
    append_endings(kind, 21, text);
    text += '\n';
  }
  return text;
}

std::string kinds_text() {
  std::string text;
  for (const MapKind& kind : map_kinds()) {
    text += fmt::format("{}\n  role     {}\n  values   {}\n", kind.name, name_of(kind.role), kind.values);
    if (kind.contents.size() > 1) text += fmt::format("  channels {}\n", channels_text(kind));
    text += "  endings ";
    append_endings(kind, 10, text);
    text += '\n';
  }
  return text;
}

std::vector<ChannelContent> filled_contents(std::vector<ChannelContent> contents, int channels) {
  if (contents.empty()) return contents;
  // Grey is often stored as R, G and B.
  const ChannelContent rest = contents.size() == 1 ? contents.front() : ChannelContent::other;
  contents.resize(static_cast<std::size_t>(channels), rest);
  return contents;
}

} // namespace tilepack
