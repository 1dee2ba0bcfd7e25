#include "support/images.h"

#include "tilepack/bake/bake_fields.h"
#include "tilepack/report/bake_page.h"
#include "tilepack/report/bake_pictures.h"
#include "tilepack/report/pack_picture.h"
#include "tilepack/report/size_choice.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

using namespace tilepack;

namespace {

// A set with which nothing is wrong.
BakeFacts good_facts() {
  BakeFacts facts;
  SetFigures& f = facts.report.figures;
  f.cut_length = 900;
  f.cut_mean = 8;
  f.cut_p95 = 20;
  f.sample_step = 12;
  f.coverage = 0.78;
  f.fresh = 0.5;
  f.shown_often = 0.1;
  f.distinct_tiles = 9;
  f.histogram_distance = 0.02;
  facts.seams.seam = 1;
  facts.nature.two_tone = 0.7;
  facts.nature.drift = 0.05;
  facts.synth.tile_size = {128, 128};
  facts.synth.coloring = Coloring::corner;
  facts.synth.colors = {0, 0, 2};
  facts.sample = {512, 512};
  facts.tiles = 16;
  return facts;
}

// Whether the verdict has a remark of this grade that holds the text.
bool says(const BakeFacts& facts, Grade grade, const std::string& text) {
  const BakeVerdict verdict = bake_verdict(facts);
  return std::any_of(verdict.remarks.begin(), verdict.remarks.end(), [&](const BakeRemark& r) {
    return r.grade == grade && spelled(r.text, FieldSpelling::option).find(text) != std::string::npos;
  });
}

BakedPack small_bake(const std::vector<SampleMap>& samples, const std::string& coloring,
                     const std::string& flatten = "0") {
  const std::vector<BakeSetting> settings{
      {"coloring", coloring, "test", ErrorKind::usage},
      {"flatten", flatten, "test", ErrorKind::usage},
      {"tile-size", "16", "test", ErrorKind::usage},
      {"effort", "0", "test", ErrorKind::usage},
      {"virtual-size", "8", "test", ErrorKind::usage},
      {"wraps", "no", "test", ErrorKind::usage}}; // noise goes on anywhere
  return baked(samples, bake_options(settings));
}

bool has_paint(const Image& image, const Paint& paint) {
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const auto texel = image.texel(x, y);
      if (std::abs(static_cast<double>(texel[0]) - paint.red) < 1e-5 &&
          std::abs(static_cast<double>(texel[1]) - paint.green) < 1e-5 &&
          std::abs(static_cast<double>(texel[2]) - paint.blue) < 1e-5)
        return true;
    }
  return false;
}

} // namespace

TEST_CASE("a good set gets a good verdict", "[bake_verdict]") {
  const BakeVerdict verdict = bake_verdict(good_facts());
  CHECK(verdict.grade == Grade::good);
  CHECK(verdict.remarks.size() >= 3);
}

