#include "tilepack/report/scene_view_page.h"

#include "tilepack/batch/content_hash.h"
#include "tilepack/error/error.h"
#include "tilepack/json/json_value.h"
#include "tilepack/pattern/pattern_texture.h"
#include "tilepack/scene/scene_graph.h"
#include "tilepack/scene/scene_texture.h"
#include "tilepack/shader/graph_program.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <tuple>

namespace tilepack {
namespace {

constexpr std::size_t most_textures = 16; // that every WebGL 2 reads in one program
constexpr int overview_side = 512, least_overview = 64;

// Texels as the page uploads them: RGB, or RGBA with colors multiplied by alpha; light by the sRGB curve.
struct PageTexels {
  bool light = false;
  bool alpha = false;
  std::vector<unsigned char> bytes;

  void add(std::span<const float> linear) {
    const std::size_t values = linear.size() - (alpha ? 1 : 0);
    const float cover = alpha ? linear.back() : 1.0f;
    for (std::size_t c = 0; c < 3; ++c) {
      const float value = values == 1 ? linear[0] : c < values ? linear[c] : 0.0f;
      const double shown = static_cast<double>(value) * static_cast<double>(cover);
      bytes.push_back(static_cast<unsigned char>(
          code_of(static_cast<float>(light ? linear_to_srgb(shown) : shown), 255)));
    }
    if (alpha) bytes.push_back(static_cast<unsigned char>(code_of(cover, 255)));
  }
};

GraphProgram program_of(const SceneFile& scene, const PatternGraph& graph) {
  try {
    return graph_program(graph);
  } catch (const Error& error) {
    throw scene_error(scene, error);
  }
}

class ScenePage {
public:
  ScenePage(const SceneFile& of_scene, SceneFiles& files, double at_time)
      : scene(of_scene), time(at_time), made(scene_graph(of_scene, files, at_time)),
        program(program_of(of_scene, made.graph)) {}

  SceneViewPage page(ViewPageSettings settings) {
    check_texture_counts();
    std::string data = fmt::format(
        "{{\"tile\": [{}, {}], \"levels\": 64, \"layers\": 0, \"virtual\": [{}, {}], \"metres\": {}, "
        "\"exact\": "
        "false,\n\"mappings\": [{{\"name\": \"scene\", \"ids\": false}}], \"corners\": null, \"ids\": "
        "null,\n\"maps\": "
        "[{}],\n",
        unit().width, unit().height, made.graph.scene.width, made.graph.scene.height,
        settings.metres ? fmt::format("{}", *settings.metres * unit().width / SceneTexture::view_tile)
                        : "null",
        maps_json());
    data += "\"scene\": {" + scene_json() + "}}";
    settings.content = hash_of(data).low;
    SceneViewPage result;
    result.text = page_with(settings, "scene", std::move(data), view_scene_script());
    result.cells_a_texel = cells_a_texel();
    return result;
  }

private:
  Size unit() const { return made.graph.unit; }

  [[noreturn]] void refuse(const std::string& what) const {
    throw Error(ErrorKind::invalid_content, scene.file, what);
  }

  void check_texture_counts() const {
    for (std::size_t m = 0; m < program.maps.size(); ++m) {
      std::vector<int> all = program.maps[m].samplers;
      for (const int needed : program.maps[m].needs) {
        const std::vector<int>& more = program.maps[static_cast<std::size_t>(needed)].samplers;
        all.insert(all.end(), more.begin(), more.end());
      }
      std::sort(all.begin(), all.end());
      const auto count = static_cast<std::size_t>(std::unique(all.begin(), all.end()) - all.begin()) + 2;
      if (count > most_textures)
        refuse(fmt::format("its map \"{}\" is made from {} textures, and a page reads {} at once; use fewer "
                           "packs and sets of patterns, or draw pictures by `compose`",
                           made.graph.maps[m].name, count, most_textures));
    }
  }

  std::string maps_json() const {
    std::string text;
    for (const PatternMapFacts& map : made.graph.maps)
      text += fmt::format(
          "{}{{\"name\": {}, \"role\": {}, \"channels\": {}, \"mean\": [0, 0, 0], \"alpha\": {}}}",
          text.empty() ? "" : ", ", json_text(map.name), json_text(std::string(name_of(map.role))),
          map.role == Role::normal ? map.channels : 3, map.has_alpha());
    return text;
  }

