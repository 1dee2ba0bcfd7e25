#include "tilepack/shader/lookup_description.h"

#include "tilepack/sampler/corner_blend.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace tilepack {
namespace {

// Texture coordinates, and the layer of an array.
struct TexturePoint {
  Expression u, v, layer;
};

// How a place moves for a step to the next pixel, and to the next row.
struct Steps {
  Expression across_x, across_y, down_x, down_y;
  std::vector<Expression> all() const { return {across_x, across_y, down_x, down_y}; }
};

/// Writes the functions that read texels.
class TexelDescription {
public:
  TexelDescription(LookupProgram& of_program, const PackLookup& of_lookup, const LookupFeatures& of_features)
      : program(of_program), lookup(of_lookup), layout(of_lookup.layout), features(of_features) {}

  void describe() {
    if (lookup.corner_columns > 0) {
      describe_corner_place(program, lookup);
      describe_corner_share();
    }
    if (features.gradients) describe_level_of();
    if (features.levels) {
      if (!turned()) describe_texel();
      describe_nearest();
      describe_filtered("level");
      if (!turned()) describe_exact();
    }
    if (!features.gradients) return;
    describe_filtered("grad");
    if (features.levels && !turned()) describe_exact_grad();
  }

private:
  bool turned() const { return lookup.layout_kind == LayoutKind::rotated; }
  bool layered() const { return lookup.layout_kind == LayoutKind::array; }

  // A cell and the fraction within it, as parameters; within the virtual texture.
  struct At {
    Expression cell_x, cell_y; // as handed in
    Expression x, y;           // fractions
  };

  static At place_parameters(FunctionWriter& f) {
    At at;
    at.cell_x = f.parameter("cell_x", ValueType::whole);
    at.cell_y = f.parameter("cell_y", ValueType::whole);
    at.x = f.parameter("fraction_x", ValueType::real);
    at.y = f.parameter("fraction_y", ValueType::real);
    return at;
  }

  // Where the texture doesn't wrap, what is shown there.
  At within(FunctionWriter& f, At at) {
    if (features.border == WrapMode::wrap) return at;
    at.x = f.declare("fx", f.call("fraction_x", {at.cell_x, at.x}));
    at.y = f.declare("fy", f.call("fraction_y", {at.cell_y, at.y}));
    return at;
  }

  // The same, half a texel from borders beyond which the virtual texture doesn't go on. Sides in texels of the level.
  static void keep_inside(FunctionWriter& f, const Expression& cell, const Expression& fraction,
                          std::uint32_t side, const Expression& texels) {
    const Expression half = real(0.5) / texels;
    f.assign(fraction, select(cell == word(0), maximum(fraction, half), fraction));
    f.assign(fraction, select(cell == word(side - 1), minimum(fraction, real(1) - half), fraction));
  }

  static Expression column_of(const Expression& place) { return place & word(0xffff); }
  static Expression row_of(const Expression& place) { return place >> word(16); }

  // Step 5 of pack_lookup.h, in texture coordinates.
  TexturePoint texture_point(const Expression& place, const Expression& x, const Expression& y) const {
    const Expression column = to_real(column_of(place)), row = to_real(row_of(place));
    if (layered()) {
      const auto within_layer = [&](const Expression& fraction, double tile) {
        if (layout.border == 0) return fraction;
        return (fraction * real(tile) + real(layout.border)) / real(tile + 2.0 * layout.border);
      };
      return {within_layer(x, layout.tile_width), within_layer(y, layout.tile_height), row_of(place)};
    }
    if (!turned()) return {(column + x) / real(layout.columns), (row + y) / real(layout.rows), word(0)};
    const double side = layout.tile_width + 2.0 * layout.gutter;
    const double m = static_cast<double>(layout.n) * layout.n + static_cast<double>(layout.k) * layout.k;
    const auto within_cell = [&](const Expression& fraction) {
      if (layout.gutter == 0) return fraction;
      return (fraction * real(layout.tile_width) + real(layout.gutter)) / real(side);
    };
    const Expression n = real(layout.n), k = real(layout.k);
    return {(column + n * within_cell(x) - k * within_cell(y)) / real(m * layout.squares),
            (row + k * within_cell(x) + n * within_cell(y)) / real(m), word(0)};
  }

