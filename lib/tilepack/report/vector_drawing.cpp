#include "tilepack/report/vector_drawing.h"

#include "tilepack/image/png_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace tilepack {
namespace {

// Characters of 5 x 7 dots, a string a row, in the order of drawn_characters.
constexpr int glyph_columns = 5;
constexpr int glyph_rows = 7;
using Glyph = std::array<std::string_view, glyph_rows>;
constexpr Glyph box{"#####", "#   #", "#   #", "#   #", "#   #", "#   #", "#####"};
constexpr std::array<Glyph, drawn_characters.size()> glyphs{{
    {" ### ", "#   #", "#  ##", "# # #", "##  #", "#   #", " ### "},
    {"  #  ", " ##  ", "  #  ", "  #  ", "  #  ", "  #  ", " ### "},
    {" ### ", "#   #", "    #", "   # ", "  #  ", " #   ", "#####"},
    {" ### ", "#   #", "    #", "  ## ", "    #", "#   #", " ### "},
    {"   # ", "  ## ", " # # ", "#  # ", "#####", "   # ", "   # "},
    {"#####", "#    ", "#### ", "    #", "    #", "#   #", " ### "},
    {" ### ", "#    ", "#    ", "#### ", "#   #", "#   #", " ### "},
    {"#####", "    #", "   # ", "  #  ", "  #  ", " #   ", " #   "},
    {" ### ", "#   #", "#   #", " ### ", "#   #", "#   #", " ### "},
    {" ### ", "#   #", "#   #", " ####", "    #", "    #", " ### "},
    {"     ", "     ", " ### ", "    #", " ####", "#   #", " ####"},
    {"     ", "     ", " ### ", "#   #", "#    ", "#   #", " ### "},
    {"     ", "     ", " ### ", "#   #", "#####", "#    ", " ### "},
    {"  #  ", "     ", " ##  ", "  #  ", "  #  ", "  #  ", " ### "},
    {"#    ", "#    ", "#  # ", "# #  ", "##   ", "# #  ", "#  # "},
    {"     ", "     ", "## # ", "# # #", "# # #", "# # #", "# # #"},
    {"     ", "     ", "#### ", "#   #", "#   #", "#   #", "#   #"},
    {"     ", "     ", "#### ", "#   #", "#### ", "#    ", "#    "},
    {"     ", "     ", "#   #", "#   #", "#   #", " # # ", "  #  "},
    {"     ", "     ", "#   #", " # # ", "  #  ", " # # ", "#   #"},
    {"#    ", "#    ", "#### ", "#   #", "#   #", "#   #", "#### "},
    {"    #", "    #", " ####", "#   #", "#   #", "#   #", " ####"},
    {"  ## ", " #  #", " #   ", "###  ", " #   ", " #   ", " #   "},
    {"     ", " ####", "#   #", "#   #", " ####", "    #", " ### "},
    {"#    ", "#    ", "#### ", "#   #", "#   #", "#   #", "#   #"},
    {"   # ", "     ", "  ## ", "   # ", "   # ", "#  # ", " ##  "},
    {" ##  ", "  #  ", "  #  ", "  #  ", "  #  ", "  #  ", " ### "},
    {"     ", "     ", " ### ", "#   #", "#   #", "#   #", " ### "},
    {"     ", "     ", " ####", "#   #", " ####", "    #", "    #"},
    {"     ", "     ", "# ## ", "##  #", "#    ", "#    ", "#    "},
    {"     ", "     ", " ####", "#    ", " ### ", "    #", "#### "},
    {" #   ", " #   ", "###  ", " #   ", " #   ", " #  #", "  ## "},
    {"     ", "     ", "#   #", "#   #", "#   #", "#  ##", " ## #"},
    {"     ", "     ", "#   #", "#   #", "# # #", "# # #", " # # "},
    {"     ", "     ", "#   #", "#   #", " ####", "    #", " ### "},
    {"     ", "     ", "#####", "   # ", "  #  ", " #   ", "#####"},
    {"     ", "     ", "     ", "#####", "     ", "     ", "     "},
    {"     ", "     ", "     ", "     ", "     ", "     ", "#####"},
}};

void blend(Image& image, int x, int y, const Paint& paint, double coverage) {
  const auto to = image.texel(x, y);
  const double opacity = paint.opacity * coverage;
  const double channels[] = {paint.red, paint.green, paint.blue};
  for (std::size_t c = 0; c < 3; ++c)
    to[c] = static_cast<float>(static_cast<double>(to[c]) * (1 - opacity) + channels[c] * opacity);
}

// Where the polygon crosses the horizontal line y, from west to east; the inside lies between pairs.
std::vector<double> crossings(const std::vector<DrawingPoint>& points, double y) {
  std::vector<double> xs;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const DrawingPoint& a = points[i];
    const DrawingPoint& b = points[(i + 1) % points.size()];
    if ((a.y <= y) == (b.y <= y)) continue;
    xs.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
  }
  std::sort(xs.begin(), xs.end());
  return xs;
}

