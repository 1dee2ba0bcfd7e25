#include "support/shader_packs.h"
#include "support/small_pack.h"

#include "tilepack/numeric/random.h"
#include "tilepack/sampler/fast_sampler.h"
#include "tilepack/sampler/ground_truth.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

using namespace tilepack;

namespace {

// Places in and round a pack's tiles, half of them where a filter of their level crosses a border.
struct Places {
  std::vector<std::int32_t> tile_x, tile_y;
  std::vector<float> x, y, level;

  Places(const Pack& pack, int count) {
    for (int i = 0; i < count; ++i) {
      const auto drawn = [&](std::string_view purpose) {
        return static_cast<double>(random_bits(7, purpose, static_cast<std::uint64_t>(i)) >> 11) * 0x1p-53;
      };
      const int fine = static_cast<int>(drawn("level") * pack.tile_levels);
      const auto fraction = [&](std::string_view purpose, int side) {
        const double u = drawn(purpose);
        const double half = 0.5 / std::max(1, side >> fine);
        return static_cast<float>(i % 2 == 0 ? u : u < 0.5 ? u * 2 * half : 1 - (1 - u) * 2 * half);
      };
      tile_x.push_back(static_cast<std::int32_t>(drawn("tx") * 400) - 200);
      tile_y.push_back(static_cast<std::int32_t>(drawn("ty") * 400) - 200);
      x.push_back(fraction("x", pack.tile_size.width));
      y.push_back(fraction("y", pack.tile_size.height));
      const double at = i % 3 == 0 ? fine : fine + drawn("part");
      level.push_back(static_cast<float>(pack.full_chain ? std::min(at, pack.tile_levels - 1.0) : at));
    }
  }
  SampleBatch batch() const {
    return {x.size(), tile_x.data(), tile_y.data(), x.data(), y.data(), level.data()};
  }
};

struct Off {
  double exact = 0, plain = 0; // largest, linear values
};

Off largest_off(const Pack& pack, const GroundTruth& truth, Filter filter, Weights weights) {
  const FastSampler sampler(pack, 0);
  const auto channels = static_cast<std::size_t>(sampler.channels());
  const Places places(pack, 20011); // not whole chunks
  std::array<std::vector<float>, 4> exact, plain;
  std::array<float*, 4> to_exact{}, to_plain{};
  for (std::size_t c = 0; c < channels; ++c) {
    exact[c].resize(places.x.size());
    plain[c].resize(places.x.size());
    to_exact[c] = exact[c].data();
    to_plain[c] = plain[c].data();
  }
  sampler.sample_exact(places.batch(), filter, weights, {to_exact.data(), channels});
  sampler.sample(places.batch(), filter, weights, {to_plain.data(), channels});
  Off off;
  std::array<double, 4> expected{};
  for (std::size_t i = 0; i < places.x.size(); ++i) {
    truth.sample({places.tile_x[i], static_cast<double>(places.x[i])},
                 {places.tile_y[i], static_cast<double>(places.y[i])}, static_cast<double>(places.level[i]),
                 filter, {expected.data(), channels});
    for (std::size_t c = 0; c < channels; ++c) {
      // Where alpha is 0, colors are free.
      if (channels == 4 && c < 3 && expected[3] < 1e-3) continue;
      off.exact = std::max(off.exact, std::fabs(static_cast<double>(exact[c][i]) - expected[c]));
      off.plain = std::max(off.plain, std::fabs(static_cast<double>(plain[c][i]) - expected[c]));
    }
  }
  return off;
}

} // namespace

TEST_CASE("exact lookups read every texel from the tile that it lies in, at every level") {
  for (const test::NamedPack& named : test::shader_packs()) {
    if (named.pack.layout.kind == LayoutKind::rotated) continue;
    INFO(named.name);
    const GroundTruth truth = GroundTruth::of_stored_levels(named.pack, 0);
    for (const Filter filter : {Filter::bilinear, Filter::trilinear}) {
      const Off off = largest_off(named.pack, truth, filter, Weights::exact);
      CHECK(off.exact < 2e-5);
      CHECK(off.plain > 0.01);
      CHECK(largest_off(named.pack, truth, filter, Weights::fixed_8_8).exact < 6.0 / 256);
    }
    CHECK(largest_off(named.pack, truth, Filter::nearest, Weights::exact).exact < 2e-5);
  }
}

TEST_CASE("exact lookups hold for every kind of stored texel, with alpha too") {
  for (const auto& [depth, encoding] : {std::pair{Depth::u8, Encoding::linear},
                                        {Depth::u16, Encoding::linear},
                                        {Depth::f16, Encoding::linear},
                                        {Depth::f32, Encoding::linear},
                                        {Depth::u8, Encoding::srgb}})
    for (const int channels : {1, 3, 4}) {
      CAPTURE(name_of(depth), name_of(encoding), channels);
      SmallPack wanted;
      wanted.depth = depth;
      wanted.encoding = encoding;
      wanted.channels = channels;
      const Pack pack = small_pack(wanted);
      const GroundTruth truth = GroundTruth::of_stored_levels(pack, 0);
      CHECK(largest_off(pack, truth, Filter::trilinear, Weights::exact).exact < 1e-4);
    }
}

TEST_CASE(
    "with box mips, exact lookups are off the true picture by rounding alone; with mended borders by more") {
  const TileSet set = framed_set(complete_corner_set(2), {16, 16}, 4);
  PackingOptions options;
  options.layout = LayoutKind::de_bruijn;
  const auto encoded_off = [&](MipMode mode, bool exact) {
    options.mips.mode = mode;
    const Pack pack = packed(set, options, 1);
    const GroundTruth truth = GroundTruth::of_level_0(pack, 0);
    const FastSampler sampler(pack, 0);
    const Places places(pack, 20000);
    std::array<std::vector<float>, 3> values;
    std::array<float*, 3> to{};
    for (std::size_t c = 0; c < 3; ++c) {
      values[c].resize(places.x.size());
      to[c] = values[c].data();
    }
    if (exact)
      sampler.sample_exact(places.batch(), Filter::bilinear, Weights::exact, to);
    else
      sampler.sample(places.batch(), Filter::bilinear, Weights::exact, to);
    double largest = 0;
    std::array<double, 3> expected{};
    for (std::size_t i = 0; i < places.x.size(); ++i) {
      truth.sample({places.tile_x[i], static_cast<double>(places.x[i])},
                   {places.tile_y[i], static_cast<double>(places.y[i])}, static_cast<double>(places.level[i]),
                   Filter::bilinear, expected);
      for (std::size_t c = 0; c < 3; ++c)
        largest = std::max(largest, 255 * std::fabs(linear_to_srgb(static_cast<double>(values[c][i])) -
                                                    linear_to_srgb(expected[c])));
    }
    return largest;
  };
  CHECK(encoded_off(MipMode::box, true) < 0.51); // half a code, and the table of light in 16 bits
  CHECK(encoded_off(MipMode::edges, true) > 2);
  CHECK(encoded_off(MipMode::box, false) > 5);
  WARN("largest error of 255: box exact " << encoded_off(MipMode::box, true) << ", edges "
                                          << encoded_off(MipMode::edges, false) << ", box "
                                          << encoded_off(MipMode::box, false));
}