TEST_CASE("what is wrong with a set is said with the option to turn", "[bake_verdict]") {
  BakeFacts facts = good_facts();
  SECTION("cuts dearer than the texture hides") {
    facts.report.figures.cut_mean = 30;
    CHECK(says(facts, Grade::poor, "--effort 9"));
    facts.synth.effort = 9;
    CHECK_FALSE(says(facts, Grade::poor, "--effort 9"));
    facts.synth.interior = Construction::quilt;
    CHECK(says(facts, Grade::poor, "--interior patch"));
    facts.sample = {1024, 1024};
    CHECK(says(facts, Grade::poor, "--tile-size 256"));
    CHECK_FALSE(says(facts, Grade::poor, "--colors 2"));
    facts.synth.colors.corner = 3;
    CHECK(says(facts, Grade::poor, "--colors 2 (fewer parts"));
    facts.report.figures.cut_mean = 8;
    CHECK(says(facts, Grade::good, "cuts hide"));
    facts.report.figures.cut_p95 = 2.6 * facts.report.figures.sample_step; // as of pebbles that stay whole
    CHECK(says(facts, Grade::good, "cuts hide"));
    facts.report.figures.cut_p95 = 3.0 * facts.report.figures.sample_step; // as of stones that are cut off
    CHECK(says(facts, Grade::fair, "some can be seen"));
    facts.report.figures.cut_p95 = 60; // few texels of cut are dear
    CHECK(says(facts, Grade::fair, "some can be seen"));
    facts.report.figures.cut_length = 0;
    CHECK(says(facts, Grade::good, "No tile has a cut"));
  }
  SECTION("a tile that holds no whole periods") {
    facts.nature.periods.y = {24.0, 0.5};
    CHECK(says(facts, Grade::fair, "every 24.00 texels along y"));
    CHECK(says(facts, Grade::good, "no border can be told"));
    CHECK_FALSE(says(facts, Grade::fair, "border")); // what breaks off does so at cuts inside tiles
    CHECK_FALSE(says(facts, Grade::fair, "Lines then run on"));
    const Size fitting = fitting_tile_size(facts.nature.periods, {128, 128}, facts.sample).size;
    CHECK(fitting.height % 24 == 0);
    CHECK(says(facts, Grade::fair, "--tile-size 128x" + std::to_string(fitting.height)));
    facts.report.figures.cut_mean = 20; // dear cuts may come from that
    CHECK(says(facts, Grade::poor, "--tile-size 128x" + std::to_string(fitting.height)));
    facts.report.figures.cut_mean = 8;
    CHECK(fitting == Size{128, 96});
    CHECK(says(facts, Grade::fair, "have 6 mip levels, these 8"));
    facts.synth.tile_size = {100, 100}; // three levels, as 100 x 96 have
    CHECK_FALSE(says(facts, Grade::fair, "mip level"));
    facts.synth.tile_size = fitting;
    CHECK(bake_verdict(facts).grade == Grade::good);
    CHECK(says(facts, Grade::good, "a tile holds"));
  }
  SECTION("borders that are cuts") {
    facts.synth.coloring = Coloring::edge;
    facts.synth.colors = {2, 2, 0};
    facts.report.figures.border_mean = 3;
    CHECK(says(facts, Grade::fair, "--coloring corner"));
    facts.report.figures.border_mean = 10;
    CHECK(says(facts, Grade::poor, "--coloring corner"));
  }
  SECTION("a sample that is too small") {
    facts.sample = {256, 256};
    CHECK(says(facts, Grade::fair, "--tile-size 64"));
    facts.sample = {160, 160};
    CHECK(says(facts, Grade::poor, "--tile-size 40"));
  }
  SECTION("slow shading") {
    facts.nature.shading = 0.01;
    CHECK(bake_verdict(facts).grade == Grade::good);
    facts.nature.shading = 0.03;
    facts.flat_drift = 0.004;
    CHECK(says(facts, Grade::fair, "5.0 % of the sample's variance"));
    CHECK(says(facts, Grade::fair, "Bake with --flatten 100, which leaves 0.4 %"));
    facts.flatten = 50;
    CHECK(says(facts, Grade::fair, "--flatten 100"));
    facts.flatten = 100; // more of the same is no cure
    CHECK(says(facts, Grade::fair, "Use a larger --tile-size"));
    CHECK_FALSE(says(facts, Grade::fair, "--flatten"));
    facts.flatten = 0;
    facts.flat_drift = 0.049; // nor is what changes nothing
    CHECK_FALSE(says(facts, Grade::fair, "--flatten"));
    facts.nature.shading = 0;
    facts.nature.drift = 0.6;
    CHECK(says(facts, Grade::poor, "--flatten 100"));
  }
  SECTION("writing") {
    facts.nature.two_tone = 0.95;
    facts.nature.ink = 0.15;
    facts.nature.periods.y = {32.0, 0.5};
    CHECK(says(facts, Grade::poor, "looks like writing"));
    CHECK_FALSE(says(facts, Grade::fair, "Lines then run on"));
    facts.nature.periods.y = {24.0, 0.5}; // a size fits lines, and what they say all the same gets lost
    CHECK(says(facts, Grade::fair, "Lines then run on, what they say does not."));
    facts.nature.ink = 0.5; // boards and the gaps between them
    CHECK_FALSE(says(facts, Grade::poor, "looks like writing"));
    facts.nature.ink = 0.15;
    facts.nature.periods.x = {32.0, 0.5}; // a grid of tiles and joints
    CHECK_FALSE(says(facts, Grade::poor, "looks like writing"));
  }
  SECTION("little of the sample, again and again") {
    facts.report.figures.coverage = 0.3;
    facts.report.figures.distinct_tiles = 3;
    CHECK(says(facts, Grade::poor, "--colors 3 shows more, in 81 tiles"));
    facts.report.figures.distinct_tiles = 9; // a small part of a large sample, shown once
    CHECK(bake_verdict(facts).grade == Grade::good);
    facts.report.figures.distinct_tiles = 3;
    facts.report.figures.shown_often = 0.5;
    CHECK(says(facts, Grade::fair, "half of all tiles"));
    CHECK_FALSE(says(facts, Grade::fair, "half of all tiles show. --colors")); // said already
    facts.report.figures.coverage = 0.6;
    CHECK(says(facts, Grade::fair, "half of all tiles show. --colors 3"));
    facts.report.figures.coverage = 0.3;
    facts.synth.coloring = Coloring::edge;
    facts.synth.colors = {2, 2, 0};
    facts.tiles = 8; // the sequential set
    facts.report.figures.distinct_tiles = 2;
    CHECK(says(facts, Grade::poor, "--colors 3 shows more, in 18 tiles"));
    facts.synth.interior = Construction::quilt;
    CHECK(says(facts, Grade::poor, "--interior patch"));
    CHECK_FALSE(says(facts, Grade::poor, "--colors"));
    facts.synth.interior = Construction::framed;
    facts.synth.colors = {8, 8, 0};
    facts.sample = {9000, 9000};
    facts.tiles = 4096;
    CHECK_FALSE(says(facts, Grade::poor, "--colors"));
  }
  SECTION("more tiles than the sample has material for") {
    facts.report.figures.coverage = 0.45;
    facts.report.figures.distinct_tiles = 1;
    facts.report.figures.shown_often = 0.5;
    facts.sample = {400, 400}; // 9.8 tiles
    CHECK(says(facts, Grade::poor, "A larger sample or smaller tiles"));
    facts.sample = {300, 300}; // 5.5 tiles
    CHECK(says(facts, Grade::poor, "never seen."));
    CHECK(says(facts, Grade::fair, "--tile-size 72"));
    for (const Grade grade : {Grade::fair, Grade::poor}) {
      CHECK_FALSE(says(facts, grade, "--colors"));
      CHECK_FALSE(says(facts, grade, "A larger sample or smaller tiles"));
    }
  }
  SECTION("a single tile") {
    facts.tiles = 1;
    facts.report.figures.shown_often = 1;
    CHECK(says(facts, Grade::fair, "--colors 2 shows more"));
    CHECK_FALSE(says(facts, Grade::fair, "half of all tiles"));
  }
  SECTION("a sample of one value") {
    facts.report.figures = {};
    facts.report.figures.shown_often = 1;
    CHECK(says(facts, Grade::fair, "nothing to tile"));
    CHECK(bake_verdict(facts).remarks.size() == 1);
    CHECK(size_choice(facts).smaller.empty());
    CHECK(size_choice(facts).richer.empty());
    facts.clear = true;
    CHECK(says(facts, Grade::fair, "transparent"));
  }
  SECTION("levels that end early") {
    facts.synth.tile_size = {132, 128};
    facts.coarsest = {33, 32};
    CHECK(says(facts, Grade::good,
               "132 x 128 texels halves evenly 2 times, so that its coarsest level has 33 x 32: from farther "
               "away it flickers "
               "or turns flat. --full-mips"));
    CHECK(bake_verdict(facts).grade == Grade::good);
    facts.coarsest = {8, 16};
    CHECK_FALSE(says(facts, Grade::good, "--full-mips"));
    facts.coarsest = {};
    CHECK_FALSE(says(facts, Grade::good, "--full-mips"));
    facts.coarsest = {121, 121};
    facts.synth.tile_size = {121, 121};
    CHECK(says(facts, Grade::good, "can't be halved"));
  }
  SECTION("a landmark") {
    facts.report.landmark = {{100, 200}, 6.0, 0.5};
    CHECK(says(facts, Grade::poor, "(100, 200)"));
    facts.report.landmark.shown = 0.05;
    CHECK(bake_verdict(facts).grade == Grade::good);
    facts.report.landmark = {{100, 200}, 3.0, 0.5};
    CHECK(bake_verdict(facts).grade == Grade::good);
  }
  SECTION("other values than the sample's") {
    facts.report.figures.histogram_distance = 0.2;
    CHECK(says(facts, Grade::poor, "20.0 %"));
    CHECK(says(facts, Grade::poor, "more --colors"));
    facts.synth.interior = Construction::quilt;
    CHECK(says(facts, Grade::poor, "--seed or --interior patch"));
    facts.report.figures.histogram_distance = 0.1;
    CHECK(says(facts, Grade::fair, "10.0 %"));
  }
  const BakeVerdict verdict = bake_verdict(facts);
  for (const BakeRemark& remark : verdict.remarks) {
    INFO(remark.text);
    const auto codes = remark_codes();
    CHECK(std::find(codes.begin(), codes.end(), remark.code) != codes.end());
    if (!remark.cure) continue;
    CHECK((remark.grade != Grade::good || remark.code == "levels-end"));
    const std::vector<std::string> fields = bake_field_names();
    CHECK(std::find(fields.begin(), fields.end(), remark.cure->field) != fields.end());
    const std::string value = remark.cure->value == "true" ? "" : remark.cure->value; // flags are named alone
    CHECK(remark.text.find(field(remark.cure->field, value)) != std::string::npos);
  }
  for (std::size_t i = 1; i < verdict.remarks.size(); ++i) // the worst first
    CHECK(verdict.remarks[i - 1].grade >= verdict.remarks[i].grade);
  CHECK(verdict.grade == verdict.remarks.front().grade);
}

