#pragma once

#include "tilepack/image/image.h"

#include <span>

namespace tilepack {

/// What the texels of a 2 × 2 box count for.
enum class Weighting {
  plain,    ///< a quarter each
  by_alpha, ///< channels before the last in proportion to the last, alpha; a quarter each where all are clear
};

/// `image` at half the size, each texel the mean of its 2 × 2 box; both sides must be even. Alpha weighting
/// keeps the color that clear texels happen to hold out of their neighbours. The sums are taken as
/// (nw + ne) + (sw + se).
Image halved(const Image& image, Weighting weighting);

/// One row of it, of two rows of as many channels; `to` has half their length.
void halve_rows(std::span<const float> north, std::span<const float> south, int channels, Weighting weighting,
                std::span<float> to);

} // namespace tilepack
