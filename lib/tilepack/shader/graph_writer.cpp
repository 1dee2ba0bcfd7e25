#include "tilepack/shader/graph_writer.h"

#include "tilepack/error/error.h"
#include "tilepack/pattern/placed_patterns.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace tilepack {
namespace {

constexpr std::size_t most_words = std::size_t{1} << 24;

// What all graphs need.
constexpr std::string_view prelude = R"(struct Place { uvec2 cell; vec2 part; };
uniform isampler2D tables;
uniform float now;
int entry(int i) { return texelFetch(tables, ivec2(i & 2047, i >> 11), 0).x; }
float real_entry(int i) { return intBitsToFloat(entry(i)); }
// a / n and a % n of any words, a below 2^31 + 2^16: whole numbers divided by what isn't constant take software
// renderers a minute to compile.
uint quotient(uint a, uint n) {
  uint q = uint(float(a) / float(n));
  q += uint(int(floor(float(int(a - q * n)) / float(n))));
  int r = int(a - q * n);
  return q + uint(uint(max(r, 0)) >= n) - uint(r < 0);
}
uint rest_of(uint a, uint n) { return a - quotient(a, n) * n; }
int modulo(int a, int n) {
  int r = int(rest_of(uint(a >= 0 ? a : -(a + 1)), uint(n)));
  return a >= 0 ? r : n - 1 - r;
}
uint around_axis(uint cell, int by, uint cells) {
  uint step = rest_of(uint(by >= 0 ? by : -(by + 1)), cells), to = cell + (by >= 0 ? step : cells - 1u - step);
  return to >= cells ? to - cells : to;
}
uvec2 around(uvec2 cell, ivec2 by, uvec2 cells) { return uvec2(around_axis(cell.x, by.x, cells.x), around_axis(cell.y, by.y, cells.y)); }
// The same where `by` is no farther than the cells are.
uint moved_axis(uint cell, int by, uint cells) {
  uint to = cell + uint(by);
  return by < 0 ? (cell < uint(-by) ? to + cells : to) : (to >= cells ? to - cells : to);
}
uvec2 moved(uvec2 cell, ivec2 by, uvec2 cells) { return uvec2(moved_axis(cell.x, by.x, cells.x), moved_axis(cell.y, by.y, cells.y)); }
uint mix_round(uint v, uint odd) { v *= odd; return v ^ (v >> 15u); }
uint mix_word(uvec4 k, uvec2 c) {
  c.y ^= mix_round(c.x + k.x, 0x85ebca6bu);
  c.x ^= mix_round(c.y + k.y, 0xc2b2ae35u);
  c.y ^= mix_round(c.x + k.z, 0x9e3779b1u);
  c.x ^= mix_round(c.y + k.w, 0x27d4eb2fu);
  return c.x;
}
int scaled(uint word, uint values) { return int(((word >> 16u) * values + (((word & 65535u) * values) >> 16u)) >> 16u); }
float fraction_of(uint word) { return float(word >> 8u) / 16777216.0; }
uint chain(int table, uint n, int steps_x, int steps_y, uvec2 cell) {
  uint s = 0u, g = cell.x;
  for (int i = 0; i < steps_x; ++i, g = quotient(g, n)) s = uint(entry(table + int(rest_of(g + s, n))));
  g = cell.y;
  for (int i = 0; i < steps_y; ++i, g = quotient(g, n)) s = uint(entry(table + int(rest_of(g + s, n))));
  return s;
}
// Between the middles of cells: how many cells back the first is, and the share of the next.
void between(vec2 part, out ivec2 first, out vec2 b) {
  first = ivec2(part.x < 0.5 ? -1 : 0, part.y < 0.5 ? -1 : 0);
  b = part - vec2(first) - 0.5;
}
int dithered(int v1, int v2, float b, float random) { return b > random ? v2 : v1; }
// Steps of animations are floats, exact within 2^24 steps of time 0; and no branches, for the same reason.
float rest_steps(float density, float rest) { return clamp(floor(density * rest), 0.0, 16777216.0); }
float cycle(float n, float rest, float phase, float t) {
  float period = n + rest, at = t + phase, r = at - period * floor(at / period);
  r += period * (float(r < 0.0) - float(r >= period));
  return max(r - rest, 0.0);
}
float transition(float n, float before, float after, float phase, float start, float t) {
  float old = cycle(n, before, phase, start), last = start + (n - old) * float(old > 0.0), entering = cycle(n, after, phase, last);
  float later = cycle(n, after, phase, t) * float(!(entering > 0.0 && t <= last + n - entering));
  return mix(later, cycle(n, before, phase, t), float(t <= last));
}
int square_of(int table, int square, int side, uvec2 c) {
  for (int size = side; square >= 0 && size > 1;) {
    size >>= 1;
    square = entry(table + 4 * square + ((int(c.x) & size) != 0 ? 1 : 0) + ((int(c.y) & size) != 0 ? 2 : 0));
  }
  return -1 - square;
}
float sine_of_turns(float turns) { return sin(6.283185307 * (turns - floor(turns))); }
float away(uint cell, float part, float to, uint units) {
  float whole = floor(part - to), d = float(around_axis(cell, int(clamp(whole, -1e9, 1e9)), units)) + (part - to - whole);
  return min(d, float(units) - d);
}
// The sharpest level that a filter of `aniso` probes along the longer axis reads.
float level_of(vec4 d, vec2 texels) {
  vec4 t = d * texels.xyxy;
  float a = dot(t.xy, t.xy), b = dot(t.zw, t.zw);
  return 0.5 * log2(max(max(min(a, b), max(a, b) / (aniso * aniso)), 1e-30));
}
vec4 tap(sampler2DArray t, vec2 f, int layer, vec4 d, float level, float last) {
  if (filter_mode == 2) {
    vec4 s = d * vec2(textureSize(t, 0).xy).xyxy;
    int l = int(clamp(floor(0.5 * log2(max(max(dot(s.xy, s.xy), dot(s.zw, s.zw)), 1e-30)) + 0.5), 0.0, last));
    ivec2 side = textureSize(t, l).xy;
    return texelFetch(t, ivec3(clamp(ivec2(f * vec2(side)), ivec2(0), side - 1), layer), l);
  }
  if (level >= 0.0) return textureLod(t, vec3(f, float(layer)), level);
  return textureGrad(t, vec3(f, float(layer)), d.xy, d.zw);
}
float flat_value(vec4 v) { return v.a > 0.0 ? v.r / v.a : 0.0; }
vec4 over(vec4 top, vec4 below) { return top + (1.0 - top.a) * below; }
// A pattern moved, turned and scaled: its middle in a cell, its sides, cosine and sine.
struct Laid { vec2 middle; float scale; vec2 turn; };
Laid laid(vec2 place, float scale, float turns, bool stays) {
  Laid t = Laid(clamp(place, 0.0, 1.0), scale > 0.0 ? min(scale, stays ? 1.0 : $LARGEST) : 0.0, vec2(sine_of_turns(turns + 0.25), sine_of_turns(turns)));
  if (!stays) return t;
  float box = abs(t.turn.x) + abs(t.turn.y);
  t.scale = min(t.scale, 1.0 / box);
  t.middle = 0.5 + (t.middle - 0.5) * max(0.0, 1.0 - t.scale * box);
  return t;
}
// Where in it a place of the cell lies, and how much of a pixel there it covers; `texels` of the set, d in cells.
vec2 within(Laid t, vec2 at) {
  vec2 r = at - t.middle;
  return vec2(r.x * t.turn.x + r.y * t.turn.y, r.y * t.turn.x - r.x * t.turn.y) / t.scale + 0.5;
}
vec4 turned(Laid t, vec4 d) {
  return vec4(d.x * t.turn.x + d.y * t.turn.y, d.y * t.turn.x - d.x * t.turn.y, d.z * t.turn.x + d.w * t.turn.y, d.w * t.turn.x - d.z * t.turn.y) / t.scale;
}
float share_of(vec2 u, vec4 d, vec2 texels, float last) {
  if (filter_mode == 2) return u.x >= 0.0 && u.y >= 0.0 && u.x < 1.0 && u.y < 1.0 ? 1.0 : 0.0;
  vec2 side = max(texels * exp2(-clamp(level_of(d, texels), 0.0, last)), 1.0), s = clamp(min(u * side, (1.0 - u) * side) + 0.5, 0.0, 1.0);
  return s.x * s.y;
}
)";

} // namespace

