#include "tilepack/synth/set_faults.h"

#include "tilepack/exemplar/structure.h"
#include "tilepack/seam/source_canvas.h"
#include "tilepack/synth/framed_set_settings.h"
#include "tilepack/tileset/border_colors.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace tilepack {
namespace {

constexpr int line_length = 20; // texels
constexpr int line_band = 2;    // a cut so far to either side of the line lies along it
constexpr int block_depth = 12; // of what is compared on its two sides
constexpr int beyond = line_band + 1 + block_depth;
constexpr int least_line_step = 4;   // between lines that are looked at, along them
constexpr double along_line = 0.8;   // of its texels have a cut
constexpr double over_usual = 1.25;  // times what 19 of 20 lines of the sample stay below
constexpr double least_step = 3.0;   // of 255: less is never seen
constexpr double of_deviation = 0.2; // of the sample: less is lost in what it shows
constexpr int places_apart = 16;     // texels
constexpr std::size_t most_breaks = 16;
constexpr int sampled_lines = 48; // of the sample, along each axis
constexpr int dear_side = 24;
constexpr int dear_step = 8;

using Sums = std::array<std::int64_t, max_feature_channels>;

// RMS over channels of the difference of two means, each of `count` texels.
double step_between(const Sums& a, const Sums& b, int channels, double count) {
  double squares = 0.0;
  for (int c = 0; c < channels; ++c) {
    const auto k = static_cast<std::size_t>(c);
    const double d = static_cast<double>(a[k] - b[k]) / count;
    squares += d * d;
  }
  return std::sqrt(squares / channels);
}

// The step across a line at `at` (across) from `from` on (along). `texel(across, along)` is a texel's values.
template <class Texel>
double step_across(const FeatureImage& image, int at, int from, Texel&& texel) {
  Sums before{}, after{};
  for (int v = from; v < from + line_length; ++v)
    for (int i = 0; i < block_depth; ++i) {
      const std::uint8_t* a = texel(at - line_band - 1 - i, v);
      const std::uint8_t* b = texel(at + line_band + i, v);
      for (int c = 0; c < image.channels; ++c) {
        before[static_cast<std::size_t>(c)] += a[c];
        after[static_cast<std::size_t>(c)] += b[c];
      }
    }
  return step_between(before, after, image.channels, line_length * block_depth);
}

// What 19 of 20 lines of the sample stay below.
double usual_step(const FeatureImage& image, bool vertical) {
  const int across = vertical ? image.width : image.height;
  const int along = vertical ? image.height : image.width;
  const auto texel = [&](int u, int v) { return vertical ? image.texel(u, v) : image.texel(v, u); };
  std::vector<double> steps;
  const int first = beyond, last = across - beyond, end = along - line_length;
  if (last <= first || end <= 0) return 0.0;
  for (int i = 0; i < sampled_lines; ++i)
    for (int j = 0; j < sampled_lines; ++j)
      steps.push_back(
          step_across(image, first + (last - first) * i / sampled_lines, end * j / sampled_lines, texel));
  const auto place = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() * 19 / 20);
  std::nth_element(steps.begin(), place, steps.end());
  return *place;
}

// RMS over channels.
double deviation_of(const FeatureImage& image) {
  return std::sqrt(static_cast<double>(variance_of(image)) / image.channels);
}

// Tiles that may lie beside each: the first of those whose border fits.
struct Beside {
  std::vector<std::size_t> west, east, north, south;

  explicit Beside(const TileColors& tiles) {
    const std::vector<BorderColors> colors = border_colors(tiles);
    const auto first = [&](auto&& fits, std::size_t own) {
      const auto it = std::find_if(colors.begin(), colors.end(), fits);
      return it == colors.end() ? own : static_cast<std::size_t>(it - colors.begin());
    };
    for (std::size_t t = 0; t < colors.size(); ++t) {
      west.push_back(first([&](const BorderColors& c) { return c.east == colors[t].west; }, t));
      east.push_back(first([&](const BorderColors& c) { return c.west == colors[t].east; }, t));
      north.push_back(first([&](const BorderColors& c) { return c.south == colors[t].north; }, t));
      south.push_back(first([&](const BorderColors& c) { return c.north == colors[t].south; }, t));
    }
  }
};

