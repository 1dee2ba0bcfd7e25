#pragma once

#include "tilepack/mip/srgb_kernel.h"

#include <span>

namespace tilepack {

/// Two rows of sRGB-encoded texels at half their size, in linear light: what halve_rows() gives of the
/// decoded rows (by alpha for 2 and 4 channels) to the last bit, several times as fast, if all values are
/// 8-bit codes (k / 255), which are looked up in a table. Otherwise false, and nothing of use in `to`. 1 to 4
/// channels, an even number of texels.
bool halve_srgb_codes(std::span<const float> north, std::span<const float> south, int channels,
                      std::span<float> to);
bool halve_srgb_codes(std::span<const float> north, std::span<const float> south, int channels,
                      std::span<float> to, const SrgbKernel& kernel); ///< by one of srgb_kernels(): same bits

/// linear_to_srgb() of texels to 2^-22 (float precision), several times as fast: the power branch of the
/// curve by parabolas over 64 pieces an octave, the rest exactly. All channels but the alpha of 2 or 4. `to`
/// has the length of `linear`, and may be `linear`. Like all of tilepack's arithmetic that reaches files, of
/// + - * / only: the bits are the same everywhere.
void encode_srgb(std::span<const float> linear, int channels, std::span<float> to);
void encode_srgb(std::span<const float> linear, int channels, std::span<float> to, const SrgbKernel& kernel);

} // namespace tilepack
