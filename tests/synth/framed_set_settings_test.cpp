#include "tilepack/synth/framed_set_settings.h"

#include <catch2/catch.hpp>

using namespace tilepack;

TEST_CASE("strips reach as far as what a sample shows is large, within bounds") {
  const FramedSetSettings plain = settings_for(5, 1);
  const auto reach = [&](double scale) { return fitted(plain, scale, 1000, {128, 160}, {}).reach.x; };
  CHECK(reach(1.0) == plain.reach.x);
  CHECK(reach(6.4) == Approx(0.25));
  CHECK(reach(32.0) == plain.longest_reach);
  const auto with_periods = [&](double x, double y) {
    Periodicity periods;
    periods.x.length = x;
    periods.y.length = y;
    return fitted(plain, 32.0, 5000, {128, 128}, PeriodAlignment(periods, {128, 128}));
  };
  CHECK(with_periods(0, 64).reach.x == plain.longest_reach_in_step);
  CHECK(with_periods(0, 64).reach.y == plain.longest_reach_in_step);
  CHECK(with_periods(64, 32).reach.x == Approx(1.1 * 32 / 128)); // half a brick and some room
  CHECK(with_periods(64, 32).reach.y == plain.longest_reach_in_step);
  CHECK(with_periods(32, 64).reach.y == Approx(1.1 * 32 / 128));
  CHECK(with_periods(128, 32).reach.x == plain.longest_reach_of_lattice);
  CHECK(with_periods(8, 8).reach.x == plain.longest_reach_in_step);
  CHECK(with_periods(64, 32).interiors.bias < with_periods(0, 64).interiors.bias);
  for (const double scale : {1.0, 4.0, 8.0, 32.0}) {
    const FramedSetSettings settings = fitted(plain, scale, 1000, {128, 128}, {});
    CHECK(settings.corner_reach.x >= plain.corner_reach.x);
    CHECK(settings.corner_reach.x >= settings.reach.x);
    CHECK(settings.corner_reach.x <= 0.5); // of the tile
    CHECK(settings.corner_reach.y == settings.corner_reach.x);
  }
}

TEST_CASE("cuts are drawn outward the more, the more a sample varies") {
  const FramedSetSettings plain = settings_for(5, 1);
  CHECK(fitted(plain, 5.0, 0, {128, 128}, {}).interiors.bias == plain.interiors.bias);
  CHECK(fitted(plain, 5.0, 5000, {128, 128}, {}).interiors.bias == 400);
  CHECK(fitted(plain, 5.0, 5000, {128, 128}, {}).set_repair.price == 400);
}

TEST_CASE("no effort does less than the one before it") {
  for (int effort = 1; effort <= 9; ++effort) {
    const FramedSetSettings less = settings_for(effort - 1, 1), more = settings_for(effort, 1);
    CHECK(more.frame.screened >= less.frame.screened);
    CHECK(more.frame.starts >= less.frame.starts);
    CHECK(more.frame.starts <= more.frame.screened);
    CHECK(more.frame.candidates >= less.frame.candidates);
    CHECK(more.interiors.cuts >= less.interiors.cuts);
    CHECK(more.repair.patches >= less.repair.patches);
    CHECK(more.fine_match.passes >= less.fine_match.passes);
    CHECK(more.fine_match.sweeps >= less.fine_match.sweeps);
    CHECK(more.set_repair.corner_tries >= less.set_repair.corner_tries);
    CHECK(more.set_repair.edge_spots >= less.set_repair.edge_spots);
    CHECK(more.set_repair.rounds >= less.set_repair.rounds);
    CHECK(more.coarse_match.passes == 0);
  }
}

TEST_CASE("what is paid by the texel is less for larger tiles, and small ones have it as it is") {
  CHECK(halvings_to_usual({32, 32}) == 0);
  CHECK(halvings_to_usual({255, 400}) == 0);
  CHECK(halvings_to_usual({256, 400}) == 1);
  CHECK(halvings_to_usual({2560, 1280}) == 3);
  const FramedSetSettings plain = settings_for(5, 1);
  CHECK(fitted(plain, 5.0, 50'000, {160, 160}, {}).interiors.bias == 4000);
  CHECK(fitted(plain, 5.0, 50'000, {1280, 1280}, {}).interiors.bias == 500);
}
