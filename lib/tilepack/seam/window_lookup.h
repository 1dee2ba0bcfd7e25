#pragma once

#include "tilepack/match/patch_search.h"
#include "tilepack/match/use_counts.h"
#include "tilepack/seam/source_canvas.h"

namespace tilepack {

/// Adds what a canvas shows in the rectangle of the overlap's size, north-west corner at `at`, at 1 / scale of its size.
/// Within `hole`, relative to that corner and in texels of the canvas, nothing is added: what is to be replaced says
/// nothing about what should come there.
void add_shown(const FeatureImage& image, const SourceCanvas& canvas, SourceTexel at, int scale, Rect hole,
               Overlap& overlap);

/// Rules out the positions of a map, made at 1 / scale of the sample's size, within `distance` of a sample texel.
void rule_out(PositionMap& map, SourceTexel origin, int scale, int distance);

/// Rules out where a window over `area` would show the material that the canvas shows there already, looked at every
/// `step` texels: what stems from there is no news.
void rule_out_material_of(PositionMap& map, const SourceCanvas& canvas, Rect area, int scale, int step,
                          int distance);

/// A window shown as often as the average counts 1 + reuse_weight times as unlike. `window` in texels of the map.
void add_reuse_weight(PositionMap& map, const UseTable& uses, Size window, double reuse_weight);

/// The position that fits best; none if all are ruled out.
bool take_best(PositionMap& map, int apart, SourceTexel& place);

} // namespace tilepack
