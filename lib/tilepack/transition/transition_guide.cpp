#include "tilepack/transition/transition_guide.h"

#include "tilepack/exemplar/object_scale.h"
#include "tilepack/exemplar/structure.h"
#include "tilepack/numeric/side_by_side.h"
#include "tilepack/numeric/summed_areas.h"

#include <algorithm>
#include <cmath>

namespace tilepack {
namespace {

// A border that is as long as it can be costs something, and so does one between unlike texels; what costs most is to
// run through things. In 1024ths.
constexpr std::int64_t length_cost = 110;
constexpr std::int64_t difference_cost = 220;
constexpr std::int64_t inside_cost = 1000;

constexpr double things_of_scale = 3.0; // a thing is so many object_scales wide (exemplar/object_scale.h)
constexpr double least_thing = 6.0;
constexpr double usual_sign = 0.5;
constexpr double sign_of_correlation =
    4.0; // of 18 photos and samples: walls, mud, planks 0.2 to 0.6, bricks with bright
         // mortar -0.3, sand 0
constexpr double seen_thing = 24.0; // texels
constexpr int least_seen_side = 32; // of a sample looked at from afar

// Smoothed by 1 4 6 4 1 along both axes, in 16ths of a value: what is steep then is no grain.
Grid<int> smoothed(const FeatureImage& image, int channel) {
  constexpr int weights[5] = {1, 4, 6, 4, 1};
  Grid<int> along(image.width, image.height);
  Grid<int> both(image.width, image.height);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int k = -2; k <= 2; ++k) along.at(x, y) += weights[k + 2] * image.clamped_texel(x + k, y)[channel];
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      for (int k = -2; k <= 2; ++k)
        both.at(x, y) += weights[k + 2] * along.at(x, std::clamp(y + k, 0, image.height - 1));
      both.at(x, y) /= 16;
    }
  return both;
}

// How steep the smoothed image is, all channels together.
Grid<int> steepness(const FeatureImage& image) {
  Grid<int> steep(image.width, image.height);
  for (int c = 0; c < image.channels; ++c) {
    const Grid<int> values = smoothed(image, c);
    const auto at = [&](int x, int y) {
      return values.at(std::clamp(x, 0, image.width - 1), std::clamp(y, 0, image.height - 1));
    };
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x) {
        const int dx = at(x + 1, y) - at(x - 1, y);
        const int dy = at(x, y + 1) - at(x, y - 1);
        steep.at(x, y) += (dx * dx + dy * dy) / 256;
      }
  }
  return steep;
}

// 255 where a material is least steep, 0 where it is steepest, falling with the square of the rank: outlines are few, and
// all that is no outline is about as bad to cut.
Grid<std::uint8_t> flatness(const FeatureImage& image) {
  const Grid<int> steep = steepness(image);
  std::vector<int> sorted = steep.values;
  std::sort(sorted.begin(), sorted.end());
  Grid<std::uint8_t> flat(image.width, image.height);
  const auto count = static_cast<std::int64_t>(sorted.size());
  for (std::size_t p = 0; p < flat.values.size(); ++p) {
    const std::int64_t above = sorted.end() - std::upper_bound(sorted.begin(), sorted.end(), steep.values[p]);
    flat.values[p] = static_cast<std::uint8_t>(255 * above / count * above / count);
  }
  return flat;
}

// A sample looked at from so far off that a thing is `seen_thing` texels wide: what is drawn on a stone is then no outline.
struct FarView {
  FeatureImage image;
  int scale = 1; // texels of the sample to one of the image
};

FarView far_view(const FeatureImage& image, double thing) {
  FarView far{image, 1};
  for (; thing / far.scale > seen_thing && std::min(far.image.width, far.image.height) >= 2 * least_seen_side;
       far.scale *= 2)
    far.image = halved(far.image);
  return far;
}

