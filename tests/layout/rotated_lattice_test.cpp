#include "tilepack/layout/rotated_lattice.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

using namespace tilepack;

namespace {

const std::vector<RotatedScheme> various{{1, 0, 1}, {1, 0, 2}, {1, 1, 1}, {1, 1, 2}, {2, 1, 1}, {2, 2, 1},
                                         {2, 1, 2}, {3, 0, 1}, {3, 3, 1}, {4, 2, 1}, {4, 3, 2}, {7, 1, 1},
                                         {5, 5, 1}, {8, 1, 1}, {7, 4, 1}, {6, 3, 2}};

} // namespace

TEST_CASE("a scheme has as many sites as tiles, and its steps are a group on them") {
  for (const RotatedScheme& scheme : various) {
    CAPTURE(scheme.n, scheme.k, scheme.squares);
    const RotatedLattice lattice(scheme);
    REQUIRE(lattice.sites() == tile_count(scheme));
    std::set<int> easts;
    std::set<int> souths;
    std::set<std::pair<int, int>> corners;
    for (int site = 0; site < lattice.sites(); ++site) {
      CHECK(lattice.site_at(lattice.step_to(site)) == site);
      const Cell cell = lattice.cell_of(site);
      CHECK(lattice.site_with(cell.column, cell.row) == site);
      corners.insert({cell.column, cell.row});
      easts.insert(lattice.east_of(site));
      souths.insert(lattice.south_of(site));
      CHECK(lattice.east_of(lattice.south_of(site)) == lattice.south_of(lattice.east_of(site)));
    }
    CHECK(static_cast<int>(corners.size()) == lattice.sites());
    CHECK(static_cast<int>(easts.size()) == lattice.sites());
    CHECK(static_cast<int>(souths.size()) == lattice.sites());
    // Going round the texture in whole steps leads back.
    CHECK(lattice.site_at({scheme.squares * scheme.n, -scheme.squares * scheme.k}) ==
          lattice.site_at({0, 0}));
    CHECK(lattice.site_at({scheme.k, scheme.n}) == lattice.site_at({0, 0}));
  }
}

TEST_CASE("each texel has one owner, whose square holds its centre; owners share the texture evenly") {
  for (const RotatedScheme& scheme : various) {
    CAPTURE(scheme.n, scheme.k, scheme.squares);
    const RotatedLattice lattice(scheme);
    const Size texture{90 * scheme.squares + 1, 91};
    const double m = scheme.n * scheme.n + scheme.k * scheme.k;
    std::vector<int> owned(static_cast<std::size_t>(lattice.sites()));
    double worst = 0;
    for (int y = 0; y < texture.height; ++y)
      for (int x = 0; x < texture.width; ++x) {
        const RotatedLattice::Owner owner = lattice.owner_of(texture, x, y);
        REQUIRE((owner.x >= 0 && owner.x < 1 && owner.y >= 0 && owner.y < 1));
        ++owned[static_cast<std::size_t>(owner.site)];
        // From the corner along the sides to the texel again, up to whole turns of the texture.
        const Cell cell = lattice.cell_of(owner.site);
        const double u = (cell.column + scheme.n * owner.x - scheme.k * owner.y) / (m * scheme.squares);
        const double v = (cell.row + scheme.k * owner.x + scheme.n * owner.y) / m;
        const double du = u - (x + 0.5) / texture.width;
        const double dv = v - (y + 0.5) / texture.height;
        worst = std::max({worst, std::fabs(du - std::round(du)), std::fabs(dv - std::round(dv))});
      }
    CHECK(worst < 1e-12);
    const double share = texture.width * texture.height / static_cast<double>(lattice.sites());
    for (const int count : owned) CHECK(std::fabs(count - share) < 4 * std::sqrt(share) + 4);
  }
}

TEST_CASE("owners of a plain grid are its cells") {
  const RotatedLattice lattice({3, 0, 1});
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 12; ++x) {
      const auto owner = lattice.owner_of({12, 12}, x, y);
      CHECK(owner.site == lattice.site_at({x / 4, y / 4}));
      CHECK(owner.x * 4 == x % 4 + 0.5);
      CHECK(owner.y * 4 == y % 4 + 0.5);
    }
}
