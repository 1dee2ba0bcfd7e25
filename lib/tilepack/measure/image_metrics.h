#pragma once

#include "tilepack/image/image.h"

#include <cstdint>
#include <optional>

namespace tilepack {

/// How far two images of one size are apart. Values are compared as stored (sRGB-encoded color stays
/// encoded), all channels alike, alpha too. `scale` turns differences into the unit reported: 255 gives 8-bit
/// units.
struct ImageDifference {
  bool equal = false;              ///< every value has the same bits, but for the sign of 0; NaN equals NaN
  std::int64_t differing = 0;      ///< texels with a channel that differs
  std::int64_t not_comparable = 0; ///< texels where a value of either image is NaN or infinite and the other
                                   ///< is not the same; left out of all figures below
  double largest = 0;              ///< largest absolute difference of a value, in units
  int largest_x = 0;               ///< the texel where it is: the first, row by row
  int largest_y = 0;
  int largest_channel = 0;
  double mean = 0;            ///< mean absolute difference, in units
  double rms = 0;             ///< root of the mean squared difference, in units
  std::optional<double> psnr; ///< 20 log10(peak * scale / rms), dB; absent when rms is 0: infinite
  double ssim = 1;            ///< see structural_similarity
  double peak = 1; ///< the value that counts as full range: 1, or for `unbounded` the largest magnitude in
                   ///< either image (1 if both are 0)
};

/// What full scale is.
enum class FullRange {
  unit,      ///< integers, normalised to 0..1
  unbounded, ///< half and float
};

/// Throws Error (invalid_content) if sizes or channels differ.
ImageDifference difference(const Image& a, const Image& b, FullRange range, double scale);

/// Mean structural similarity, 1 for equal images: a Gaussian window of 11 x 11 texels, sigma 1.5, K1 = 0.01,
/// K2 = 0.03, over all windows that lie wholly inside, mean over channels.   [Wang04, Eq. 13]
/// In an image narrower or lower than 11 texels the window is as large as the image allows (an odd side).
double structural_similarity(const Image& a, const Image& b, double peak);

/// The absolute difference times `gain`, clamped to 0..1, as 3 channels (1 and 2 channels as grey, alpha left
/// out); texels that can't be compared are magenta. To be looked at.
Image difference_picture(const Image& a, const Image& b, double gain);

} // namespace tilepack
