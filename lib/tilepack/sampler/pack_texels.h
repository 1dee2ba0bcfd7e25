#pragma once

#include "tilepack/lookup/lookup_tables.h"
#include "tilepack/pack/pack.h"
#include "tilepack/sampler/filter.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace tilepack {

/// The texels of one map of a pack as a filter sees them: in linear light, reached from a cell of the virtual
/// texture.
///
/// This is where the packed texture's wrap happens: a texel beyond the tile's border is that of the tile's
/// neighbour *in the pack*, as graphics hardware would read it, and not that of the neighbour in the virtual
/// texture. In an array it is the layer's border, and beyond that the layer's last texel; in a rotated layout
/// the place is turned, and the filter's square stays upright in the texture.
class PackTexels {
public:
  /// Decodes levels first_level..last_level (clamped to those stored) of pack.maps[map]. `pack` must outlive
  /// this. Throws Error (usage) for a map that isn't there.
  PackTexels(const Pack& pack, int map, int first_level = 0, int last_level = 1 << 20);

  /// The same for the corner pack's map of that number, whose cells form a grid. Throws Error (usage) also if
  /// the pack has no corner pack.
  static PackTexels of_corners(const Pack& pack, int map, int first_level = 0, int last_level = 1 << 20);

  /// Where the tile of a cell lies in the pack: its grid column and row, and its id.
  struct Place {
    int column = 0;
    int row = 0;
    int tile = 0;
    bool operator==(const Place&) const = default;
  };
  Place place(std::int64_t cell_x, std::int64_t cell_y) const;

  const PackLookup& lookup() const { return tables.words(); }

  /// Texel (i, j) counted from the north-west texel of the tile at `place`, any integers. Not for rotated
  /// layouts, whose tiles have no rows of texels.
  std::span<const float> texel(int level, Place place, int i, int j) const;

  /// A texel that a filter reads, and its share.
  struct Tap {
    std::span<const float> texel;
    double weight = 0;
  };
  struct Taps {
    std::array<Tap, 4> taps;
    int count = 0;
  };

  /// What `filter` (nearest, else bilinear) reads in one level at a point of the tile, given as fractions
  /// 0 <= x, y < 1 of its sides. Weights add up to 1 and none is 0. Far levels are read bilinearly.
  Taps taps(int level, Place place, double fraction_x, double fraction_y, Filter filter) const;

  /// What stands for texel (i, j) of the tile's own rows, any integers: that texel; in a rotated layout,
  /// where tiles have none, what lies at its centre, bilinearly.
  Taps texel_taps(int level, Place place, int i, int j) const;

  int channels() const;
  int levels() const;                      ///< of tiles, whether decoded or not
  int chain_levels() const;                ///< with the far levels of a full chain
  Size tile_size(int level) const;         ///< texels
  bool has_alpha() const { return alpha; } ///< color whose last channel weighs the others

private:
  PackTexels(const Pack& pack, const std::vector<PackedMap>& maps, int map, int first_level, int last_level);
  const Image& image(int level) const;
  Taps far_taps(const Image& far, Place place, double fraction_x, double fraction_y) const;

  const PackedMap* map; // of the pack
  LookupTables tables;
  std::vector<Image> decoded; ///< by level; empty where not asked for or where stored values are linear
  bool alpha = false;
  bool turned = false;                            ///< rotated layout
  int border = -1;                                ///< array: its border at level 0; others -1
  std::vector<std::vector<Placement>> placements; ///< rotated: level → tile
};

} // namespace tilepack
