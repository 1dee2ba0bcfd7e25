#include "support/images.h"

#include "tilepack/match/row_correlation.h"
#include "tilepack/numeric/random.h"
#include "tilepack/synth/border_match_costs.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

using namespace tilepack;

namespace {

// Bytes of all values, the extremes often.
// Noise, every third value at an end of the range.
FeatureImage extreme_noise(int width, int height, int channels) {
  FeatureImage image = test::noise_features(width, height, channels, 7);
  for (std::size_t i = 0; i < image.values.size(); i += 3) image.values[i] = image.values[i] < 128 ? 0 : 255;
  return image;
}

} // namespace

TEST_CASE("rows of pairs are correlated as by the plain sum, at every stride and number of places") {
  const FeatureImage image = extreme_noise(173, 9, 3);
  for (const int stride : {1, 2, 5})
    for (const int places : {1, 4, 15, 16, 17, 63, 64, 65, 100}) {
      const PairPlanes pairs(image, stride);
      std::vector<PairTerm> terms;
      struct Laid {
        int channel, x, y;
      };
      const int room = image.width - (places - 1) * stride;
      if (room < 2) continue;
      std::vector<Laid> laid;
      for (int i = 0; i < 50; ++i) {
        const auto n = static_cast<std::uint64_t>(i);
        const auto width = static_cast<std::uint32_t>(room - 1);
        laid.push_back({i % 3, static_cast<int>(random_below(1, "x", n, width)), (i * 5) % image.height});
        const auto value = [&](const char* which) {
          return static_cast<std::int16_t>(random_below(1, which, n, 256));
        };
        terms.push_back({pairs.index(laid.back().channel, laid.back().x, laid.back().y), value("first"),
                         i % 4 == 0 ? std::int16_t{0} : value("second")});
      }
      std::vector<std::int64_t> sums(static_cast<std::size_t>(places), -1);
      correlate_pairs(pairs.data(), terms, sums);
      for (int place = 0; place < places; ++place) {
        std::int64_t expected = 0;
        for (std::size_t i = 0; i < terms.size(); ++i) {
          const int x = laid[i].x + place * stride;
          expected += terms[i].first * image.texel(x, laid[i].y)[laid[i].channel] +
                      terms[i].second * image.texel(x + 1, laid[i].y)[laid[i].channel];
        }
        INFO("stride " << stride << ", place " << place << " of " << places);
        CHECK(sums[static_cast<std::size_t>(place)] == expected);
      }
    }
}

TEST_CASE("sums of many largest products do not overflow") {
  FeatureImage image{2, 1, 1, {255, 255}};
  const PairPlanes pairs(image, 1);
  const std::vector<PairTerm> terms(50'000, PairTerm{0, 255, 255});
  std::vector<std::int64_t> sum(1);
  correlate_pairs(pairs.data(), terms, sum);
  CHECK(sum[0] == 2LL * 255 * 255 * 50'000);
}

// The definition, texel by texel: what the frame shows of a tile within `reach` of one border, less the parts
// that belong to the strips of the other direction.
TEST_CASE("match costs are the differences between what strips show and what insides would show there") {
  const FeatureImage image = extreme_noise(60, 52, 3);
  for (const auto& [tile, reach] :
       {std::pair<Size, ReachShares>{{24, 18}, 0.2}, std::pair<Size, ReachShares>{{17, 25}, {0.2, 0.4}},
        std::pair<Size, ReachShares>{{26, 20}, {0.45, 0.25}}}) {
    SynthOptions options;
    options.tile_size = {tile.width, tile.height};
    options.coloring = Coloring::corner;
    options.colors = {0, 0, 2};
    const FrameShape shape = frame_shape(options, {}, reach, 0.3);
    const BorderMatchCosts match_costs(image, shape, 10'000);
    REQUIRE(match_costs.positions().stride == 1);
    REQUIRE(match_costs.positions().columns == image.width - tile.width + 1);
    for (const Direction direction : {Direction::horizontal, Direction::vertical}) {
      const StripAxes axes = axes_of(shape, direction);
      const StripAt strip{image, shape, axes, {11, 7}, {20, 22}, {31, 25}};
      const auto maps = match_costs.of(strip);
      for (int j = 0; j < match_costs.positions().rows; j += 3)
        for (int i = 0; i < match_costs.positions().columns; i += 5)
          for (const EdgeSide side : {EdgeSide::before, EdgeSide::after}) {
            const bool before = side == EdgeSide::before;
            std::int64_t expected = 0;
            for (int y = 0; y < tile.height; ++y)
              for (int x = 0; x < tile.width; ++x) {
                const int to_vertical = std::min(x, tile.width - 1 - x);
                const int to_horizontal = std::min(y, tile.height - 1 - y);
                const bool of_horizontal = to_horizontal * shape.reach.x <= to_vertical * shape.reach.y;
                if (of_horizontal != (direction == Direction::horizontal)) continue;
                const int extent = of_horizontal ? tile.height : tile.width;
                const int tile_across = of_horizontal ? y : x;
                // The tile before an edge shows it at its far side.
                const int distance = before ? extent - 1 - tile_across : tile_across;
                if (distance >= axes.reach) continue;
                const int across = before ? axes.reach - 1 - distance : axes.reach + distance;
                expected += squared_difference(strip.shown(of_horizontal ? x : y, across),
                                               image.texel(i + x, j + y), image.channels);
              }
            const auto place = static_cast<std::size_t>(j * match_costs.positions().columns + i);
            INFO("tile " << tile.width << " x " << tile.height << ", " << i << ", " << j
                         << (before ? " before" : " after"));
            CHECK(maps[static_cast<std::size_t>(side)][place] ==
                  static_cast<float>(static_cast<double>(expected) / axes.reach));
          }
    }
  }
}
