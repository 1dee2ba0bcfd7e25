#pragma once

#include "tilepack/tileset/material_map.h"

#include <string>
#include <vector>

namespace tilepack {

/// A texel that is so much brighter than its surroundings and the rest of its map that it is a fault: a path of
/// light that a renderer sampled badly, a hot pixel of a camera.
struct Firefly {
  int x = 0;
  int y = 0;
  double times = 0; ///< as bright as nearly all of the map
  bool operator==(const Firefly&) const = default;
};

/// Those of a map of light that is stored in floats, the brightest first: texels with a channel eight times as
/// bright as what 99 of 100 texels stay below, and eight times as bright as all of their neighbours but two.
/// Where they are more than one texel in 200 they belong to the picture, and there are none; none also in maps
/// of integers, where nothing is much brighter than white.
std::vector<Firefly> fireflies(const SampleMap& map);

/// "3 texels far brighter than all round them (fireflies): (12, 40) …, up to 310 times as bright as nearly all
/// others": how many and where the brightest are. Empty for none.
std::string listed(const std::vector<Firefly>& found);

} // namespace tilepack
