#include "tilepack/report/scene_picture.h"

#include "tilepack/image/encoding.h"
#include "tilepack/pattern/pattern_texture.h"
#include "tilepack/scene/scene_graph.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace tilepack {
namespace {

constexpr int box_side = 96;     // of a picture, pixels
constexpr int column_step = 168; // from column to column
constexpr int row_step = 136;    // from row to row
constexpr int picture_margin = 24;
constexpr double name_height = 9; // height of names
constexpr int shown_texels = 384; // of a texture, a box_side
constexpr Paint ink{0.15, 0.15, 0.2, 1};
constexpr Paint line_ink{0.45, 0.5, 0.65, 0.8};

struct BoxPlace {
  int column = 0, row = 0;
  int x() const { return picture_margin + column * column_step; }
  int y() const { return picture_margin + row * row_step; }
};

// Columns by how many nodes lie at most between a node and what it is made from alone.
std::vector<BoxPlace> places_of(const SceneFile& scene) {
  std::vector<BoxPlace> places(scene.nodes.size());
  std::map<int, int> taken;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const auto after = [&](int node) {
      if (node >= 0)
        places[i].column = std::max(places[i].column, places[static_cast<std::size_t>(node)].column + 1);
    };
    for (const auto& [name, value] : scene.nodes[i].inputs) {
      after(value.node);
      for (const int listed : value.nodes) after(listed);
    }
    places[i].row = taken[places[i].column]++;
  }
  return places;
}

std::array<float, 3> color_of_index(std::int64_t index) {
  if (index < 0) return {0.93f, 0.93f, 0.93f};
  const double hue = std::fmod(static_cast<double>(index) * 0.618034 + 0.58, 1.0) * 6;
  const double dim = 0.95 - 0.25 * static_cast<double>(index / 6 % 3) / 2;
  const auto level = [&](double shift) {
    const double t = std::fabs(std::fmod(hue + shift, 6.0) - 3) - 1;
    return static_cast<float>(dim * (0.25 + 0.75 * std::clamp(t, 0.0, 1.0)));
  };
  return {level(0), level(4), level(2)};
}

PatternPlace spot(const PatternGraph& graph, int x, int y) {
  const auto along = [](int at, std::int64_t units) {
    return normalised({0, (at + 0.5) / box_side * static_cast<double>(units)});
  };
  return {along(x, graph.scene.width), along(y, graph.scene.height)};
}

template <class Color>
void paint_pixels(Image& into, const BoxPlace& at, Color color) {
  for (int y = 0; y < box_side; ++y)
    for (int x = 0; x < box_side; ++x) {
      const std::array<float, 3> value = color(x, y);
      std::copy(value.begin(), value.end(), into.texel(at.x() + x, at.y() + y).begin());
    }
}

void paint_texture(Image& into, const BoxPlace& at, PatternGraph graph, NodeId node, double time) {
  graph.output = node;
  PatternOptions options;
  options.time = time;
  const PatternTexture texture(graph, 0, options);
  const auto step_along = [](std::int64_t units, int unit) {
    return std::min(static_cast<double>(units), static_cast<double>(shown_texels) / unit) /
           box_side; // units a pixel
  };
  const double step_u = step_along(graph.scene.width, graph.unit.width);
  const double step_v = step_along(graph.scene.height, graph.unit.height);
  const auto channels = static_cast<std::size_t>(texture.channels());
  const bool has_alpha = graph.maps.front().has_alpha();
  const bool is_light_map = is_light(graph.maps.front().role);
  paint_pixels(into, at, [&](int x, int y) {
    std::array<double, 4> value{};
    const TileCoordinate u = normalised({graph.scene.width / 2, (x + 0.5) * step_u});
    const TileCoordinate v = normalised({graph.scene.height / 2, (y + 0.5) * step_v});
    texture.sample(u, v, {step_u, 0, 0, step_v}, std::span(value.data(), channels));
    const double cover = has_alpha ? value[channels - 1] : 1;
    std::array<float, 3> color{};
    for (std::size_t c = 0; c < 3; ++c) {
      const double shown = value[channels >= 3 ? c : 0];
      const double ground = (x / 8 + y / 8) % 2 == 0 ? 0.9 : 0.75; // squares where nothing is
      color[c] = static_cast<float>(std::clamp(
          (is_light_map ? linear_to_srgb(shown) : shown) * cover + ground * (1 - cover), 0.0, 1.0));
    }
    return color;
  });
}

