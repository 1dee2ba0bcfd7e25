#include "tilepack/report/pack_picture.h"

#include "tilepack/error/error.h"
#include "tilepack/layout/corner_grid.h"
#include "tilepack/mip/level_size.h"
#include "tilepack/numeric/wrap.h"
#include "tilepack/pack/pack_maps.h"
#include "tilepack/sampler/virtual_texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tilepack {
namespace {

constexpr double band_share = 0.07; // of the tile's side
constexpr double disc_share = 0.2;
constexpr double mark_opacity = 0.88;

DrawingPoint at(const TileOutline& f, double u, double v) {
  return {f.corner.x + f.along.x * u + f.down.x * v, f.corner.y + f.along.y * u + f.down.y * v};
}

double length(DrawingPoint v) {
  return std::hypot(v.x, v.y);
}

Paint marked(int color) {
  Paint paint = color_paint(color);
  paint.opacity = mark_opacity;
  return paint;
}

// Four trapezoids, mitred like the sides of a picture frame; `inset` and `thickness` in shares of the side.
std::array<std::vector<DrawingPoint>, 4> picture_frame(const TileOutline& f, double inset, double thickness) {
  const double a = inset;
  const double b = inset + thickness;
  return {{{at(f, a, a), at(f, 1 - a, a), at(f, 1 - b, b), at(f, b, b)},
           {at(f, 1 - a, a), at(f, 1 - a, 1 - a), at(f, 1 - b, 1 - b), at(f, 1 - b, b)},
           {at(f, 1 - a, 1 - a), at(f, a, 1 - a), at(f, b, 1 - b), at(f, 1 - b, 1 - b)},
           {at(f, a, 1 - a), at(f, a, a), at(f, b, b), at(f, b, 1 - b)}}};
}

// A quarter of a disc round (u, v), one of the tile's corners.
std::vector<DrawingPoint> quarter_disc(const TileOutline& f, double u, double v, double radius) {
  constexpr int steps = 12;
  std::vector<DrawingPoint> points{at(f, u, v)};
  for (int i = 0; i <= steps; ++i) {
    const double angle = i * (3.14159265358979324 / 2) / steps;
    const double du = std::cos(angle) * radius;
    const double dv = std::sin(angle) * radius;
    points.push_back(at(f, u == 0 ? du : 1 - du, v == 0 ? dv : 1 - dv));
  }
  return points;
}

void draw_label(VectorDrawing& drawing, int tile, const TileOutline& f) {
  const double side = std::min(length(f.along), length(f.down));
  const double height = std::clamp(side * 0.11, 7.0, 42.0);
  const double dot = std::max(1.0, std::floor(height / 7));
  const double wide = (6 * static_cast<double>(std::to_string(tile).size()) - 1) * dot / 2 + 3 * dot;
  const double high = 7 * dot / 2 + 3 * dot;
  const DrawingPoint centre = at(f, 0.5, 0.5);
  drawing.shapes.push_back({{{centre.x - wide, centre.y - high},
                             {centre.x + wide, centre.y - high},
                             {centre.x + wide, centre.y + high},
                             {centre.x - wide, centre.y + high}},
                            {0, 0, 0, 0.6}});
  drawing.numbers.push_back({centre, dot * 7, tile, {1, 1, 1, 1}});
}

// The finest level whose picture keeps within max_side, where level 0 would have this size.
int level_of(const PackedMap& map, std::int64_t width, std::int64_t height,
             const PackPictureOptions& options) {
  const int levels = static_cast<int>(map.levels.size());
  if (options.level) {
    level_at(map, *options.level);
    return *options.level;
  }
  int level = 0;
  while (level + 1 < levels && (std::max(width, height) >> level) > options.max_side) ++level;
  return level;
}

Image magnified(const Image& image, int factor) {
  if (factor == 1) return image;
  Image result(image.width() * factor, image.height() * factor, image.channels());
  for (int y = 0; y < result.height(); ++y)
    for (int x = 0; x < result.width(); ++x)
      std::ranges::copy(image.texel(x / factor, y / factor), result.texel(x, y).begin());
  return result;
}

int magnification(Size tile, int min_side) {
  const int side = std::min(tile.width, tile.height);
  return std::max(1, (min_side + side - 1) / side);
}

TileOutline frame_of_cell(int column, int row, Size tile) {
  return {{static_cast<double>(column) * tile.width, static_cast<double>(row) * tile.height},
          {static_cast<double>(tile.width), 0},
          {0, static_cast<double>(tile.height)}};
}

TileOutline frame_of(const Placement& place, int factor) {
  return {{place.origin.x * factor, place.origin.y * factor},
          {place.east.x * factor, place.east.y * factor},
          {place.south.x * factor, place.south.y * factor}};
}

// A turned tile goes on beyond the texture's borders, where it enters again on the other side. The drawing
// shows `margin` pixels of what lies there.
void draw_wrapped(VectorDrawing& drawing, const TileColors& tiles, int tile, const TileOutline& frame,
                  int margin) {
  const double width = drawing.background.width() - 2 * margin;
  const double height = drawing.background.height() - 2 * margin;
  const double left = std::min({0.0, frame.along.x, frame.down.x, frame.along.x + frame.down.x});
  const double right = std::max({0.0, frame.along.x, frame.down.x, frame.along.x + frame.down.x});
  const double top = std::min({0.0, frame.along.y, frame.down.y, frame.along.y + frame.down.y});
  const double bottom = std::max({0.0, frame.along.y, frame.down.y, frame.along.y + frame.down.y});
  for (int down = -2; down <= 2; ++down)
    for (int across = -2; across <= 2; ++across) {
      const DrawingPoint corner{margin + frame.corner.x + across * width,
                                margin + frame.corner.y + down * height};
      const bool seen = corner.x + left < width + 2 * margin && corner.x + right > 0 &&
                        corner.y + top < height + 2 * margin && corner.y + bottom > 0;
      if (seen) draw_marks(drawing, tiles, tile, {corner, frame.along, frame.down});
    }
}

Image with_wrapped_margin(const Image& image, int margin) {
  Image result(image.width() + 2 * margin, image.height() + 2 * margin, image.channels());
  for (int y = 0; y < result.height(); ++y)
    for (int x = 0; x < result.width(); ++x)
      std::ranges::copy(image.texel(wrapped(x - margin, image.width()), wrapped(y - margin, image.height())),
                        result.texel(x, y).begin());
  return result;
}

std::vector<DrawingPoint> rectangle(double left, double top, double right, double bottom) {
  return {{left, top}, {right, top}, {right, bottom}, {left, bottom}};
}

// What lies beyond the texture's borders is veiled, and tiles are numbered within them only.
void veil_margin(VectorDrawing& drawing, int margin) {
  const double width = drawing.background.width();
  const double height = drawing.background.height();
  const double m = margin;
  const Paint veil{1, 1, 1, 0.6};
  drawing.shapes.push_back({rectangle(0, 0, width, m), veil});
  drawing.shapes.push_back({rectangle(0, height - m, width, height), veil});
  drawing.shapes.push_back({rectangle(0, m, m, height - m), veil});
  drawing.shapes.push_back({rectangle(width - m, m, width, height - m), veil});
  const TileOutline border{{m, m}, {width - 2 * m, 0}, {0, height - 2 * m}};
  for (const auto& line : picture_frame(border, 0, 1.5 / std::min(width, height)))
    drawing.shapes.push_back({line, {0, 0, 0, 1}});
  std::erase_if(drawing.numbers, [&](const DrawingNumber& n) {
    return n.centre.x < m || n.centre.y < m || n.centre.x >= width - m || n.centre.y >= height - m;
  });
}

// Where a layer of an array is drawn: side by side, as many to a row as make the picture about square.
struct LayerSheet {
  int columns;
  int rows;
  Size cell; // a layer and the gap round it, pixels
  int gap;

