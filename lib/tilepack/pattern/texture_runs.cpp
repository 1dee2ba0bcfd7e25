#include "tilepack/pattern/texture_runs.h"

#include "tilepack/numeric/exact_math.h"
#include "tilepack/pattern/areas.h"
#include "tilepack/pattern/height_blend.h"
#include "tilepack/pattern/placed_patterns.h"
#include "tilepack/pattern/transition_tiles.h"

#include <algorithm>
#include <cmath>

namespace tilepack {
namespace {

void clear(const RunValues& out, int channels, std::size_t count) {
  for (int c = 0; c < channels; ++c) std::fill_n(out.value[static_cast<std::size_t>(c)], count, 0.0f);
  std::fill_n(out.cover, count, 0.0f);
}

} // namespace

TextureRuns::TextureRuns(const PatternGraph& of_graph, const PatternValues& of_values)
    : graph(of_graph), values(of_values) {
  for (const PatternMapFacts& map : graph.maps) channels.push_back(map.channels - (map.has_alpha() ? 1 : 0));
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    const PatternSource* source = source_of(graph.nodes[i].block);
    if (source == nullptr) {
      offsets.push_back(0);
      continue;
    }
    const Size tile = source->facts().tile_size;
    const TileMapping& grid = values.mapping(static_cast<NodeId>(i));
    offsets.push_back(exact_log2(std::max(tile.width * grid.x.ratio() / graph.unit.width,
                                          tile.height * grid.y.ratio() / graph.unit.height)));
  }
}

// One node's run: a function for each kind of texture.
struct TextureRun {
  const TextureRuns& runs;
  NodeId node;
  const PatternRun& run;
  const RunLookup& lookup;
  const RunValues& out;

  const PatternValues& values() const { return runs.values; }
  int channels() const { return runs.value_channels(lookup.map); }
  bool vectors() const {
    const PatternMapFacts& facts = runs.graph.maps[static_cast<std::size_t>(lookup.map)];
    return facts.role == Role::normal && facts.channels >= 3;
  }
  SourceLookup in(const PatternSource& source, PatternSource::Use use) const {
    return {source, use, lookup.map, channels(), vectors(), lookup.filter};
  }
  PatternDrawing drawing(const PatternSource& source) const {
    return {in(source, PatternSource::Use::patterns), lookup.level + runs.level_offset(node)};
  }

  // A part of this run as another node has it.
  void pass(NodeId other, std::size_t first, std::size_t end) const {
    if (first == 0 && end == run.count)
      runs.evaluate(other, run, lookup, out);
    else if (first < end)
      runs.evaluate(other, run.part(first, end - first), lookup, out.from(first));
  }
  void clear_part(std::size_t first, std::size_t end) const {
    clear(out.from(first), channels(), end - first);
  }

  template <typename Block>
  void operator()(const Block&) const {
    clear_part(0, run.count); // gives no texture
  }

  void operator()(const ConstantTexture& b) const {
    const std::vector<double>& value = b.values[static_cast<std::size_t>(lookup.map)];
    if (value.empty()) return clear_part(0, run.count);
    for (std::size_t c = 0; c < static_cast<std::size_t>(channels()); ++c)
      std::fill_n(out.value[c], run.count, static_cast<float>(value[c]));
    const bool alpha = value.size() > static_cast<std::size_t>(channels());
    std::fill_n(out.cover, run.count, alpha ? static_cast<float>(value.back()) : 1.0f);
  }

  void operator()(const WangTexture& b) const {
    const GridWalk walk(values().mapping(node), run);
    const double level = lookup.level + runs.level_offset(node);
    SourceSamples samples;
    samples.count = run.count;
    const PatternCell first = walk.first_cell();
    std::fill_n(samples.tile_x, run.count, static_cast<std::int32_t>(first.x));
    std::fill_n(samples.tile_y, run.count, static_cast<std::int32_t>(first.y));
    walk.places(0, run.count, 0, 0, samples.x, samples.y);
    std::fill_n(samples.level, run.count, static_cast<float>(level));
    in(*b.source, PatternSource::Use::wang).sample(samples, level, out);
  }

