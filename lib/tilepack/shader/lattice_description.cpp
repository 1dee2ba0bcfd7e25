#include "tilepack/error/field.h"
#include "tilepack/layout/tile_index.h"
#include "tilepack/shader/lookup_description.h"

#include <algorithm>
#include <bit>
#include <utility>
#include <vector>

namespace tilepack {
namespace {

constexpr double below_one = 1.0 - 0x1p-24; // as a float
constexpr std::uint32_t longest_side = std::uint32_t{1} << 31;

// a mod n; a is below 2^31.
Expression modulo(Expression a, std::uint32_t n) {
  return std::has_single_bit(n) ? std::move(a) & word(n - 1) : std::move(a) % word(n);
}

/// Writes the functions of one pack's lattice.
class LatticeDescription {
public:
  LatticeDescription(LookupProgram& of_program, const PackLookup& of_lookup, WrapMode of_border)
      : program(of_program), lookup(of_lookup), words(of_lookup.lattice), border(of_border) {}

  void describe() {
    describe_axis("x", words.width);
    describe_axis("y", words.height);
    if (words.kind == MappingKind::index) {
      FunctionWriter f(program, "tile_of", ValueType::word, {});
      const Expression x = f.parameter("x", ValueType::word), y = f.parameter("y", ValueType::word);
      f.result(fetch(Operation::fetch_id, PackTextureSlot::tiles, {x, y, word(words.width)}));
    } else {
      describe_colors();
      describe_tile();
    }
    describe_place();
    describe_public("tile", {"The id of the tile in a cell of the virtual texture."});
    describe_public("place",
                    {"Where that tile lies in the pack: column in bits 0..15, row or layer in bits 16..31."});
  }

private:
  // Cell coordinate → cell within the virtual texture; and, where the texture doesn't wrap, the fraction that is shown
  // there.
  void describe_axis(const std::string& axis, std::uint32_t side) {
    FunctionWriter f(program, "cell_" + axis, ValueType::word, {});
    const Expression i = f.parameter("i", ValueType::whole);
    const Expression negative = i < whole(0);
    const Expression bits = to_word(i);
    Expression backwards = negative; // mirror: in tiles that are turned round
    if (border == WrapMode::clamp) {
      const Expression inside = side == longest_side ? bits : minimum(bits, word(side - 1));
      f.result(select(negative, word(0), inside));
    } else if (border == WrapMode::wrap) {
      f.result(wrapped(bits, negative, side));
    } else if (side == longest_side) {
      f.result(select(negative, ~bits, bits));
    } else {
      const Expression turned = wrapped(bits, negative, 2 * side);
      const Expression at = f.declare("turned", turned);
      f.result(select(at < word(side), at, word(2 * side - 1) - at));
      backwards = word(side) <= turned;
    }
    if (border == WrapMode::wrap) return;
    FunctionWriter g(program, "fraction_" + axis, ValueType::real, {});
    g.parameter("i", ValueType::whole);
    const Expression fraction = g.parameter("fraction", ValueType::real);
    if (border == WrapMode::mirror) {
      g.result(select(backwards, minimum(real(1) - fraction, real(below_one)), fraction));
      return;
    }
    const Expression beyond =
        side == longest_side ? fraction : select(word(side) <= bits, real(below_one), fraction);
    g.result(select(negative, real(0), beyond));
  }

  static Expression wrapped(const Expression& bits, const Expression& negative, std::uint32_t side) {
    if (std::has_single_bit(side)) return bits & word(side - 1);
    return select(negative, word(side - 1) - ~bits % word(side), bits % word(side));
  }

  // H, V and C of lattice_words.h.
  Expression hashed(FunctionWriter& f, const MixKeys& keys, const Expression& x, const Expression& y) {
    return f.call("mix_word", {x, y, word(keys.k[0]), word(keys.k[1]), word(keys.k[2]), word(keys.k[3])});
  }