TEST_CASE("a remark tells programs what it means and what to turn", "[bake_verdict]") {
  const auto cure_of = [](const BakeFacts& facts, const std::string& code) -> std::optional<Cure> {
    for (const BakeRemark& remark : bake_verdict(facts).remarks)
      if (remark.code == code) return remark.cure;
    return Cure{"none", ""};
  };
  BakeFacts facts = good_facts();
  CHECK(cure_of(facts, "cuts-hidden") == std::nullopt);
  facts.report.figures.cut_mean = 30;
  CHECK(cure_of(facts, "cuts-seen") == Cure{"effort", "9"});
  facts.synth.effort = 9;
  CHECK(cure_of(facts, "cuts-seen") == Cure{"tile-size", "256"});
  facts.nature.shading = 0.03;
  facts.flat_drift = 0.004;
  CHECK(cure_of(facts, "shading") == Cure{"flatten", "100"});
  facts.sample = {256, 256};
  CHECK(cure_of(facts, "sample-small") == Cure{"tile-size", "64"});
  CHECK(cure_of(facts, "cuts-seen") == Cure{"seed", ""});
}

TEST_CASE("flattening is advised where it helps", "[bake_verdict]") {
  std::vector<SampleMap> samples{
      {"color", Role::color, Encoding::srgb, Depth::u8, test::noise(128, 128, 3, 3)}};
  CHECK(bake_facts(small_bake(samples, "corner"), samples).flat_drift == 0); // not looked for
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x)
      for (float& v : samples[0].image.texel(x, y)) v *= 0.2f + 0.8f * static_cast<float>(x) / 127.0f;
  const BakeFacts shaded = bake_facts(small_bake(samples, "corner"), samples);
  CHECK(shaded.nature.drift > 0.15);
  CHECK(shaded.flat_drift < 0.02);
  CHECK(says(shaded, Grade::fair, "--flatten 100"));
  const BakedPack made = small_bake(samples, "corner", "100");
  const BakeFacts flat = bake_facts(made, samples);
  CHECK(flat.nature.drift == Approx(shaded.flat_drift));
  CHECK_FALSE(says(flat, Grade::fair, "variance"));
  CHECK(bake_page({"s.png", flat, {}}, made, samples).find(", flattened by 100 %") != std::string::npos);
  samples[0].role = Role::data; // which is never flattened
  const BakeFacts data = bake_facts(small_bake(samples, "corner"), samples);
  CHECK(says(data, Grade::fair, "Use a larger --tile-size"));
}

