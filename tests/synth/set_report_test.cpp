#include "support/samples.h"

#include "tilepack/exemplar/sample_traits.h"
#include "tilepack/seam/source_canvas.h"
#include "tilepack/synth/set_report.h"
#include "tilepack/synth/synthesize.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>

using namespace tilepack;
using namespace tilepack::testing;

namespace {

// Tiles that are windows of the sample, each with its north-west texel at the place given.
SourceMap windows(Size tile, const std::vector<SourceTexel>& places) {
  SourceMap map{tile, {1, 1, 0}, std::vector<EdgeTile>(places.size()), {}, 0};
  for (const SourceTexel place : places) {
    auto& texels = map.texels.emplace_back();
    for (int y = 0; y < tile.height; ++y)
      for (int x = 0; x < tile.width; ++x) texels.push_back({place.x + x, place.y + y});
  }
  return map;
}

} // namespace

TEST_CASE("windows of the sample have no cuts, and show what they show", "[set_report]") {
  const FeatureImage image = features(blobs(64, 64));
  const SetReport four =
      set_report(analysed(image, {}), windows({32, 32}, {{0, 0}, {32, 0}, {0, 32}, {32, 32}}));
  CHECK(four.figures.cut_length == 0);
  CHECK(four.figures.cut_mean == 0);
  CHECK(four.figures.in_pieces == 0);
  CHECK(four.figures.coverage == 1);
  CHECK(four.figures.fresh == 1);
  CHECK(four.figures.shown_often == 0);
  CHECK(four.figures.distinct_tiles == 4);
  CHECK(four.figures.histogram_distance == 0);
  CHECK(four.tiles.size() == 4);

  // Two of four alike, the others half over one another: 32 x 16 texels are shown twice.
  const SetReport some =
      set_report(analysed(image, {}), windows({32, 32}, {{0, 0}, {0, 0}, {32, 0}, {32, 16}}));
  CHECK(some.figures.coverage == 0.625);
  CHECK(some.figures.fresh == 0.25);
  CHECK(some.figures.shown_often == 0.75);
  // (Σ uses)² / Σ uses² over texels, in tiles: 4² / (2² + ½ + ½ + 2² · ½)
  CHECK(some.figures.distinct_tiles == Approx(16.0 / 7.0).margin(1e-4));
  CHECK(some.figures.histogram_distance > 0.005);
  CHECK(some.tiles[0].fresh == 0);
  CHECK(some.tiles[2].fresh == 0.5);
}

TEST_CASE("a straight cut is found, measured and drawn where it is", "[set_report]") {
  // Left half of the sample 100, right half 120, in the tile joined at another place: both sides differ
  // by 20.
  Image sample(64, 32, 1);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) sample.texel(x, y)[0] = (x < 32 ? 100.0f : 120.0f) / 255.0f;
  const FeatureImage image = features(sample);
  SourceMap sources = windows({16, 16}, {{4, 0}});
  for (int y = 0; y < 16; ++y)
    for (int x = 11; x < 16; ++x) sources.texels[0][static_cast<std::size_t>(y * 16 + x)] = {40 + x, y};
  const SetReport report = set_report(analysed(image, {}), sources);
  CHECK(report.figures.cut_length == 16);
  CHECK(report.figures.cut_mean == 20);
  CHECK(report.figures.cut_p95 == 20);
  CHECK(report.figures.in_pieces == Approx(5.0 / 16.0).margin(1e-4)); // five columns hold no 8 x 8 square
  CHECK(report.figures.sample_step == Approx(20.0 * 32 / (63 * 32 + 64 * 31)).margin(1e-4));
  const std::vector<Cut> cuts = cuts_of_tile(image, sources, 0);
  REQUIRE(cuts.size() == 16);
  for (int y = 0; y < 16; ++y) {
    CHECK(cuts[static_cast<std::size_t>(y)].x == 10);
    CHECK(cuts[static_cast<std::size_t>(y)].y == y);
    CHECK_FALSE(cuts[static_cast<std::size_t>(y)].to_south);
  }
  const std::vector<int> pieces = pieces_of_tile(sources, 0);
  CHECK(pieces[10] == 0);
  CHECK(pieces[11] == 1);
  CHECK(*std::max_element(pieces.begin(), pieces.end()) == 1);
}

