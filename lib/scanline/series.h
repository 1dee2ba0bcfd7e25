#pragma once

namespace tilepack {

/// Logarithm and tangent from + - * / alone: the C library picks fused instructions at run time where the
/// processor has them, so its last bits may differ, and pictures must not.

/// ln x for finite x > 0, relative error below 1e-15 (absolute near x = 1). -infinity for 0.
double repeatable_ln(double x);

/// log2 x, as repeatable_ln.
double repeatable_log2(double x);

/// tan of half an angle given in degrees, 0 < degrees < 180: what a field of view needs.
double tangent_of_half(double degrees);

} // namespace tilepack
