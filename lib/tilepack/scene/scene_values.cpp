#include "tilepack/scene/scene_values.h"

#include "tilepack/scene/scene_limits.h"

#include <fmt/format.h>

#include <algorithm>

namespace tilepack {
namespace {

std::string path_at(const JsonCursor& at) {
  std::string path = at.text(scene_limits::longest_path);
  if (path.empty()) at.fail("is empty; name a file");
  if (path.find('\0') != path.npos) at.fail("is no path");
  return path;
}

std::int64_t whole_at(const JsonCursor& at, const SceneInput& input) {
  return at.integer(static_cast<std::int64_t>(input.lowest), static_cast<std::int64_t>(input.highest));
}

Grid<float> rows_at(const JsonCursor& at, bool is_whole) {
  const std::size_t height = at.array(1, scene_limits::most_written_cells);
  const std::size_t width = at.item(0).array(1, scene_limits::most_written_cells / height);
  Grid<float> cells(static_cast<int>(width), static_cast<int>(height));
  for (std::size_t y = 0; y < height; ++y) {
    const JsonCursor row = at.item(y);
    row.array(width, width);
    for (std::size_t x = 0; x < width; ++x) {
      const JsonCursor value = row.item(x);
      cells.at(static_cast<int>(x), static_cast<int>(y)) =
          is_whole
              ? static_cast<float>(value.small_integer(-1, static_cast<int>(scene_limits::most_indices) - 1))
              : static_cast<float>(value.number(-1e9, 1e9));
    }
  }
  return cells;
}

std::array<double, 2> point_at(const JsonCursor& at) {
  at.array(2, 2);
  return {at.item(0).number(-scene_limits::most_cells, scene_limits::most_cells),
          at.item(1).number(-scene_limits::most_cells, scene_limits::most_cells)};
}

SceneSprite sprite_at(const JsonCursor& at) {
  at.only({"at", "path", "period", "start", "pattern", "rotate", "scale", "follows"});
  SceneSprite sprite;
  const auto place = at.find("at");
  const auto path = at.find("path");
  if (place.has_value() == path.has_value())
    at.fail("needs either \"at\", a place, or \"path\", a list of them");
  if (place) sprite.path.push_back(point_at(*place));
  if (path) {
    const std::size_t count = path->array(2, scene_limits::most_listed);
    for (std::size_t i = 0; i < count; ++i) sprite.path.push_back(point_at(path->item(i)));
  }
  if (const auto period = at.find("period")) sprite.period = period->number(1e-6, 1e9);
  if (const auto start = at.find("start")) sprite.start = start->number(0, 1);
  if (const auto pattern = at.find("pattern"))
    sprite.pattern = pattern->small_integer(0, static_cast<int>(scene_limits::most_indices) - 1);
  if (const auto rotate = at.find("rotate")) sprite.rotate = rotate->number(-1e6, 1e6);
  if (const auto scale = at.find("scale")) sprite.scale = scale->number(1e-3, 1);
  if (const auto follows = at.find("follows")) sprite.follows = follows->boolean();
  return sprite;
}

SceneOutline outline_at(const JsonCursor& at) {
  at.only({"material", "points"});
  SceneOutline outline;
  outline.material = at.member("material").small_integer(0, 15);
  const JsonCursor points = at.member("points");
  const std::size_t count = points.array(3, scene_limits::most_listed);
  for (std::size_t i = 0; i < count; ++i)
    for (const double coordinate : point_at(points.item(i))) outline.points.push_back(coordinate);
  return outline;
}

// Of an input that takes nodes too: an index or number alone, a color as 1 to 4 of them.
void read_constant(const JsonCursor& at, const SceneInput& input, SceneValue& value) {
  const auto takes = [&](SceneKind kind) {
    return std::find(input.kinds.begin(), input.kinds.end(), kind) != input.kinds.end();
  };
  const auto refuse = [&](const char* alternative) {
    at.fail(fmt::format("must be the name of a node{}, and is {}", alternative, at.shown()));
  };
  if (takes(SceneKind::number)) {
    if (at.is_array() || at.is_object() || at.is_boolean() || at.is_null()) refuse(" or a number");
    value.numbers.push_back(at.number(input.lowest, input.highest));
  } else if (takes(SceneKind::index)) {
    if (!at.is_integer()) refuse(" or a whole number");
    value.numbers.push_back(
        static_cast<double>(at.integer(-1, static_cast<std::int64_t>(scene_limits::most_indices) - 1)));
  } else if (takes(SceneKind::texture) && at.is_array()) {
    const std::size_t count = at.array(1, 4);
    for (std::size_t i = 0; i < count; ++i) value.numbers.push_back(at.item(i).number(0, 65504));
  } else {
    refuse(takes(SceneKind::texture) ? " or a color, a list of 1 to 4 numbers" : "");
  }
}

void read_numbers(const JsonCursor& at, const SceneInput& input, std::vector<double>& numbers) {
  const std::size_t count = at.array(1, scene_limits::most_listed);
  for (std::size_t i = 0; i < count; ++i)
    numbers.push_back(input.form == SceneForm::wholes ? static_cast<double>(whole_at(at.item(i), input))
                                                      : at.item(i).number(input.lowest, input.highest));
}

} // namespace

SceneValue scene_constant(const JsonCursor& at, const SceneInput& input) {
  SceneValue value;
  switch (input.form) {
  case SceneForm::node:
  case SceneForm::nodes:
    read_constant(at, input, value);
    break;
  case SceneForm::whole:
    value.numbers.push_back(static_cast<double>(whole_at(at, input)));
    break;
  case SceneForm::real:
    value.numbers.push_back(at.number(input.lowest, input.highest));
    break;
  case SceneForm::flag:
    value.numbers.push_back(at.boolean() ? 1 : 0);
    break;
  case SceneForm::pair:
    at.array(2, 2);
    for (std::size_t i = 0; i < 2; ++i)
      value.numbers.push_back(static_cast<double>(whole_at(at.item(i), input)));
    break;
  case SceneForm::range:
    at.array(2, 2);
    for (std::size_t i = 0; i < 2; ++i)
      value.numbers.push_back(at.item(i).number(input.lowest, input.highest));
    if (value.numbers[0] > value.numbers[1]) at.fail("begins above its end; write the lowest number first");
    break;
  case SceneForm::numbers:
  case SceneForm::wholes:
    read_numbers(at, input, value.numbers);
    break;
  case SceneForm::lists: {
    const std::size_t count = at.array(1, scene_limits::most_listed);
    for (std::size_t i = 0; i < count; ++i) read_numbers(at.item(i), input, value.lists.emplace_back());
    break;
  }
  case SceneForm::choice: {
    const std::vector<std::string> choices(input.choices.begin(), input.choices.end());
    value.texts.push_back(choices[at.one_of(choices)]);
    break;
  }
  case SceneForm::text:
    value.texts.push_back(at.text());
    break;
  case SceneForm::file:
    value.texts.push_back(path_at(at));
    break;
  case SceneForm::files: {
    const std::size_t count = at.array(1, scene_limits::most_listed);
    for (std::size_t i = 0; i < count; ++i) value.texts.push_back(path_at(at.item(i)));
    break;
  }
  case SceneForm::map:
  case SceneForm::levels:
    if (at.is_text())
      value.texts.push_back(path_at(at));
    else if (at.is_array())
      value.cells = rows_at(at, input.form == SceneForm::map);
    else
      at.fail(fmt::format("must be the path of a picture or rows of numbers, and is {}", at.shown()));
    break;
  case SceneForm::sprites: {
    const std::size_t count = at.array(0, scene_limits::most_listed);
    for (std::size_t i = 0; i < count; ++i) value.sprites.push_back(sprite_at(at.item(i)));
    break;
  }
  case SceneForm::outlines: {
    const std::size_t count = at.array(0, scene_limits::most_listed);
    for (std::size_t i = 0; i < count; ++i) value.outlines.push_back(outline_at(at.item(i)));
    break;
  }
  }
  return value;
}

std::vector<SceneMap> scene_maps(const std::optional<JsonCursor>& at) {
  if (!at) return {SceneMap{}};
  std::vector<SceneMap> maps;
  const std::size_t count = at->array(1, scene_limits::most_maps);
  for (std::size_t i = 0; i < count; ++i) {
    const JsonCursor map = at->item(i);
    map.only({"name", "role", "channels"});
    SceneMap read;
    read.name = map.member("name").text(scene_limits::longest_name);
    const std::vector<std::string> roles = names_of<Role>();
    const JsonCursor role = map.member("role");
    read.role = *enum_named<Role>(roles[role.one_of(roles)]);
    read.channels = map.member("channels").small_integer(1, 4);
    if (read.role == Role::normal && read.channels < 3)
      map.member("channels").fail("normals have 3 channels, or 4");
    for (const SceneMap& other : maps)
      if (other.name == read.name)
        map.member("name").fail(fmt::format("{} stands twice", map.member("name").shown()));
    maps.push_back(std::move(read));
  }
  return maps;
}

} // namespace tilepack
