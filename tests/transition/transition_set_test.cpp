#include "support/samples.h"

#include "tilepack/transition/transition_set.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

using namespace tilepack;

namespace {

// Dark blobs, bright blobs, and so on: no value of one material lies near those of another.
SampleMap toned(int material, int side) {
  Image image = testing::blobs(side, side, static_cast<std::uint64_t>(material) + 1);
  for (float& v : image.data()) v = 0.25f * static_cast<float>(material) + 0.2f * v;
  return testing::color_map(std::move(image));
}

struct Made {
  JoinedSamples joined;
  TransitionSet set;

  int material(std::size_t tile, int x, int y) const { return joined.material_at(at(tile, x, y).x); }
  SourceTexel at(std::size_t tile, int x, int y) const {
    return set.sources
        .texels[tile][static_cast<std::size_t>(y) * static_cast<std::size_t>(set.sources.tile_size.width) +
                      static_cast<std::size_t>(x)];
  }
  const std::vector<CornerTile>& tiles() const {
    return std::get<std::vector<CornerTile>>(set.sources.tiles);
  }
};

Made made(int materials, Size tile, int variants, int guard = 0, int colors_of_each = 1) {
  std::vector<std::vector<SampleMap>> maps;
  for (int m = 0; m < materials; ++m) maps.push_back({toned(m, 64 + 8 * m)});
  std::vector<std::span<const SampleMap>> spans(maps.begin(), maps.end());
  std::vector<SampleAnalysis> analyses;
  for (const auto& list : maps) analyses.push_back(analysed(list));
  std::vector<const SampleAnalysis*> pointers;
  for (const SampleAnalysis& sample : analyses) pointers.push_back(&sample);
  SynthOptions options;
  options.tile_size = tile;
  options.coloring = Coloring::corner;
  options.colors = {0, 0, materials * colors_of_each, variants};
  options.guard = guard;
  options.effort = 1;
  Made result{joined(spans), {}};
  result.set = transition_set(result.joined, pointers, options);
  return result;
}

// How many of the texels along sides whose ends are alike differ between two tiles, `depth` texels deep.
int differing(const Made& m, int depth) {
  const int w = m.set.sources.tile_size.width;
  const int h = m.set.sources.tile_size.height;
  int count = 0;
  const auto& tiles = m.tiles();
  for (std::size_t a = 0; a < tiles.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      for (int d = 0; d < depth; ++d) {
        const CornerTile& s = tiles[a];
        const CornerTile& t = tiles[b];
        for (int x = 0; x < w; ++x) {
          if (s.nw == t.nw && s.ne == t.ne) count += m.at(a, x, d) != m.at(b, x, d);
          if (s.sw == t.sw && s.se == t.se) count += m.at(a, x, h - 1 - d) != m.at(b, x, h - 1 - d);
        }
        for (int y = 0; y < h; ++y) {
          if (s.nw == t.nw && s.sw == t.sw) count += m.at(a, d, y) != m.at(b, d, y);
          if (s.ne == t.ne && s.se == t.se) count += m.at(a, w - 1 - d, y) != m.at(b, w - 1 - d, y);
        }
      }
  return count;
}

} // namespace

TEST_CASE("tiles of a transition agree along equal pairs of corners, whatever the others are", "[synth]") {
  CHECK(differing(made(2, {32, 24}, 2), 1) == 0);
  CHECK(differing(made(2, {32, 32}, 1, 3), 3) == 0);
  CHECK(differing(made(3, {24, 24}, 1), 1) == 0);
}

TEST_CASE("a material may have several corner colors, whose tiles all are its own", "[synth]") {
  const Made m = made(2, {24, 24}, 1, 0, 2);
  REQUIRE(m.tiles().size() == 256);
  CHECK(m.set.layers[0].texels.size() == 81);
  CHECK(differing(m, 1) == 0);
  int pure = 0;
  for (std::size_t id = 0; id < m.tiles().size(); ++id) {
    const CornerTile& c = m.tiles()[id];
    const int first = c.nw / 2;
    CHECK(m.material(id, 0, 0) == first);
    CHECK(m.material(id, 23, 23) == c.se / 2);
    if (c.ne / 2 != first || c.sw / 2 != first || c.se / 2 != first) continue;
    ++pure;
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 24; ++x) CHECK(m.material(id, x, y) == first);
  }
  CHECK(pure == 32);
}

TEST_CASE("the two sides of an edge show the same material wherever they meet", "[synth]") {
  const Made m = made(2, {32, 32}, 1);
  // Along an edge the border may step aside by what it is cut to; it may not jump.
  for (std::size_t a = 0; a < m.tiles().size(); ++a)
    for (std::size_t b = 0; b < m.tiles().size(); ++b) {
      if (m.tiles()[a].sw != m.tiles()[b].nw || m.tiles()[a].se != m.tiles()[b].ne) continue;
      int unlike = 0;
      for (int x = 0; x < 32; ++x) unlike += m.material(a, x, 31) != m.material(b, x, 0);
      CHECK(unlike <= 4);
    }
}