void paint_number(Image& into, const BoxPlace& at, const PatternGraph& graph, NodeId node, double time) {
  std::vector<double> values;
  for (int y = 0; y < box_side; ++y)
    for (int x = 0; x < box_side; ++x) values.push_back(number_at(graph, node, spot(graph, x, y), time));
  const double low = *std::min_element(values.begin(), values.end());
  const double high = *std::max_element(values.begin(), values.end());
  const double range = high > low ? high - low : 1;
  paint_pixels(into, at, [&](int x, int y) {
    const auto grey = static_cast<float>((values[static_cast<std::size_t>(y * box_side + x)] - low) / range);
    return std::array<float, 3>{grey, grey, grey};
  });
}

void paint_grid(Image& into, const BoxPlace& at, const SceneNode& node) {
  // As many cells as can be told apart.
  const SceneValue* cells = node.find("cells");
  const auto shown = [&](std::size_t axis) {
    return cells == nullptr ? 4 : static_cast<int>(std::min(cells->numbers[axis], 12.0));
  };
  paint_pixels(into, at, [&](int x, int y) {
    const bool is_dark = (x * shown(0) / box_side + y * shown(1) / box_side) % 2 == 0;
    return is_dark ? std::array<float, 3>{0.80f, 0.84f, 0.90f} : std::array<float, 3>{0.94f, 0.95f, 0.98f};
  });
}

DrawingShape line(const DrawingPoint& from, const DrawingPoint& to) {
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  const double x = 0.8 * (to.y - from.y) / length, y = -0.8 * (to.x - from.x) / length;
  return {{{from.x + x, from.y + y}, {to.x + x, to.y + y}, {to.x - x, to.y - y}, {from.x - x, from.y - y}},
          line_ink};
}

DrawingShape frame_side(double x, double y, double width, double height, const Paint& paint) {
  return {{{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, paint};
}

} // namespace

VectorDrawing scene_picture(const SceneFile& scene, SceneFiles& files, double time) {
  const SceneGraph made = scene_graph(scene, files, time);
  const std::vector<BoxPlace> places = places_of(scene);
  int columns = 1, rows = 1;
  for (const BoxPlace& place : places) {
    columns = std::max(columns, place.column + 1);
    rows = std::max(rows, place.row + 1);
  }
  VectorDrawing drawing;
  drawing.background = Image(2 * picture_margin + columns * column_step - (column_step - box_side),
                             2 * picture_margin + rows * row_step - (row_step - box_side - 24), 3);
  std::fill(drawing.background.data().begin(), drawing.background.data().end(), 1.0f);
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const SceneNode& node = scene.nodes[i];
    const BoxPlace& at = places[i];
    const NodeId id = made.node_of[i];
    if (node.gives == SceneKind::grid || node.gives == SceneKind::place)
      paint_grid(drawing.background, at, node);
    else if (id == no_node)
      paint_pixels(drawing.background, at, [](int, int) {
        return std::array<float, 3>{0.97f, 0.97f, 0.97f};
      });
    else if (kind_of(made.graph.nodes[static_cast<std::size_t>(id)].block) == ValueKind::index)
      paint_pixels(drawing.background, at, [&](int x, int y) {
        return color_of_index(index_at(made.graph, id, spot(made.graph, x, y), time));
      });
    else if (kind_of(made.graph.nodes[static_cast<std::size_t>(id)].block) == ValueKind::number)
      paint_number(drawing.background, at, made.graph, id, time);
    else
      paint_texture(drawing.background, at, made.graph, id, time);
    const auto draw_input = [&](int from) {
      if (from < 0) return;
      const BoxPlace& source = places[static_cast<std::size_t>(from)];
      drawing.shapes.push_back(line({source.x() + box_side + 1.0, source.y() + box_side / 2.0},
                                    {at.x() - 1.0, at.y() + box_side / 2.0}));
    };
    for (const auto& [name, value] : node.inputs) {
      draw_input(value.node);
      for (const int listed : value.nodes) draw_input(listed);
    }
    const bool is_output = static_cast<int>(i) == scene.output;
    const double wide = is_output ? 3 : 1;
    for (const double y : {at.y() - wide, static_cast<double>(at.y() + box_side)})
      drawing.shapes.push_back(frame_side(at.x() - wide, y, box_side + 2 * wide, wide, ink));
    for (const double x : {at.x() - wide, static_cast<double>(at.x() + box_side)})
      drawing.shapes.push_back(frame_side(x, at.y(), wide, box_side, ink));
    const double height = std::min(name_height, name_height * 20 / static_cast<double>(node.name.size()));
    drawing.words.push_back({{at.x() + box_side / 2.0, at.y() + box_side + 13.0}, height, node.name, ink});
  }
  return drawing;
}

} // namespace tilepack
