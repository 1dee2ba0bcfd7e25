#include "tilepack/error/error.h"
#include "tilepack/pattern/placed_patterns.h"
#include "tilepack/shader/graph_writer.h"
#include "tilepack/shader/shader_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace tilepack {
namespace {

constexpr std::size_t most_sprites_shown = 1024;
constexpr int most_layers = 2048;

std::int32_t bits_of(double value) {
  return std::bit_cast<std::int32_t>(static_cast<float>(value));
}

} // namespace

bool GraphWriter::is_vector_map(int map) const {
  const PatternMapFacts& facts = graph.maps[static_cast<std::size_t>(map)];
  return facts.role == Role::normal && facts.channels >= 3;
}

int GraphWriter::source_number(const std::shared_ptr<const PatternSource>& source) {
  const auto known = std::find(sources.begin(), sources.end(), source);
  if (known == sources.end()) sources.push_back(source);
  return static_cast<int>(std::find(sources.begin(), sources.end(), source) - sources.begin());
}

int GraphWriter::sampler(GraphSampler::Kind kind, const std::shared_ptr<const PatternSource>& source, int map,
                         bool is_array) {
  static constexpr const char* words[] = {"patterns", "tiles", "corners", "ids"};
  const std::string name = fmt::format("{}_{}_{}", words[static_cast<int>(kind)], source_number(source), map);
  std::size_t at = 0;
  while (at < program.samplers.size() && program.samplers[at].name != name) ++at;
  if (at == program.samplers.size()) program.samplers.push_back({name, kind, source, map, is_array});
  part->samplers.push_back(static_cast<int>(at));
  return static_cast<int>(at);
}

namespace {

// What a source has of a map: `read` gives a texel of a map of the graph.
template <class Read>
std::string shaped(const PackFacts& facts, int map, const PatternMapFacts& of_map, Read read) {
  const bool there = facts.map_of[static_cast<std::size_t>(map)] >= 0;
  const std::string cover = facts.alpha_map < 0 ? "1.0" : read(facts.alpha_map) + ".a";
  if (!there)
    return fmt::format(
        "vec4({}, 1.0) * {}",
        of_map.role == Role::normal && of_map.channels >= 3 ? "0.5, 0.5, 1.0" : "0.0, 0.0, 0.0", cover);
  if (facts.alpha_map == map) return read(map);
  return fmt::format("vec4({}.rgb, 1.0) * {}", read(map), cover);
}

} // namespace

// pattern_SOURCE_MAP(f, layer, d, level): the place f of a pattern; level -1: by d, in tiles.
std::string GraphWriter::pattern_reader(NodeId node, const std::shared_ptr<const PatternSource>& source,
                                        int map) {
  const PackFacts& facts = source->facts();
  if (facts.tiles > most_layers)
    refuse(node, fmt::format("its set has {} patterns, of which a page holds {}; name fewer", facts.tiles,
                             most_layers));
  const std::string name = fmt::format("pattern_{}_{}", source_number(source), map);
  if (std::find(readers.begin(), readers.end(), name) != readers.end()) return name;
  readers.push_back(name);
  const auto read = [&](int of_map) {
    const int at = sampler(GraphSampler::Kind::patterns, source, of_map, true);
    return fmt::format("tap({}, f, layer, d, level, {}.0)",
                       program.samplers[static_cast<std::size_t>(at)].name, facts.levels - 1);
  };
  part->text += fmt::format("vec4 {}(vec2 f, int layer, vec4 d, float level) {{ return {}; }}\n", name,
                            shaped(facts, map, graph.maps[static_cast<std::size_t>(map)], read));
  return name;
}

// Reads the pack once, and writes its lookup.
const GraphWriter::WangFacts& GraphWriter::wang_facts(NodeId node, const PatternSource& source, int number) {
  const auto found = wangs.find(number);
  if (found != wangs.end()) return found->second;
  WangFacts known;
  while (source.facts().map_of[static_cast<std::size_t>(known.any)] < 0) ++known.any;
  const Pack pack = source.stored_pack(known.any, PatternSource::Use::wang);
  known.layers = pack.layout.kind == LayoutKind::array;
  known.ids = pack.mapping.kind == MappingKind::index;
  known.corners = pack.corner_pack.has_value();
  try {
    ShaderSettings settings;
    settings.name = fmt::format("wang{}", number);
    settings.has_head = false;
    program.common += shader_text(pack, settings, {}, 0);
  } catch (const Error& error) {
    refuse(node, fmt::format("{}: {}", source.facts().name, error.what_happened()));
  }
  return wangs.emplace(number, known).first->second;
}

