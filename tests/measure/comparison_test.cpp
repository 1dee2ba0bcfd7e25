#include "support/good_pack.h"

#include "tilepack/measure/comparison.h"

#include <nlohmann/json.hpp>

#include <catch2/catch.hpp>

using namespace tilepack;
using namespace tilepack::test;

namespace {

ImageFile grey(float value, Depth depth = Depth::u8, Encoding encoding = Encoding::srgb) {
  return {Image(16, 16, 3, value), encoding, depth};
}

} // namespace

TEST_CASE("equal images are equal, others keep the limits they keep") {
  CHECK(equal(compared(grey(0.5f), grey(0.5f))));
  const Comparison close = compared(grey(100 / 255.0f), grey(102 / 255.0f));
  CHECK_FALSE(equal(close));
  CHECK(within(close, {.max_difference = 2.001}));
  CHECK_FALSE(within(close, {.max_difference = 1.999}));
  CHECK(within(close, {.min_psnr = 42.1}));
  CHECK_FALSE(within(close, {.min_psnr = 42.2}));
  CHECK(within(close, {.min_ssim = 0.99}));
  CHECK_FALSE(within(close, {.max_difference = 3, .min_psnr = 50}));
}

TEST_CASE("images of different shape are different, whatever the limits") {
  ImageFile wide = grey(0.5f);
  wide.image = Image(17, 16, 3, 0.5f);
  const Comparison result = compared(grey(0.5f), wide);
  CHECK_FALSE(within(result, {.max_difference = 1000}));
  CHECK(result.parts.at(0).mismatch == "16 x 16 of 3 channels and 17 x 16 of 3");
  CHECK(comparison_text(result, {}).find("can't be compared") != std::string::npos);
}

TEST_CASE("a linear image is encoded before it is held against an encoded one") {
  CHECK(compared(grey(0.5f), grey(0.2140411f, Depth::f32, Encoding::linear)).parts[0].figures->largest <
        1e-5);
  CHECK(compared(grey(0.2140411f, Depth::f32, Encoding::linear), grey(0.5f)).parts[0].figures->largest <
        1e-5);
}

TEST_CASE("packs are compared map by map and level by level") {
  const Pack a = good_pack();
  Pack b = a;
  b.generator.seed = 7;
  b.generator.version = std::string{"9"};
  CHECK(equal(compared(a, b)));
  CHECK(compared(a, b).parts.size() == 5);
  float& texel = b.maps[0].levels[1].texel(3, 4)[2];
  texel = texel > 0.5f ? texel - 1 / 255.0f : texel + 1 / 255.0f;
  const Comparison changed = compared(a, b);
  CHECK_FALSE(equal(changed));
  CHECK(changed.parts[1].name == "color, level 1");
  CHECK(changed.parts[1].figures->largest_x == 3);
  CHECK(within(changed, {.max_difference = 1.01}));
}

TEST_CASE("what a sampler reads beside images counts too") {
  const Pack a = good_pack();
  const auto differs = [&](auto&& change) {
    Pack b = a;
    change(b);
    const Comparison result = compared(a, b);
    return !result.facts.empty() && !within(result, {.max_difference = 1000});
  };
  CHECK(differs([](Pack& p) { p.mapping.table[0] ^= 1; }));
  CHECK(differs([](Pack& p) { p.mapping.size.width = 9; }));
  CHECK(differs([](Pack& p) { p.guard = 1; }));
  CHECK(differs([](Pack& p) { p.mip_mode = MipMode::box; }));
  CHECK(differs([](Pack& p) { p.maps[0].name = "albedo"; }));
  CHECK(differs([](Pack& p) { p.maps[0].encoding = Encoding::linear; }));
  CHECK(differs([](Pack& p) { p.maps[0].levels.pop_back(); }));
  CHECK(differs([](Pack& p) { std::swap(p.layout.cells[0].row, p.layout.cells[9].row); }));
  CHECK(differs([](Pack& p) { p.corner_pack = CornerPack{}; }));
  CHECK_FALSE(equal(compared(a, good_pack({.colors = {3, 2, 0}}))));
  CHECK_FALSE(equal(compared(a, good_pack({.tile = {24, 16}}))));
}

TEST_CASE("a JSON report has null for an infinite PSNR") {
  const auto json = nlohmann::json::parse(comparison_json(compared(grey(0.5f), grey(0.5f)), {}));
  CHECK(json["equal"] == true);
  CHECK(json["parts"][0]["psnr"].is_null());
  CHECK(json["parts"][0]["ssim"] == Approx(1));
}
