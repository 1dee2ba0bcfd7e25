#include "tilepack/check/level_view.h"
#include "tilepack/check/structure_checks.h"
#include "tilepack/check/tile_border.h"
#include "tilepack/mip/far_levels.h"
#include "tilepack/mip/level_size.h"
#include "tilepack/mip/shared_border.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>

namespace tilepack {
namespace {

// Finds the first offending texel and their number; `good` judges a value.
template <typename Good>
void check_values(const LevelView& view, Rule rule, const char* expected, Good&& good,
                  std::vector<Issue>& issues) {
  const Texels& values = view.image->data();
  std::size_t bad = 0;
  std::size_t first = 0;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!good(values[i]) && bad++ == 0) first = i;
  if (bad == 0) return;
  const auto channels = static_cast<std::size_t>(view.image->channels());
  const auto width = static_cast<std::size_t>(view.image->width());
  const std::size_t texel = first / channels;
  issues.push_back(
      {rule,
       fmt::format("{}, texel ({}, {}) channel {}", place_name(*view.map, view.level), texel % width,
                   texel / width, first % channels),
       fmt::format("{}{}", values[first], bad > 1 ? fmt::format(" and {} more values", bad - 1) : ""),
       expected});
}

struct Member {
  int tile;
  std::vector<float> values;
};

// Bits, since NaN has no order; adding 0 makes -0 and 0 one.
std::vector<std::uint32_t> comparable(const std::vector<float>& values) {
  std::vector<std::uint32_t> bits(values.size());
  std::transform(values.begin(), values.end(), bits.begin(),
                 [](float v) { return std::bit_cast<std::uint32_t>(v + 0.0f); });
  return bits;
}

// The values most tiles of the group have: if one tile was edited, it is that one that is named. A tie goes
// to the lowest id.
const Member& majority(const std::vector<Member>& group) {
  struct Vote {
    int count;
    const Member* first;
  };
  std::map<std::vector<std::uint32_t>, Vote> votes;
  for (const Member& member : group)
    ++votes.try_emplace(comparable(member.values), Vote{0, &member}).first->second.count;
  const auto better = [](const auto& a, const auto& b) {
    return a.second.count != b.second.count ? a.second.count < b.second.count
                                            : a.second.first->tile > b.second.first->tile;
  };
  return *std::max_element(votes.begin(), votes.end(), better)->second.first;
}

// Reports each member that differs from the majority; `texel_at` gives the place of texel i within the tile.
template <typename TexelAt, typename RuleAt, typename Name>
void compare_group(const LevelView& view, const std::vector<Member>& group, TexelAt&& texel_at,
                   RuleAt&& rule_at, Name&& name, std::vector<Issue>& issues) {
  if (group.size() < 2) return;
  const Member& usual = majority(group);
  const auto channels = static_cast<std::size_t>(view.image->channels());
  for (const Member& member : group) {
    if (member.values == usual.values) continue;
    std::size_t differing = 0;
    std::size_t first = 0;
    double largest = 0;
    for (std::size_t i = 0; i < member.values.size(); i += channels) {
      bool same = true;
      for (std::size_t c = i; c < i + channels; ++c) {
        if (member.values[c] == usual.values[c]) continue;
        same = false;
        largest = std::max(largest, std::abs(static_cast<double>(member.values[c]) - usual.values[c]));
      }
      if (!same && differing++ == 0) first = i / channels;
    }
    if (differing == 0) continue; // NaN beside NaN: another rule's matter
    const bool integer = view.map->depth == Depth::u8 || view.map->depth == Depth::u16;
    const Place spot = texel_at(static_cast<int>(first));
    const Rect& rect = *view.rects[member.tile];
    issues.push_back(
        {rule_at(static_cast<int>(first)),
         fmt::format("{}, tile {}, {}", place_name(*view.map, view.level), member.tile, name(member.tile)),
         fmt::format("{} of {} texels differ, by up to {:.4g}{}; the first at ({}, {}) of the image",
                     differing, member.values.size() / channels, integer ? largest * 255 : largest,
                     integer ? "/255" : "", rect.x + spot.x, rect.y + spot.y),
         fmt::format("the texels of tile {}", usual.tile)});
  }
}

// All tiles that share a border color must agree in `strip`; rule_of_row tells which promise a row keeps.
template <typename RuleOfRow>
void check_strip(const LevelView& view, BorderStrip strip, RuleOfRow&& rule_of_row,
                 std::vector<Issue>& issues) {
  const int texels = texel_count(view.tile, strip);
  if (texels <= 0) return;
  const Pack& pack = *view.pack;
  std::map<int, std::vector<Member>> groups;
  for (int tile = 0; tile < tile_count(pack.tiles); ++tile)
    if (view.rects[tile])
      groups[border_key(pack.tiles, tile, strip.side)].push_back(
          {tile, values_of(*view.image, *view.rects[tile], strip)});
  const int row_length = texels / strip.rows;
  for (const auto& [key, group] : groups)
    compare_group(
        view, group, [&](int i) { return texel_of(view.tile, strip, i); },
        [&](int i) { return rule_of_row(i / row_length); },
        [&](int tile) { return border_text(pack.tiles, tile, strip.side); }, issues);
}

int ceil_shift(int value, int shift) {
  return (value + (1 << shift) - 1) >> shift;
}

// A box of guarded texels alone is equal too, so at coarser levels guard >> level rows are, and the free
// squares at the corners grow to whole texels.
void check_guard(const LevelView& view, std::vector<Issue>& issues) {
  const Pack& pack = *view.pack;
  const int rows = pack.guard >> view.level;
  const bool corners_shared = coloring_of(pack.tiles) == Coloring::corner;
  if (rows >= 1) {
    const int skip = corners_shared ? 0 : ceil_shift(pack.guard, view.level);
    for (const Side side : all_sides)
      check_strip(
          view, {side, rows, skip},
          [&](int row) { return row == 0 && view.level == 0 ? Rule::edge_texels : Rule::guard_texels; },
          issues);
  } else if (view.level == 0) {
    // Borders of coarser levels are averaged or fitted on the ground that level 0 is legal.
    const bool promised = pack.mip_mode != MipMode::none && pack.mip_mode != MipMode::box;
    const Rule rule = promised ? Rule::edge_texels : Rule::edge_texels_unpromised;
    for (const Side side : all_sides)
      check_strip(
          view, {side, 1, 1}, [rule](int) { return rule; }, issues);
  }
}

bool in_corner(Size tile, Place place) {
  return (place.x == 0 || place.x == tile.width - 1) && (place.y == 0 || place.y == tile.height - 1);
}

// Which border the places of a group lie on, from the second: the first may be a corner of two.
std::string border_name(const LevelView& view, const SharedTexels& group, int tile) {
  const Size size = view.tile;
  const Place place = group.places[group.places.size() / 2];
  if (in_corner(size, place) || size.width == 1 || size.height == 1)
    return fmt::format("texel ({}, {}) of the tile", place.x, place.y);
  const Side side = place.y == 0                 ? Side::north
                    : place.y == size.height - 1 ? Side::south
                    : place.x == 0               ? Side::west
                                                 : Side::east;
  return border_text(view.pack->tiles, tile, side);
}

// What mip/shared_border.h says of sanitized levels.
void check_sanitized(const LevelView& view, std::vector<Issue>& issues) {
  const Pack& pack = *view.pack;
  if (view.level == 0 || exact_through_guard(pack.guard, view.level)) return;
  for (const SharedTexels& shared : shared_border(pack.tiles, view.tile, pack.mip_mode)) {
    if (shared.places.empty()) continue;
    std::vector<Member> group;
    for (const int tile : shared.tiles) {
      if (!view.rects[tile]) continue;
      Member& member = group.emplace_back(Member{tile, {}});
      for (const Place place : shared.places) {
        const auto texel = view.image->texel(view.rects[tile]->x + place.x, view.rects[tile]->y + place.y);
        member.values.insert(member.values.end(), texel.begin(), texel.end());
      }
    }
    compare_group(
        view, group, [&](int i) { return shared.places[static_cast<std::size_t>(i)]; },
        [&](int i) {
          return in_corner(view.tile, shared.places[static_cast<std::size_t>(i)]) ? Rule::sanitized_corners
                                                                                  : Rule::sanitized_edges;
        },
        [&](int tile) { return border_name(view, shared, tile); }, issues);
  }
}

std::vector<Issue> check_level(const LevelView& view) {
  std::vector<Issue> issues;
  if (view.image->empty()) return issues;
  check_values(
      view, Rule::not_finite, "a finite number", [](float v) { return std::isfinite(v); }, issues);
  if (view.map->depth != Depth::f32)
    check_values(
        view, Rule::not_representable,
        view.map->depth == Depth::u8    ? "a multiple of 1/255 from 0 to 1"
        : view.map->depth == Depth::u16 ? "a multiple of 1/65535 from 0 to 1"
                                        : "a half float",
        [depth = view.map->depth](float v) { return !std::isfinite(v) || quantised(v, depth) == v; }, issues);
  check_guard(view, issues);
  check_sanitized(view, issues);
  return issues;
}

} // namespace

