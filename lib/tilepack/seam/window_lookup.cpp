#include "tilepack/seam/window_lookup.h"

#include <algorithm>
#include <tuple>

namespace tilepack {

void add_shown(const FeatureImage& image, const SourceCanvas& canvas, SourceTexel at, int scale, Rect hole,
               Overlap& overlap) {
  std::vector<std::uint8_t> texel(static_cast<std::size_t>(image.channels));
  for (int y = 0; y < overlap.height; ++y)
    for (int x = 0; x < overlap.width; ++x) {
      if (x * scale >= hole.x && x * scale < hole.x + hole.width && y * scale >= hole.y &&
          y * scale < hole.y + hole.height)
        continue;
      for (int c = 0; c < image.channels; ++c) {
        int sum = scale * scale / 2;
        for (int j = 0; j < scale; ++j)
          for (int i = 0; i < scale; ++i) {
            const SourceTexel s = canvas.at(at.x + x * scale + i, at.y + y * scale + j);
            sum += image.texel(s.x, s.y)[c];
          }
        texel[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(sum / (scale * scale));
      }
      overlap.add(x, y, texel.data());
    }
}

void rule_out(PositionMap& map, SourceTexel origin, int scale, int distance) {
  const int cx = origin.x / scale;
  const int cy = origin.y / scale;
  for (PositionMap::Part& part : map.parts) {
    const Rect& a = part.area;
    for (int y = std::max(a.y, cy - distance); y <= std::min(a.y + a.height - 1, cy + distance); ++y)
      for (int x = std::max(a.x, cx - distance); x <= std::min(a.x + a.width - 1, cx + distance); ++x)
        part.at(x, y) = ruled_out;
  }
}

void rule_out_material_of(PositionMap& map, const SourceCanvas& canvas, Rect area, int scale, int step,
                          int distance) {
  std::vector<SourceTexel> origins;
  for (int y = area.y; y < area.y + area.height; y += step)
    for (int x = area.x; x < area.x + area.width; x += step) {
      const SourceTexel s = canvas.at(x, y);
      const SourceTexel origin{s.x - (x - area.x), s.y - (y - area.y)};
      if (std::find(origins.rbegin(), origins.rend(), origin) != origins.rend()) continue;
      origins.push_back(origin);
      rule_out(map, origin, scale, distance);
    }
}

void add_reuse_weight(PositionMap& map, const UseTable& uses, Size window, double reuse_weight) {
  const double average = uses.mean();
  if (average <= 0.0 || reuse_weight <= 0.0) return;
  map.for_each([&](int x, int y, std::int64_t& mismatch) {
    if (mismatch == ruled_out) return;
    const double often = uses.mean({x, y, window.width, window.height}) / average;
    mismatch = static_cast<std::int64_t>(static_cast<double>(mismatch) * (1.0 + reuse_weight * often));
  });
}

bool take_best(PositionMap& map, int apart, SourceTexel& place) {
  std::int64_t best = ruled_out;
  for (const PositionMap::Part& part : map.parts) {
    const auto least = std::min_element(part.values.begin(), part.values.end());
    if (least == part.values.end() || *least == ruled_out) continue;
    const SourceTexel at = part.place(static_cast<std::size_t>(least - part.values.begin()));
    if (*least > best || (*least == best && std::tie(place.y, place.x) < std::tie(at.y, at.x))) continue;
    best = *least;
    place = at;
  }
  if (best == ruled_out) return false;
  rule_out(map, place, 1, apart);
  return true;
}

} // namespace tilepack
