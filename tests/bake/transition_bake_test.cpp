#include "support/samples.h"

#include "tilepack/bake/bake_job.h"
#include "tilepack/error/error.h"

#include <catch2/catch.hpp>
#include <string>
#include <vector>

using namespace tilepack;
using Catch::Matchers::Contains;

namespace {

BakeJob job_of(std::vector<std::string> materials, std::vector<BakeSetting> settings = {}) {
  BakeJob job;
  job.transition = std::move(materials);
  job.settings = std::move(settings);
  job.folder = "out";
  return job;
}

TransitionMaterial material(const std::string& name, std::uint64_t seed, int side = 64) {
  Image image = testing::blobs(side, side, seed);
  for (float& v : image.data()) v = quantised(v, Depth::u8);
  return {name, {testing::color_map(std::move(image))}};
}

BakeOptions small(int materials, int colors = 0) {
  BakeOptions options;
  options.synth.tile_size = {16, 16};
  options.synth.effort = 0;
  options.synth.colors.corner = colors > 0 ? colors : 2;
  options.virtual_size = {8, 8};
  return transition_options(options, materials, colors > 0, false);
}

} // namespace

TEST_CASE("the options of a transition follow from its materials", "[bake]") {
  CHECK(options_of(job_of({"a.png", "b.png"})).synth.colors == ColorCounts{0, 0, 2, 4});
  CHECK(options_of(job_of({"a.png", "b.png", "c.png"})).synth.colors == ColorCounts{0, 0, 3, 3});
  CHECK(options_of(job_of({"a.png", "b.png", "c.png", "d.png"})).synth.colors == ColorCounts{0, 0, 4, 2});
  CHECK(options_of(job_of({"a.png", "b.png"}, {{"colors", "4", field("colors")}})).synth.colors ==
        ColorCounts{0, 0, 4, 1});
  CHECK(options_of(job_of({"a.png", "b.png"}, {{"variants", "1", field("variants")}})).synth.colors ==
        ColorCounts{0, 0, 2, 1});
  const auto refused = [](std::vector<std::string> materials, const char* name, const char* value) {
    CHECK_THROWS_AS(options_of(job_of(std::move(materials), {{name, value, field(name)}})), Error);
  };
  refused({"a.png", "b.png"}, "colors", "3");
  refused({"a.png", "b.png", "c.png"}, "colors", "4");
  refused({"a.png", "b.png"}, "coloring", "edge");
  refused({"a.png", "b.png"}, "set", "sequential");
  refused({"a.png"}, "effort", "5");
}

TEST_CASE("materials are called as their files, each once, and what they are called is part of a job",
          "[bake]") {
  const BakeJob job = job_of({"x/moss.png", "y/moss.png", "z/two words.png", "z/sand/"});
  CHECK(material_names_of(job) == std::vector<std::string>{"moss", "moss-2", "two_words", "sand"});
  CHECK_THAT(canonical_options(job_of({"a.png", "b.png"})), Contains("transition=a,b\n"));
  CHECK_THAT(canonical_options(BakeJob{.sample = "a.png"}), !Contains("transition"));
}

TEST_CASE("a baked transition names its materials and tells of each", "[bake]") {
  const std::vector<TransitionMaterial> materials{material("moss", 1), material("sand", 2, 48)};
  const BakedPack made = baked_transition(materials, small(2));
  CHECK(made.pack.materials == std::vector<std::string>{"moss", "sand"});
  CHECK(tile_count(made.pack.tiles) == 64);
  REQUIRE(made.materials.size() == 2);
  CHECK(made.materials[1].size == Size{48, 48});
  CHECK(made.pack.synthesis->cut_length ==
        Approx((made.materials[0].report.figures.cut_length + made.materials[1].report.figures.cut_length) /
               2));
  CHECK(baked_transition(materials, small(2, 4)).pack.materials ==
        std::vector<std::string>{"moss", "moss", "sand", "sand"});
}