  std::string scene_json() {
    const double side = static_cast<double>(std::max(scene.size[0], scene.size[1]));
    const double least =
        std::max(100 / side, 8192.0 / (std::ldexp(1.0, 29) * std::min(unit().width, unit().height)));
    std::string text = fmt::format("\"common\": {},\n\"parts\": [", json_text(program.common));
    for (std::size_t m = 0; m < program.maps.size(); ++m)
      text += fmt::format("{}{{\"needs\": [{}], \"samplers\": [{}], \"text\": {}}}", m == 0 ? "" : ",\n",
                          fmt::join(program.maps[m].needs, ", "), fmt::join(program.maps[m].samplers, ", "),
                          json_text(program.maps[m].text));
    text += "],\n\"samplers\": [";
    for (const GraphSampler& sampler : program.samplers)
      text += (&sampler == program.samplers.data() ? "" : ",\n") + sampler_json(sampler);
    text += "],\n\"overviews\": [";
    for (std::size_t m = 0; m < made.graph.maps.size(); ++m)
      text += (m == 0 ? "" : ",\n") + overview_json(static_cast<int>(m));
    text += "],\n\"words\": \"" + words_data() + "\",\n\"sprites\": [" + sprites_json() + "]";
    const auto per_unit = [](std::int64_t cells, std::int64_t units) {
      return static_cast<double>(cells) / static_cast<double>(units);
    };
    return text +
           fmt::format(
               ",\n\"cells\": [{}, {}], \"fade\": {:.6f}, \"moves\": {}, \"least\": {:.9g}, \"start\": "
               "{{\"x\": {}, \"y\": {}, \"zoom\": 1, \"height\": {:.6g}, \"time\": {}}},\n\"note\": {}",
               per_unit(program.finest.width, made.graph.scene.width),
               per_unit(program.finest.height, made.graph.scene.height), fade(), program.moves, least,
               made.graph.scene.width / 2, made.graph.scene.height / 2,
               1.5 * SceneTexture::view_tile / unit().width, time, json_text(note()));
  }

  std::string note() const {
    std::string text =
        fmt::format("Evaluated where it is looked at; pixels of more than {} cells show an overview of {} x "
                    "{} texels",
                    fade() > 1 ? "several" : "4", overview().width, overview().height);
    if (program.moves) text += fmt::format(", at time {}", time);
    return text + ".";
  }

  // A map of a source as it is stored, with its index map and corner pack: kept for the samplers of these.
  const Pack& stored_pack(const GraphSampler& sampler) {
    const auto use = sampler.kind == GraphSampler::Kind::patterns ? PatternSource::Use::patterns
                                                                  : PatternSource::Use::wang;
    const std::tuple asked(sampler.source.get(), sampler.map, use);
    if (last_stored != asked) last_pack = sampler.source->stored_pack(sampler.map, use);
    last_stored = asked;
    return last_pack;
  }

  // Of a sampler, all levels.
  std::string sampler_json(const GraphSampler& sampler) {
    const Pack& pack = stored_pack(sampler);
    const std::string head = fmt::format("{{\"name\": \"{}\", \"array\": {}, \"layers\": {}, ", sampler.name,
                                         sampler.is_array, sampler.is_array ? pack.layout.rows : 0);
    if (sampler.kind == GraphSampler::Kind::ids) {
      count(2 * pack.mapping.ids.size());
      return head + fmt::format("\"ids\": true, \"width\": {}, \"height\": {}, \"data\": \"{}\"}}",
                                pack.mapping.size.width, pack.mapping.size.height,
                                view_page_ids(pack.mapping));
    }
    const PackedMap& map =
        sampler.kind == GraphSampler::Kind::corners ? pack.corner_pack->maps[0] : pack.maps[0];
    std::string levels;
    PageTexels texels{is_light(map), has_alpha(map.role, map.channels), {}};
    for (std::size_t l = 0; l < map.levels.size() + map.far_levels.size(); ++l) {
      const Image& stored = l < map.levels.size() ? map.levels[l] : map.far_levels[l - map.levels.size()];
      const Image level = to_linear(stored, map.encoding);
      texels.bytes.clear();
      for (int y = 0; y < level.height(); ++y)
        for (int x = 0; x < level.width(); ++x) texels.add(level.texel(x, y));
      count(texels.bytes.size());
      levels += (levels.empty() ? "" : ",\n") + view_page_level(level.size(), texels.bytes);
    }
    return head + fmt::format("\"channels\": {}, \"srgb\": {}, \"levels\": [{}]}}", texels.alpha ? 4 : 3,
                              texels.light, levels);
  }

  void count(std::size_t more) {
    bytes_so_far += more;
    if (bytes_so_far > most_page_bytes)
      refuse(
          fmt::format("more than {} MiB of texels, which is the most that a page holds; use smaller packs, "
                      "or draw pictures by `compose`",
                      most_page_bytes >> 20));
  }

  Size overview() const {
    const auto side = [](std::int64_t cells) {
      return static_cast<int>(std::clamp<std::int64_t>(2 * cells, least_overview, overview_side));
    };
    return {side(program.finest.width), side(program.finest.height)};
  }
  double cells_a_texel() const {
    return std::max(static_cast<double>(program.finest.width) / overview().width,
                    static_cast<double>(program.finest.height) / overview().height);
  }
  // Octaves over which cells fade into the overview, from 2 cells a pixel on.
  double fade() const { return std::clamp(std::log2(cells_a_texel()) - 1, 1.0, 5.0); }