// A tile with `beyond` texels of its neighbours on two sides, lines running along the other axis.
class TileView {
public:
  TileView(const FeatureImage& feature_image, const SourceMap& source_map, const Beside& beside,
           std::size_t tile, bool vertical_lines)
      : image(feature_image), vertical(vertical_lines), width(source_map.tile_size.width),
        across(vertical ? source_map.tile_size.width : source_map.tile_size.height),
        along(vertical ? source_map.tile_size.height : source_map.tile_size.width),
        own(source_map.texels[tile]),
        before(source_map.texels[vertical ? beside.west[tile] : beside.north[tile]]),
        after(source_map.texels[vertical ? beside.east[tile] : beside.south[tile]]) {}

  SourceTexel source(int u, int v) const {
    const auto& texels = u < 0 ? before : u < across ? own : after;
    const int place = std::clamp(u < 0 ? u + across : u < across ? u : u - across, 0, across - 1);
    const int x = vertical ? place : v, y = vertical ? v : place;
    return texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
  const std::uint8_t* texel(int u, int v) const {
    const SourceTexel s = source(u, v);
    return image.texel(s.x, s.y);
  }
  bool has_cut(int u, int v) const { // between u - 1 and u
    const SourceTexel p = source(u - 1, v), q = source(u, v);
    return vertical ? q.x != p.x + 1 || q.y != p.y : q.x != p.x || q.y != p.y + 1;
  }

  const FeatureImage& image;
  bool vertical;
  int width, across, along;

private:
  const std::vector<SourceTexel>&own, &before, &after;
};

struct Line {
  int at = 0, from = 0;
  double step = 0;
};

// Of all lines that begin at one place along them, those that break most, apart.
void add_breaks(const TileView& view, const std::vector<std::uint8_t>& near_cut, int from, double limit,
                std::vector<Line>& breaks) {
  std::vector<Line> here;
  for (int at = 0; at < view.across; at += 2) {
    int cuts = 0;
    for (int v = from; v < from + line_length; ++v)
      cuts += near_cut[static_cast<std::size_t>(v) * static_cast<std::size_t>(view.across) +
                       static_cast<std::size_t>(at)];
    if (cuts < along_line * line_length) continue;
    const double step = step_across(view.image, at, from, [&](int u, int v) { return view.texel(u, v); });
    if (step > limit) here.push_back({at, from, step});
  }
  std::stable_sort(here.begin(), here.end(), [](const Line& a, const Line& b) { return a.step > b.step; });
  const std::size_t first = breaks.size();
  for (const Line& line : here)
    if (std::none_of(breaks.begin() + static_cast<std::ptrdiff_t>(first), breaks.end(),
                     [&](const Line& other) { return std::abs(other.at - line.at) < places_apart; }))
      breaks.push_back(line);
}

// Between lines, along them: large tiles are not looked at more often.
int line_step(int along) {
  return std::max(least_line_step, along / 40);
}

std::vector<Line> breaks_of(const TileView& view, double limit) {
  std::vector<std::uint8_t> near_cut(static_cast<std::size_t>(view.across) *
                                     static_cast<std::size_t>(view.along));
  for (int v = 0; v < view.along; ++v)
    for (int at = 1 - line_band; at < view.across + line_band; ++at) {
      if (!view.has_cut(at, v)) continue;
      for (int u = std::max(0, at - line_band + 1); u <= std::min(view.across - 1, at + line_band); ++u)
        near_cut[static_cast<std::size_t>(v) * static_cast<std::size_t>(view.across) +
                 static_cast<std::size_t>(u)] = 1;
    }
  std::vector<Line> breaks;
  for (int from = 0; from + line_length <= view.along; from += line_step(view.along))
    add_breaks(view, near_cut, from, limit, breaks);
  return breaks;
}

bool far(const TilePlace& a, const TilePlace& b) {
  return a.tile != b.tile ||
         std::abs(a.area.x + a.area.width / 2 - b.area.x - b.area.width / 2) >= places_apart ||
         std::abs(a.area.y + a.area.height / 2 - b.area.y - b.area.height / 2) >= places_apart;
}

// The strongest, none near another.
std::vector<TilePlace> strongest(std::vector<TilePlace> places, std::size_t count) {
  std::stable_sort(places.begin(), places.end(),
                   [](const TilePlace& a, const TilePlace& b) { return a.strength > b.strength; });
  std::vector<TilePlace> chosen;
  for (const TilePlace& place : places) {
    if (chosen.size() == count) break;
    if (std::all_of(chosen.begin(), chosen.end(), [&](const TilePlace& other) { return far(place, other); }))
      chosen.push_back(place);
  }
  return chosen;
}

} // namespace