  void operator()(const PatternsTexture& b) const {
    const PatternDrawing patterns = drawing(*b.source);
    const GridWalk walk(values().mapping(node), run);
    const auto index = [&](PatternCell cell) {
      const std::int64_t p = values().index(b.index, values().mapping(node).centre_of(cell.x, cell.y));
      return p >= 0 && p < b.source->facts().tiles ? static_cast<std::int32_t>(p) : -1;
    };
    if (b.fit == TransformFit::none) {
      patterns.tile(walk, run.count, index, b.seamless, out);
      return;
    }
    clear_part(0, run.count);
    const bool stays = b.fit == TransformFit::shrink;
    const double largest = values().same_everywhere(b.scale)
                               ? std::clamp(values().number_or(b.scale, run.place, 1), 0.0, largest_scale)
                               : largest_scale;
    if (!(largest > 0)) return;
    const std::int64_t reach = stays ? 0 : patterns.cells_reached(largest);
    for (std::size_t i = 0; i < run.count;) {
      const GridWalk::Spot spot = walk.spot(i);
      const std::size_t end = walk.stretch_end(i);
      const PixelBox box = pixel_box(walk, i, end);
      for (std::int64_t dy = -reach; dy <= reach; ++dy)
        for (std::int64_t dx = -reach; dx <= reach; ++dx) {
          const PatternDrawing::CellOffset offset{spot.x + dx, spot.y + dy};
          if (!stays && !patterns.may_reach(largest, offset, box)) continue;
          // The index, which may be the dearest to find, comes last.
          const PatternCell cell = walk.cell(spot, dx, dy);
          PatternInstance instance{0, placed(b, cell)};
          if (!(instance.transform.scale > 0) || !patterns.may_show(instance.transform, offset, box))
            continue;
          instance.pattern = index(cell);
          if (instance.pattern >= 0) patterns.draw(instance, walk, offset, i, end, stays, out);
        }
      i = end;
    }
  }

  // The place of the pattern of a cell; scale 0: nowhere.
  TileTransform placed(const PatternsTexture& b, PatternCell cell) const {
    const PatternPlace centre = values().mapping(node).centre_of(cell.x, cell.y);
    TileTransform t;
    const auto unit = [](double number) { return number >= 0 ? std::min(number, 1.0) : 0.0; };
    t.x = unit(values().number_or(b.x, centre, 0.5));
    t.y = unit(values().number_or(b.y, centre, 0.5));
    t.scale = values().number_or(b.scale, centre, 1);
    if (!(t.scale > 0)) t.scale = 0;
    t.scale = std::min(t.scale, b.fit == TransformFit::shrink ? 1.0 : largest_scale);
    if (b.rotation != no_node) t.turn(values().number(b.rotation, centre));
    if (b.fit == TransformFit::shrink) {
      t.shrink_to_fit();
      t = t.centred_when_shrunk();
    }
    return t;
  }

  void operator()(const SpritesTexture& b) const {
    const PatternDrawing patterns = drawing(*b.source);
    const GridWalk walk(values().mapping(node), run);
    clear_part(0, run.count);
    for (std::size_t i = 0; i < run.count;) {
      const GridWalk::Spot spot = walk.spot(i);
      const std::size_t end = walk.stretch_end(i);
      const PatternCell cell = walk.cell(spot);
      for (const int number : sprites_near(*b.sprites, walk, spot)) {
        const int pattern = b.sprites->sprite(number).pattern;
        if (pattern < 0 || pattern >= b.source->facts().tiles) continue;
        patterns.draw({pattern, b.sprites->seen_from(number, cell)}, walk, {spot.x, spot.y}, i, end, false,
                      out);
      }
      i = end;
    }
  }

  // Those of the cell; where a filter reads beyond their borders, those of its neighbours too.
  std::vector<int> sprites_near(const SpriteMap& sprites, const GridWalk& walk,
                                const GridWalk::Spot& spot) const {
    std::vector<int> found;
    const std::int64_t reach = lookup.filter == Filter::nearest ? 0 : 1;
    for (std::int64_t dy = -reach; dy <= reach; ++dy)
      for (std::int64_t dx = -reach; dx <= reach; ++dx) {
        const std::span<const int> there = sprites.in_cell(walk.cell(spot, dx, dy));
        found.insert(found.end(), there.begin(), there.end());
      }
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    return found;
  }

  void operator()(const SelectTexture& b) const {
    for (std::size_t i = 0; i < run.count;) {
      const PatternValues::Stretch first = values().stretch(b.index, run, i);
      const std::int64_t index = first.value;
      std::size_t end = first.end;
      while (end < run.count) {
        const PatternValues::Stretch next = values().stretch(b.index, run, end);
        if (next.value != index) break;
        end = next.end;
      }
      if (index >= 0 && static_cast<std::size_t>(index) < b.textures.size())
        pass(b.textures[static_cast<std::size_t>(index)], i, end);
      else
        clear_part(i, end);
      i = end;
    }
  }

