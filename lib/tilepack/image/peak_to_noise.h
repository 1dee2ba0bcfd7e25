#pragma once

#include <optional>

namespace tilepack {

/// The ratio of peak to noise: 20 log10(peak / rms) in decibels, of the largest value that counts and the root
/// of the mean squared error, in one unit. Without the C library's logarithm, whose last bit may differ from
/// one processor to another. Unset if rms is 0 (no noise) or either is not a positive finite number.
std::optional<double> peak_to_noise(double peak, double rms);

} // namespace tilepack