  std::string overview_json(int map) const {
    PatternOptions options;
    options.time = time;
    const PatternTexture texture(made.graph, map, options);
    const Size size = overview();
    const PatternMapFacts& facts = made.graph.maps[static_cast<std::size_t>(map)];
    const auto channels = static_cast<std::size_t>(texture.channels());
    Image picture(size.width, size.height, texture.channels());
    const double step_u = static_cast<double>(made.graph.scene.width) / size.width;
    const double step_v = static_cast<double>(made.graph.scene.height) / size.height;
    tbb::parallel_for(0, size.height, [&](int y) {
      std::vector<std::vector<float>> values(channels,
                                             std::vector<float>(static_cast<std::size_t>(size.width)));
      std::vector<float*> to;
      for (std::vector<float>& channel : values) to.push_back(channel.data());
      texture.sample_run({{normalised({0, 0.5 * step_u}), normalised({0, (y + 0.5) * step_v})},
                          step_u,
                          0,
                          static_cast<std::size_t>(size.width)},
                         {step_u, 0, 0, step_v}, to);
      for (int x = 0; x < size.width; ++x)
        for (std::size_t c = 0; c < channels; ++c)
          picture.texel(x, y)[c] = values[c][static_cast<std::size_t>(x)];
    });
    PageTexels texels{is_light(facts.role), true, {}};
    std::vector<float> texel;
    for (int y = 0; y < size.height; ++y)
      for (int x = 0; x < size.width; ++x) {
        texel.assign(picture.texel(x, y).begin(), picture.texel(x, y).end());
        if (!facts.has_alpha()) texel.push_back(1.0f);
        texels.add(texel);
      }
    return fmt::format("{{\"channels\": 4, \"srgb\": {}, \"levels\": [{}]}}", texels.light,
                       view_page_level(size, texels.bytes));
  }

  std::string words_data() {
    std::vector<std::int32_t>& words = program.words;
    constexpr std::size_t row = GraphProgram::row_words;
    words.resize(std::max<std::size_t>(1, (words.size() + row - 1) / row) * row);
    std::vector<unsigned char> bytes;
    for (const std::int32_t word : words)
      for (int shift = 0; shift < 32; shift += 8)
        bytes.push_back(static_cast<unsigned char>(static_cast<std::uint32_t>(word) >> shift & 255));
    count(bytes.size());
    return view_page_bytes(bytes);
  }

  // The sprites of a node that go round a path.
  std::string sprites_json() {
    std::string text;
    for (const GraphSprites& set : program.sprites) {
      std::string moving;
      const std::vector<SceneSprite>* listed = sprites_of(set.node);
      for (std::size_t i = 0; listed != nullptr && i < set.numbers.size(); ++i) {
        const SceneSprite& s = (*listed)[static_cast<std::size_t>(set.numbers[i])];
        if (s.path.size() < 2) continue;
        program.moves = true;
        std::string path;
        for (const auto& [x, y] : s.path) path += fmt::format("{}[{}, {}]", path.empty() ? "" : ", ", x, y);
        moving += fmt::format("{}{{\"word\": {}, \"path\": [{}], \"period\": {}, \"start\": {}, \"rotate\": "
                              "{}, \"follows\": {}}}",
                              moving.empty() ? "" : ",\n", set.first + words_of_sprite * i, path, s.period,
                              s.start, s.rotate, s.follows);
      }
      const auto* block =
          std::get_if<SpritesTexture>(&made.graph.nodes[static_cast<std::size_t>(set.node)].block);
      text += fmt::format("{}{{\"cells\": [{}, {}], \"moving\": [{}]}}", text.empty() ? "" : ", ",
                          block->sprites->grid().width, block->sprites->grid().height, moving);
    }
    return text;
  }
  const std::vector<SceneSprite>* sprites_of(NodeId node) const {
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
      if (made.node_of[i] != node) continue;
      const SceneValue* place = scene.nodes[i].find("place");
      if (place == nullptr || place->node < 0) continue;
      const SceneValue* sprites = scene.nodes[static_cast<std::size_t>(place->node)].find("sprites");
      if (sprites != nullptr) return &sprites->sprites;
    }
    return nullptr;
  }

  const SceneFile& scene;
  double time;
  SceneGraph made;
  GraphProgram program;
  std::size_t bytes_so_far = 0;
  std::optional<std::tuple<const PatternSource*, int, PatternSource::Use>> last_stored;
  Pack last_pack;
};

} // namespace

SceneViewPage scene_view_page(const SceneFile& scene, SceneFiles& files, ViewPageSettings settings,
                              double time) {
  return ScenePage(scene, files, time).page(std::move(settings));
}

} // namespace tilepack
