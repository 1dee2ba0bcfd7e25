#include "tilepack/report/bake_pictures.h"

#include "tilepack/report/pack_picture.h"
#include "tilepack/tileset/border_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

namespace tilepack {
namespace {

constexpr int longest_side = 1536; // of a picture, in pixels

float grey_of(std::span<const float> texel) {
  return (texel[0] * 2 + texel[1] * 5 + texel[2]) / 8;
}

void lay(std::span<float> pixel, const Paint& paint) {
  const double channels[] = {paint.red, paint.green, paint.blue};
  for (std::size_t c = 0; c < 3; ++c)
    pixel[c] =
        static_cast<float>(static_cast<double>(pixel[c]) * (1 - paint.opacity) + channels[c] * paint.opacity);
}

void fill(Image& image, Rect area, const Paint& paint) {
  for (int y = area.y; y < area.y + area.height; ++y)
    for (int x = area.x; x < area.x + area.width; ++x) lay(image.texel(x, y), paint);
}

Paint between(const std::array<Paint, 3>& stops, double t) {
  const double place = std::clamp(t, 0.0, 1.0) * 2;
  const std::size_t low = place < 1 ? 0 : 1;
  const double part = place - static_cast<double>(low);
  const auto mixed = [&](double Paint::*c) { return stops[low].*c * (1 - part) + stops[low + 1].*c * part; };
  return {mixed(&Paint::red), mixed(&Paint::green), mixed(&Paint::blue), mixed(&Paint::opacity)};
}

// Texels become zoom x zoom pixels, or shrink x shrink texels one pixel.
struct Scale {
  int zoom = 1;
  int shrink = 1;

