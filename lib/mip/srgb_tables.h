#pragma once

#include "tilepack/image/image.h"
#include "tilepack/mip/srgb_kernel.h"

namespace tilepack {

/// Half the size of an sRGB-encoded image, in linear light, every texel the mean of its 2 × 2 box: what
/// halved(to_linear(image, Encoding::srgb), Weighting::plain) gives to the last bit, several times as fast if
/// all values are 8-bit codes (k / 255), which are looked up in a table. 1 or 3 channels, even sides.
Image halved_from_srgb(const Image& image);
Image halved_from_srgb(const Image& image, const SrgbKernel& kernel); ///< by one of srgb_kernels(): same bits

/// from_linear(image, Encoding::srgb) to 2^-22 (float precision), several times as fast: the power branch of
/// the curve by parabolas over 64 pieces an octave, the rest exactly. All channels but the alpha of 2 or 4.
/// Like all of tilepack's arithmetic that reaches files, of + - * / only: the bits are the same everywhere.
void encode_srgb(Image& image);
void encode_srgb(Image& image, const SrgbKernel& kernel);

} // namespace tilepack
