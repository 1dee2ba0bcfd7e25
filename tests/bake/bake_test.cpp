#include "support/noise_pack.h"

#include "tilepack/bake/bake.h"
#include "tilepack/error/error.h"
#include "tilepack/pack/pack_json.h"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>

using namespace tilepack;

namespace {

SampleMap sample(const std::string& name, Role role, Depth depth, int channels, int side = 64) {
  const Encoding encoding =
      role == Role::color && depth != Depth::f16 && depth != Depth::f32 ? Encoding::srgb : Encoding::linear;
  return {name, role, encoding, depth, quantised(test::noise(side, side, channels, 5), depth)};
}

BakeOptions small_options() {
  BakeOptions options;
  options.synth.coloring = Coloring::edge;
  options.synth.colors = {2, 2, 0};
  options.layout = LayoutKind::tile_index;
  options.synth.tile_size = {16, 16};
  options.synth.effort = 0;
  options.virtual_size = {8, 8};
  return options;
}

ErrorKind fault(const std::vector<SampleMap>& samples, const BakeOptions& options) {
  try {
    bake(samples, options);
  } catch (const Error& error) {
    return error.kind();
  }
  return ErrorKind::internal;
}

} // namespace

TEST_CASE("a baked pack is whole", "[pack]") {
  const std::vector<SampleMap> samples{sample("color", Role::color, Depth::u8, 3),
                                       sample("height", Role::height, Depth::u16, 1)};
  for (const MappingKind mapping : {MappingKind::permutation, MappingKind::mix, MappingKind::index}) {
    BakeOptions options = small_options();
    options.mapping = mapping;
    options.synth.colors = {3, 2, 0};
    const Pack pack = bake(samples, options);
    CHECK(tile_count(pack.tiles) == 36);
    CHECK(pack.layout.columns == 4);
    CHECK(pack.layout.rows == 9);
    CHECK(pack.tile_levels == 5);
    REQUIRE(pack.maps.size() == 2);
    for (const PackedMap& map : pack.maps) {
      REQUIRE(map.levels.size() == 5);
      CHECK(map.levels[4].size() == Size{4, 9});
      for (const Image& level : map.levels) CHECK(quantised(level, map.depth) == level);
    }
    // What was baked is what can be read.
    CHECK_NOTHROW(parsed_pack_json(pack_json(described(pack)), "pack.json"));
  }
}

TEST_CASE("a report belongs to the tiles of its pack", "[pack]") {
  const std::vector<SampleMap> samples{sample("color", Role::color, Depth::u8, 3)};
  for (const bool sequential : {false, true}) {
    BakeOptions options = small_options();
    if (sequential) {
      options.set = SetKind::sequential;
      options.layout = LayoutKind::array;
      options.mapping = MappingKind::index;
    }
    const BakedPack made = baked(samples, options);
    CHECK(made.sources.tiles == made.pack.tiles);
    CHECK(made.report.tiles.size() == static_cast<std::size_t>(tile_count(made.pack.tiles)));
    REQUIRE(made.pack.synthesis);
    CHECK(*made.pack.synthesis == made.report.figures);
    CHECK(pack_json(described(made.pack)) == pack_json(described(bake(samples, options))));
    // The sources say where the packed texels come from.
    const std::vector<Image> tiles =
        tiles_at_level(made.pack.maps[0].levels[0], made.pack.layout, made.pack.tile_size, 0);
    CHECK(tiles == assembled(made.sources, samples).maps[0].tiles);
  }
}

TEST_CASE("flattening comes before all else", "[pack]") {
  std::vector<SampleMap> samples{sample("color", Role::color, Depth::u8, 3),
                                 sample("normal", Role::normal, Depth::u8, 3),
                                 sample("height", Role::height, Depth::u16, 1)};
  for (SampleMap& map : samples)
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x)
        for (float& v : map.image.texel(x, y))
          v = quantised(v * (0.4f + 0.6f * static_cast<float>(x) / 63.0f), map.depth);
  BakeOptions options = small_options();
  const BakedPack plain = baked(samples, options);
  CHECK(plain.prepared.empty());
  CHECK(plain.samples_used(samples).data() == samples.data());
  options.flatten = 100;
  const BakedPack made = baked(samples, options);
  CHECK(made.flatten == 100);
  const auto used = made.samples_used(samples);
  REQUIRE(used.size() == 3);
  CHECK(used[0].image != samples[0].image);
  CHECK(used[1].image == samples[1].image);
  CHECK(used[2].image != samples[2].image);
  // The tiles, the figures and the record are those of the flattened maps.
  BakeOptions none = options;
  none.flatten = 0;
  const BakedPack again = baked(used, none);
  CHECK(again.sources.texels == made.sources.texels);
  CHECK(again.report.figures == made.report.figures);
  for (std::size_t m = 0; m < 3; ++m) CHECK(again.pack.maps[m].levels == made.pack.maps[m].levels);
  CHECK(made.sources.texels != plain.sources.texels);
  const auto recorded = [](const BakedPack& b) {
    for (const auto& [name, value] : b.pack.generator.options)
      if (name == "flatten") return value;
    return std::string();
  };
  CHECK(recorded(made) == "100");
  CHECK(recorded(plain) == "0");
  for (const int percent : {-1, 101}) {
    options.flatten = percent;
    CHECK(fault(samples, options) == ErrorKind::usage);
  }
}

