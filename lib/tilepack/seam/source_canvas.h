#pragma once

#include "tilepack/exemplar/feature_image.h"
#include "tilepack/tileset/source_map.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace tilepack {

/// A rectangle of texels in the making, each with the sample texel it is copied from.
struct SourceCanvas {
  int width = 0;
  int height = 0;
  std::vector<SourceTexel> texels; ///< row by row

  SourceCanvas() = default;
  SourceCanvas(int w, int h)
      : width(w), height(h), texels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  SourceTexel& at(int x, int y) { return texels[index(x, y)]; }
  const SourceTexel& at(int x, int y) const { return texels[index(x, y)]; }
};

/// How visible the seam between two neighbouring texels is: texel p shows `p_source`, its neighbour at
/// p + (dx, dy) shows `q_source`. Zero where they are neighbours in the sample too; else, at both texels, the
/// squared difference between what is shown and what the other side's material would show there [Kwatra03].
std::int64_t seam_cost(const FeatureImage& image, SourceTexel p_source, SourceTexel q_source, int dx, int dy);

/// The sum of seam costs between all neighbours of a canvas.
std::int64_t seam_energy(const FeatureImage& image, const SourceCanvas& canvas);

/// Each texel's share of the seams around it: half the cost of each seam it is part of, times two.
std::vector<std::int64_t> seams_at_texels(const FeatureImage& image, const SourceCanvas& canvas);

/// The same row by row, from the first on, for canvases so large that the shares would take much room: visit(row, a share
/// for each of its texels).
void seams_by_rows(const FeatureImage& image, const SourceCanvas& canvas,
                   const std::function<void(int, const std::vector<std::int64_t>&)>& visit);

} // namespace tilepack