// Exact coverage along x, four sample lines a pixel along y.
void fill_shape(Image& image, const DrawingShape& shape) {
  if (shape.points.size() < 3) return;
  constexpr int lines = 4;
  double top = shape.points[0].y;
  double bottom = top;
  for (const DrawingPoint& p : shape.points) {
    top = std::min(top, p.y);
    bottom = std::max(bottom, p.y);
  }
  const int first = std::clamp(static_cast<int>(std::floor(top)), 0, image.height());
  const int last = std::clamp(static_cast<int>(std::ceil(bottom)), 0, image.height());
  std::vector<double> coverage(static_cast<std::size_t>(image.width()));
  for (int y = first; y < last; ++y) {
    int west = image.width();
    int east = 0;
    for (int line = 0; line < lines; ++line) {
      const std::vector<double> xs = crossings(shape.points, y + (line + 0.5) / lines);
      for (std::size_t i = 0; i + 1 < xs.size(); i += 2) {
        const double from = std::clamp(xs[i], 0.0, static_cast<double>(image.width()));
        const double to = std::clamp(xs[i + 1], 0.0, static_cast<double>(image.width()));
        const int begin = static_cast<int>(std::floor(from));
        const int end = static_cast<int>(std::ceil(to));
        for (int x = begin; x < end; ++x)
          coverage[x] += (std::min(to, x + 1.0) - std::max(from, static_cast<double>(x))) / lines;
        west = std::min(west, begin);
        east = std::max(east, end);
      }
    }
    for (int x = west; x < east; ++x) {
      if (coverage[x] > 0) blend(image, x, y, shape.paint, std::min(1.0, coverage[x]));
      coverage[x] = 0;
    }
  }
}

void write(Image& image, const DrawingPoint& centre, double height, std::string_view text,
           const Paint& paint) {
  // Whole pixels a dot keep small digits legible.
  const int dot = std::max(1, static_cast<int>(height / glyph_rows));
  const int width = (static_cast<int>(text.size()) * (glyph_columns + 1) - 1) * dot;
  const int x0 = static_cast<int>(std::floor(centre.x - width / 2.0 + 0.5));
  const int y0 = static_cast<int>(std::floor(centre.y - glyph_rows * dot / 2.0 + 0.5));
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::size_t name = drawn_characters.find(text[i]);
    const Glyph& glyph = name == std::string_view::npos ? box : glyphs[name];
    for (int row = 0; row < glyph_rows * dot; ++row)
      for (int column = 0; column < glyph_columns * dot; ++column) {
        const int x = x0 + static_cast<int>(i) * (glyph_columns + 1) * dot + column;
        const int y = y0 + row;
        const bool inside = x >= 0 && y >= 0 && x < image.width() && y < image.height();
        if (inside &&
            glyph[static_cast<std::size_t>(row / dot)][static_cast<std::size_t>(column / dot)] == '#')
          blend(image, x, y, paint, 1);
      }
  }
}

std::string base64(const std::vector<std::byte>& bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = word << 8 | (i + k < bytes.size() ? std::to_integer<unsigned>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k <= bytes.size() ? letters[word >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string color_text(const Paint& paint) {
  const auto code = [](double v) { return static_cast<int>(std::clamp(v, 0.0, 1.0) * 255 + 0.5); };
  std::string text =
      fmt::format("fill=\"#{:02x}{:02x}{:02x}\"", code(paint.red), code(paint.green), code(paint.blue));
  if (paint.opacity < 1) text += fmt::format(" fill-opacity=\"{:.3g}\"", paint.opacity);
  return text;
}

} // namespace

std::string png_data_uri(const Image& image) {
  return "data:image/png;base64," + base64(png_bytes(image));
}

Image rasterised(const VectorDrawing& drawing) {
  Image image = drawing.background;
  for (const DrawingShape& shape : drawing.shapes) fill_shape(image, shape);
  for (const DrawingNumber& n : drawing.numbers)
    write(image, n.centre, n.height, std::to_string(std::abs(n.number)), n.paint);
  for (const DrawingWord& w : drawing.words) write(image, w.centre, w.height, w.word, w.paint);
  return image;
}

std::string svg(const VectorDrawing& drawing) {
  const int width = drawing.background.width();
  const int height = drawing.background.height();
  std::string text = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
                                 "viewBox=\"0 0 {0} {1}\">\n<image width=\"{0}\" height=\"{1}\" "
                                 "style=\"image-rendering:pixelated\" href=\"{2}\"/>\n",
                                 width, height, png_data_uri(drawing.background));
  for (const DrawingShape& shape : drawing.shapes) {
    text += "<polygon points=\"";
    for (std::size_t i = 0; i < shape.points.size(); ++i)
      text += fmt::format("{}{:.6g},{:.6g}", i == 0 ? "" : " ", shape.points[i].x, shape.points[i].y);
    text += fmt::format("\" {}/>\n", color_text(shape.paint));
  }
  const auto add = [&](const DrawingPoint& centre, double size, const auto& characters, const Paint& paint) {
    text += fmt::format("<text x=\"{:.6g}\" y=\"{:.6g}\" font-family=\"monospace\" font-weight=\"bold\" "
                        "font-size=\"{:.6g}\" text-anchor=\"middle\" {}>{}</text>\n",
                        centre.x, centre.y + size / 2, size * 1.35, color_text(paint), characters);
  };
  for (const DrawingNumber& n : drawing.numbers) add(n.centre, n.height, n.number, n.paint);
  for (const DrawingWord& w : drawing.words) add(w.centre, w.height, w.word, w.paint);
  return text + "</svg>\n";
}

} // namespace tilepack
