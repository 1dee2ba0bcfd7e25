#pragma once

#include "surface.h"

#include <cstdint>

/// The subjects of the samples, one file each. Coordinates in texels of the finished sample.
namespace samples {

Surface pebbles(int size, int oversampling, std::uint64_t seed);
Surface meadow(int size, int oversampling, std::uint64_t seed);
Surface bricks(int size, int oversampling, std::uint64_t seed);
Surface planks(int size, int oversampling, std::uint64_t seed);
Surface cracked(int size, int oversampling, std::uint64_t seed);
Surface rock(int size, int oversampling, std::uint64_t seed);

} // namespace samples