// wang_SOURCE_MAP(c, f, d): the place f of cell c of a pack's virtual texture.
std::string GraphWriter::wang_reader(NodeId node, const WangTexture& block, int map) {
  const PackFacts& facts = block.source->facts();
  const int number = source_number(block.source);
  const std::string name = fmt::format("wang_{}_{}", number, map), prefix = fmt::format("wang{}", number);
  if (std::find(readers.begin(), readers.end(), name) != readers.end()) return name;
  readers.push_back(name);
  const WangFacts& known = wang_facts(node, *block.source, number);
  const std::string place = "c.x, c.y, f.x, f.y";
  const auto name_of_sampler = [&](GraphSampler::Kind kind, int of_map, bool is_array) {
    return program.samplers[static_cast<std::size_t>(sampler(kind, block.source, of_map, is_array))].name;
  };
  const auto read = [&](int of_map) {
    const std::string tiles = name_of_sampler(GraphSampler::Kind::tiles, of_map, known.layers);
    const std::string index =
        known.ids ? name_of_sampler(GraphSampler::Kind::ids, known.any, false) + ", " : "";
    const std::string corners =
        known.corners ? name_of_sampler(GraphSampler::Kind::corners, of_map, false) + ", " : "";
    return fmt::format(
        "(filter_mode == 2 ? {0}_nearest({1}, {2}{3}, int(clamp(floor({0}_level_of(d.x, d.y, d.z, d.w) "
        "+ 0.5), 0.0, {4}.0))) : {0}_grad({1}, {5}{2}{3}, d.x, d.y, d.z, d.w))",
        prefix, tiles, index, place, facts.levels - 1, corners);
  };
  part->text += fmt::format("vec4 {}(ivec2 c, vec2 f, vec4 d) {{ return {}; }}\n", name,
                            shaped(facts, map, graph.maps[static_cast<std::size_t>(map)], read));
  return name;
}

// The function of a texture, a block each.
struct TextureText {
  GraphWriter& writer;
  NodeId node;
  int map;

  std::string head() const { return fmt::format("vec4 texture_{}_{}(Place p, vec4 d) {{\n", node, map); }
  std::string of(NodeId other, std::string_view place = "p") const {
    return fmt::format("texture_{}_{}({}, d)", other, map, place);
  }
  std::string in_cell(PatternGrid grid) const {
    return fmt::format("  Place at = in_grid_{}(p);\n  vec4 dc = d * {};\n", writer.grid(grid),
                       writer.cells_a_unit(grid));
  }
  static std::string texels_of(const PatternSource& source) {
    const Size tile = source.facts().tile_size;
    return fmt::format("vec2({}.0, {}.0)", tile.width, tile.height);
  }
  std::string choice(const std::vector<NodeId>& textures, std::string_view of_map_text) const {
    std::string text;
    for (std::size_t i = 0; i < textures.size(); ++i)
      text += fmt::format("    case {}: return texture_{}_{}(p, d);\n", i, textures[i], of_map_text);
    return text;
  }

  template <typename Block>
  std::string operator()(const Block&) const {
    return {}; // an index or a number
  }

  std::string operator()(const ConstantTexture& b) const {
    const std::vector<double>& v = b.values[static_cast<std::size_t>(map)];
    const PatternMapFacts& facts = writer.graph.maps[static_cast<std::size_t>(map)];
    if (v.empty()) return head() + "  return vec4(0.0);\n}\n";
    const double cover = facts.has_alpha() ? v.back() : 1;
    const auto value = [&](std::size_t c) { return v[facts.channels < 3 ? 0 : c] * cover; };
    return head() + fmt::format("  return vec4({}, {}, {}, {});\n}}\n", GraphWriter::real(value(0)),
                                GraphWriter::real(value(1)), GraphWriter::real(value(2)),
                                GraphWriter::real(cover));
  }