std::string GraphWriter::filled(std::string_view text,
                                std::initializer_list<std::pair<std::string_view, std::string>> names) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] != '$') {
      result += text[at++];
      continue;
    }
    std::size_t end = at + 1;
    while (end < text.size() && text[end] >= 'A' && text[end] <= 'Z') ++end;
    const std::string_view name = text.substr(at + 1, end - at - 1);
    for (const auto& [known, stands] : names)
      if (known == name) result += stands;
    at = end;
  }
  return result;
}

std::string GraphWriter::real(double value) {
  if (!std::isfinite(value)) return "0.0";
  std::string text = fmt::format("{}", static_cast<float>(value));
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return value < 0 ? "(" + text + ")" : text;
}

void GraphWriter::refuse(NodeId node, const std::string& what) const {
  throw Error(ErrorKind::invalid_content,
              fmt::format("node '{}'", graph.nodes[static_cast<std::size_t>(node)].name), what);
}

std::string GraphWriter::divided(const std::string& word, std::int64_t by) {
  if (by == 1) return word;
  const auto divisor = static_cast<std::uint64_t>(by);
  return std::has_single_bit(divisor) ? fmt::format("({} >> {})", word, std::countr_zero(divisor))
                                      : fmt::format("quotient({}, {}u)", word, by);
}