  // Derivatives of those, from steps in tiles.
  Steps in_texture(const Steps& s) const {
    if (!turned()) {
      const double columns = layered() ? (layout.tile_width + 2.0 * layout.border) / layout.tile_width : 1;
      const double rows = layered() ? (layout.tile_height + 2.0 * layout.border) / layout.tile_height : 1;
      const Expression across = real(layered() ? columns : layout.columns),
                       down = real(layered() ? rows : layout.rows);
      return {s.across_x / across, s.across_y / down, s.down_x / across, s.down_y / down};
    }
    const double part = layout.tile_width / (layout.tile_width + 2.0 * layout.gutter);
    const double m = static_cast<double>(layout.n) * layout.n + static_cast<double>(layout.k) * layout.k;
    const Expression n = real(layout.n * part), k = real(layout.k * part);
    const Expression u = real(m * layout.squares), v = real(m);
    return {(n * s.across_x - k * s.across_y) / u, (k * s.across_x + n * s.across_y) / v,
            (n * s.down_x - k * s.down_y) / u, (k * s.down_x + n * s.down_y) / v};
  }

  static Steps step_parameters(FunctionWriter& f) {
    Steps s;
    s.across_x = f.parameter("dx_x", ValueType::real);
    s.across_y = f.parameter("dx_y", ValueType::real);
    s.down_x = f.parameter("dy_x", ValueType::real);
    s.down_y = f.parameter("dy_y", ValueType::real);
    return s;
  }

  Expression last_level() const { return real(lookup.levels - 1.0); } // of tiles
  bool has_far_levels() const { return lookup.chain_levels > lookup.levels; }

  void describe_level_of() {
    FunctionWriter f(program, "level_of", ValueType::real,
                     {"The level at which the longer of two steps, in tiles, is one texel."});
    const Steps s = step_parameters(f);
    const auto length = [&](const std::string& name, const Expression& x, const Expression& y) {
      const Expression u = f.declare(name + "_u", x * real(layout.tile_width));
      const Expression v = f.declare(name + "_v", y * real(layout.tile_height));
      return u * u + v * v;
    };
    const Expression across = length("across", s.across_x, s.across_y);
    const Expression down = length("down", s.down_x, s.down_y);
    f.result(real(0.5) * unary(Operation::log2, ValueType::real, maximum(maximum(across, down), real(1))));
  }

  // corner_blend.h, corner_weight(), at any level.
  void describe_corner_share() {
    FunctionWriter f(program, "corner_share", ValueType::real,
                     {"The share of the corner pack at a place of a tile."});
    const Expression fx = f.parameter("fraction_x", ValueType::real),
                     fy = f.parameter("fraction_y", ValueType::real);
    const Expression level = f.parameter("level", ValueType::real);
    const double side = std::min(layout.tile_width, layout.tile_height);
    const Expression scale = f.declare("scale", unary(Operation::exp2, ValueType::real, level));
    const Expression width =
        f.declare("width", minimum(real(default_corner_width) * scale,
                                   real(std::min<double>(lookup.corner_width, 0.5 * side))));
    const auto distance = [&](const std::string& name, const Expression& fraction, double tile) {
      return f.declare(name, minimum(fraction, real(1) - fraction) * real(tile));
    };
    const Expression x = distance("x", fx, layout.tile_width), y = distance("y", fy, layout.tile_height);
    const Expression t =
        f.declare("t", minimum(maximum((width - unary(Operation::sqrt, ValueType::real, x * x + y * y)) /
                                           maximum(width * real(0.5), real(1e-6)),
                                       real(0)),
                               real(1)));
    f.result(t * t * (real(3) - real(2) * t));
  }

  Expression size_at(std::uint32_t texels, const Expression& level) const {
    return word(texels) >> to_word(level);
  }

