#include "tilepack/scanline/mesh.h"

#include "tilepack/error/error.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace tilepack {
namespace {

constexpr double farthest_vertex = 1e9;

struct TextureCoordinate {
  double u = 0, v = 0;
};

struct Corner {
  std::size_t place = 0, texture = 0; // indices from 0
};

class ObjReader {
public:
  ObjReader(const std::string& file_name, double scale) : name(file_name), tiles_a_unit(scale) {}

  void read(std::string_view text) {
    while (!text.empty()) {
      ++line_number;
      const std::size_t end = text.find('\n');
      read_line(text.substr(0, end));
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    if (triangles.empty()) {
      throw Error(ErrorKind::invalid_content, name,
                  "no face in it; a mesh needs lines such as 'f 1/1 2/2 3/3'");
    }
  }

  std::vector<TexturedTriangle> triangles;

private:
  void read_line(std::string_view line) {
    line = line.substr(0, line.find('#'));
    const std::string_view key = word(line);
    if (key == "v") {
      const double x = number(line, "v"), y = number(line, "v"), z = number(line, "v");
      places.push_back({x, y, z});
    } else if (key == "vt") {
      const double u = number(line, "vt"), v = number(line, "vt");
      textures.push_back({u, v});
    } else if (key == "f") {
      read_face(line);
    }
  }

  void read_face(std::string_view line) {
    std::vector<Corner> corners;
    for (std::string_view w = word(line); !w.empty(); w = word(line)) corners.push_back(corner(w));
    if (corners.size() < 3) fail(fmt::format("a face of {} corners; it needs 3 or more", corners.size()));
    for (std::size_t i = 2; i < corners.size(); ++i) {
      TexturedTriangle triangle;
      const Corner fan[3] = {corners[0], corners[i - 1], corners[i]};
      for (std::size_t k = 0; k < 3; ++k) {
        triangle.corners[k] = places[fan[k].place];
        triangle.u[k] = textures[fan[k].texture].u * tiles_a_unit;
        triangle.v[k] = -textures[fan[k].texture].v * tiles_a_unit;
      }
      triangles.push_back(triangle);
    }
  }

  // "3/7" or "3/7/2".
  Corner corner(std::string_view text) {
    const std::size_t slash = text.find('/');
    const std::string_view rest = slash == std::string_view::npos ? "" : text.substr(slash + 1);
    const std::string_view texture = rest.substr(0, rest.find('/'));
    if (texture.empty()) {
      fail(fmt::format("corner '{}' has no texture coordinate; write it as vertex/texture", text));
    }
    return {index(text.substr(0, slash), places.size(), "vertex"),
            index(texture, textures.size(), "texture coordinate")};
  }

  std::size_t index(std::string_view text, std::size_t count, const char* what) {
    std::int64_t i = 0;
    const auto [after, fault] = std::from_chars(text.data(), text.data() + text.size(), i);
    if (fault != std::errc() || after != text.data() + text.size()) {
      fail(fmt::format("'{}' is no {} index; it must be a whole number", text, what));
    }
    const auto n = static_cast<std::int64_t>(count);
    if (i == 0 || i > n || i < -n) {
      fail(fmt::format(
          "there is no {} {}; {} are given above this line, counted from 1 (or from -1 backwards)", what, i,
          n));
    }
    return static_cast<std::size_t>(i > 0 ? i - 1 : n + i);
  }

  double number(std::string_view& line, const char* key) {
    const std::string_view text = word(line);
    if (text.empty()) fail(fmt::format("a '{}' line needs {} numbers", key, key[1] == 't' ? 2 : 3));
    double value = 0;
    const auto [after, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (fault != std::errc() || after != text.data() + text.size()) {
      fail(fmt::format("'{}' is no number", text));
    }
    if (!(std::abs(value) <= farthest_vertex)) fail(fmt::format("{} is out of range; -1e9..1e9 is allowed", text));
    return value;
  }

  // Takes the next word off the front of `line`; empty at its end.
  static std::string_view word(std::string_view& line) {
    constexpr std::string_view blanks = " \t\r\v\f";
    line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
    const std::string_view taken = line.substr(0, line.find_first_of(blanks));
    line.remove_prefix(taken.size());
    return taken;
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw Error(ErrorKind::invalid_content, fmt::format("{}:{}", name, line_number), message);
  }

  std::string name;
  double tiles_a_unit;
  std::size_t line_number = 0;
  std::vector<Vec3> places;
  std::vector<TextureCoordinate> textures;
};

} // namespace

std::vector<TexturedTriangle> parse_obj(std::string_view text, const std::string& name, double tiles_a_unit) {
  ObjReader reader(name, tiles_a_unit);
  reader.read(text);
  return std::move(reader.triangles);
}

} // namespace tilepack