TEST_CASE("the figures add up to what synthesis counts", "[set_report]") {
  const SampleMap maps[] = {color_map(blobs(96, 96))};
  const FeatureImage image = feature_image(maps);
  for (const Coloring coloring : {Coloring::edge, Coloring::corner}) {
    const SourceMap sources = synthesize(maps, testing::two_colors({32, 32}, coloring, 0));
    const SetReport report = set_report(analysed(image, {}), sources);
    // All figures but those of borders and landmark once more, from the sources alone.
    std::vector<double> visibilities;
    std::vector<int> uses(96 * 96);
    for (std::size_t tile = 0; tile < 16; ++tile) {
      double of_cuts = 0;
      const auto cuts = cuts_of_tile(image, sources, static_cast<int>(tile));
      for (const Cut& cut : cuts) {
        of_cuts += cut.visibility * cut.visibility * 2 * image.channels;
        visibilities.push_back(cut.visibility);
      }
      SourceCanvas canvas(32, 32);
      canvas.texels = sources.texels[tile];
      CHECK(of_cuts == Approx(static_cast<double>(seam_energy(image, canvas))));
      CHECK(of_cuts > 0);
      CHECK(report.tiles[tile].cut_length == static_cast<int>(cuts.size()));
      for (const SourceTexel& s : canvas.texels) ++uses[static_cast<std::size_t>(s.y * 96 + s.x)];
    }
    const SetFigures& figures = report.figures;
    const auto count = static_cast<double>(visibilities.size());
    CHECK(figures.cut_length == Approx(count / 16).margin(1e-4));
    CHECK(figures.cut_mean ==
          Approx(std::accumulate(visibilities.begin(), visibilities.end(), 0.0) / count).margin(1e-4));
    // 95 % of the cuts are no more visible than cut_p95.
    const auto above = std::count_if(visibilities.begin(), visibilities.end(),
                                     [&](double v) { return v > figures.cut_p95 + 1e-4; });
    const auto below = std::count_if(visibilities.begin(), visibilities.end(),
                                     [&](double v) { return v < figures.cut_p95 - 1e-4; });
    CHECK(static_cast<double>(above) <= 0.05 * count + 1);
    CHECK(static_cast<double>(below) <= 0.95 * count);
    double squares = 0;
    for (const int n : uses) squares += static_cast<double>(n) * n;
    CHECK(figures.distinct_tiles == Approx(32 * 32 * 16.0 * 16 / squares).margin(1e-4));
    int shown_cells = 0; // of 16 x 16 texels, of which a quarter is shown
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 6; ++i) {
        int shown = 0;
        for (int y = 0; y < 16; ++y)
          for (int x = 0; x < 16; ++x)
            shown += uses[static_cast<std::size_t>((16 * j + y) * 96 + 16 * i + x)] > 0;
        shown_cells += shown >= 64;
      }
    CHECK(figures.coverage == Approx(shown_cells / 36.0).margin(1e-4));
    // Every tile counts once for a texel that it shows, however often it does.
    const std::vector<int> showing = tiles_showing(sources, {96, 96});
    std::int64_t alone = 0, often = 0;
    for (std::size_t i = 0; i < uses.size(); ++i) {
      CHECK(showing[i] <= uses[i]);
      CHECK((showing[i] > 0) == (uses[i] > 0));
      alone += showing[i] == 1 ? uses[i] : 0;
      often += showing[i] >= 8 ? uses[i] : 0;
    }
    CHECK(figures.fresh == Approx(static_cast<double>(alone) / (16 * 32 * 32)).margin(2e-4));
    CHECK(figures.shown_often == Approx(static_cast<double>(often) / (16 * 32 * 32)).margin(2e-4));
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    CHECK(set_report(analysed(image, {}), sources).figures == report.figures);
  }
}

TEST_CASE("a spot unlike the rest is named when tiles show it", "[set_report]") {
  Image sample = blobs(128, 128);
  for (int y = 64; y < 80; ++y)
    for (int x = 32; x < 48; ++x) std::fill_n(sample.texel(x, y).begin(), 3, x % 2 == 0 ? 1.0f : 0.0f);
  const FeatureImage image = features(sample);
  const SetReport seen = set_report(analysed(image, {}), windows({64, 64}, {{0, 32}, {16, 48}, {64, 64}}));
  CHECK(seen.landmark.centre == SourceTexel{40, 72});
  CHECK(seen.landmark.deviation > 5);
  CHECK(seen.landmark.shown == Approx(2.0 / 3.0));
  const SetReport unseen = set_report(analysed(image, {}), windows({64, 64}, {{64, 64}, {64, 64}, {64, 64}}));
  CHECK_FALSE(unseen.landmark.centre == SourceTexel{40, 72});
  CHECK(unseen.landmark.deviation < 5);
}

TEST_CASE("drift and two tones are told from texture", "[sample_traits]") {
  const auto nature = [](const Image& image, Size tile) {
    const SampleMap maps[] = {color_map(image)};
    return sample_traits(feature_image(maps), {}, tile);
  };
  Image plain = blobs(128, 128);
  const SampleTraits usual = nature(plain, {32, 32});
  CHECK(usual.drift < 0.1);
  CHECK(usual.two_tone < 0.8);
  Image shaded = plain;
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x)
      for (float& v : shaded.texel(x, y)) v = 0.1f * v + 0.9f * static_cast<float>(x) / 127.0f;
  CHECK(nature(shaded, {32, 32}).drift > 0.7);
  CHECK(nature(shaded, {128, 128}).drift == 0); // one tile alone says nothing
  CHECK(nature(shaded, {32, 32}).shading > 0.5);
  CHECK(nature(shaded, {128, 128}).shading == 0);
  // Patches of half a tile without order drift by a share, and are no shading, whatever the tile.
  Image patches(512, 512, 1);
  for (int y = 0; y < 512; ++y)
    for (int x = 0; x < 512; ++x)
      patches.texel(x, y)[0] =
          static_cast<float>(random_below(9, "patches", y / 32 * 16 + x / 32, 256)) / 255.0f;
  CHECK(nature(patches, {64, 64}).drift > 0.15);
  CHECK(nature(patches, {64, 64}).shading < 0.02);
  CHECK(nature(patches, {32, 32}).drift > 0.9);
  CHECK(nature(patches, {32, 32}).shading < 0.02);
  for (int y = 0; y < 512; ++y) // and squares that even out are none at all, not less than none
    for (int x = 0; x < 512; ++x) patches.texel(x, y)[0] = static_cast<float>((x / 64 + y / 64) % 2);
  CHECK(nature(patches, {64, 64}).shading == 0);
  Image ink(128, 128, 1, 1.0f);
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x)
      if ((x * 7 + y * 3) % 10 == 0) ink.texel(x, y)[0] = 0.0f;
  CHECK(nature(ink, {32, 32}).two_tone > 0.99);
  CHECK(nature(ink, {32, 32}).ink == Approx(0.1).margin(0.01));
  CHECK(nature(Image(64, 64, 3, 0.5f), {32, 32}).two_tone == 0);
}
