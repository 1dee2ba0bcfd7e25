#pragma once

#include "tilepack/exemplar/feature_image.h"

#include <cstddef>
#include <vector>

namespace tilepack {

/// A feature image and its halvings: level 0 is the image itself, which is not copied and has to outlive the
/// pyramid.
class FeaturePyramid {
public:
  explicit FeaturePyramid(const FeatureImage& image) : base(&image) {}
  FeaturePyramid(FeatureImage&&) = delete;

  void add_half() { halves.push_back(halved(back())); }

  std::size_t size() const { return 1 + halves.size(); }
  const FeatureImage& operator[](std::size_t level) const { return level == 0 ? *base : halves[level - 1]; }
  const FeatureImage& front() const { return *base; }
  const FeatureImage& back() const { return halves.empty() ? *base : halves.back(); }

private:
  const FeatureImage* base;
  std::vector<FeatureImage> halves;
};

} // namespace tilepack