  std::string operator()(const WangTexture& b) const {
    const std::string reader = writer.wang_reader(node, b, map);
    return head() + in_cell(b.grid) + fmt::format("  return {}(ivec2(at.cell), at.part, dc);\n}}\n", reader);
  }

  std::string operator()(const PatternsTexture& b) const {
    const std::string reader = writer.pattern_reader(node, b.source, map);
    const std::string index = GraphWriter::filled(R"(int shown_$NODE(uvec2 c) {
  int i = index_$INDEX(centre_$GRID(c));
  return i >= 0 && i < $TILES ? i : -1;
}
)",
                                                  {{"NODE", fmt::format("{}_{}", node, map)},
                                                   {"INDEX", std::to_string(b.index)},
                                                   {"GRID", writer.grid(b.grid)},
                                                   {"TILES", std::to_string(b.source->facts().tiles)}});
    if (b.fit != TransformFit::none) return index + placed(b, reader);
    if (!b.seamless)
      return index + head() + in_cell(b.grid) +
             fmt::format("  int i = shown_{}_{}(at.cell);\n  return i < 0 ? vec4(0.0) : {}(at.part, i, dc, "
                         "-1.0);\n}}\n",
                         node, map, reader);
    return index + head() + in_cell(b.grid) +
           GraphWriter::filled(R"(  vec2 texels = $TEXELS;
  float level = clamp(level_of(dc, texels), 0.0, $LAST), fine = floor(level), share = level - fine;
  vec2 outer = 0.5 / max(floor(texels * exp2(-fine - (share > 0.0 ? 1.0 : 0.0))), 1.0), f = at.part;
  bool inner = f.x >= outer.x && f.y >= outer.y && f.x <= 1.0 - outer.x && f.y <= 1.0 - outer.y;
  if (filter_mode == 2) inner = true;
  vec4 sum = vec4(0.0);
  for (int n = 0; n < (inner ? 1 : 8); ++n) {
    int l = n >> 2, i;
    vec2 side = max(floor(texels * exp2(-fine - float(l))), 1.0), half_texel = 0.5 / side, t = f * side - 0.5;
    ivec2 step = ivec2(t.x < 0.0 ? -1 : t.x > side.x - 1.0 ? 1 : 0, t.y < 0.0 ? -1 : t.y > side.y - 1.0 ? 1 : 0);
    ivec2 by = ivec2(n & 1, (n >> 1) & 1), other = step * by;
    vec2 towards = vec2(step), beyond = max(max(-t, t - (side - 1.0)), 0.0), w = mix(1.0 - beyond, beyond, vec2(by));
    vec2 edge = mix(0.5 + towards * (0.5 - half_texel), 0.5 - towards * (0.5 - half_texel), vec2(by));
    vec2 at_tap = inner ? f : vec2(step.x == 0 ? f.x : edge.x, step.y == 0 ? f.y : edge.y);
    float weight = inner ? 1.0 : (l == 0 ? 1.0 - share : share) * w.x * w.y;
    if (!(weight > 0.0)) continue;
    i = shown_$NODE($MOVED);
    if (i >= 0) sum += weight * $READ(at_tap, i, dc, inner ? -1.0 : fine + float(l));
  }
  return sum;
}
)",
                               {{"NODE", fmt::format("{}_{}", node, map)},
                                {"TEXELS", texels_of(*b.source)},
                                {"LAST", fmt::format("{}.0", b.source->facts().levels - 1)},
                                {"READ", reader},
                                {"MOVED", writer.neighbour("at.cell", "other", b.grid)}});
  }

  // Patterns that are moved, turned and scaled.
  std::string placed(const PatternsTexture& b, const std::string& reader) const {
    const bool stays = b.fit == TransformFit::shrink;
    int reach = 0;
    if (!stays) {
      // By the largest scale: half the diagonal, and half a texel of margin where a tile is one texel.
      const double largest = writer.values.same_everywhere(b.scale)
                                 ? std::clamp(writer.values.number_or(b.scale, {}, 1), 0.0, largest_scale)
                                 : largest_scale;
      reach = largest > 0.94 ? 2 : 1;
    }
    return head() + in_cell(b.grid) +
           GraphWriter::filled(R"(  vec4 sum = vec4(0.0);
  for (int y = -$REACH; y <= $REACH; ++y) for (int x = -$REACH; x <= $REACH; ++x) {
    uvec2 c = $MOVED;
    Place m = centre_$GRID(c);
    Laid t = laid(vec2($X, $Y), $SCALE, $TURN, $STAYS);
    if (!(t.scale > 0.0)) continue;
    vec2 u = within(t, at.part - vec2(ivec2(x, y)));
    vec4 du = turned(t, dc);
    float share = share_of(u, du, $TEXELS, $LAST);
    if (!(share > 0.0)) continue;
    int i = shown_$NODE(c);
    if (i >= 0) sum = over($READ(clamp(u, 0.0, 0.99999994), i, du, -1.0) * share, sum);
  }
  return sum;
}
)",
                               {{"REACH", std::to_string(reach)},
                                {"MOVED", writer.neighbour("at.cell", "ivec2(x, y)", b.grid)},
                                {"GRID", writer.grid(b.grid)},
                                {"X", writer.number_or(b.x, "m", 0.5)},
                                {"Y", writer.number_or(b.y, "m", 0.5)},
                                {"SCALE", writer.number_or(b.scale, "m", 1)},
                                {"TURN", writer.number_or(b.rotation, "m", 0)},
                                {"STAYS", stays ? "true" : "false"},
                                {"TEXELS", texels_of(*b.source)},
                                {"LAST", fmt::format("{}.0", b.source->facts().levels - 1)},
                                {"NODE", fmt::format("{}_{}", node, map)},
                                {"READ", reader}});
  }

  std::string operator()(const SpritesTexture& b) const {
    const std::string reader = writer.pattern_reader(node, b.source, map);
    GraphSprites* sprites = nullptr;
    for (GraphSprites& known : writer.program.sprites)
      if (known.node == node) sprites = &known;
    if (sprites == nullptr) {
      const std::vector<int> numbers = b.sprites->numbers();
      if (numbers.size() > most_sprites_shown)
        writer.refuse(
            node,
            fmt::format("has {} sprites, of which a page shows {}; strew them by `tile-transform` instead",
                        numbers.size(), most_sprites_shown));
      std::vector<std::int32_t> words;
      words.reserve(words_of_sprite * numbers.size());
      for (const int number : numbers) {
        const Sprite& s = b.sprites->sprite(number);
        words.insert(words.end(),
                     {static_cast<std::int32_t>(s.centre.u.tile), static_cast<std::int32_t>(s.centre.v.tile),
                      s.pattern, bits_of(s.centre.u.fraction), bits_of(s.centre.v.fraction), bits_of(s.scale),
                      bits_of(s.cosine), bits_of(s.sine)});
      }
      const std::size_t first = std::stoul(writer.table(words, node));
      writer.program.sprites.push_back({node, first, numbers});
      sprites = &writer.program.sprites.back();
    }
    return head() + in_cell(b.sprites->grid()) +
           GraphWriter::filled(R"(  vec4 sum = vec4(0.0);
  for (int n = 0; n < $NUMBER; ++n) {
    int s = $FIRST + $WORDS * n;
    uvec2 cells = $COUNT, gone = moved(at.cell, -ivec2(entry(s), entry(s + 1)), cells);
    vec2 r = vec2(gone.x > cells.x / 2u ? -float(cells.x - gone.x) : float(gone.x), gone.y > cells.y / 2u ? -float(cells.y - gone.y) : float(gone.y));
    r += at.part - vec2(real_entry(s + 3), real_entry(s + 4));
    if (abs(r.x) > 2.0 || abs(r.y) > 2.0) continue;
    Laid t = Laid(vec2(0.0), real_entry(s + 5), vec2(real_entry(s + 6), real_entry(s + 7)));
    vec2 u = within(t, r);
    vec4 du = turned(t, dc);
    float share = share_of(u, du, $TEXELS, $LAST);
    int i = entry(s + 2);
    if (share > 0.0 && i >= 0 && i < $TILES) sum = over($READ(clamp(u, 0.0, 0.99999994), i, du, -1.0) * share, sum);
  }
  return sum;
}
)",
                               {{"NUMBER", std::to_string(sprites->numbers.size())},
                                {"FIRST", std::to_string(sprites->first)},
                                {"WORDS", std::to_string(words_of_sprite)},
                                {"COUNT", writer.cell_count(b.sprites->grid())},
                                {"TEXELS", texels_of(*b.source)},
                                {"LAST", fmt::format("{}.0", b.source->facts().levels - 1)},
                                {"TILES", std::to_string(b.source->facts().tiles)},
                                {"READ", reader}});
  }

  std::string operator()(const SelectTexture& b) const {
    return head() + fmt::format("  switch (index_{}(p)) {{\n{}  }}\n  return vec4(0.0);\n}}\n", b.index,
                                choice(b.textures, std::to_string(map)));
  }

  std::string corners(NodeId material, PatternGrid grid) const {
    return GraphWriter::filled(R"(  int m[4];
  for (int k = 0; k < 4; ++k) m[k] = index_$INDEX(centre_$GRID($MOVED));
)",
                               {{"INDEX", std::to_string(material)},
                                {"MOVED", writer.neighbour("at.cell", "ivec2(k & 1, k >> 1)", grid)},
                                {"GRID", writer.grid(grid)}});
  }

  std::string operator()(const TransitionTexture& b) const {
    const std::string reader = writer.pattern_reader(node, b.source, map);
    const std::size_t m = b.textures.size(), per = static_cast<std::size_t>(b.colors_of_material),
                      colors = m * per;
    std::string text = head() + in_cell(b.grid) + corners(b.material, b.grid);
    text += fmt::format("  for (int k = 0; k < 4; ++k) if (m[k] < 0 || m[k] >= {}) return vec4(0.0);\n", m);
    if (!b.plain_from_set)
      text += fmt::format("  if (m[0] == m[1] && m[0] == m[2] && m[0] == m[3]) switch (m[0]) {{\n{}  }}\n",
                          choice(b.textures, std::to_string(map)));
    text += "  int tile = 0;\n";
    const std::string color =
        per == 1
            ? "m[k]"
            : fmt::format("m[k] * {} + {}", per,
                          writer.hashed_index(writer.values.corner_hash(node),
                                              writer.neighbour("at.cell", "ivec2(k & 1, k >> 1)", b.grid),
                                              node));
    text += fmt::format("  for (int k = 0; k < 4; ++k) tile = tile * {} + {};\n", colors, color);
    text +=
        fmt::format("  tile += {} * {};\n", writer.hashed_index(writer.values.hash(node), "at.cell", node),
                    colors * colors * colors * colors);
    if (!b.tiles.empty())
      text += fmt::format("  tile = entry({} + tile);\n", writer.table_once(b.tiles, node));
    return text + fmt::format("  return tile < 0 ? vec4(0.0) : {}(at.part, tile, dc, -1.0);\n}}\n", reader);
  }

  std::string operator()(const BorderTexture& b) const {
    const std::string reader = writer.pattern_reader(node, b.source, map);
    return head() + in_cell(b.grid) + corners(b.material, b.grid) +
           GraphWriter::filled(R"(  int code = 0;
  for (int k = 0; k < 4; ++k) code = code * 2 + (m[k] == $FAMILY ? 1 : 0);
  if (code == 15) return $INSIDE;
  vec4 below = $BELOW;
  return code == 0 ? below : over($READ(at.part, code + 16 * $VARIANT, dc, -1.0), below);
}
)",
                               {{"FAMILY", std::to_string(b.family)},
                                {"INSIDE", of(b.inside)},
                                {"BELOW", of(b.below)},
                                {"READ", reader},
                                {"VARIANT", writer.hashed_index(writer.values.hash(node), "at.cell", node)}});
  }

  std::string operator()(const HeightBlendTexture& b) const;

  std::string operator()(const LayersTexture& b) const {
    std::string text = head() + fmt::format("  vec4 sum = {};\n", of(b.textures[0]));
    for (std::size_t i = 1; i < b.textures.size(); ++i)
      text += fmt::format("  sum = over({}, sum);\n", of(b.textures[i]));
    return text + "  return sum;\n}\n";
  }

  std::string operator()(const MovedTexture& b) const {
    return head() + fmt::format("  return {};\n}}\n",
                                of(b.texture, fmt::format("place_at(p.cell, p.part - vec2({}, {}))",
                                                          writer.number_or(b.x, "p", 0),
                                                          writer.number_or(b.y, "p", 0))));
  }
};