TEST_CASE("a tile shows the materials of its corners, round them and in about their share", "[synth]") {
  for (const int materials : {2, 3}) {
    const Made m = made(materials, {32, 32}, 2);
    double off = 0;
    for (std::size_t id = 0; id < m.tiles().size(); ++id) {
      const CornerTile& c = m.tiles()[id];
      const int corners[] = {c.nw, c.ne, c.sw, c.se};
      std::vector<double> shown(static_cast<std::size_t>(materials)), wanted = shown;
      for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x) shown[static_cast<std::size_t>(m.material(id, x, y))] += 1.0 / 1024;
      for (const int corner : corners) wanted[static_cast<std::size_t>(corner)] += 0.25;
      CHECK(m.material(id, 0, 0) == c.nw);
      CHECK(m.material(id, 31, 0) == c.ne);
      CHECK(m.material(id, 0, 31) == c.sw);
      CHECK(m.material(id, 31, 31) == c.se);
      for (std::size_t k = 0; k < shown.size(); ++k) {
        if (wanted[k] == 0) CHECK(shown[k] == 0);
        if (wanted[k] == 1) CHECK(shown[k] == Approx(1.0));
        CHECK(std::abs(shown[k] - wanted[k]) < 0.35);
        off += std::abs(shown[k] - wanted[k]) / static_cast<double>(shown.size() * m.tiles().size());
      }
    }
    CHECK(off < 0.1);
  }
}

TEST_CASE("pure tiles are those of the material's own set, and all texels are copies of its sample",
          "[synth]") {
  const Made m = made(2, {32, 32}, 2);
  for (std::size_t id = 0; id < m.tiles().size(); ++id) {
    const CornerTile& c = m.tiles()[id];
    const std::size_t variant = id / 16;
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 32; ++x) {
        const SourceTexel s = m.at(id, x, y);
        const Rect& place = m.joined.places[static_cast<std::size_t>(m.material(id, x, y))];
        CHECK((s.x >= place.x && s.x < place.x + place.width && s.y < place.y + place.height));
        if (c == CornerTile{1, 1, 1, 1}) {
          const SourceTexel own =
              m.set.layers[1].texels[variant * 16 + 15][static_cast<std::size_t>(32 * y + x)];
          CHECK(s == SourceTexel{own.x + place.x, own.y});
        }
      }
  }
  // No blend: in the assembled tiles every value is one of the sample's.
  const TileSet tiles = assembled(m.set.sources, m.joined.maps);
  for (const Image& tile : tiles.maps[0].tiles)
    for (const float v : tile.data()) CHECK((v <= 0.2f || v >= 0.25f));
}

TEST_CASE("borders run neither straight nor the same in all variants", "[synth]") {
  const Made m = made(2, {48, 48}, 3);
  std::vector<std::vector<int>>
      columns; // of the border in tiles with one material in the west, one in the east
  for (std::size_t id = 0; id < m.tiles().size(); ++id) {
    if (!(m.tiles()[id] == CornerTile{0, 1, 0, 1})) continue;
    std::vector<int> border;
    for (int y = 0; y < 48; ++y) {
      int west = 0;
      for (int x = 0; x < 48; ++x) west += m.material(id, x, y) == 0;
      border.push_back(west);
    }
    const auto [least, most] = std::minmax_element(border.begin(), border.end());
    CHECK(*most - *least >= 4);
    columns.push_back(border);
  }
  REQUIRE(columns.size() == 3);
  CHECK(columns[0] != columns[1]);
  CHECK(columns[1] != columns[2]);
}

TEST_CASE("a transition is the same for any number of threads", "[synth]") {
  const Made all = made(3, {24, 24}, 1);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Made single = made(3, {24, 24}, 1);
  CHECK(all.set.sources.texels == single.set.sources.texels);
  CHECK(all.set.figures.border_length == single.set.figures.border_length);
}

TEST_CASE("figures of a transition count its borders and what is shown", "[synth]") {
  const Made m = made(2, {32, 32}, 1);
  const TransitionFigures& figures = m.set.figures;
  REQUIRE(figures.shown.size() == 2);
  CHECK(figures.shown[0] + figures.shown[1] == Approx(1.0));
  CHECK(figures.shown[0] == Approx(0.5).margin(0.1));
  CHECK(figures.border_length > 24);
  CHECK(figures.border_length < 200);
  CHECK(figures.through_things < figures.expected);
}