std::string GraphWriter::rest(const std::string& word, std::int64_t by) {
  if (by == 1) return "0u";
  return std::has_single_bit(static_cast<std::uint64_t>(by)) ? fmt::format("({} & {}u)", word, by - 1)
                                                             : fmt::format("rest_of({}, {}u)", word, by);
}

// in_grid_N(Place p): a place of the scene in a grid; centre_N(uvec2 cell): the middle of a cell, in the scene.
std::string GraphWriter::grid(PatternGrid of) {
  const auto known = std::find(grids.begin(), grids.end(), of);
  const auto number = std::to_string(known - grids.begin());
  if (known != grids.end()) return number;
  grids.push_back(of);
  const auto axis = [&](std::int64_t cells, std::int64_t units, char name) {
    const std::int64_t finer = std::max<std::int64_t>(cells / units, 1),
                       coarser = std::max<std::int64_t>(units / cells, 1);
    program.common += filled("void in_grid_axis_$N$AXIS(inout uint cell, inout float part) {\n",
                             {{"N", number}, {"AXIS", {name}}});
    if (finer > 1)
      program.common += fmt::format(
          "  float whole = min(floor(part * {0}.0), {1}.0);\n  cell = cell * {0}u + uint(whole);\n"
          "  part = min(part * {0}.0 - whole, 0.99999994);\n",
          finer, finer - 1);
    if (coarser > 1)
      program.common += fmt::format(
          "  uint before = cell;\n  cell = {};\n  part = min((float({}) + part) / {}.0, 0.99999994);\n",
          divided("before", coarser), rest("before", coarser), coarser);
    program.common += filled("}\nvoid centre_axis_$N$AXIS(inout uint cell, out float part) {\n",
                             {{"N", number}, {"AXIS", {name}}});
    program.common += fmt::format("  part = {};\n", coarser > 1 && coarser % 2 == 0 ? "0.0" : "0.5");
    if (coarser > 1) program.common += fmt::format("  cell = cell * {}u + {}u;\n", coarser, coarser / 2);
    if (finer > 1)
      program.common +=
          fmt::format("  uint before = cell;\n  cell = {};\n  part = (float({}) + part) / {}.0;\n",
                      divided("before", finer), rest("before", finer), finer);
    program.common += "}\n";
  };
  axis(of.width, graph.scene.width, 'x');
  axis(of.height, graph.scene.height, 'y');
  program.common += filled(R"(Place in_grid_$N(Place p) {
  in_grid_axis_$Nx(p.cell.x, p.part.x); in_grid_axis_$Ny(p.cell.y, p.part.y);
  return p;
}
Place centre_$N(uvec2 cell) {
  Place p; p.cell = cell;
  centre_axis_$Nx(p.cell.x, p.part.x); centre_axis_$Ny(p.cell.y, p.part.y);
  return p;
}
)",
                           {{"N", number}});
  return number;
}

std::string GraphWriter::neighbour(std::string_view cell, std::string_view by, PatternGrid grid) const {
  const bool roomy = std::min(grid.width, grid.height) > 2; // neighbours are two cells away at most
  return fmt::format("{}({}, {}, {})", roomy ? "moved" : "around", cell, by, cell_count(grid));
}

std::string GraphWriter::cell_count(PatternGrid grid) const {
  return fmt::format("uvec2({}u, {}u)", grid.width, grid.height);
}

std::string GraphWriter::cells_a_unit(PatternGrid grid) const {
  const std::string x = real(GridAxis(grid.width, graph.scene.width).ratio());
  const std::string y = real(GridAxis(grid.height, graph.scene.height).ratio());
  return fmt::format("vec4({0}, {1}, {0}, {1})", x, y);
}

std::string GraphWriter::hashed_index(const CellHash& hash, std::string_view cell, NodeId node) {
  const auto& k = hash.mix_keys_drawn().k;
  if (hash.kind() == HashKind::mix)
    return fmt::format("scaled(mix_word(uvec4({}u, {}u, {}u, {}u), {}), {}u)", k[0], k[1], k[2], k[3], cell,
                       hash.values());
  return fmt::format("int(chain({}, {}u, {}, {}, {}) % {}u)", table_once(hash.permutation(), node),
                     hash.table_length(), hash.chain_steps_x(), hash.chain_steps_y(), cell, hash.values());
}