  void describe_texel() {
    FunctionWriter f(
        program, "texel", ValueType::texel,
        {"Texel (i, j) of a level of the tile in cell (x, y), both within the virtual texture."});
    const Expression x = f.parameter("x", ValueType::word), y = f.parameter("y", ValueType::word);
    const Expression i = f.parameter("i", ValueType::word), j = f.parameter("j", ValueType::word);
    const Expression level = f.parameter("level", ValueType::whole);
    const Expression place = f.declare("place", f.call("place_of", {x, y}));
    Expression column = i, row = j, layer = word(0);
    if (layered()) {
      layer = row_of(place);
      if (layout.border > 0) {
        column = column + size_at(layout.border, level);
        row = row + size_at(layout.border, level);
      }
    } else {
      column = column_of(place) * size_at(layout.tile_width, level) + i;
      row = row_of(place) * size_at(layout.tile_height, level) + j;
    }
    f.result(fetch(Operation::fetch_texel, PackTextureSlot::tiles,
                   {to_whole(column), to_whole(row), to_whole(layer), level}));
  }

  void describe_nearest() {
    FunctionWriter f(program, "nearest", ValueType::texel,
                     {"The texel that holds a place, at a whole level."});
    const At at = place_parameters(f);
    Expression level = f.parameter("level", ValueType::whole);
    if (has_far_levels()) { // they are filtered or nothing
      const Expression last = whole(static_cast<std::int32_t>(lookup.levels) - 1);
      level = f.declare("of_tiles", select(level < last, level, last));
    }
    const At in = within(f, at);
    const Expression x = f.declare("x", f.call("cell_x", {at.cell_x})),
                     y = f.declare("y", f.call("cell_y", {at.cell_y}));
    if (!turned()) {
      const auto texel = [&](const std::string& name, const Expression& fraction, std::uint32_t texels) {
        const Expression side = f.declare(name + "_side", size_at(texels, level));
        return f.declare(name, minimum(to_word(floor(fraction * to_real(side))), side - word(1)));
      };
      const Expression i = texel("i", in.x, layout.tile_width), j = texel("j", in.y, layout.tile_height);
      f.result(f.call("texel", {x, y, i, j, level}));
      return;
    }
    const Expression place = f.declare("place", f.call("place_of", {x, y}));
    const TexturePoint point = texture_point(place, in.x, in.y);
    const auto texel = [&](const std::string& name, const Expression& coordinate, std::uint32_t texels) {
      const Expression c = f.declare(name, coordinate);
      const Expression side = f.declare(name + "_side", maximum(size_at(texels, level), word(1)));
      return to_whole(minimum(to_word(floor((c - floor(c)) * to_real(side))), side - word(1)));
    };
    f.result(fetch(Operation::fetch_texel, PackTextureSlot::tiles,
                   {texel("u", point.u, layout.texture_width), texel("v", point.v, layout.texture_height),
                    whole(0), level}));
  }

  // "level" or "grad": as the texture's own filter does it.
  void describe_filtered(const std::string& name) {
    const bool by_level = name == "level";
    FunctionWriter f(program, name, ValueType::texel,
                     {by_level ? "Filtered at a level, 0 the finest."
                               : "Filtered over a pixel: derivatives of the place, in tiles."});
    const At at = place_parameters(f);
    Expression level;
    Steps steps;
    if (by_level)
      level = f.parameter("level", ValueType::real);
    else
      steps = step_parameters(f);
    At in = within(f, at);
    const Expression x = f.declare("x", f.call("cell_x", {at.cell_x})),
                     y = f.declare("y", f.call("cell_y", {at.cell_y}));
    Expression here = by_level ? level : Expression{};
    const bool corners = lookup.corner_columns > 0;
    if (features.border != WrapMode::wrap || corners)
      here =
          f.declare("at_level", minimum(maximum(by_level ? level : f.call("level_of", steps.all()), real(0)),
                                        last_level()));
    if (features.border != WrapMode::wrap) {
      const Expression scale = f.declare("scale", unary(Operation::exp2, ValueType::real, real(0) - here));
      keep_inside(f, x, in.x, lookup.lattice.width, real(layout.tile_width) * scale);
      keep_inside(f, y, in.y, lookup.lattice.height, real(layout.tile_height) * scale);
    }
    const Steps inside = by_level ? Steps{} : in_texture(steps);
    const auto filtered = [&](PackTextureSlot slot, const TexturePoint& p) {
      const Expression layer = to_whole(p.layer);
      if (by_level) return fetch(Operation::fetch_level, slot, {p.u, p.v, layer, level});
      return fetch(Operation::fetch_grad, slot,
                   {p.u, p.v, layer, inside.across_x, inside.across_y, inside.down_x, inside.down_y});
    };
    const Expression place = f.declare("place", f.call("place_of", {x, y}));
    if (!corners) {
      f.result(filtered(PackTextureSlot::tiles, texture_point(place, in.x, in.y)));
      return;
    }
    const Expression value =
        f.declare("value", filtered(PackTextureSlot::tiles, texture_point(place, in.x, in.y)));
    const Expression share = f.declare("share", f.call("corner_share", {in.x, in.y, here}));
    f.branch(real(0) < share, [&] {
      const Expression corner = f.declare("corner", f.call("corner_place", {x, y, in.x, in.y}));
      const TexturePoint point{(to_real(column_of(corner)) + in.x) / real(lookup.corner_columns),
                               (to_real(row_of(corner)) + in.y) / real(lookup.corner_rows), word(0)};
      f.assign(value, value * (real(1) - share) + filtered(PackTextureSlot::corners, point) * share);
    });
    f.result(value);
  }

