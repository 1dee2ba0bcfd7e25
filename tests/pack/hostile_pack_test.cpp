#include "support/scratch_folder.h"
// Packs with a changed pack.json: whatever the change, reading either refuses it as invalid or unreadable, or
// gives a pack that can be sampled anywhere. Under the sanitizers this finds reads out of bounds.

#include "support/noise_pack.h"

#include "tilepack/bake/packing.h"
#include "tilepack/error/error.h"
#include "tilepack/pack/pack_read.h"
#include "tilepack/pack/pack_write.h"
#include "tilepack/sampler/reference_sampler.h"

#include <nlohmann/json.hpp>

#include <catch2/catch.hpp>
#include <fstream>

using namespace tilepack;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

Pack noise_pack_of(const PackingOptions& options, Coloring coloring) {
  TileSet set;
  set.tile_size = {8, 8};
  const bool edge = coloring == Coloring::edge;
  set.colors = edge ? ColorCounts{2, 2, 0} : ColorCounts{0, 0, 2};
  if (edge)
    set.tiles = complete_edge_set(2, 2);
  else
    set.tiles = complete_corner_set(2);
  set.maps = {{"color", Role::color, Encoding::srgb, Depth::u8, {}}};
  for (std::uint64_t i = 0; i < 16; ++i) set.maps[0].tiles.push_back(test::noise(8, 8, 3, i));
  Pack pack = packed(std::move(set), options, 1);
  pack.generator.version = "0.1.0";
  return pack;
}

std::vector<Pack> packs_of_every_kind() {
  PackingOptions plain;
  plain.virtual_size = {4, 4};
  PackingOptions index = plain;
  index.mapping = MappingKind::index;
  index.corner_pack = true;
  PackingOptions torus = plain;
  torus.layout = LayoutKind::de_bruijn;
  torus.mapping = MappingKind::mix;
  PackingOptions rotated = plain;
  rotated.layout = LayoutKind::rotated;
  PackingOptions array = plain;
  array.layout = LayoutKind::array;
  array.array.border = 2;
  return {noise_pack_of(plain, Coloring::edge), noise_pack_of(index, Coloring::edge),
          noise_pack_of(torus, Coloring::corner), noise_pack_of(rotated, Coloring::edge),
          noise_pack_of(array, Coloring::edge)};
}

const std::vector<json>& strange_values() {
  static const std::vector<json> values{nullptr,
                                        true,
                                        -1,
                                        0,
                                        1,
                                        2,
                                        3,
                                        7,
                                        8,
                                        16,
                                        64,
                                        255,
                                        4096,
                                        65536,
                                        2147483647,
                                        2147483648u,
                                        18446744073709551615u,
                                        0.5,
                                        -0.0,
                                        1e308,
                                        "",
                                        "..",
                                        "../x",
                                        "color_0.png",
                                        "color_1.png",
                                        json::array(),
                                        json::object(),
                                        {1, 2},
                                        {8, 8},
                                        "edge",
                                        "corner",
                                        "rotated",
                                        "array",
                                        "tile-index",
                                        "mix",
                                        "index"};
  return values;
}

// One to three changes: a value replaced, a member removed, or one value put in the place of another.
json changed(json document, std::uint64_t seed) {
  std::uint64_t draw = 0;
  const auto below = [&](std::size_t count) {
    return random_below(seed, "change", draw++, static_cast<std::uint32_t>(count));
  };
  for (std::uint32_t turn = below(3); turn < 3; ++turn) {
    const json flat = document.flatten();
    auto chosen = flat.begin();
    std::advance(chosen, below(flat.size()));
    json::json_pointer place(chosen.key());
    while (place.to_string().find('/', 1) != std::string::npos && below(3) == 0) place.pop_back();
    if (below(4) == 0 && !place.empty() && document[place.parent_pointer()].is_object())
      document[place.parent_pointer()].erase(place.back());
    else if (below(8) == 0)
      document[place] = *std::next(flat.begin(), below(flat.size()));
    else
      document[place] = strange_values()[below(strange_values().size())];
    if (!document.is_object() || document.empty()) break;
  }
  return document;
}

void sample_everywhere(const Pack& pack) {
  for (int m = 0; m < static_cast<int>(pack.maps.size()); ++m) {
    const ReferenceSampler sampler(pack, m);
    std::vector<double> out(static_cast<std::size_t>(sampler.channels()));
    for (std::uint64_t i = 0; i < 24; ++i) {
      const auto tile = [&](std::uint64_t n) {
        return static_cast<std::int64_t>(random_bits(i, "tile", n) >> 40) - 9;
      };
      const double fraction = static_cast<double>(random_below(i, "fraction", 0, 5)) / 4.0;
      sampler.sample({tile(0), fraction}, {tile(1), 1.0 - fraction}, static_cast<double>(i) / 4.0 - 1.0,
                     Filter::trilinear, out);
    }
  }
}

} // namespace

TEST_CASE("no change of a pack.json gets past the reader and breaks the sampler", "[pack]") {
  const ScratchFolder temporary;
  int refused = 0;
  int accepted = 0;
  for (const Pack& pack : packs_of_every_kind()) {
    const fs::path folder = temporary / std::to_string(refused);
    write_pack(pack, folder);
    REQUIRE_NOTHROW(sample_everywhere(read_pack(folder)));
    const json good = json::parse(std::ifstream(folder / "pack.json"));
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
      const json other = changed(good, seed);
      std::ofstream(folder / "pack.json") << other;
      INFO("change " << seed << " of " << name_of(pack.layout.kind) << " in " << other.dump());
      try {
        const Pack read = read_pack(folder);
        sample_everywhere(read);
        ++accepted;
      } catch (const Error& error) {
        const bool expected =
            error.kind() == ErrorKind::invalid_content || error.kind() == ErrorKind::cannot_read;
        CHECK(expected);
        ++refused;
      }
    }
  }
  CHECK(refused > accepted);
  CHECK(accepted > 0); // else the changes would be too wild to reach what lies behind the reader
}
