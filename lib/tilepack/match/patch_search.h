#pragma once

#include "tilepack/exemplar/feature_image.h"
#include "tilepack/tileset/source_map.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

namespace tilepack {

/// What a patch laid at some place would overlap: for each texel of the patch how much it counts there, and
/// what lies there already. Several layers may be added on one texel, as when one patch meets several others.
class Overlap {
public:
  Overlap(int patch_width, int patch_height, int channel_count);

  /// Texel (x, y) of the patch overlaps `texel` (channel_count values), counted `weight` times,
  /// 0 <= weight <= 64.
  void add(int x, int y, const std::uint8_t* texel, int weight = 1);

  int width;
  int height;
  int channels;
  std::vector<int> weight;   ///< sum of weights, row by row
  std::vector<int> weighted; ///< sum of weight * value, channels interleaved
  std::int64_t constant = 0; ///< sum of weight * value²
};

/// In place of a mismatch: a position that must not be taken.
constexpr std::int64_t ruled_out = std::numeric_limits<std::int64_t>::max();

/// One number for each position of a patch's north-west texel at which the patch lies inside the image, or for those
/// of some parts of it: then it takes no more room and time than these, however large the image is.
struct PositionMap {
  struct Part {
    Rect area;                        ///< positions
    std::vector<std::int64_t> values; ///< row by row

    std::int64_t& at(int x, int y) {
      return values[static_cast<std::size_t>(y - area.y) * static_cast<std::size_t>(area.width) +
                    static_cast<std::size_t>(x - area.x)];
    }
    SourceTexel place(std::size_t i) const {
      return {area.x + static_cast<int>(i % static_cast<std::size_t>(area.width)),
              area.y + static_cast<int>(i / static_cast<std::size_t>(area.width))};
    }
  };
  int width = 0; ///< positions of the image
  int height = 0;
  std::vector<Part> parts; ///< none overlaps another; elsewhere positions are ruled out

  PositionMap() = default;
  /// Of all positions, each with this number.
  PositionMap(int all_width, int all_height, std::int64_t value)
      : width(all_width),
        height(all_height), parts{{{0, 0, width, height},
                                   std::vector<std::int64_t>(static_cast<std::size_t>(width) *
                                                                 static_cast<std::size_t>(height),
                                                             value)}} {}

  std::int64_t at(int x, int y) const;

  /// visit(x, y, value), part by part and row by row.
  template <class Visit>
  void for_each(Visit&& visit) {
    for (Part& part : parts)
      for (std::size_t i = 0; i < part.values.size(); ++i) {
        const SourceTexel p = part.place(i);
        visit(p.x, p.y, part.values[i]);
      }
  }
};

/// Compares an overlap with every placement of its patch in an image, by Fourier transform: the time grows
/// with the image's area, hardly with the patch's.
///
/// The sums are exact integers. The transforms work in double precision on integers, and their results are
/// rounded; the rounding error of a circular correlation of f and g of N texels computed through transforms
/// is at most about 3 log2(N) 2^-53 |f| |g| (Euclidean norms). That is below 0.1 for 16 channels, two million
/// texels and the largest weights used, so rounding restores the exact sum on any processor with any library.
class PatchSearch {
public:
  /// All of the image.
  explicit PatchSearch(const FeatureImage& image)
      : PatchSearch(image, {0, 0}, std::numeric_limits<std::int64_t>::max()) {}

  /// Of an image of more than `most_texels` texels only the middles of its four quarters, of so many texels
  /// together, and at least twice as wide and as high as the largest patch. Positions elsewhere are ruled out.
  /// Where these would overlap, they are one.
  PatchSearch(const FeatureImage& image, Size largest_patch, std::int64_t most_texels);
  ~PatchSearch();
  PatchSearch(const PatchSearch&) = delete;
  PatchSearch& operator=(const PatchSearch&) = delete;

  /// For each position p: the sum over texels m and layers of weight * |image(p + m) - value|². The patch
  /// must fit into the image. Safe to call from several threads at once.
  PositionMap mismatches(const Overlap& overlap) const;

private:
  struct Spectra;
  std::unique_ptr<Spectra> spectra;
};

/// The same for one position, counted texel by texel.
std::int64_t mismatch_at(const FeatureImage& image, const Overlap& overlap, SourceTexel position);

/// The position with the least mismatch within `distance` texels of `start` in x and in y, of those at which
/// the patch lies inside the image.
SourceTexel best_near(const FeatureImage& image, const Overlap& overlap, SourceTexel start, int distance);

} // namespace tilepack