  CornerMaterials corners_of(NodeId material, PatternCell cell) const {
    const auto at = [&](std::int64_t dx, std::int64_t dy) {
      return values().index(material, values().mapping(node).centre_of(cell.x + dx, cell.y + dy));
    };
    return {at(0, 0), at(1, 0), at(0, 1), at(1, 1)};
  }

  void operator()(const TransitionTexture& b) const {
    const auto m = static_cast<std::int64_t>(b.textures.size());
    const PatternDrawing patterns = drawing(*b.source);
    const GridWalk walk(values().mapping(node), run);
    const auto known = [&](std::int64_t material) { return material >= 0 && material < m; };
    const auto corners_at = [&](std::size_t i) { return corners_of(b.material, walk.cell(walk.spot(i))); };
    for (std::size_t i = 0; i < run.count;) {
      const CornerMaterials corners = corners_at(i);
      std::size_t end = walk.stretch_end(i);
      if (!known(corners.nw) || !known(corners.ne) || !known(corners.sw) || !known(corners.se)) {
        clear_part(i, end);
      } else if (corners.plain() && !b.plain_from_set) {
        while (end < run.count && corners_at(end) == corners) end = walk.stretch_end(end);
        pass(b.textures[static_cast<std::size_t>(corners.nw)], i, end);
      } else {
        const std::int64_t variant = values().hash(node).index(walk.cell(walk.spot(i)));
        const std::int64_t colors = m * b.colors_of_material;
        const std::int64_t code = transition_code(colors_at(b, corners, walk, walk.spot(i)), colors) +
                                  variant * colors * colors * colors * colors;
        const std::int64_t tile = b.tiles.empty() ? code : b.tiles[static_cast<std::size_t>(code)];
        patterns.fill(static_cast<std::int32_t>(tile), walk, i, end, out);
      }
      i = end;
    }
  }

  // The corner colors of a cell whose corners are of these materials.
  CornerMaterials colors_at(const TransitionTexture& b, const CornerMaterials& materials,
                            const GridWalk& walk, const GridWalk::Spot& spot) const {
    if (b.colors_of_material == 1) return materials;
    const auto color = [&](std::int64_t material, std::int64_t dx, std::int64_t dy) {
      return material * b.colors_of_material + values().corner_hash(node).index(walk.cell(spot, dx, dy));
    };
    return {color(materials.nw, 0, 0), color(materials.ne, 1, 0), color(materials.sw, 0, 1),
            color(materials.se, 1, 1)};
  }

  void operator()(const BorderTexture& b) const {
    const PatternDrawing patterns = drawing(*b.source);
    const GridWalk walk(values().mapping(node), run);
    for (std::size_t i = 0; i < run.count;) {
      const PatternCell cell = walk.cell(walk.spot(i));
      const std::size_t end = walk.stretch_end(i);
      const std::int64_t code = border_code(corners_of(b.material, cell), b.family);
      pass(code == 15 ? b.inside : b.below, i, end);
      if (code != 0 && code != 15) {
        RunBuffer border;
        const std::int64_t tile = code + 16 * static_cast<std::int64_t>(values().hash(node).index(cell));
        patterns.fill(static_cast<std::int32_t>(tile), walk, i, end, border.view());
        lay_over(out.from(i), border, channels(), end - i, i);
      }
      i = end;
    }
  }

  // `top` from pixel `first` on, over the start of `to`.
  static void lay_over(const RunValues& to, const RunBuffer& top, int channels, std::size_t count,
                       std::size_t first) {
    for (std::size_t k = 0; k < count; ++k) {
      const float above = top.cover[first + k], below = to.cover[k] * (1 - above), both = above + below;
      to.cover[k] = both;
      if (!(both > 0)) continue;
      for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c)
        to.value[c][k] = (top.value[c][first + k] * above + to.value[c][k] * below) / both;
    }
  }

  void operator()(const HeightBlendTexture& b) const;
  void blend(std::span<const RunBuffer> shown, std::span<const double> weights, std::size_t k,
             const RunValues& to) const;

  void operator()(const LayersTexture& b) const {
    pass(b.textures[0], 0, run.count);
    for (std::size_t i = 1; i < b.textures.size(); ++i) {
      RunBuffer top;
      runs.evaluate(b.textures[i], run, lookup, top.view());
      lay_over(out, top, channels(), run.count, 0);
    }
  }

  void operator()(const MovedTexture& b) const {
    const auto moved = [&](const PatternRun& from) {
      const double x = values().number_or(b.x, from.place, 0), y = values().number_or(b.y, from.place, 0);
      PatternRun to = from;
      to.place.u = normalised({from.place.u.tile, from.place.u.fraction - x});
      to.place.v = normalised({from.place.v.tile, from.place.v.fraction - y});
      return to;
    };
    if (values().same_everywhere(b.x) && values().same_everywhere(b.y)) {
      runs.evaluate(b.texture, moved(run), lookup, out);
      return;
    }
    for (std::size_t i = 0; i < run.count; ++i)
      runs.evaluate(b.texture, moved(run.part(i, 1)), lookup, out.from(i));
  }
};