  static Expression scaled(const Expression& hash, std::uint32_t colors) {
    if (colors == 1) return word(0);
    if (std::has_single_bit(colors))
      return hash >> word(32 - static_cast<std::uint32_t>(std::countr_zero(colors)));
    return (hash >> word(16)) * word(colors) >> word(16);
  }

  void describe_mix() {
    FunctionWriter f(program, "mix_word", ValueType::word,
                     {"32 random bits for the pair (x, y): four rounds of a Feistel network."});
    const Expression x = f.parameter("x", ValueType::word), y = f.parameter("y", ValueType::word);
    std::vector<Expression> keys;
    for (const char* name : {"k0", "k1", "k2", "k3"}) keys.push_back(f.parameter(name, ValueType::word));
    const Expression a = f.declare("a", x), b = f.declare("b", y),
                     v = f.declare("v", (a + keys[0]) * word(0x85ebca6bu));
    f.assign(b, b ^ v ^ (v >> word(15)));
    f.assign(v, (b + keys[1]) * word(0xc2b2ae35u));
    f.assign(a, a ^ v ^ (v >> word(15)));
    f.assign(v, (a + keys[2]) * word(0x9e3779b1u));
    f.assign(b, b ^ v ^ (v >> word(15)));
    f.assign(v, (b + keys[3]) * word(0x27d4eb2fu));
    f.result(a ^ v ^ (v >> word(15)));
  }

  void describe_even() {
    std::vector<std::uint32_t> colors(words.table, words.table + words.table_length);
    const PackedTable pattern = add_table(program, "pattern", "the pattern of corner colors", colors,
                                          "bake with " + field("mapping", "mix"));
    FunctionWriter f(program, "even_color", ValueType::word,
                     {"The color of corner (x, y) in a block of 64 x 64 corners that has this word."});
    const Expression block = f.parameter("block", ValueType::word);
    const Expression x = f.parameter("x", ValueType::word), y = f.parameter("y", ValueType::word);
    const auto bit = [&](std::uint32_t number) { return (block >> word(number)) & word(1); };
    const Expression u = f.declare("u", ((x + block) ^ (word(0) - bit(12))) & word(63));
    const Expression v = f.declare("v", ((y + (block >> word(6))) ^ (word(0) - bit(13))) & word(63));
    const Expression at =
        f.declare("at", select(bit(14) == word(1), u << word(6) | v, v << word(6) | u)); // row by row
    const Expression color =
        f.declare("shade", entry_of(pattern, at) + scaled(block, words.horizontal_colors));
    f.result(select(color < word(words.horizontal_colors), color, color - word(words.horizontal_colors)));
  }

  void describe_permutation() {
    std::vector<std::uint32_t> entries(words.table, words.table + words.table_length);
    const PackedTable table =
        add_table(program, "permutation", "the permutation table", entries,
                  "bake with " + field("mapping", "mix") + ", or a smaller " + field("virtual-size"));
    FunctionWriter f(program, "permuted", ValueType::word, {});
    f.result(entry_of(table, modulo(f.parameter("i", ValueType::word), words.table_length)));
  }

  // color_h(x, y) = H or C, color_v(x, y) = V, of a cell within the virtual texture.
  void describe_color(const std::string& name, bool vertical) {
    FunctionWriter f(program, name, ValueType::word, {});
    const Expression x = f.parameter("x", ValueType::word), y = f.parameter("y", ValueType::word);
    const std::uint32_t colors = vertical ? words.vertical_colors : words.horizontal_colors;
    if (words.kind == MappingKind::mix) {
      f.result(scaled(hashed(f, vertical ? words.vertical_keys : words.horizontal_keys, x, y), colors));
      return;
    }
    // [Wei04, Eq. 2]; the remainder before the sum too, so that nothing reaches 2^31.
    const std::uint32_t n = words.table_length;
    if (vertical)
      f.result(
          modulo(f.call("permuted", {modulo(x, n) + f.call("permuted", {modulo(y, n) << word(1)})}), colors));
    else
      f.result(modulo(f.call("permuted", {f.call("permuted", {x}) + modulo(y, n)}), colors));
  }

