#include "tilepack/seam/scaled_cut.h"

#include <algorithm>

namespace tilepack {
namespace {

// A patch and what it is laid over, one texel for scale × scale, seen from the patch's north-west texel.
struct CoarsePatch {
  SourceCanvas canvas; // the area, and round it a texel where the canvas goes on
  LaidPatch patch;
};

int floor_div(int a, int b) {
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

CutConstraint of_block(const LaidPatch& patch, int x, int y, int scale) {
  CutConstraint all = CutConstraint::free;
  for (int j = y * scale; j < (y + 1) * scale; ++j)
    for (int i = x * scale; i < (x + 1) * scale; ++i) {
      const CutConstraint own =
          patch.constraints[static_cast<std::size_t>(j) * static_cast<std::size_t>(patch.area.width) +
                            static_cast<std::size_t>(i)];
      if (own == CutConstraint::keep || own == CutConstraint::take) return own;
      if (own == CutConstraint::unbiased) all = own;
    }
  return all;
}

CoarsePatch coarse_patch(const FeatureImage& image, const SourceCanvas& canvas, const LaidPatch& patch,
                         int scale) {
  const Rect& a = patch.area;
  const int w = a.width / scale, h = a.height / scale;
  const int west = a.x >= scale ? 1 : 0, north = a.y >= scale ? 1 : 0;
  const int east = a.x + (w + 1) * scale <= canvas.width ? 1 : 0;
  const int south = a.y + (h + 1) * scale <= canvas.height ? 1 : 0;
  const auto in_image = [&](SourceTexel s) {
    return SourceTexel{std::clamp(floor_div(s.x, scale), 0, image.width - 1),
                       std::clamp(floor_div(s.y, scale), 0, image.height - 1)};
  };
  CoarsePatch coarse{SourceCanvas(west + w + east, north + h + south), {{west, north, w, h}, {}, {}}};
  for (int y = 0; y < coarse.canvas.height; ++y)
    for (int x = 0; x < coarse.canvas.width; ++x)
      coarse.canvas.at(x, y) =
          in_image(canvas.at(a.x + (x - west) * scale + scale / 2, a.y + (y - north) * scale + scale / 2));
  // Where the area's north-west texel comes from, so that the rest lies within the level, too.
  const SourceTexel first{floor_div(patch.origin.x + a.x + scale / 2, scale),
                          floor_div(patch.origin.y + a.y + scale / 2, scale)};
  coarse.patch.origin = {std::clamp(first.x, 0, std::max(0, image.width - w)) - west,
                         std::clamp(first.y, 0, std::max(0, image.height - h)) - north};
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) coarse.patch.constraints.push_back(of_block(patch, x, y, scale));
  return coarse;
}

} // namespace

void settle(const std::vector<CutConstraint>& settled, std::vector<CutConstraint>& constraints) {
  for (std::size_t i = 0; i < settled.size(); ++i)
    if (settled[i] != CutConstraint::free &&
        (constraints[i] == CutConstraint::free || constraints[i] == CutConstraint::unbiased))
      constraints[i] = settled[i];
}

std::vector<CutConstraint> settled_by(const std::vector<std::uint8_t>& taken, Size coarse, Size fine,
                                      int factor) {
  const int w = coarse.width, h = coarse.height;
  const auto takes = [&](int x, int y) {
    return taken[static_cast<std::size_t>(std::clamp(y, 0, h - 1)) * static_cast<std::size_t>(w) +
                 static_cast<std::size_t>(std::clamp(x, 0, w - 1))] != 0;
  };
  std::vector<CutConstraint> settled(
      static_cast<std::size_t>(fine.width) * static_cast<std::size_t>(fine.height), CutConstraint::free);
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      int neighbours = 0;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) neighbours += takes(x + dx, y + dy);
      if (neighbours > 0 && neighbours < 9) continue;
      for (int j = 0; j < factor; ++j)
        std::fill_n(settled.begin() + static_cast<std::ptrdiff_t>(y * factor + j) * fine.width + x * factor,
                    factor, neighbours > 0 ? CutConstraint::take : CutConstraint::keep);
    }
  return settled;
}

bool lay_patch_by_scales(const FeaturePyramid& pyramid, SourceCanvas& canvas, const LaidPatch& patch) {
  int level = static_cast<int>(pyramid.size()) - 1;
  if (level <= levels_at_once) return lay_patch(pyramid.front(), canvas, patch);
  const Size area{patch.area.width, patch.area.height};
  std::vector<CutConstraint> settled; // for `level`; by none, all is free
  while (level > 0) {
    const int scale = 1 << level;
    const FeatureImage& image = pyramid[static_cast<std::size_t>(level)];
    CoarsePatch coarse = coarse_patch(image, canvas, patch, scale);
    settle(settled, coarse.patch.constraints);
    lay_patch(image, coarse.canvas, coarse.patch);
    const Rect& in = coarse.patch.area;
    std::vector<std::uint8_t> taken;
    for (int y = in.y; y < in.y + in.height; ++y)
      for (int x = in.x; x < in.x + in.width; ++x)
        taken.push_back(coarse.canvas.at(x, y) ==
                        SourceTexel{coarse.patch.origin.x + x, coarse.patch.origin.y + y});
    const int next = scale > widest_step ? level - 1 : 0;
    settled = settled_by(taken, {in.width, in.height}, {area.width >> next, area.height >> next},
                         1 << (level - next));
    level = next;
  }
  LaidPatch full = patch;
  settle(settled, full.constraints);
  return lay_patch(pyramid.front(), canvas, full);
}

} // namespace tilepack
