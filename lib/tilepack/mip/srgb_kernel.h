#pragma once

#include <cstddef>
#include <vector>

/// The vector kernels below srgb_tables.h. One for each instruction set; all give the same bits.
namespace tilepack {

/// Over one piece of the encoding curve, t in [0, 1): a + t (b + t c). Four values, to be fetched in one go.
struct alignas(16) Parabola {
  float a, b, c, unused;
};

/// The pieces are the floats from `first_bits` to 1 (as bit patterns), 2^piece_bits a piece.
struct EncodeCurve {
  static constexpr int piece_bits = 17; // of the 23 of a float's mantissa: 64 pieces an octave
  int first_bits = 0;
  const Parabola* pieces = nullptr;
};

struct SrgbKernel {
  const char* target = "";

  /// Means of 2 × 2 boxes, `width` texels of `channels` values (1 to 4), of two rows of 8-bit codes k / 255
  /// decoded by `linear`, a table of 256 values; the last of 2 or 4 channels is alpha, is not decoded, and
  /// the others count in proportion to it. Returns other than 0, and nothing of use, if some value is no such
  /// code.
  int (*halve)(const float* north, const float* south, const float* linear, float* to, std::size_t width,
               std::size_t channels) = nullptr;

  /// Codes of up to `block` values by the curve's pieces; `codes` has room for `block`. Returns other than 0
  /// if some value lies off them; its code then means nothing.
  int (*encode)(const float* values, float* codes, std::size_t count, const EncodeCurve& curve) = nullptr;
  static constexpr std::size_t block = 256;
};

/// Those this machine can run, best first; never empty.
std::vector<SrgbKernel> srgb_kernels();

} // namespace tilepack
