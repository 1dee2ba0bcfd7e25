#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace tilepack {

/// The weighted mean of texels, as every exact filter takes it: in doubles, colors weighed by alpha.
///
/// With alpha, colors are summed weighed by it (`weighed`) and plainly (`plain`), for the case that no texel
/// has any.
struct TexelSums {
  static constexpr std::size_t max_channels = 4;
  std::array<double, max_channels> weighed{};
  std::array<double, max_channels> plain{};

  /// `alpha`: the last channel is one.
  void add(std::span<const float> texel, double weight, bool alpha) {
    const double coverage = alpha ? static_cast<double>(texel.back()) : 1.0;
    for (std::size_t c = 0; c < texel.size(); ++c) {
      plain[c] += weight * static_cast<double>(texel[c]);
      weighed[c] += weight * coverage * static_cast<double>(texel[c]);
    }
  }

  /// The mean; weights must have added up to 1.
  void resolve(std::span<double> out, bool alpha) const {
    const double coverage = alpha ? plain[out.size() - 1] : 1.0;
    for (std::size_t c = 0; c < out.size(); ++c)
      out[c] = alpha && coverage != 0.0 ? weighed[c] / coverage : plain[c];
    if (alpha) out.back() = coverage;
  }
};

} // namespace tilepack
