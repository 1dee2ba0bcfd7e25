#include "tilepack/mip/box_levels.h"
#include "tilepack/mip/mip_chain.h"
#include "tilepack/mip/level_values.h"
#include "tilepack/numeric/random.h"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cstddef>

using namespace tilepack;

namespace {

TileMap random_map(Size size, int channels, Role role, Encoding encoding, Depth depth) {
  Image tile(size.width, size.height, channels);
  std::uint64_t index = 0;
  for (float& v : tile.data())
    v = quantised(static_cast<float>(random_below(1, "value", index++, 65536)) / 65535.0f, depth);
  return {"map", role, encoding, depth, {tile}};
}

// Whole images, level after level.
std::vector<Image> one_after_another(const TileMap& map, int levels, int encoded) {
  std::vector<Image> result(1);
  Image decoded = map.tiles[0];
  decode(map.tiles[0].data(), map, decoded.data());
  for (int level = 1; level < levels; ++level) {
    decoded = halved(decoded, weighting_of(map));
    result.push_back(decoded);
    if (level <= encoded) encode(decoded.data(), map, result.back().data());
  }
  return result;
}

} // namespace

TEST_CASE("levels made depth first, in bands, are those made one after another, to the last bit") {
  struct Kind {
    int channels;
    Role role;
    Encoding encoding;
    Depth depth;
  };
  for (const Size size : {Size{512, 256}, Size{96, 64}, Size{2, 2}}) // several bands twice over, one, none
    for (const Kind& kind :
         {Kind{3, Role::color, Encoding::srgb, Depth::u8}, Kind{4, Role::color, Encoding::srgb, Depth::u8},
          Kind{3, Role::color, Encoding::srgb, Depth::u16},
          Kind{4, Role::color, Encoding::linear, Depth::f32},
          Kind{3, Role::normal, Encoding::linear, Depth::u8},
          Kind{1, Role::height, Encoding::linear, Depth::u16}}) {
      const TileMap map = random_map(size, kind.channels, kind.role, kind.encoding, kind.depth);
      const int levels = level_count(size);
      for (int encoded = 0; encoded < levels; ++encoded) {
        INFO(size.width << " x " << size.height << " x " << kind.channels << ", " << encoded);
        CHECK(box_levels(map.tiles[0], map, levels, encoded) == one_after_another(map, levels, encoded));
      }
    }
}

TEST_CASE("levels of a large tile don't depend on the number of threads") {
  const TileMap map = random_map({1024, 512}, 3, Role::color, Encoding::srgb, Depth::u8);
  const auto many = box_levels(map.tiles[0], map, 10, 9);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  CHECK(box_levels(map.tiles[0], map, 10, 9) == many);
}
