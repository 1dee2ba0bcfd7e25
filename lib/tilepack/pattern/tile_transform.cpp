#include "tilepack/pattern/tile_transform.h"

#include "tilepack/numeric/exact_math.h"

#include <cmath>

namespace tilepack {

void TileTransform::turn(double turns) {
  const double turned = turns - std::floor(turns); // of NaN and infinities NaN
  const double at = turned >= 0 ? turned : 0;
  const auto sine_of = [](double t) { // of 0..1.25 turns
    if (t >= 1) t -= 1;
    return exact_sine_of_half_turns(t < 0.25 ? 2 * t : t < 0.75 ? 1 - 2 * t : 2 * t - 2);
  };
  sine = sine_of(at);
  cosine = sine_of(at + 0.25);
}

} // namespace tilepack