  DrawingPoint corner(int layer) const {
    return {static_cast<double>(layer % columns * cell.width + gap),
            static_cast<double>(layer / columns * cell.height + gap)};
  }
};

LayerSheet sheet_for(int layers, Size layer, int gap) {
  int columns = 1;
  while (columns * columns < layers) ++columns;
  return {columns, (layers + columns - 1) / columns, {layer.width + gap, layer.height + gap}, gap};
}

VectorDrawing layers_picture(const Pack& pack, const PackedMap& map, const PackPictureOptions& options) {
  const int layers = pack.layout.rows;
  const Size whole = texture_size(pack.layout, pack.tile_size, 0);
  const LayerSheet fine = sheet_for(layers, {whole.width, whole.height / layers}, 4);
  const int level = level_of(map, std::int64_t{fine.columns} * fine.cell.width,
                             std::int64_t{fine.rows} * fine.cell.height, options);
  const int factor = magnification(level_size(pack.tile_size, level), options.min_tile_side);
  const Image strip =
      magnified(viewable(map.levels[static_cast<std::size_t>(level)], map.role, map.encoding), factor);
  const Size layer{strip.width(), strip.height() / layers};
  const LayerSheet sheet = sheet_for(layers, layer, 4);
  VectorDrawing drawing{Image(sheet.columns * sheet.cell.width + sheet.gap,
                              sheet.rows * sheet.cell.height + sheet.gap, 3, 1.0f),
                        {},
                        {}};
  for (const Cell& cell : pack.layout.cells) {
    const DrawingPoint corner = sheet.corner(cell.row);
    paste(drawing.background, crop(strip, {0, cell.row * layer.height, layer.width, layer.height}),
          static_cast<int>(corner.x), static_cast<int>(corner.y));
    if (!options.marks) continue;
    TileOutline frame = frame_of(placement(pack.layout, cell.tile, pack.tile_size, level), factor);
    frame.corner = {frame.corner.x + corner.x, frame.corner.y - cell.row * layer.height + corner.y};
    draw_marks(drawing, pack.tiles, cell.tile, frame);
  }
  return drawing;
}

VectorDrawing background_of(const PackedMap& map, int level, int factor) {
  return {magnified(viewable(map.levels[static_cast<std::size_t>(level)], map.role, map.encoding), factor),
          {},
          {}};
}

} // namespace