Grid<std::uint8_t> inside_of(const FeatureImage& image, const FarView& far) {
  const FeatureImage& seen = far.image;
  const int scale = far.scale;
  const Grid<std::uint8_t> flat = flatness(seen);
  if (scale == 1) return flat;
  Grid<std::uint8_t> result(image.width, image.height);
  const int unit = 2 * scale; // parts of a texel of the smaller image
  const auto at = [&](int x, int y) {
    return static_cast<int>(flat.at(std::clamp(x, 0, flat.width - 1), std::clamp(y, 0, flat.height - 1)));
  };
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) { // bilinear between the centres of its texels
      const int u = 2 * x + 1 - scale, v = 2 * y + 1 - scale;
      const int i = u >= 0 ? u / unit : -1, j = v >= 0 ? v / unit : -1;
      const int s = u - i * unit, t = v - j * unit;
      const int upper = at(i, j) * (unit - s) + at(i + 1, j) * s;
      const int lower = at(i, j + 1) * (unit - s) + at(i + 1, j + 1) * s;
      result.at(x, y) = static_cast<std::uint8_t>((upper * (unit - t) + lower * t) / (unit * unit));
    }
  return result;
}

// Heights where there are some, else brightness.
Grid<int> what_stands(const JoinedSamples& joined, Rect place, bool& are_heights) {
  constexpr float steps = 65535.0f;
  const auto height = std::find_if(joined.maps.begin(), joined.maps.end(),
                                   [](const SampleMap& map) { return map.role == Role::height; });
  are_heights = height != joined.maps.end();
  const Image& image = are_heights ? height->image : joined.maps.front().image;
  const int channels = are_heights ? 1 : color_channels(image.channels());
  Grid<double> values(place.width, place.height);
  for (int y = 0; y < place.height; ++y)
    for (int x = 0; x < place.width; ++x)
      for (const float v : image.texel(place.x + x, place.y + y).first(static_cast<std::size_t>(channels)))
        values.at(x, y) += static_cast<double>(v);
  const auto [low, high] = std::minmax_element(values.values.begin(), values.values.end());
  const double least = *low;
  const double range = *high > least ? *high - least : 1.0;
  Grid<int> result(place.width, place.height);
  for (std::size_t p = 0; p < result.values.size(); ++p)
    result.values[p] = static_cast<int>((values.values[p] - least) / range * static_cast<double>(steps));
  return result;
}

// Whether things are brighter (1) or darker (-1) than what is between them, by how brightness goes with the distance to the
// nearest outline, which is less between things than inside them. Where it says little, what is dark is taken to lie low, as
// it gets less light: then 0.5.
double sign_of_brightness(const Grid<int>& over, const FarView& far) {
  const FeatureImage structured = with_structure(far.image);
  if (structured.channels == far.image.channels) return usual_sign; // has no room for the channel
  double x_sum = 0, y_sum = 0, xx = 0, yy = 0, xy = 0;
  for (int j = 0; j < structured.height; ++j)
    for (int i = 0; i < structured.width; ++i) {
      const double x = structured.texel(i, j)[structured.channels - 1];
      const double y = over.at(std::min(i * far.scale + far.scale / 2, over.width - 1),
                               std::min(j * far.scale + far.scale / 2, over.height - 1));
      x_sum += x;
      y_sum += y;
      xx += x * x;
      yy += y * y;
      xy += x * y;
    }
  const double n = static_cast<double>(structured.width) * structured.height;
  const double spread = (xx - x_sum * x_sum / n) * (yy - y_sum * y_sum / n);
  const double correlation = spread > 0 ? (xy - x_sum * y_sum / n) / std::sqrt(spread) : 0.0;
  return std::clamp(usual_sign + sign_of_correlation * correlation, -1.0, 1.0);
}