TEST_CASE("pictures show tiles, uses and sources where they are", "[bake_pictures]") {
  const std::vector<SampleMap> samples{
      {"color", Role::color, Encoding::srgb, Depth::u8, test::noise(64, 64, 3, 3)}};
  const FeatureImage features = feature_image(samples);
  const Image& sample = samples[0].image;
  for (const char* coloring : {"edge", "corner"}) {
    const BakedPack made = small_bake(samples, coloring);
    const VectorDrawing cuts = cut_picture(sample, features, made.sources, made.report);
    CHECK(cuts.numbers.size() == 16);
    CHECK(cuts.background.width() > 4 * 32); // tiles of 16 texels are drawn at twice the size
    CHECK(has_paint(cuts.background, color_paint(0)));
    CHECK(has_paint(cuts.background, color_paint(1)));
    // Tiles are grey but for their cuts, which are two pixels long on each side.
    int colored = 0;
    for (int y = 26; y < 26 + 32; ++y)
      for (int x = 26; x < 26 + 32; ++x)
        colored += cuts.background.texel(x, y)[0] != cuts.background.texel(x, y)[2];
    CHECK(colored >= made.report.tiles[0].cut_length);
    CHECK(colored <= 4 * made.report.tiles[0].cut_length);
    const VectorDrawing few = cut_picture(sample, features, made.sources, made.report, 5);
    REQUIRE(few.numbers.size() == 5);
    // The five with the dearest cuts.
    std::vector<std::pair<double, int>> dear;
    for (int t = 0; t < 16; ++t) {
      const TileFigures& tile = made.report.tiles[static_cast<std::size_t>(t)];
      dear.emplace_back(-tile.cut_mean * tile.cut_length, t);
    }
    std::sort(dear.begin(), dear.end());
    std::set<int> expected, drawn;
    for (std::size_t i = 0; i < 5; ++i) {
      expected.insert(dear[i].second);
      drawn.insert(few.numbers[i].number);
    }
    CHECK(drawn == expected);

    // 2 x 2 pixels a texel: blue where one tile shows it, dark where none does.
    const Image use = use_picture(sample, made.sources);
    REQUIRE(use.size() == Size{128, 128});
    const std::vector<int> showing = tiles_showing(made.sources, {64, 64});
    int wrong = 0;
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) {
        const auto pixel = use.texel(2 * x + 1, 2 * y);
        const bool grey = pixel[0] == pixel[1] && pixel[1] == pixel[2] && pixel[0] <= 0.3f;
        wrong += grey != (showing[static_cast<std::size_t>(y * 64 + x)] == 0);
      }
    CHECK(wrong == 0);

    const VectorDrawing from = source_picture(sample, made.sources);
    CHECK(from.numbers.size() == 16);
    CHECK((has_paint(from.background, color_paint(0)) || has_paint(from.background, color_paint(1))));
  }
}