  static Scale fitting(int longest, int pixels) {
    if (2 * longest <= pixels) return {2, 1};
    return {1, std::max(1, (longest + pixels - 1) / pixels)};
  }
  int pixels(int texels) const { return std::max(1, texels * zoom / shrink); }
  int texel(int pixel) const { return pixel * shrink / zoom; }
};

// For each texel whether it lies on the outline of its piece.
bool on_outline(const std::vector<int>& pieces, Size tile, int x, int y) {
  const int piece = pieces[static_cast<std::size_t>(y * tile.width + x)];
  const auto other = [&](int i, int j) {
    return i < 0 || j < 0 || i >= tile.width || j >= tile.height ||
           pieces[static_cast<std::size_t>(j * tile.width + i)] != piece;
  };
  return other(x - 1, y) || other(x + 1, y) || other(x, y - 1) || other(x, y + 1);
}

struct Piece {
  int texels = 0;
  std::array<int, 4> on_border{}; // texels on north, east, south, west
  std::int64_t sum_x = 0;         // of its places in the sample
  std::int64_t sum_y = 0;
};

std::vector<Piece> measured(const std::vector<int>& pieces, const std::vector<SourceTexel>& texels,
                            Size tile) {
  std::vector<Piece> list(static_cast<std::size_t>(*std::max_element(pieces.begin(), pieces.end()) + 1));
  for (int y = 0; y < tile.height; ++y)
    for (int x = 0; x < tile.width; ++x) {
      const auto p = static_cast<std::size_t>(y * tile.width + x);
      Piece& piece = list[static_cast<std::size_t>(pieces[p])];
      ++piece.texels;
      piece.on_border[0] += y == 0;
      piece.on_border[1] += x + 1 == tile.width;
      piece.on_border[2] += y + 1 == tile.height;
      piece.on_border[3] += x == 0;
      piece.sum_x += texels[p].x;
      piece.sum_y += texels[p].y;
    }
  return list;
}

// Colors outside the tile, so that they hide nothing.
void draw_colors(Image& image, const TileColors& tiles, int id, Rect tile) {
  constexpr int band = 5;
  constexpr int away = 2;
  const int x1 = tile.x + tile.width;
  const int y1 = tile.y + tile.height;
  const auto index = static_cast<std::size_t>(id);
  if (const auto* edges = std::get_if<std::vector<EdgeTile>>(&tiles)) {
    const EdgeTile& t = (*edges)[index];
    fill(image, {tile.x, tile.y - away - band, tile.width, band}, color_paint(t.north));
    fill(image, {x1 + away, tile.y, band, tile.height}, color_paint(t.east));
    fill(image, {tile.x, y1 + away, tile.width, band}, color_paint(t.south));
    fill(image, {tile.x - away - band, tile.y, band, tile.height}, color_paint(t.west));
    return;
  }
  constexpr int side = 9;
  const CornerTile& t = std::get<std::vector<CornerTile>>(tiles)[index];
  fill(image, {tile.x - side, tile.y - side, side, side}, color_paint(t.nw));
  fill(image, {x1, tile.y - side, side, side}, color_paint(t.ne));
  fill(image, {tile.x - side, y1, side, side}, color_paint(t.sw));
  fill(image, {x1, y1, side, side}, color_paint(t.se));
}

std::vector<int> tiles_to_draw(const SetReport& report, int most) {
  std::vector<int> ids(report.tiles.size());
  std::iota(ids.begin(), ids.end(), 0);
  if (static_cast<int>(ids.size()) <= most) return ids;
  const auto cost = [&](int id) {
    const TileFigures& t = report.tiles[static_cast<std::size_t>(id)];
    return t.cut_mean * t.cut_length;
  };
  std::stable_sort(ids.begin(), ids.end(), [&](int a, int b) { return cost(a) > cost(b); });
  ids.resize(static_cast<std::size_t>(most));
  std::sort(ids.begin(), ids.end());
  return ids;
}

void draw_tile_with_cuts(Image& image, Rect area, const Scale& scale, const Image& sample,
                         const FeatureImage& features, const SourceMap& sources, int id, double step) {
  const auto& texels = sources.texels[static_cast<std::size_t>(id)];
  const int width = sources.tile_size.width;
  for (int y = 0; y < area.height; ++y)
    for (int x = 0; x < area.width; ++x) {
      const SourceTexel from = texels[static_cast<std::size_t>(scale.texel(y) * width + scale.texel(x))];
      std::ranges::fill(image.texel(area.x + x, area.y + y),
                        0.12f + 0.6f * grey_of(sample.texel(from.x, from.y)));
    }
  std::map<std::pair<int, int>, double> strongest; // pixel → visibility
  const auto mark = [&](int x, int y, double visibility) {
    if (x >= area.width || y >= area.height) return;
    double& so_far = strongest[{y, x}];
    so_far = std::max(so_far, visibility);
  };
  for (const Cut& cut : cuts_of_tile(features, sources, id)) {
    // The pixels on both sides of the line between the two texels, along its whole length.
    for (int side = 0; side < 2; ++side)
      for (int along = 0; along < scale.zoom; ++along) {
        const int across = side == 0 ? scale.zoom - 1 : scale.zoom;
        const int x = cut.x * scale.zoom + (cut.to_south ? along : across);
        const int y = cut.y * scale.zoom + (cut.to_south ? across : along);
        mark(x / scale.shrink, y / scale.shrink, cut.visibility);
      }
  }
  for (const auto& [place, visibility] : strongest)
    lay(image.texel(area.x + place.second, area.y + place.first), cut_paint(visibility, step));
}

// A frame round a place of a tile drawn at `tile`, its number in the corner.
void draw_mark(VectorDrawing& drawing, Rect tile, const Scale& scale, Rect place, int number) {
  const Paint paint{1.0, 0.2, 0.8, 1};
  const int x0 = tile.x + scale.pixels(place.x), x1 = tile.x + scale.pixels(place.x + place.width);
  const int y0 = tile.y + scale.pixels(place.y), y1 = tile.y + scale.pixels(place.y + place.height);
  for (const Rect& bar : {Rect{x0, y0, x1 - x0, 2}, Rect{x0, y1 - 2, x1 - x0, 2}, Rect{x0, y0, 2, y1 - y0},
                          Rect{x1 - 2, y0, 2, y1 - y0}})
    fill(drawing.background, bar, paint);
  drawing.numbers.push_back({{x0 + 10.0, y0 + 11.0}, 11, number, paint});
}

// The sample in dark grey, for outlines to stand out.
Image dimmed(const Image& sample, const Scale& scale) {
  Image image(scale.pixels(sample.width()), scale.pixels(sample.height()), 3);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      std::ranges::fill(image.texel(x, y),
                        0.08f + 0.55f * grey_of(sample.texel(scale.texel(x), scale.texel(y))));
  return image;
}

// One tile's pieces, to be outlined where they lie in the sample.
struct TilePieces {
  const std::vector<SourceTexel>& texels;
  Size tile;
  std::vector<int> piece_of; // texel → piece
  std::vector<Piece> list;