// Values over their surroundings, in halves of their spread, -127..127; with a sign if they are brightness.
void set_standing(const Grid<int>& values, bool are_heights, double thing, const FarView& far, Rect place,
                  Grid<std::int8_t>& standing) {
  const int around = std::max(4, static_cast<int>(2 * thing));
  const int grain = std::max(1, static_cast<int>(thing / 12));
  const SummedAreas<std::int64_t> areas(values);
  const auto mean = [&](int x, int y, int reach) {
    return areas.mean({x - reach, y - reach, 2 * reach + 1, 2 * reach + 1});
  };
  Grid<int> over(values.width, values.height);
  double squares = 0;
  for (int y = 0; y < values.height; ++y)
    for (int x = 0; x < values.width; ++x) {
      const int here = static_cast<int>(std::lround(mean(x, y, grain) - mean(x, y, around)));
      over.at(x, y) = here;
      squares += static_cast<double>(here) * here;
    }
  const double spread = std::sqrt(squares / static_cast<double>(over.values.size()));
  if (spread < 1) return;
  const double sign = are_heights ? 1.0 : sign_of_brightness(over, far);
  for (int y = 0; y < values.height; ++y)
    for (int x = 0; x < values.width; ++x)
      standing.at(place.x + x, place.y + y) = static_cast<std::int8_t>(
          std::clamp<long>(std::lround(64 * sign * over.at(x, y) / spread), -127, 127));
}

// The mean over every so-manieth texel of both, at places that have nothing to do with one another.
std::int64_t mean_difference(const FeatureImage& image, const std::vector<Rect>& places) {
  constexpr int samples = 64; // along each axis
  std::int64_t sum = 0;
  std::int64_t count = 0;
  for (std::size_t a = 0; a < places.size(); ++a)
    for (std::size_t b = a + 1; b < places.size(); ++b)
      for (int j = 0; j < samples; ++j)
        for (int i = 0; i < samples; ++i, ++count) {
          const auto at = [&](const Rect& r) {
            return image.texel(r.x + i * r.width / samples, r.y + j * r.height / samples);
          };
          sum += squared_difference(at(places[a]), at(places[b]), image.channels);
        }
  return count > 0 ? std::max<std::int64_t>(1, sum / count) : 1;
}

} // namespace

std::int64_t TransitionGuide::border_cost(SourceTexel p, SourceTexel p_beyond, SourceTexel q,
                                          SourceTexel q_beyond) const {
  const auto texel = [&](SourceTexel s) { return features.texel(s.x, s.y); };
  const std::int64_t difference = squared_difference(texel(p), texel(q_beyond), features.channels) +
                                  squared_difference(texel(q), texel(p_beyond), features.channels);
  const auto within = [&](SourceTexel here, SourceTexel there) { // a sheet's outline may lie at either texel
    return std::min(inside.at(here.x, here.y), inside.at(there.x, there.y));
  };
  return length_cost + difference_cost * difference / (difference + 2 * usual_difference) +
         inside_cost * (within(p, p_beyond) + within(q, q_beyond)) / 255;
}

TransitionGuide transition_guide(const JoinedSamples& joined,
                                 std::span<const SampleAnalysis* const> materials) {
  TransitionGuide guide;
  guide.features = feature_image(joined.maps);
  guide.inside = Grid<std::uint8_t>(guide.features.width, guide.features.height);
  guide.standing = Grid<std::int8_t>(guide.features.width, guide.features.height);
  guide.usual_difference = mean_difference(guide.features, joined.places);
  std::vector<double> things(materials.size());
  each_side_by_side(materials.size(), [&](std::size_t m) {
    things[m] = std::max(least_thing, things_of_scale * object_scale(materials[m]->features));
  });
  const double largest = *std::max_element(things.begin(), things.end());
  each_side_by_side(materials.size(), [&](std::size_t m) {
    const Rect place = joined.places[m];
    const FarView far = far_view(materials[m]->features, things[m]);
    const Grid<std::uint8_t> inside = inside_of(materials[m]->features, far);
    for (int y = 0; y < place.height; ++y)
      for (int x = 0; x < place.width; ++x) // the smaller things are, the less is it seen that they are cut
        guide.inside.at(place.x + x, place.y + y) =
            static_cast<std::uint8_t>(inside.at(x, y) * std::sqrt(things[m] / largest));
    bool are_heights = false;
    const Grid<int> values = what_stands(joined, place, are_heights);
    set_standing(values, are_heights, things[m], far, place, guide.standing);
  });
  guide.thing = largest;
  return guide;
}

} // namespace tilepack