void TextureRun::operator()(const HeightBlendTexture& b) const {
  const TileMapping& grid = values().mapping(node);
  const GridWalk walk(grid, run, -0.5, -0.5); // cells between four centres
  const double texels = runs.graph.unit.width / grid.x.ratio();
  const double softness = std::min(1 - b.relief, std::max(b.width, std::exp2(lookup.level)) / texels);
  for (std::size_t i = 0; i < run.count;) {
    const GridWalk::Spot spot = walk.spot(i);
    const std::size_t end = walk.stretch_end(i);
    std::array<std::int64_t, 4> corner{};
    std::vector<std::int64_t> there;
    for (std::size_t k = 0; k < 4; ++k) {
      const PatternCell cell =
          walk.cell(spot, static_cast<std::int64_t>(k % 2), static_cast<std::int64_t>(k / 2));
      corner[k] = values().index(b.areas, grid.centre_of(cell.x, cell.y));
      if (corner[k] >= 0 && static_cast<std::size_t>(corner[k]) < b.textures.size() &&
          std::find(there.begin(), there.end(), corner[k]) == there.end())
        there.push_back(corner[k]);
    }
    if (there.size() <= 1) {
      if (there.empty())
        clear_part(i, end);
      else
        pass(b.textures[static_cast<std::size_t>(there[0])], i, end);
      i = end;
      continue;
    }
    const PatternRun part = run.part(i, end - i);
    std::vector<RunBuffer> shown(there.size()), heights(b.height < 0 ? 0 : there.size());
    for (std::size_t m = 0; m < there.size(); ++m) {
      const NodeId texture = b.textures[static_cast<std::size_t>(there[m])];
      runs.evaluate(texture, part, lookup, shown[m].view());
      if (b.height >= 0)
        runs.evaluate(texture, part, {b.height, lookup.level, lookup.filter}, heights[m].view());
    }
    const RunValues to = out.from(i);
    for (std::size_t k = 0; k < part.count; ++k) {
      const double x = std::clamp(walk.x(i + k) - std::floor(walk.x(i)), 0.0, 1.0);
      const double y = std::clamp(walk.y(i + k) - std::floor(walk.y(i)), 0.0, 1.0);
      std::array<double, 4> coverage{}, height{}, weight{};
      const std::array<double, 4> share{(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y};
      for (std::size_t m = 0; m < there.size(); ++m) {
        for (std::size_t c = 0; c < 4; ++c)
          if (corner[c] == there[m]) coverage[m] += share[c];
        height[m] = b.height < 0 ? 0.5 : static_cast<double>(heights[m].value[0][k]);
      }
      const std::size_t count = there.size();
      height_weights({coverage.data(), count}, {height.data(), count}, b.relief, softness,
                     {weight.data(), count});
      blend(shown, {weight.data(), count}, k, to);
    }
    i = end;
  }
}

void TextureRun::blend(std::span<const RunBuffer> shown, std::span<const double> weights, std::size_t k,
                       const RunValues& to) const {
  const auto count = static_cast<std::size_t>(channels());
  double cover = 0;
  std::array<double, 4> sum{};
  SlopeSum slopes;
  for (std::size_t m = 0; m < shown.size(); ++m) cover += weights[m] * static_cast<double>(shown[m].cover[k]);
  to.cover[k] = static_cast<float>(cover);
  for (std::size_t m = 0; m < shown.size() && cover > 0; ++m) {
    const double weight = weights[m] * static_cast<double>(shown[m].cover[k]) / cover;
    if (!(weight > 0)) continue;
    std::array<double, 4> value{};
    for (std::size_t c = 0; c < count; ++c) {
      value[c] = static_cast<double>(shown[m].value[c][k]);
      sum[c] += weight * value[c];
    }
    if (vectors()) slopes.add({value.data(), count}, weight);
  }
  if (vectors() && cover > 0) slopes.resolve({sum.data(), count});
  for (std::size_t c = 0; c < count; ++c) to.value[c][k] = static_cast<float>(sum[c]);
}

void TextureRuns::evaluate(NodeId node, const PatternRun& run, const RunLookup& lookup,
                           const RunValues& out) const {
  values.note(node);
  std::visit(TextureRun{*this, node, run, lookup, out}, values.block(node));
}

} // namespace tilepack