Paint color_paint(int color) {
  constexpr std::array<std::array<int, 3>, 8> palette{{{230, 159, 0},
                                                       {0, 114, 178},
                                                       {0, 158, 115},
                                                       {204, 121, 167},
                                                       {240, 228, 66},
                                                       {86, 180, 233},
                                                       {213, 94, 0},
                                                       {0, 0, 0}}};
  const auto& rgb = palette[static_cast<std::size_t>(color & 7)];
  return {rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0, 1};
}

void draw_marks(VectorDrawing& drawing, const TileColors& tiles, int tile, const TileOutline& frame) {
  const double side = std::min(length(frame.along), length(frame.down));
  const double outline = std::max(1.0, side / 160) / side;
  if (const auto* edges = std::get_if<std::vector<EdgeTile>>(&tiles)) {
    const EdgeTile& t = (*edges)[static_cast<std::size_t>(tile)];
    const auto bands = picture_frame(frame, 0, band_share);
    const int colors[] = {t.north, t.east, t.south, t.west};
    for (std::size_t i = 0; i < 4; ++i) drawing.shapes.push_back({bands[i], marked(colors[i])});
    for (const auto& line : picture_frame(frame, band_share, outline))
      drawing.shapes.push_back({line, {0, 0, 0, 0.8}});
  } else {
    const CornerTile& t = std::get<std::vector<CornerTile>>(tiles)[static_cast<std::size_t>(tile)];
    const int colors[] = {t.nw, t.ne, t.sw, t.se};
    for (int i = 0; i < 4; ++i) {
      drawing.shapes.push_back({quarter_disc(frame, i % 2, i / 2, disc_share + outline), {0, 0, 0, 0.8}});
      drawing.shapes.push_back({quarter_disc(frame, i % 2, i / 2, disc_share), marked(colors[i])});
    }
  }
  for (const auto& line : picture_frame(frame, 0, outline)) drawing.shapes.push_back({line, {0, 0, 0, 0.8}});
  draw_label(drawing, tile, frame);
}

