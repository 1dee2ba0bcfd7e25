#pragma once

#include "tilepack/pack/pack.h"

#include <cstdint>
#include <span>
#include <vector>

namespace tilepack {

/// The texels of one map of a pack as a filter sees them: in linear light, reached from a cell of the virtual
/// texture.
///
/// This is where the packed texture's wrap happens: a texel beyond the tile's border is that of the tile's
/// neighbour *in the pack*, as graphics hardware would read it, and not that of the neighbour in the virtual
/// texture.
class PackTexels {
public:
  /// Decodes levels first_level..last_level (clamped to those stored) of pack.maps[map]. `pack` must outlive
  /// this. Throws Error (usage) for a map that isn't there.
  PackTexels(const Pack& pack, int map, int first_level = 0, int last_level = 1 << 20);

  /// Where the tile of a cell lies in the pack: its grid column and row.
  struct Place {
    int column = 0;
    int row = 0;
    bool operator==(const Place&) const = default;
  };
  Place place(std::int64_t cell_x, std::int64_t cell_y) const;

  /// Texel (i, j) counted from the north-west texel of the tile at `place`, any integers.
  std::span<const float> texel(int level, Place place, int i, int j) const;

  int channels() const;
  int levels() const;                      ///< stored in the pack, whether decoded or not
  Size tile_size(int level) const;         ///< texels
  bool has_alpha() const { return alpha; } ///< color whose last channel weighs the others

private:
  const Pack* pack;
  const PackedMap* map;
  std::vector<Image> decoded; ///< by level; empty where not asked for or where stored values are linear
  bool alpha = false;
};

} // namespace tilepack