namespace {

// One texel for scale × scale, of those in their middle, for the sample at that scale, which may lack its last texels.
SourceMap shrunk(const SourceMap& sources, int scale, Size sample) {
  const Size full = sources.tile_size;
  SourceMap small{{}, sources.colors, sources.tiles, {}, sources.guard};
  small.tile_size = {full.width / scale, full.height / scale};
  for (std::size_t t = 0; t < sources.texels.size(); ++t) {
    small.texels.emplace_back();
    for (int y = 0; y < small.tile_size.height; ++y)
      for (int x = 0; x < small.tile_size.width; ++x) {
        const SourceTexel s = sources.texels[t][static_cast<std::size_t>(y * scale + scale / 2) *
                                                    static_cast<std::size_t>(full.width) +
                                                static_cast<std::size_t>(x * scale + scale / 2)];
        small.texels[t].push_back(
            {std::min(s.x / scale, sample.width - 1), std::min(s.y / scale, sample.height - 1)});
      }
  }
  return small;
}

ToneBreaks breaks_as_seen(const FeatureImage& image, const SourceMap& sources) {
  const Size tile = sources.tile_size;
  ToneBreaks result;
  if (std::min(tile.width, tile.height) < 2 * beyond) return result;
  result.looked = true;
  const Beside beside(sources.tiles);
  const std::size_t tiles = sources.texels.size();
  const double least = std::max(least_step, of_deviation * deviation_of(image));
  const std::array<double, 2> limits{std::max(least, over_usual * usual_step(image, false)),
                                     std::max(least, over_usual * usual_step(image, true))};
  std::vector<std::vector<Line>> found(2 * tiles);
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t i) {
    const TileView view(image, sources, beside, i / 2, i % 2 == 1);
    found[i] = breaks_of(view, limits[i % 2]);
  });
  std::vector<TilePlace> places;
  double length = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    length += static_cast<double>(found[i].size()) * line_step(i % 2 == 1 ? tile.height : tile.width);
    for (const Line& line : found[i]) {
      const Rect area = i % 2 == 1 ? Rect{line.at - line_length / 2, line.from, line_length, line_length}
                                   : Rect{line.from, line.at - line_length / 2, line_length, line_length};
      places.push_back({static_cast<int>(i / 2), area, line.step / limits[i % 2]});
    }
  }
  result.share = std::round(1e4 * length / (static_cast<double>(tiles) * (tile.width + tile.height))) / 1e4;
  result.worst = strongest(std::move(places), most_breaks);
  return result;
}

} // namespace

ToneBreaks tone_breaks(const FeatureImage& image, const SourceMap& sources) {
  const int halvings = halvings_to_usual(sources.tile_size);
  if (halvings == 0) return breaks_as_seen(image, sources);
  FeatureImage small = halved(image);
  for (int n = 1; n < halvings; ++n) small = halved(small);
  const int scale = 1 << halvings;
  ToneBreaks result = breaks_as_seen(small, shrunk(sources, scale, {small.width, small.height}));
  for (TilePlace& place : result.worst) {
    Rect& a = place.area;
    a = {a.x * scale, a.y * scale, a.width * scale, a.height * scale};
  }
  return result;
}

std::vector<TilePlace> dearest_places(const FeatureImage& image, const SourceMap& sources, int count) {
  const Size tile = sources.tile_size;
  std::vector<std::vector<TilePlace>> found(sources.texels.size());
  tbb::parallel_for(std::size_t{0}, found.size(), [&](std::size_t t) {
    SourceCanvas canvas(tile.width, tile.height);
    canvas.texels = sources.texels[t];
    const std::vector<std::int64_t> costs = seams_at_texels(image, canvas);
    const int w = std::min(dear_side, tile.width), h = std::min(dear_side, tile.height);
    for (int y = 0; y + h <= tile.height; y += dear_step)
      for (int x = 0; x + w <= tile.width; x += dear_step) {
        std::int64_t sum = 0;
        for (int j = y; j < y + h; ++j)
          for (int i = x; i < x + w; ++i) sum += costs[canvas.index(i, j)];
        if (sum > 0)
          found[t].push_back({static_cast<int>(t),
                              {x, y, w, h},
                              std::sqrt(static_cast<double>(sum) / (4.0 * w * h * image.channels))});
      }
  });
  std::vector<TilePlace> places;
  for (const auto& some : found) places.insert(places.end(), some.begin(), some.end());
  return strongest(std::move(places), static_cast<std::size_t>(count));
}

} // namespace tilepack