  void describe_colors() {
    if (words.kind != MappingKind::permutation) describe_mix();
    if (words.kind == MappingKind::permutation) describe_permutation();
    if (words.kind == MappingKind::even)
      describe_even();
    else
      describe_color("color_h", false);
    if (words.corner_colored == 0) describe_color("color_v", true);

    FunctionWriter f(program, "colors", ValueType::word,
                     {words.corner_colored == 1
                          ? "The colors of a cell's corners, a byte each: nw, ne, sw, se."
                          : "The colors of a cell's edges, a byte each: north, east, south, west."});
    const Expression x = f.parameter("x", ValueType::word), y = f.parameter("y", ValueType::word);
    const Expression xe = f.declare("xe", next_cell(x, words.width)),
                     ys = f.declare("ys", next_cell(y, words.height));
    std::vector<Expression> of{word(0), word(0), word(0), word(0)};
    if (words.kind == MappingKind::even) {
      const auto block = [&](const Expression& i, const Expression& j) {
        return hashed(f, words.horizontal_keys, i >> word(even_block_bits), j >> word(even_block_bits));
      };
      const Expression nw = f.declare("nw", block(x, y)), ne = f.declare("ne", nw), sw = f.declare("sw", nw),
                       se = f.declare("se", nw);
      f.branch(word(0) < ((x ^ xe) | (y ^ ys)) >> word(even_block_bits), [&] {
        f.remark("not all four in one block");
        f.assign(ne, block(xe, y));
        f.assign(sw, block(x, ys));
        f.assign(se, block(xe, ys));
      });
      of = {f.call("even_color", {nw, x, y}), f.call("even_color", {ne, xe, y}),
            f.call("even_color", {sw, x, ys}), f.call("even_color", {se, xe, ys})};
    } else if (words.corner_colored == 1) {
      of = {f.call("color_h", {x, y}), f.call("color_h", {xe, y}), f.call("color_h", {x, ys}),
            f.call("color_h", {xe, ys})};
    } else {
      of = {f.call("color_h", {x, y}), f.call("color_v", {xe, y}), f.call("color_h", {x, ys}),
            f.call("color_v", {x, y})};
    }
    f.result(of[0] | of[1] << word(8) | of[2] << word(16) | of[3] << word(24));
  }

  static Expression digit(const Expression& colors, std::uint32_t number) {
    if (number == 0) return colors & word(255);
    return number == 3 ? colors >> word(24) : (colors >> word(8 * number)) & word(255);
  }

  void describe_tile() {
    FunctionWriter f(program, "tile_of", ValueType::word, {});
    const Expression x = f.parameter("x", ValueType::word), y = f.parameter("y", ValueType::word);
    const Expression c = f.declare("c", f.call("colors", {x, y}));
    const Expression kh = word(words.horizontal_colors), kv = word(words.vertical_colors);
    f.result(((digit(c, 0) * kv + digit(c, 1)) * kh + digit(c, 2)) * kv + digit(c, 3));
  }

  bool tile_index_from_colors() const {
    if (lookup.layout_kind != LayoutKind::tile_index || words.kind == MappingKind::index) return false;
    for (std::uint32_t id = 0; id < lookup.tiles; ++id) {
      const CellColors c = colors_of_tile(lookup, id);
      const auto place = [](std::uint32_t a, std::uint32_t b) {
        return static_cast<std::uint32_t>(tile_index_1d(static_cast<int>(a), static_cast<int>(b)));
      };
      if (place_of_tile(lookup, id) != TexturePlace{place(c.d, c.b), place(c.a, c.c)}) return false;
    }
    return true;
  }