  TilePieces(const SourceMap& sources, int id)
      : texels(sources.texels[static_cast<std::size_t>(id)]), tile(sources.tile_size),
        piece_of(pieces_of_tile(sources, id)), list(measured(piece_of, texels, tile)) {}

  const Piece& operator[](int piece) const { return list[static_cast<std::size_t>(piece)]; }

  // The side on which most of the piece's border texels lie (north, east, south, west); none if it has none.
  std::optional<std::size_t> side_of(int piece) const {
    const auto& counts = (*this)[piece].on_border;
    const auto most = std::max_element(counts.begin(), counts.end());
    if (*most == 0) return std::nullopt;
    return static_cast<std::size_t>(most - counts.begin());
  }

  int largest() const {
    return static_cast<int>(
        std::max_element(list.begin(), list.end(),
                         [](const Piece& a, const Piece& b) { return a.texels < b.texels; }) -
        list.begin());
  }

  void outline(Image& image, const Scale& scale, int piece, const Paint& paint) const {
    for (int y = 0; y < tile.height; ++y)
      for (int x = 0; x < tile.width; ++x) {
        const auto p = static_cast<std::size_t>(y * tile.width + x);
        if (piece_of[p] != piece || !on_outline(piece_of, tile, x, y)) continue;
        for (int j = 0; j < scale.zoom; ++j)
          for (int i = 0; i < scale.zoom; ++i) {
            const int px = (texels[p].x * scale.zoom + i) / scale.shrink;
            const int py = (texels[p].y * scale.zoom + j) / scale.shrink;
            if (px < image.width() && py < image.height()) lay(image.texel(px, py), paint);
          }
      }
  }
};

// Outlines the pieces that reach a border, in its color, and returns the largest of the others; none if all
// do. Those of fewer texels than `least` are passed over.
std::optional<int> outline_borders(Image& image, const Scale& scale, const TilePieces& pieces,
                                   const BorderColors& colors, int least) {
  std::optional<int> inside;
  for (int piece = 0; piece < static_cast<int>(pieces.list.size()); ++piece) {
    if (pieces[piece].texels < least) continue;
    const auto side = pieces.side_of(piece);
    if (!side) {
      if (!inside || pieces[piece].texels > pieces[*inside].texels) inside = piece;
      continue;
    }
    Paint paint = color_paint(std::array{colors.north, colors.east, colors.south, colors.west}[*side] % 8);
    paint.opacity = 1;
    pieces.outline(image, scale, piece, paint);
  }
  return inside;
}

DrawingNumber number_on(const Piece& piece, const Scale& scale, int id, const Paint& paint) {
  const double pixels = static_cast<double>(scale.zoom) / scale.shrink / piece.texels;
  return {
      {static_cast<double>(piece.sum_x) * pixels, static_cast<double>(piece.sum_y) * pixels}, 14, id, paint};
}

} // namespace

Paint cut_paint(double visibility, double sample_step) {
  const double relative = visibility / std::max(sample_step, 0.5);
  // Half way, yellow, at the sample's own step; red from three times that on.
  const double t = relative < 1 ? relative / 2 : 0.5 + (relative - 1) / 4;
  return between({{{0.0, 0.35, 0.25, 0.65}, {0.95, 0.85, 0.1, 0.9}, {0.95, 0.05, 0.05, 1.0}}}, t);
}

Paint use_paint(int shown, int tiles) {
  const double t = tiles > 1 ? std::sqrt((std::max(1, shown) - 1.0) / (tiles - 1.0)) : 0.0;
  return between({{{0.1, 0.35, 0.95, 0.5}, {1.0, 0.85, 0.1, 0.55}, {0.9, 0.0, 0.0, 0.7}}}, t);
}

VectorDrawing cut_picture(const Image& sample, const FeatureImage& features, const SourceMap& sources,
                          const SetReport& report, int most_tiles, const std::vector<WorstPlace>& marked) {
  const std::vector<int> ids = tiles_to_draw(report, most_tiles);
  const int count = static_cast<int>(ids.size());
  int columns = 1;
  while (columns * columns < count) ++columns;
  const int rows = (count + columns - 1) / columns;
  constexpr int gap = 26;
  const Size tile = sources.tile_size;
  const Scale scale = Scale::fitting(std::max(tile.width, tile.height), longest_side / columns);
  const int wide = scale.pixels(tile.width);
  const int high = scale.pixels(tile.height);
  VectorDrawing drawing{Image(columns * (wide + gap) + gap, rows * (high + gap) + gap, 3, 1.0f), {}, {}};
  for (int i = 0; i < count; ++i) {
    const int id = ids[static_cast<std::size_t>(i)];
    const Rect area{gap + i % columns * (wide + gap), gap + i / columns * (high + gap), wide, high};
    draw_tile_with_cuts(drawing.background, area, scale, sample, features, sources, id,
                        report.figures.sample_step);
    draw_colors(drawing.background, sources.tiles, id, area);
    drawing.numbers.push_back({{area.x + wide / 2.0, area.y - 15.0}, 7, id, {0.1, 0.1, 0.1, 1}});
    for (std::size_t m = 0; m < marked.size(); ++m)
      if (marked[m].tile == id) draw_mark(drawing, area, scale, marked[m].area, static_cast<int>(m) + 1);
  }
  return drawing;
}

Image use_picture(const Image& sample, const SourceMap& sources) {
  const std::vector<int> showing = tiles_showing(sources, sample.size());
  const int tiles = static_cast<int>(sources.texels.size());
  const Scale scale = Scale::fitting(std::max(sample.width(), sample.height()), longest_side / 2);
  Image picture(scale.pixels(sample.width()), scale.pixels(sample.height()), 3);
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const int u = scale.texel(x);
      const int v = scale.texel(y);
      const auto pixel = picture.texel(x, y);
      const int shown = showing[static_cast<std::size_t>(v) * static_cast<std::size_t>(sample.width()) +
                                static_cast<std::size_t>(u)];
      const float grey = grey_of(sample.texel(u, v));
      std::ranges::fill(pixel, shown > 0 ? 0.15f + 0.85f * grey : 0.3f * grey);
      if (shown > 0) lay(pixel, use_paint(shown, tiles));
    }
  return picture;
}

VectorDrawing source_picture(const Image& sample, const SourceMap& sources) {
  const Paint white{1, 1, 1, 1};
  const Scale scale = Scale::fitting(std::max(sample.width(), sample.height()), longest_side * 3 / 4);
  VectorDrawing drawing{dimmed(sample, scale), {}, {}};
  const int least = sources.tile_size.width * sources.tile_size.height / 64;
  const std::vector<BorderColors> colors = border_colors(sources.tiles);
  for (int id = 0; id < static_cast<int>(sources.texels.size()); ++id) {
    const TilePieces pieces(sources, id);
    const auto inside =
        outline_borders(drawing.background, scale, pieces, colors[static_cast<std::size_t>(id)], least);
    if (inside) pieces.outline(drawing.background, scale, *inside, white);
    // An inside that goes on over a border has its outline already.
    drawing.numbers.push_back(number_on(pieces[inside.value_or(pieces.largest())], scale, id, white));
  }
  return drawing;
}

} // namespace tilepack
