#pragma once

#include "tilepack/image/image.h"
#include "tilepack/numeric/enum_names.h"

#include <optional>
#include <span>
#include <string_view>

namespace tilepack {

/// How values between texel centres are found when a tile is stored turned.
enum class ResampleFilter {
  bilinear, ///< 2 × 2 texels
  bicubic,  ///< 4 × 4, the cubic of Catmull and Rom
  lanczos,  ///< 6 × 6, sinc windowed by its own central lobe
};

template <>
inline constexpr auto enum_names<ResampleFilter> =
    std::array{EnumName{ResampleFilter::bilinear, "bilinear"}, EnumName{ResampleFilter::bicubic, "bicubic"},
               EnumName{ResampleFilter::lanczos, "lanczos"}};

/// Taps on either side of a place, per axis: 1, 2 or 3.
int filter_reach(ResampleFilter filter);

/// The value of `image` at texel coordinates (x, y), centres at + 0.5; beyond its borders the nearest texel
/// counts. At a texel's centre it is that texel, and where all texels read are equal it is their value, both
/// to the last bit. `out` has image.channels() entries.
void resample(const Image& image, double x, double y, ResampleFilter filter, std::span<double> out);

} // namespace tilepack
