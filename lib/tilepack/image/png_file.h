#pragma once

#include "tilepack/image/raster.h"

#include <filesystem>

namespace tilepack {

/// Opens a PNG file with libpng. Palettes, single bits and transparent colors come expanded to 8-bit
/// channels, 16 bits as they are; no gamma, no change of alpha. The encoding is that of a cICP chunk, else of
/// a profile, else sRGB, but for a gAMA chunk of 1 that stands alone: linear. Any other gamma is near sRGB.
/// Interlaced images are decoded as a whole on the first read.
RasterReader open_png(const std::filesystem::path& file);

/// Writes a PNG of 8 or 16 bits (u8, u16) and 1 to 4 channels. Marked by gAMA and sRGB chunks if `encoding`
/// is srgb, not at all if linear.
///
/// The bytes depend on the texels alone, not on bands or threads: rows are compressed in blocks of a fixed
/// height, each by itself, all cores at once. A row has the filter with the smallest sum of magnitudes;
/// deflate runs at level 1 with run lengths only. On photographs of 8 bits that is 2 % larger than level 1
/// with matches and 3 % larger than level 6, in 0.7 and 0.27 times their processor time; drawings get 18 %
/// larger.
RasterWriter create_png(ByteSink sink, Size size, int channels, Depth depth, Encoding encoding);

} // namespace tilepack
