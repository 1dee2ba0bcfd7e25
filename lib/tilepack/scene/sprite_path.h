#pragma once

#include "tilepack/pattern/sprite_map.h"
#include "tilepack/scene/scene_values.h"

namespace tilepack {

/// A sprite of a scene as it lies at `time`, in cells of `grid`, which wraps. Paths are closed curves through their
/// points (Catmull-Rom), each stretch of which takes the same time.
Sprite sprite_at_time(const SceneSprite& sprite, double time, const PatternGrid& grid);

} // namespace tilepack