  void describe_exact_at() {
    FunctionWriter f(program, "exact_at", ValueType::texel,
                     {"Bilinear at a whole level. Where the four texels lie in one tile the texture's filter "
                      "does it, else",
                      "each is read from the tile that it lies in."});
    const At at = place_parameters(f);
    const Expression level = f.parameter("level", ValueType::whole);
    const At in = within(f, at);
    const Expression x = f.declare("x", f.call("cell_x", {at.cell_x})),
                     y = f.declare("y", f.call("cell_y", {at.cell_y}));
    const auto side = [&](std::uint32_t texels) {
      if (!has_far_levels()) return size_at(texels, level);
      return word(texels) >> minimum(to_word(level), word(lookup.levels - 1));
    };
    const Expression width = f.declare("width", side(layout.tile_width));
    const Expression height = f.declare("height", side(layout.tile_height));
    if (features.border != WrapMode::wrap) {
      keep_inside(f, x, in.x, lookup.lattice.width, to_real(width));
      keep_inside(f, y, in.y, lookup.lattice.height, to_real(height));
    }
    // Of the north-west one of four texels; -1 lies in the cell before.
    const Expression px = f.declare("px", in.x * to_real(width) - real(0.5));
    const Expression py = f.declare("py", in.y * to_real(height) - real(0.5));
    const Expression i = f.declare("i", to_whole(floor(px))), j = f.declare("j", to_whole(floor(py)));
    const Expression ie = f.declare("ie", to_word(i + whole(1))), js = f.declare("js", to_word(j + whole(1)));
    const Expression value = f.declare("value", no_texel());
    const Expression within_tile = whole(0) <= i && whole(0) <= j && ie < width && js < height;
    // Far levels are the texture's own.
    const auto past_tiles = static_cast<std::int32_t>(lookup.levels) - 1;
    f.branch(
        has_far_levels() ? whole(past_tiles) < level || within_tile : within_tile,
        [&] {
          const TexturePoint p = texture_point(f.declare("place", f.call("place_of", {x, y})), in.x, in.y);
          f.assign(value, fetch(Operation::fetch_level, PackTextureSlot::tiles,
                                {p.u, p.v, to_whole(p.layer), to_real(level)}));
        },
        [&] {
          const Expression sx = f.declare("sx", px - floor(px)), sy = f.declare("sy", py - floor(py));
          const auto& [w, h] = std::pair{lookup.lattice.width, lookup.lattice.height};
          const Expression west = f.declare("west", select(i < whole(0), previous_cell(x, w), x));
          const Expression east = f.declare("east", select(ie == width, next_cell(x, w), x));
          const Expression north = f.declare("north", select(j < whole(0), previous_cell(y, h), y));
          const Expression south = f.declare("south", select(js == height, next_cell(y, h), y));
          const Expression iw = f.declare("iw", select(i < whole(0), width - word(1), to_word(i)));
          const Expression jn = f.declare("jn", select(j < whole(0), height - word(1), to_word(j)));
          f.assign(ie, select(ie == width, word(0), ie));
          f.assign(js, select(js == height, word(0), js));
          const auto row = [&](const Expression& cell_y, const Expression& texel_y) {
            return f.call("texel", {west, cell_y, iw, texel_y, level}) * (real(1) - sx) +
                   f.call("texel", {east, cell_y, ie, texel_y, level}) * sx;
          };
          f.assign(value, row(north, jn) * (real(1) - sy) + row(south, js) * sy);
        });
    f.result(value);
  }