TEST_CASE("what flattening makes too bright to be stored is refused", "[pack]") {
  SampleMap sky = sample("color", Role::color, Depth::f32, 3);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      for (float& v : sky.image.texel(x, y)) v = x < 32 ? 60000.0f : 1.0f;
  sky.image.texel(63, 0)[0] = 60000.0f;
  BakeOptions options = small_options();
  options.depth = Depth::f16;
  CHECK_NOTHROW(bake(std::vector{sky}, options));
  options.flatten = 100;
  CHECK(fault({sky}, options) == ErrorKind::invalid_content);
  options.depth = Depth::f32;
  CHECK_NOTHROW(bake(std::vector{sky}, options));
}

TEST_CASE("threads do not change a pack, the seed does", "[pack]") {
  const std::vector<SampleMap> samples{sample("color", Role::color, Depth::u8, 3)};
  BakeOptions options = small_options();
  const Pack many = bake(samples, options);
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    CHECK(bake(samples, options).maps[0].levels == many.maps[0].levels);
  }
  options.synth.seed = 1;
  CHECK(bake(samples, options).maps[0].levels != many.maps[0].levels);
}

TEST_CASE("depth and format decide how maps are stored", "[pack]") {
  struct Case {
    Depth read;
    std::optional<PackFormat> format;
    std::optional<Depth> depth;
    Depth stored;
    Encoding color;
  };
  const Case cases[] = {
      {Depth::u8, {}, {}, Depth::u8, Encoding::srgb},
      {Depth::u16, {}, {}, Depth::u16, Encoding::srgb},
      {Depth::f16, {}, {}, Depth::f16, Encoding::linear},
      {Depth::u8, PackFormat::exr, {}, Depth::f16, Encoding::linear},
      {Depth::f32, PackFormat::png, {}, Depth::u16, Encoding::srgb},
      {Depth::u8, {}, Depth::f32, Depth::f32, Encoding::linear},
      {Depth::u16, PackFormat::png, Depth::u8, Depth::u8, Encoding::srgb},
  };
  for (const Case& c : cases) {
    BakeOptions options = small_options();
    options.format = c.format;
    options.depth = c.depth;
    const Pack pack = bake(
        std::vector{sample("color", Role::color, c.read, 3), sample("n", Role::normal, c.read, 3)}, options);
    CHECK(pack.maps[0].depth == c.stored);
    CHECK(pack.maps[0].encoding == c.color);
    CHECK(pack.maps[1].encoding == Encoding::linear);
    // Texels are copied, so each is one of the sample's after the change of encoding.
    CHECK(quantised(pack.maps[0].levels[0], c.stored) == pack.maps[0].levels[0]);
  }
}

TEST_CASE("samples and options that can't be are refused", "[pack]") {
  const SampleMap color = sample("color", Role::color, Depth::u8, 3);
  BakeOptions options = small_options();
  CHECK(fault({}, options) == ErrorKind::usage);
  CHECK(fault({color, sample("normal", Role::normal, Depth::u8, 3, 48)}, options) ==
        ErrorKind::invalid_content);
  CHECK(fault({color, color}, options) == ErrorKind::usage);
  CHECK(fault({sample("../x", Role::color, Depth::u8, 3)}, options) == ErrorKind::usage);
  options.layout = LayoutKind::de_bruijn;
  CHECK(fault({color}, options) == ErrorKind::usage);
  options = small_options();
  options.format = PackFormat::png;
  options.depth = Depth::f16;
  CHECK(fault({color}, options) == ErrorKind::usage);
  options = small_options();
  options.synth.tile_size = {128, 128};
  CHECK(fault({color}, options) == ErrorKind::invalid_content);
  options.synth.tile_size = {4096, 4096};
  options.synth.colors = {8, 8, 0};
  CHECK(fault({color}, options) == ErrorKind::usage);
  options = small_options();
  options.mapping = MappingKind::permutation;
  options.virtual_size = {5000, 5000};
  CHECK(fault({color}, options) == ErrorKind::usage);
}
