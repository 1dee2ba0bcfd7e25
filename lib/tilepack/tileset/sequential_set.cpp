#include "tilepack/tileset/sequential_set.h"

#include "tilepack/error/error.h"
#include "tilepack/tileset/limits.h"

#include <string>

namespace tilepack {

std::vector<EdgeTile> sequential_edge_set(int horizontal_colors, int vertical_colors) {
  const auto out_of_range = [](int colors) { return colors < 1 || colors > limits::most_edge_colors; };
  if (out_of_range(horizontal_colors) || out_of_range(vertical_colors) ||
      horizontal_colors * vertical_colors < 2)
    throw Error(ErrorKind::usage, field("colors"),
                std::to_string(horizontal_colors) + "x" + std::to_string(vertical_colors) +
                    "; a sequential set takes 1 to " + std::to_string(limits::most_edge_colors) +
                    " colors of each kind, and at least 2 of one");
  std::vector<EdgeTile> tiles;
  for (int north = 0; north < horizontal_colors; ++north)
    for (int west = 0; west < vertical_colors; ++west)
      for (const int choice : {0, 1})
        tiles.push_back(
            {north, (west + choice) % vertical_colors, (north + choice) % horizontal_colors, west});
  return tiles;
}

} // namespace tilepack
