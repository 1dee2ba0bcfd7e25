#pragma once

#include "tilepack/numeric/enum_names.h"
#include "tilepack/scanline/span.h"

#include <string>
#include <string_view>

namespace tilepack {

/// How 1/(1 - bend * n), the perspective of a span, is followed from pixel to pixel.
///
/// s is the distance in pixels from the pixel at hand to the horizon, m the number of steps since the last
/// exact value ("seed"). The bounds are of the error in pixels of the screen, before rounding.
enum class SpanMethod {
  exact,         ///< a division a pixel
  euler1,        ///< y += bend y²; error 0..ln((s+m+1)/(s+1))  [Cou, Theorem 3.1]
  euler2,        ///< y += bend y² + bend² y³; error 0..4m/((2s+1)(2s+2m+1)) < 2  [Cou, Theorem 3.2]
  newton,        ///< y = (q y + 2) y, q += bend; error 0..min(1, 1/s)  [Cou, Theorem 4.1, Listing 1]
  newton_direct, ///< as newton, q = bend (n + 1) - 1 computed afresh: a multiplication more, but no sum whose
                 ///< roundings pile up, so in float the one recurrence that truly corrects itself
  newton_general, ///< each coordinate by its own quadratic, same error  [Cou, Eq. 5.5, Listing 2]
  affine,         ///< straight lines between seeds; error -(sqrt(s+m) - sqrt(s))²..0
  estimate,       ///< a division's stand-in: a start value from the bits of the divisor, Newton steps to full
                  ///< precision; no error but rounding, the same bits on every processor
};

template <>
inline constexpr auto enum_names<SpanMethod> =
    std::array{EnumName{SpanMethod::exact, "exact"},
               EnumName{SpanMethod::euler1, "euler1"},
               EnumName{SpanMethod::euler2, "euler2"},
               EnumName{SpanMethod::newton, "newton"},
               EnumName{SpanMethod::newton_direct, "newton-direct"},
               EnumName{SpanMethod::newton_general, "newton-general"},
               EnumName{SpanMethod::affine, "affine"},
               EnumName{SpanMethod::estimate, "estimate"}};

/// The method of that name; Error (usage) that names the nearest one.
SpanMethod span_method_of(const std::string& name);

enum class SpanPrecision { f32, f64 };
template <>
inline constexpr auto enum_names<SpanPrecision> =
    std::array{EnumName{SpanPrecision::f32, "f32"}, EnumName{SpanPrecision::f64, "f64"}};

struct SpanOptions {
  SpanMethod method = SpanMethod::exact;
  int reseed =
      0; ///< pixels between exact values, 1..max_span_pixels; 0: only the first is exact (affine: 16)
};

} // namespace tilepack