std::string GraphWriter::hashed_number(const CellHash& hash, std::string_view cell, NodeId node) {
  const auto& k = hash.mix_keys_drawn().k;
  if (hash.kind() == HashKind::mix)
    return fmt::format("fraction_of(mix_word(uvec4({}u, {}u, {}u, {}u), {}))", k[0], k[1], k[2], k[3], cell);
  return fmt::format("float(chain({}, {}u, {}, {}, {})) / {}.0", table_once(hash.permutation(), node),
                     hash.table_length(), hash.chain_steps_x(), hash.chain_steps_y(), cell,
                     hash.table_length());
}

std::string GraphWriter::number_or(NodeId node, std::string_view place, double otherwise) const {
  return node == no_node ? real(otherwise) : fmt::format("number_{}({})", node, place);
}

void GraphWriter::make_room(std::size_t more, NodeId node) const {
  if (program.words.size() + more > most_words)
    refuse(node,
           fmt::format("with the maps of the nodes before it the scene has more than 2^24 stored numbers, "
                       "which a page does not hold; make its maps coarser"));
}

std::string GraphWriter::table(const std::vector<std::int32_t>& words, NodeId node) {
  make_room(words.size(), node);
  const std::size_t first = program.words.size();
  program.words.insert(program.words.end(), words.begin(), words.end());
  return std::to_string(first);
}

std::string GraphWriter::stored_map(const StoredMap& map, bool is_whole, NodeId node) {
  for (const auto& [known, where] : placed)
    if (known == &map) return where;
  make_room(static_cast<std::size_t>(map.size().width) * static_cast<std::size_t>(map.size().height), node);
  std::vector<std::int32_t> words;
  for (const float value : map.all().values)
    words.push_back(is_whole ? static_cast<std::int32_t>(std::floor(std::clamp(value, -1.0f, 1e9f)))
                             : std::bit_cast<std::int32_t>(value));
  placed.emplace_back(&map, table(words, node));
  return placed.back().second;
}

GraphProgram GraphWriter::write() {
  const std::vector<bool> reached = reachable_nodes(graph);
  program.common = filled(prelude, {{"LARGEST", real(largest_scale)}});
  program.common +=
      filled("Place place_at(uvec2 from, vec2 p) {\n"
             "  vec2 whole = floor(p);\n"
             "  return Place(around(from, ivec2(whole), $CELLS), min(p - whole, 0.99999994));\n}\n",
             {{"CELLS", cell_count(graph.scene)}});
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    if (!reached[i]) continue;
    const NodeId node = static_cast<NodeId>(i);
    if (kind_of(graph.nodes[i].block) != ValueKind::texture) program.common += value_text(node);
    if (source_of(graph.nodes[i].block) == nullptr) continue;
    program.finest.width = std::max(program.finest.width, values.mapping(node).x.cells);
    program.finest.height = std::max(program.finest.height, values.mapping(node).y.cells);
  }
  for (std::size_t m = 0; m < graph.maps.size(); ++m) {
    const int map = static_cast<int>(m);
    GraphMapText text;
    part = &text;
    readers.clear();
    if (graph.maps[m].channels == 4 && !graph.maps[m].has_alpha())
      throw Error(
          ErrorKind::invalid_content, "scene",
          fmt::format(
              "its map \"{}\" has 4 channels without alpha, of which a page shows 3; leave it out of `maps`",
              graph.maps[m].name));
    for (std::size_t i = 0; i < graph.nodes.size(); ++i)
      if (reached[i] && kind_of(graph.nodes[i].block) == ValueKind::texture)
        text.text += texture_text(static_cast<NodeId>(i), map);
    text.text += fmt::format("vec4 scene_{0}(Place p, vec4 d) {{ return texture_{1}_{0}(p, d); }}\n", map,
                             graph.output);
    std::sort(text.needs.begin(), text.needs.end());
    text.needs.erase(std::unique(text.needs.begin(), text.needs.end()), text.needs.end());
    std::sort(text.samplers.begin(), text.samplers.end());
    text.samplers.erase(std::unique(text.samplers.begin(), text.samplers.end()), text.samplers.end());
    program.maps.push_back(std::move(text));
  }
  return std::move(program);
}

GraphProgram graph_program(const PatternGraph& graph) {
  return GraphWriter(graph).write();
}

} // namespace tilepack
