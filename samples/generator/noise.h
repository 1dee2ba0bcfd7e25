#pragma once

#include <cstdint>

/// Noise made of hashes, additions, multiplications and square roots only, so that the samples come out the
/// same on every machine.
namespace samples {

/// 0..1, from a hash of the lattice point and the seed.
double random_at(std::int64_t x, std::int64_t y, std::uint64_t seed);

/// A vector of length 1, its direction from a hash.
struct Direction {
  double x = 1;
  double y = 0;
};
Direction direction_at(std::int64_t x, std::int64_t y, std::uint64_t seed);

/// Smooth noise with features one unit apart, about -1 to 1, mean 0.
double noise(double x, double y, std::uint64_t seed);

/// Sum of octaves, each turned, twice as fine and half as strong as the last; about -1 to 1.
double fractal(double x, double y, int octaves, std::uint64_t seed);

/// Distances to the two nearest of randomly placed points, one a unit cell, and the hash of the nearest.
struct Cells {
  double nearest = 0;
  double second = 0;
  std::uint64_t id = 0;
};
Cells cells(double x, double y, std::uint64_t seed);

/// 0 up to `from`, 1 from `to` on, smooth between.
double smooth_step(double from, double to, double x);

double mix(double a, double b, double t);

} // namespace samples
