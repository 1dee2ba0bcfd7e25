#pragma once

#include "tilepack/exemplar/period.h"
#include "tilepack/image/image.h"

namespace tilepack {

/// The side of square tiles that suits a sample, before its repeats are looked at: what bakes take unless they
/// are told a size.
///
/// A sample of W x H texels is shown to four fifths or more where the 16 tiles of a default set hold as many
/// texels as the sample, or, where it is large, or shows large things so that strips along edges have to be wide
/// (`object_scale`, exemplar/object_scale.h), 1.6 times as many. Tiles are at least 6 scales wide, where the
/// sample is large enough for that, and at most half of the sample's shorter side. Sides are 4, 5, 6 or 7 times
/// a power of two, so that tiles halve often.
///
/// The memory that a pack takes is bounded: 16 tiles hold at most 2.5 times the sample's texels, and larger sets,
/// whose tiles have the same size for more variety, at most 8 times; their tiles are smaller where that asks for
/// it. `tiles`: of the set, 1 or more.
int tile_side_for(Size sample, double object_scale, int tiles);

/// The largest that tile_side_for returns for such a sample, whatever it shows.
int largest_tile_side_for(Size sample, int tiles);

/// Sides of `side` or so that hold whole periods along each axis that has one: of those near it that halve four
/// times or more the one that is nearest, else what fitting_tile_size() says.
Size tile_size_in_step(const Periodicity& periods, int side, Size sample);

} // namespace tilepack