Image viewable(const Image& image, Role role, Encoding encoding) {
  const int colors = color_channels(image.channels());
  const auto count = static_cast<std::size_t>(colors);
  std::vector<float> sorted;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x)
      for (const float v : image.texel(x, y).first(count))
        if (std::isfinite(v)) sorted.push_back(v);
  const bool light = is_light(role);
  float low = 0;
  float high = 1;
  if (!sorted.empty()) {
    const auto [least, most] = std::minmax_element(sorted.begin(), sorted.end());
    if (*least < 0 && !light) low = *least;
    const float top = *most;
    if (top > 1) {
      const auto nth = sorted.begin() + static_cast<std::ptrdiff_t>((sorted.size() - 1) * 99 / 100);
      std::nth_element(sorted.begin(), nth, sorted.end());
      high = std::max(1.0f, light ? *nth : top);
    }
    if (!light && role != Role::normal && (low < 0 || top > 1)) high = top > low ? top : low + 1;
  }
  const bool encode = light && encoding == Encoding::linear;
  Image result(image.width(), image.height(), 3);
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const auto from = image.texel(x, y);
      const float alpha =
          from.size() % 2 == 0 && std::isfinite(from.back()) ? std::clamp(from.back(), 0.0f, 1.0f) : 1;
      for (std::size_t c = 0; c < 3; ++c) {
        const float v = from[count == 1 ? 0 : c];
        double shown = std::isfinite(v) ? static_cast<double>((v - low) / (high - low)) : 1.0;
        if (encode) shown = linear_to_srgb(std::clamp(shown, 0.0, 1.0));
        result.texel(x, y)[c] =
            std::clamp(static_cast<float>(shown), 0.0f, 1.0f) * alpha + 0.5f * (1 - alpha);
      }
    }
  return result;
}

VectorDrawing pack_picture(const Pack& pack, const PackPictureOptions& options) {
  const PackedMap& map = map_at(pack, options.map);
  if (pack.layout.kind == LayoutKind::array) return layers_picture(pack, map, options);
  const Size whole = texture_size(pack.layout, pack.tile_size, 0);
  const int level = level_of(map, whole.width, whole.height, options);
  const int factor = magnification(level_size(pack.tile_size, level), options.min_tile_side);
  VectorDrawing drawing = background_of(map, level, factor);
  if (!options.marks) return drawing;
  const bool turned = pack.layout.kind == LayoutKind::rotated && pack.layout.rotated.scheme.k > 0;
  const int margin = turned ? level_size(pack.tile_size, level).width * factor / 3 : 0;
  if (turned) drawing.background = with_wrapped_margin(drawing.background, margin);
  for (const Cell& cell : pack.layout.cells) {
    const TileOutline frame = frame_of(placement(pack.layout, cell.tile, pack.tile_size, level), factor);
    if (pack.layout.kind == LayoutKind::rotated)
      draw_wrapped(drawing, pack.tiles, cell.tile, frame, margin);
    else
      draw_marks(drawing, pack.tiles, cell.tile, frame);
  }
  if (turned) veil_margin(drawing, margin);
  return drawing;
}

VectorDrawing corner_picture(const Pack& pack, const PackPictureOptions& options) {
  map_at(pack, options.map);
  if (!pack.corner_pack)
    throw Error(ErrorKind::usage, field("corner-picture"),
                "the pack has none; bake it with " + field("corner-pack"));
  const CornerPack& corners = *pack.corner_pack;
  const PackedMap& map = corners.maps[static_cast<std::size_t>(options.map)];
  const int level = level_of(map, std::int64_t{corners.columns} * pack.tile_size.width,
                             std::int64_t{corners.rows} * pack.tile_size.height, options);
  Size tile = level_size(pack.tile_size, level);
  const int factor = magnification(tile, options.min_tile_side);
  VectorDrawing drawing = background_of(map, level, factor);
  if (!options.marks) return drawing;
  tile = {tile.width * factor, tile.height * factor};
  const CornerGrid grid = corner_grid(pack.colors.horizontal, pack.colors.vertical);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      draw_marks(drawing, pack.tiles, grid.tiles[static_cast<std::size_t>(row * grid.columns + column)],
                 frame_of_cell(column, row, tile));
  return drawing;
}

VectorDrawing expansion_picture(const Pack& pack, int columns, int rows, const PackPictureOptions& options) {
  const PackedMap& map = map_at(pack, options.map);
  const int level = level_of(map, std::int64_t{columns} * pack.tile_size.width,
                             std::int64_t{rows} * pack.tile_size.height, options);
  Size tile = level_size(pack.tile_size, level);
  const int factor = magnification(tile, options.min_tile_side);
  const Image texture =
      virtual_texture(pack, options.map, level, {0, 0, columns * tile.width, rows * tile.height});
  VectorDrawing drawing{magnified(viewable(texture, map.role, map.encoding), factor), {}, {}};
  if (!options.marks) return drawing;
  tile = {tile.width * factor, tile.height * factor};
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      draw_marks(drawing, pack.tiles, tile_at(pack.mapping, pack.colors, x, y), frame_of_cell(x, y, tile));
  return drawing;
}

} // namespace tilepack