TEST_CASE("large tiles and samples make no larger pictures", "[bake_pictures]") {
  const Image sample(3000, 40, 3, 0.5f);
  SourceMap sources{{2000, 20}, {1, 1, 0}, std::vector<EdgeTile>(1), {{}}, 0};
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 2000; ++x) sources.texels[0].push_back({x + 500, y});
  const std::vector<SampleMap> samples{{"color", Role::color, Encoding::srgb, Depth::u8, sample}};
  const FeatureImage features = feature_image(samples);
  const SetReport report = set_report(analysed(features, {}), sources);
  CHECK(cut_picture(sample, features, sources, report).background.width() < 1600);
  CHECK(use_picture(sample, sources).width() < 1600);
  CHECK(source_picture(sample, sources).background.width() < 1600);
}

TEST_CASE("the page holds verdict, pictures and figures, and only them", "[bake_page]") {
  const std::vector<SampleMap> samples{
      {"color", Role::color, Encoding::srgb, Depth::u8, test::noise(64, 64, 3, 3)}};
  const BakedPack made = small_bake(samples, "corner");
  const BakeSummary story{"a<b>.png", bake_facts(made, samples), {{"frame search", 0.75}, {"writing", 0.25}}};
  const std::string page = bake_page(story, made, samples);
  CHECK(page.find("<h1>a&lt;b&gt;.png</h1>") != std::string::npos);
  CHECK(page.find("frame search</td><td>75 %") != std::string::npos);
  CHECK(page.find("<script") == std::string::npos);
  CHECK(page.find("http") == std::string::npos);
  std::size_t pictures = 0;
  for (std::size_t at = 0; (at = page.find("src=\"data:image/png;base64,", at)) != std::string::npos; ++at)
    ++pictures;
  CHECK(pictures == 6);
  for (const BakeRemark& remark : bake_verdict(story.facts).remarks)
    CHECK(page.find(remark.text.substr(0, 20)) != std::string::npos);
  CHECK(page == bake_page(story, made, samples));
}