  void describe_place() {
    if (tile_index_from_colors()) {
      tilepack::describe_tile_index(program);
      FunctionWriter f(program, "place_of", ValueType::word, {});
      const Expression x = f.parameter("x", ValueType::word), y = f.parameter("y", ValueType::word);
      const Expression c = f.declare("c", f.call("colors", {x, y}));
      f.result(f.call("tile_index", {digit(c, 3), digit(c, 1)}) |
               f.call("tile_index", {digit(c, 0), digit(c, 2)}) << word(16));
      return;
    }
    bool layers = true; // row = id
    std::uint32_t columns = 0, rows = 0;
    for (std::uint32_t id = 0; id < lookup.tiles; ++id) {
      const TexturePlace place = place_of_tile(lookup, id);
      layers = layers && place == TexturePlace{0, id};
      columns = std::max(columns, place.column);
      rows = std::max(rows, place.row);
    }
    if (layers) {
      FunctionWriter f(program, "place_of", ValueType::word, {});
      const Expression x = f.parameter("x", ValueType::word), y = f.parameter("y", ValueType::word);
      f.result(f.call("tile_of", {x, y}) << word(16));
      return;
    }
    // Column and row in the halves of an entry.
    const std::uint32_t half = std::max(bits_for(columns), bits_for(rows));
    std::vector<std::uint32_t> entries;
    for (std::uint32_t id = 0; id < lookup.tiles; ++id) {
      const TexturePlace place = place_of_tile(lookup, id);
      entries.push_back(place.column | place.row << half);
    }
    if (half > 8) { // a word each
      LookupTable table{"places", "column and row of each tile", {}};
      for (std::uint32_t id = 0; id < lookup.tiles; ++id) table.words.push_back(lookup.places[id]);
      program.tables.push_back(std::move(table));
      FunctionWriter f(program, "place_of", ValueType::word, {});
      const Expression x = f.parameter("x", ValueType::word), y = f.parameter("y", ValueType::word);
      f.result(table_word("places", f.call("tile_of", {x, y})));
      return;
    }
    PackedTable table =
        add_table(program, "places", "column and row of each tile", entries, "bake fewer tiles");
    FunctionWriter f(program, "place_of", ValueType::word, {});
    const Expression x = f.parameter("x", ValueType::word), y = f.parameter("y", ValueType::word);
    const Expression id = f.declare("id", f.call("tile_of", {x, y}));
    const Expression at = f.declare("at", entry_of(table, id));
    f.result((at & word((1u << half) - 1)) | at >> word(half) << word(16));
  }

  void describe_public(const std::string& name, std::vector<std::string> comment) {
    FunctionWriter f(program, name, ValueType::word, std::move(comment));
    const Expression x = f.parameter("cell_x", ValueType::whole), y = f.parameter("cell_y", ValueType::whole);
    f.result(f.call(name + "_of", {f.call("cell_x", {x}), f.call("cell_y", {y})}));
  }

  LookupProgram& program;
  const PackLookup& lookup;
  const LatticeWords& words;
  WrapMode border;
};

} // namespace

void describe_tile_index(LookupProgram& program) {
  if (program.function("tile_index") != nullptr) return;
  FunctionWriter f(
      program, "tile_index", ValueType::word,
      {"Where the tile that joins color a to color b stands in its row or column. [Wei04, Eq. 6]"});
  const Expression a = f.parameter("a", ValueType::word), b = f.parameter("b", ValueType::word);
  const Expression square = f.declare("square", (a + word(1)) * (a + word(1)));
  f.result(select(a < b, b * b + a * word(2),
                  select(b == word(0), select(a == word(0), word(0), square - word(1)),
                         select(a == b, square - word(2), a * a + b * word(2) - word(1)))));
}

Expression next_cell(const Expression& i, std::uint32_t side) {
  if (side == 1) return word(0);
  if (std::has_single_bit(side)) return (i + word(1)) & word(side - 1);
  return select(i == word(side - 1), word(0), i + word(1));
}

Expression previous_cell(const Expression& i, std::uint32_t side) {
  if (side == 1) return word(0);
  if (std::has_single_bit(side)) return (i - word(1)) & word(side - 1);
  return select(i == word(0), word(side - 1), i - word(1));
}

void describe_lattice(LookupProgram& program, const PackLookup& lookup, WrapMode border) {
  LatticeDescription(program, lookup, border).describe();
}

} // namespace tilepack
