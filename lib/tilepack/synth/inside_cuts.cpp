#include "tilepack/synth/inside_cuts.h"

#include "tilepack/seam/scaled_cut.h"

#include <algorithm>

namespace tilepack {

InsideCuts::InsideCuts(const SearchSpace& space, const SourceCanvas& framed, std::int64_t full_bias,
                       int level)
    : image(space.pyramid[static_cast<std::size_t>(level)]),
      frame(framed.width >> level, framed.height >> level),
      // a texel stands for scale² of them, a pair of neighbours for `scale` pairs
      bias(full_bias << level) {
  const FrameShape& shape = space.shape;
  const int scale = 1 << level;
  for (int y = 0; y < frame.height; ++y)
    for (int x = 0; x < frame.width; ++x) {
      const int full_x = x * scale + scale / 2, full_y = y * scale + scale / 2;
      const SourceTexel s = framed.at(full_x, full_y);
      if (s == no_source) {
        constraints.push_back(CutConstraint::take);
        frame.at(x, y) = {0, 0};
        continue;
      }
      const bool outermost =
          std::min({x, y, frame.width - 1 - x, frame.height - 1 - y}) < std::max(1, shape.guard / scale);
      constraints.push_back(outermost ? CutConstraint::keep : constraint_at(shape, full_x, full_y));
      frame.at(x, y) = {std::clamp(s.x / scale, 0, image.width - 1),
                        std::clamp(s.y / scale, 0, image.height - 1)};
    }
}

void InsideCuts::settle(const std::vector<CutConstraint>& settled) {
  tilepack::settle(settled, constraints);
}

SourceCanvas InsideCuts::laid(SourceTexel place) const {
  SourceCanvas canvas = frame;
  lay_patch(image, canvas, {{0, 0, canvas.width, canvas.height}, place, constraints}, bias);
  return canvas;
}

std::vector<std::uint8_t> InsideCuts::taken(SourceTexel place) const {
  const SourceCanvas canvas = laid(place);
  std::vector<std::uint8_t> result;
  result.reserve(canvas.texels.size());
  for (int y = 0; y < canvas.height; ++y)
    for (int x = 0; x < canvas.width; ++x)
      result.push_back(canvas.at(x, y) == SourceTexel{place.x + x, place.y + y});
  return result;
}

std::int64_t InsideCuts::cost(SourceTexel place) const {
  const SourceCanvas canvas = laid(place);
  std::int64_t kept = 0;
  for (int y = 0; y < canvas.height; ++y)
    for (int x = 0; x < canvas.width; ++x) kept += canvas.at(x, y) != SourceTexel{place.x + x, place.y + y};
  return seam_energy(image, canvas) + bias * kept;
}

} // namespace tilepack