TEST_CASE("the verdict on a transition is that of its materials and of the borders between them",
          "[report]") {
  BakeFacts facts = good_facts();
  BakeFacts moss = facts, wall = facts;
  moss.material = "moss";
  wall.material = "wall";
  facts.materials = {moss, wall};
  facts.transition = {120, 0.1, 0.4, {0.25, 0.75}};
  CHECK(bake_verdict(facts).grade == Grade::good);
  CHECK(says(facts, Grade::good, "25 % moss, 75 % wall"));
  facts.transition.through_things = 0.35;
  CHECK(says(facts, Grade::fair, "some things look cut"));
  facts.materials[1].report.figures.cut_mean = 100;
  CHECK(bake_verdict(facts).grade == Grade::poor);
  CHECK(says(facts, Grade::poor, "wall: Along cuts"));
}

TEST_CASE("tones that end in lines are told", "[bake_verdict]") {
  BakeFacts facts = good_facts();
  facts.nature.shading = 0.03;
  CHECK(says(facts, Grade::fair, "5.0 % of the sample's variance"));
  facts.report.tones.looked = true; // and none is found
  CHECK(says(facts, Grade::good, "5.0 % of the sample's variance"));
  CHECK(bake_verdict(facts).grade == Grade::good);
  facts.nature.shading = 0;
  facts.report.tones.share = 0.2;
  CHECK(says(facts, Grade::fair, "Along 20 % of the length of borders a tone ends in a straight line"));
  CHECK(says(facts, Grade::fair, "--flatten 100"));
  facts.report.tones.share = 0.5;
  CHECK(says(facts, Grade::poor, "it looks pieced together"));
  facts.flatten = 100;
  CHECK_FALSE(says(facts, Grade::poor, "--flatten"));
}

TEST_CASE("the worst places are framed on the tiles and shown beside what they are like", "[bake_page]") {
  const std::vector<SampleMap> samples{
      {"color", Role::color, Encoding::srgb, Depth::u8, test::noise(64, 64, 3, 3)}};
  const BakedPack made = small_bake(samples, "corner");
  const std::vector<WorstPlace> places = worst_places(made, 4);
  REQUIRE_FALSE(places.empty());
  CHECK(places.size() <= 4);
  for (const WorstPlace& place : places) {
    CHECK(place.area.x >= 0);
    CHECK(place.area.x + place.area.width <= 16);
    CHECK(place.like.x + place.area.width <= 64);
    CHECK(place.like.y + place.area.height <= 64);
  }
  const Image sample = samples[0].image;
  const VectorDrawing drawing = worst_places_picture(sample, made.sources, places);
  CHECK(drawing.numbers.size() == places.size());
  const VectorDrawing plain = cut_picture(sample, made.sample.features, made.sources, made.report);
  const VectorDrawing marked =
      cut_picture(sample, made.sample.features, made.sources, made.report, 64, places);
  CHECK(marked.numbers.size() == plain.numbers.size() + places.size());
  CHECK(marked.background != plain.background);
  CHECK(bake_page({"s.png", bake_facts(made, samples), {}}, made, samples).find("The worst places") !=
        std::string::npos);
}