std::string TextureText::operator()(const HeightBlendTexture& b) const {
  const double texels = writer.graph.unit.width / GridAxis(b.grid.width, writer.graph.scene.width).ratio();
  if (b.height >= 0 && b.height != map) writer.part->needs.push_back(b.height);
  std::string text = GraphWriter::filled(
      R"(vec4 material_$NODE(int material, Place p, vec4 d) {
  switch (material) {
$CHOICE  }
  return vec4(0.0);
}
)",
      {{"NODE", fmt::format("{}_{}", node, map)}, {"CHOICE", choice(b.textures, std::to_string(map))}});
  // Texts of maps that go by each other's heights stand in any order.
  if (b.height >= 0 && b.height != map)
    text = fmt::format("vec4 material_{}_{}(int material, Place p, vec4 d);\n", node, b.height) + text;
  text += head() + in_cell(b.grid);
  text += GraphWriter::filled(
      R"(  ivec2 first; vec2 b;
  between(at.part, first, b);
  int m[4]; float cover[4], level[4];
  for (int k = 0; k < 4; ++k) m[k] = index_$AREAS(centre_$GRID($MOVED));
  float covered = 0.0, highest = 0.0;
  int kinds = 0;
  for (int k = 0; k < 4; ++k) {
    cover[k] = 0.0;
    if (m[k] < 0 || m[k] >= $M) continue;
    float share = ((k & 1) == 0 ? 1.0 - b.x : b.x) * (k < 2 ? 1.0 - b.y : b.y);
    int same = 0;
    while (m[same] != m[k]) ++same;
    cover[same] += share;
    covered += share;
    if (same == k) ++kinds;
  }
  for (int k = 0; k < 4; ++k) {
    level[k] = cover[k];
    if (!(cover[k] > 0.0) || kinds <= 1) continue;
    level[k] = cover[k] + $RELIEF * $HEIGHT;
    highest = max(highest, level[k]);
  }
  float size = sqrt(max(dot(d.xy, d.xy), dot(d.zw, d.zw))) * $UNIT;
  float limit = highest - min(1.0 - $RELIEF, max($WIDTH, size) / $TEXELS) * covered, sum = 0.0;
  for (int k = 0; k < 4; ++k) { if (kinds > 1) level[k] = cover[k] > 0.0 ? max(0.0, level[k] - limit) : 0.0; sum += level[k]; }
  vec4 value = vec4(0.0);
  for (int k = 0; k < 4; ++k) if (level[k] > 0.0) {
    vec4 v = material_$NODE(m[k], p, d);
    $ADD
  }
  $END
}
)",
      {{"AREAS", std::to_string(b.areas)},
       {"MOVED", writer.neighbour("at.cell", "first + ivec2(k & 1, k >> 1)", b.grid)},
       {"GRID", writer.grid(b.grid)},
       {"M", std::to_string(b.textures.size())},
       {"NODE", fmt::format("{}_{}", node, map)},
       {"RELIEF", GraphWriter::real(b.relief)},
       {"HEIGHT", b.height < 0 ? "0.5"
                               : fmt::format("clamp(flat_value(material_{}_{}(m[k], p, d)), 0.0, 1.0)", node,
                                             b.height)},
       {"UNIT", GraphWriter::real(std::max(writer.graph.unit.width, writer.graph.unit.height))},
       {"WIDTH", GraphWriter::real(b.width)},
       {"TEXELS", GraphWriter::real(texels)},
       {"ADD", writer.is_vector_map(map)
                   ? "if (v.a > 0.0) { vec3 n = v.rgb / v.a * 2.0 - 1.0; "
                     "value += level[k] / sum * v.a * vec4(n.xy / max(n.z, 1.0 / 64.0), 0.0, 1.0); }"
                   : "value += level[k] / sum * v;"},
       {"END", writer.is_vector_map(map)
                   ? "return value.a > 0.0 ? vec4(0.5 + 0.5 * normalize(vec3(value.xy / value.a, "
                     "1.0)), 1.0) * value.a : vec4(0.0);"
                   : "return value;"}});
  return text;
}

std::string GraphWriter::texture_text(NodeId node, int map) {
  return std::visit(TextureText{*this, node, map}, graph.nodes[static_cast<std::size_t>(node)].block);
}

} // namespace tilepack
