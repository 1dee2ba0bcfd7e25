#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tilepack {

/// A lookup at the end of what can be asked, what is promised for it, and how far the samplers are from that.
///
/// Differences are the largest over channels and filters, in 8-bit units of linear light.
struct HardLookup {
  std::string input;          ///< "x just below a border (1 - 2^-53 tiles)"
  std::string promise;        ///< "the value on the border"
  double reference = 0;       ///< reference sampler
  std::optional<double> fast; ///< fast sampler, best instruction set; absent where it has no such input

  static constexpr double reference_limit = 1e-6; ///< its sums are doubles, decoded texels floats
  static constexpr double fast_limit = 0.01;      ///< single precision
  bool kept() const { return reference <= reference_limit && (!fast || *fast <= fast_limit); }
};

/// Coordinates on borders and corners, just below them, negative, 2^24 texels and 2^31 tiles out and not
/// finite; levels outside the chain; footprints of zero, NaN, infinity, larger than the texture and of
/// extreme shape; tiles of one texel, odd and prime sides, and a single tile; borders that don't wrap. On
/// packs of random texels made here, whose tiles agree along equal colors. Deterministic.
std::vector<HardLookup> stress_lookups();

/// A table for people; the sections of a JSON and a CSV report are made in bench_text.cpp.
std::string hard_lookups_text(const std::vector<HardLookup>& cases);

} // namespace tilepack
