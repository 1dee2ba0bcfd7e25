#pragma once

#include <array>
#include <cstddef>

namespace tilepack {

/// The most pixels that are evaluated at once.
inline constexpr std::size_t longest_run = 512;

/// Where the values of a run of pixels go: an array a channel (alpha not among them), and how much of each pixel is
/// covered at all, 0..1. Values are not multiplied by that.
struct RunValues {
  std::array<float*, 4> value{};
  float* cover = nullptr;

  RunValues from(std::size_t first) const {
    RunValues part;
    for (std::size_t c = 0; c < 4; ++c) part.value[c] = value[c] == nullptr ? nullptr : value[c] + first;
    part.cover = cover + first;
    return part;
  }
};

/// Room for the values of a run.
struct RunBuffer {
  alignas(64) float value[4][longest_run];
  alignas(64) float cover[longest_run];
  RunValues view() { return {{value[0], value[1], value[2], value[3]}, cover}; }
};

} // namespace tilepack