  void describe_exact() {
    describe_exact_at();
    FunctionWriter f(program, "exact", ValueType::texel,
                     {"Trilinear, every texel from the tile that it lies in."});
    const At at = place_parameters(f);
    const Expression level = f.declare("at", minimum(maximum(f.parameter("level", ValueType::real), real(0)),
                                                     real(lookup.chain_levels - 1.0)));
    const Expression fine = f.declare("fine", floor(level)), share = f.declare("share", level - fine);
    const auto exact_at = [&](const Expression& of) {
      return f.call("exact_at", {at.cell_x, at.cell_y, at.x, at.y, to_whole(of)});
    };
    const Expression value = f.declare("value", exact_at(fine));
    f.branch(real(0) < share,
             [&] { f.assign(value, value * (real(1) - share) + exact_at(fine + real(1)) * share); });
    f.result(value);
  }

  void describe_exact_grad() {
    FunctionWriter f(program, "exact_grad", ValueType::texel,
                     {"The same at the level that fits a pixel: derivatives of the place, in tiles."});
    const At at = place_parameters(f);
    const Steps steps = step_parameters(f);
    f.result(f.call("exact", {at.cell_x, at.cell_y, at.x, at.y, f.call("level_of", steps.all())}));
  }

  LookupProgram& program;
  const PackLookup& lookup;
  const LayoutWords& layout;
  const LookupFeatures& features;
};

} // namespace

void describe_corner_place(LookupProgram& program, const PackLookup& lookup) {
  describe_tile_index(program);
  const LatticeWords& words = lookup.lattice;
  const bool index = words.kind == MappingKind::index;
  PackedTable colors;
  if (index) {
    std::vector<std::uint32_t> entries;
    for (std::uint32_t id = 0; id < lookup.tiles; ++id) {
      const CellColors c = colors_of_tile(lookup, id);
      entries.push_back(c.a | c.b << 4 | c.c << 8 | c.d << 12);
    }
    colors =
        add_table(program, "tile_colors", "the colors of each tile", entries, "bake without a corner pack");
  }
  FunctionWriter f(
      program, "corner_place", ValueType::word,
      {"The cell of the corner pack that stands for cell (x, y) round the corner nearest to a place."});
  const Expression x = f.parameter("x", ValueType::word), y = f.parameter("y", ValueType::word);
  const Expression fx = f.parameter("fraction_x", ValueType::real),
                   fy = f.parameter("fraction_y", ValueType::real);
  const Expression east = f.declare("on_east", select(fx < real(0.5), word(1), word(0)));
  const Expression south = f.declare("on_south", select(fy < real(0.5), word(1), word(0)));
  // The lattice point, and the cells west and north of it.
  const Expression px = f.declare("px", select(east == word(1), x, next_cell(x, words.width)));
  const Expression py = f.declare("py", select(south == word(1), y, next_cell(y, words.height)));
  const Expression west = f.declare("west", previous_cell(px, words.width));
  const Expression north = f.declare("north", previous_cell(py, words.height));
  const auto color = [&](bool vertical, const Expression& i, const Expression& j) {
    if (!index) return f.call(vertical ? "color_v" : "color_h", {i, j});
    return (entry_of(colors, f.call("tile_of", {i, j})) >> word(vertical ? 12 : 0)) & word(15);
  };
  const Expression column = f.call("tile_index", {color(false, west, py), color(false, px, py)});
  const Expression row = f.call("tile_index", {color(true, px, north), color(true, px, py)});
  f.result((column + east) | (row + south) << word(16));
}

LookupProgram describe_lookup(const PackLookup& lookup, const LookupFeatures& features) {
  LookupProgram program;
  describe_lattice(program, lookup, features.border);
  TexelDescription(program, lookup, features).describe();
  return program;
}

} // namespace tilepack
