#pragma once

#include "tilepack/scanline/span_options.h"

#include <cstddef>
#include <cstdint>

/// What the scalar and the side-by-side implementation of the span methods must agree on, to the bit.
namespace tilepack {

/// Half a unit in the last place of 1: the largest relative error of one operation.
template <class Real>
inline constexpr Real rounding_unit = Real(0x1p-53);
template <>
inline constexpr float rounding_unit<float> = 0x1p-24f;

/// Denominators 1 - bend n are held at this or more: what rounding at the size of 1 can still tell from 0.
template <class Real>
inline constexpr Real lowest_denominator = rounding_unit<Real>;

/// Slopes below this many tiles a pixel count as none in Listing 2, which divides by them; over the longest
/// span that neglects less than 2^-28 tiles.
template <class Real>
inline constexpr Real flattest_slope = Real(0x1p-60);

/// Subtracting the bits of x from this gives the bits of 1/x within 12.5 %: it negates the exponent, and the
/// constant's mantissa spreads the error of the linear mantissa evenly.
template <class Real>
inline constexpr std::uint64_t reciprocal_bits = 0x7FDE623822FC16E6u;
template <>
inline constexpr std::uint32_t reciprocal_bits<float> = 0x7EF311C7u;

/// Newton steps from there to full precision: 2^-3 → 2^-6 → 2^-12 → 2^-24 → 2^-48 → 2^-96.
template <class Real>
inline constexpr int reciprocal_steps = 5;
template <>
inline constexpr int reciprocal_steps<float> = 3;

/// Scanlines walked side by side. One recurrence is serial, so a vector register cannot hold its next pixels;
/// it holds the same pixel number of many scanlines instead.
inline constexpr int scanlines_side_by_side = 32;

/// Where pixel n of scanline `lane` stands among them.
inline std::size_t lane_index(int lane, int n) {
  return static_cast<std::size_t>(n) * scanlines_side_by_side + static_cast<std::size_t>(lane);
}

/// Pixels between seeds where SpanOptions::reseed is 0 and the method is affine.
inline constexpr int affine_piece = 16;

/// Pixels between seeds for a span (or spans side by side) of `count` pixels.
int piece_length(const SpanOptions& options, int count);

/// Throws Error (usage) for a reseed outside 0..max_span_pixels.
void check_reseed(const SpanOptions& options);

} // namespace tilepack
