#include "tilepack/shader/graph_writer.h"

#include <fmt/format.h>

#include <algorithm>

namespace tilepack {

// The function of an index or number, a block each.
struct ValueText {
  GraphWriter& writer;
  NodeId node;

  std::string index_head() const { return fmt::format("int index_{}(Place p) {{\n", node); }
  std::string number_head() const { return fmt::format("float number_{}(Place p) {{\n", node); }
  static std::string index_of(NodeId input, std::string_view place = "p") {
    return fmt::format("index_{}({})", input, place);
  }
  std::string cell_in(PatternGrid grid) const {
    return fmt::format("  uvec2 c = in_grid_{}(p).cell;\n", writer.grid(grid));
  }
  std::string whole_number(NodeId input) const {
    return fmt::format("int(floor(clamp({}, -1e9, 1e9)))", writer.number_or(input, "p", 0));
  }

  template <typename Block>
  std::string operator()(const Block&) const {
    return {}; // a texture
  }

  std::string operator()(const ConstantIndex& b) const {
    return index_head() + fmt::format("  return {};\n}}\n", std::clamp<std::int64_t>(b.value, -1, 1 << 30));
  }
  std::string operator()(const StoredIndex& b) const {
    return index_head() + cell_in(b.map->grid()) +
           fmt::format("  return entry({} + int(c.y) * {} + int(c.x));\n}}\n",
                       writer.stored_map(*b.map, true, node), b.map->size().width);
  }
  std::string operator()(const RandomIndex& b) const {
    return index_head() + cell_in(b.grid) +
           fmt::format("  return {};\n}}\n", writer.hashed_index(writer.values.hash(node), "c", node));
  }
  std::string operator()(const TableIndex& b) const {
    return index_head() +
           fmt::format("  int i = {};\n  return i < 0 ? -1 : entry({} + int({}));\n}}\n", index_of(b.index),
                       writer.table({b.entries.begin(), b.entries.end()}, node),
                       GraphWriter::rest("uint(i)", static_cast<std::int64_t>(b.entries.size())));
  }
  std::string operator()(const MaterialIndex& b) const {
    std::vector<std::int32_t> ends; // of each list: where it begins, and its length
    for (const std::vector<int>& list : b.table.materials) {
      ends.push_back(static_cast<std::int32_t>(std::stoul(writer.table({list.begin(), list.end()}, node))));
      ends.push_back(static_cast<std::int32_t>(list.size()));
    }
    const std::string lists = writer.table(ends, node);
    return index_head() + fmt::format("  int m = {}, i = {};\n  if (m < 0 || m >= {} || i < 0) return -1;\n"
                                      "  return entry(entry({} + 2 * m) + int(rest_of(uint(i), uint(entry({} "
                                      "+ 2 * m + 1)))));\n}}\n",
                                      index_of(b.material), index_of(b.index), b.table.materials.size(),
                                      lists, lists);
  }
  std::string operator()(const DitheredIndex& b) const {
    const std::int64_t finer_x = b.grid.width / b.coarse.width, finer_y = b.grid.height / b.coarse.height;
    return index_head() + cell_in(b.grid) +
           GraphWriter::filled(
               R"(  uvec2 coarse = uvec2($COARSEX, $COARSEY);
  ivec2 first; vec2 b;
  between((vec2(uvec2($RESTX, $RESTY)) + 0.5) / vec2($X, $Y), first, b);
  int v[4];
  for (int k = 0; k < 4; ++k) v[k] = $INDEX(centre_$GRID($MOVED));
  if (v[0] == v[1] && v[0] == v[2] && v[0] == v[3]) return v[0];
  float x = $RANDOMX;
  return dithered(dithered(v[0], v[1], b.x, x), dithered(v[2], v[3], b.x, x), b.y, $RANDOMY);
}
)",
               {{"X", fmt::format("{}.0", finer_x)},
                {"Y", fmt::format("{}.0", finer_y)},
                {"COARSEX", GraphWriter::divided("c.x", finer_x)},
                {"COARSEY", GraphWriter::divided("c.y", finer_y)},
                {"RESTX", GraphWriter::rest("c.x", finer_x)},
                {"RESTY", GraphWriter::rest("c.y", finer_y)},
                {"INDEX", fmt::format("index_{}", b.areas)},
                {"MOVED", writer.neighbour("coarse", "first + ivec2(k & 1, k >> 1)", b.coarse)},
                {"GRID", writer.grid(b.coarse)},
                {"RANDOMX", writer.hashed_number(writer.values.hash(node), "c", node)},
                {"RANDOMY", writer.hashed_number(writer.values.corner_hash(node), "c", node)}});
  }
  std::string operator()(const PixelIndex& b) const {
    std::vector<std::int32_t> squares;
    for (const PixelMap::Square& square : b.map->tree())
      squares.insert(squares.end(), std::begin(square.child), std::end(square.child));
    return index_head() + cell_in(b.map->grid()) +
           fmt::format("  return square_of({}, {}, {}, c);\n}}\n", writer.table(squares, node),
                       b.map->tree_root(), b.map->tree_side());
  }
  std::string operator()(const CornerIndex& b) const {
    return index_head() + cell_in(b.grid) +
           GraphWriter::filled(R"(  int code = 0;
  for (int k = 0; k < 4; ++k) {
    int m = $INDEX(centre_$GRID($MOVED));
    if (m < 0 || m >= $M) return -1;
    code = code * $M + m;
  }
  return code;
}
)",
                               {{"INDEX", fmt::format("index_{}", b.material)},
                                {"MOVED", writer.neighbour("c", "ivec2(k & 1, k >> 1)", b.grid)},
                                {"GRID", writer.grid(b.grid)},
                                {"M", std::to_string(b.families)}});
  }
  std::string operator()(const AnimationIndex& b) const {
    writer.program.moves = true;
    const auto rest = [&](NodeId of, NodeId density) {
      return fmt::format("rest_steps({}, {})", writer.number_or(density, "p", 1),
                         writer.number_or(of, "p", 0));
    };
    const std::string head =
        index_head() + cell_in(b.grid) + fmt::format("  p = centre_{}(c);\n", writer.grid(b.grid));
    const std::string phase = fmt::format("floor({})", writer.number_or(b.phase, "p", 0));
    const std::string after = rest(b.rest, b.density);
    if (!b.changes)
      return head +
             fmt::format("  return int(cycle({}.0, {}, {}, floor(now)));\n}}\n", b.length, after, phase);
    return head + fmt::format("  return int(transition({}.0, {}, {}, {}, {}.0, floor(now)));\n}}\n", b.length,
                              rest(b.rest_before, b.density_before), after, phase, b.changed);
  }
  std::string operator()(const FlooredIndex& b) const {
    return index_head() + fmt::format("  return {}({}, {}{});\n}}\n", b.wrap ? "modulo" : "clamp",
                                      whole_number(b.number), b.wrap ? "" : "0, ",
                                      b.wrap ? b.values : b.values - 1);
  }

  std::string operator()(const ConstantNumber& b) const {
    return number_head() + fmt::format("  return {};\n}}\n", GraphWriter::real(b.value));
  }
  std::string operator()(const RandomNumber& b) const {
    return number_head() + cell_in(b.grid) +
           fmt::format("  return {} + {} * {};\n}}\n", GraphWriter::real(b.low),
                       GraphWriter::real(b.high - b.low),
                       writer.hashed_number(writer.values.hash(node), "c", node));
  }
  std::string operator()(const StoredNumber& b) const {
    const std::string words = writer.stored_map(*b.map, false, node);
    const auto at = [&](std::string_view cell) {
      return fmt::format("real_entry({0} + int({1}.y) * {2} + int({1}.x))", words, cell, b.map->size().width);
    };
    const std::string end = fmt::format("  return value * {} + {};\n}}\n", GraphWriter::real(b.scale),
                                        GraphWriter::real(b.offset));
    if (!b.smooth)
      return number_head() + cell_in(b.map->grid()) + fmt::format("  float value = {};\n", at("c")) + end;
    return number_head() +
           GraphWriter::filled(
               R"(  Place at = in_grid_$GRID(p);
  ivec2 first; vec2 b;
  between(at.part, first, b);
  float v[4];
  for (int k = 0; k < 4; ++k) {
    uvec2 c = $MOVED;
    v[k] = $ENTRY;
  }
  float value = mix(mix(v[0], v[1], b.x), mix(v[2], v[3], b.x), b.y);
)",
               {{"GRID", writer.grid(b.map->grid())},
                {"MOVED", writer.neighbour("at.cell", "first + ivec2(k & 1, k >> 1)", b.map->grid())},
                {"ENTRY", at("c")}}) +
           end;
  }
  std::string operator()(const TimeNumber&) const {
    writer.program.moves = true;
    return number_head() + "  return now;\n}\n";
  }
  std::string operator()(const DistanceNumber& b) const {
    return number_head() + fmt::format("  return length(vec2(away(p.cell.x, p.part.x, {}, {}u), "
                                       "away(p.cell.y, p.part.y, {}, {}u)));\n}}\n",
                                       writer.number_or(b.x, "p", 0), writer.graph.scene.width,
                                       writer.number_or(b.y, "p", 0), writer.graph.scene.height);
  }
  std::string operator()(const IndexedNumber& b) const {
    return number_head() + fmt::format("  return float({});\n}}\n", index_of(b.index));
  }
  std::string operator()(const ArithmeticNumber& b) const {
    return number_head() +
           fmt::format("  float a = {}, b = {};\n", writer.number_or(b.a, "p", 0),
                       writer.number_or(b.b, "p", 1)) +
           fmt::format("  return {};\n}}\n", formula(b.operation));
  }
  static std::string formula(NumberOperation operation) {
    switch (operation) {
    case NumberOperation::add:
      return "a + b";
    case NumberOperation::subtract:
      return "a - b";
    case NumberOperation::multiply:
      return "a * b";
    case NumberOperation::divide:
      return "b == 0.0 ? 0.0 : a / b";
    case NumberOperation::minimum:
      return "min(a, b)";
    case NumberOperation::maximum:
      return "max(a, b)";
    case NumberOperation::modulo:
      return "b == 0.0 ? 0.0 : a - b * floor(a / b)";
    case NumberOperation::sine:
      break;
    }
    return "b * sine_of_turns(a)";
  }
};

std::string GraphWriter::value_text(NodeId node) {
  return std::visit(ValueText{*this, node}, graph.nodes[static_cast<std::size_t>(node)].block);
}

} // namespace tilepack