std::vector<Issue> check_levels(const Pack& pack) {
  std::vector<Issue> issues;
  const int wanted = pack.mip_mode == MipMode::none
                         ? 1
                         : levels_held(pack.layout, pack.tile_size, level_count(pack.tile_size));
  if (pack.tile_levels != wanted)
    issues.push_back({Rule::levels_missing, "mips.tile_levels", std::to_string(pack.tile_levels),
                      fmt::format("{} for tiles of {} x {} and mips {}", wanted, pack.tile_size.width,
                                  pack.tile_size.height, name_of(pack.mip_mode))});
  for (const PackedMap& map : pack.maps) {
    const int levels = static_cast<int>(map.levels.size());
    if (levels != pack.tile_levels)
      issues.push_back({Rule::levels_missing, fmt::format("map {}", map.name),
                        fmt::format("{} levels", levels),
                        fmt::format("{} levels, as mips.tile_levels says", pack.tile_levels)});
    const std::size_t far =
        pack.full_chain ? far_level_sizes(pack.layout, pack.tile_size, pack.tile_levels).size() : 0;
    if (map.far_levels.size() != far)
      issues.push_back({Rule::levels_missing, fmt::format("map {}", map.name),
                        fmt::format("{} levels past those of tiles", map.far_levels.size()),
                        fmt::format("{}, as mips.full_chain says", far)});
    for (int level = 0; level < levels; ++level) {
      const Image& image = map.levels[static_cast<std::size_t>(level)];
      if (image.empty() || has_right_size(pack, image, std::min(level, 30))) continue;
      const Size wanted_size = texture_size(pack.layout, pack.tile_size, std::min(level, 30));
      issues.push_back({Rule::level_size, place_name(map, level),
                        fmt::format("{} x {} texels", image.width(), image.height()),
                        fmt::format("{} x {}", wanted_size.width, wanted_size.height)});
    }
  }
  return issues;
}

std::vector<Issue> check_texels(const Pack& pack) {
  std::vector<LevelView> views;
  for (const PackedMap& map : pack.maps)
    for (int level = 0; level < static_cast<int>(map.levels.size()) && level <= 30; ++level)
      views.push_back(view_of(pack, map, level));
  std::vector<std::vector<Issue>> found(views.size());
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t i) { found[i] = check_level(views[i]); });
  std::vector<Issue> issues;
  for (auto& some : found) issues.insert(issues.end(), some.begin(), some.end());
  return issues;
}

} // namespace tilepack
