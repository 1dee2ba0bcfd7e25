#include "tilepack/mip/box_levels.h"

#include "tilepack/mip/downsample.h"
#include "tilepack/mip/level_values.h"
#include "tilepack/numeric/as_size.h"

#include <tbb/parallel_for.h>

#include <cstddef>
#include <span>

namespace tilepack {
namespace {

struct Work {
  const TileMap& map;
  const Image& base;          // of level `done`: the tile itself, else decoded
  int done = 0;               // levels are made from here
  int last = 0;               // to here
  int encoded = 0;            // as box_levels() is told
  Image& carried;             // decoded values of level `last`, unless that is stored decoded
  std::vector<Image>& stored; // by level
};

// A row of a level is made of two rows of the finer one, those of four, and so on, depth first: so what a row
// is made of still lies in the processor's nearest cache, and of a large image only the tile and the result
// travel through memory, once.
class Descent {
public:
  explicit Descent(const Work& work) : w(work) {
    std::size_t values = 0;
    for (int level = w.done + 1; level <= w.last; ++level) {
      starts.push_back(values);
      values += 2 * row_length(level);
    }
    rows.resize(values);
  }

  /// Decoded row `y` of `level`, with all rows of finer levels above it stored; valid until the row after
  /// next is asked for.
  std::span<const float> row(int level, int y) {
    const std::span<float> to = place_of(level, y);
    if (level == 1) {
      halve_decoded(w.base.row(2 * y), w.base.row(2 * y + 1), w.map, to);
    } else {
      const bool first = level == w.done + 1;
      const auto north = first ? w.base.row(2 * y) : row(level - 1, 2 * y);
      const auto south = first ? w.base.row(2 * y + 1) : row(level - 1, 2 * y + 1);
      halve_rows(north, south, w.base.channels(), weighting_of(w.map), to);
    }
    if (level <= w.encoded) encode(to, w.map, w.stored[as_size(level)].row(y));
    return to;
  }

private:
  std::size_t row_length(int level) const {
    return as_size(w.stored[as_size(level)].width()) * as_size(w.base.channels());
  }
  std::span<float> place_of(int level, int y) {
    if (level > w.encoded) return w.stored[as_size(level)].row(y);
    if (level == w.last && !w.carried.empty()) return w.carried.row(y);
    const std::size_t length = row_length(level);
    return {rows.data() + starts[as_size(level - w.done - 1)] + as_size(y % 2) * length, length};
  }

  const Work& w;
  std::vector<std::size_t> starts; // in `rows`, of the levels from done + 1 on
  Texels rows;                     // two a level, even and odd
};

// Many values a task: large against what a task costs, small against what all threads share.
constexpr std::size_t values_a_strip = std::size_t{1} << 16;

// The level of which a task makes one row, given those up to `done` of an image with `row_length` values a
// row there.
int last_of_task(int done, int levels, std::size_t row_length) {
  int last = done + 1;
  while (last + 1 < levels && (row_length << (last - done)) < values_a_strip) ++last;
  return last;
}

} // namespace

std::vector<Image> box_levels(const Image& tile, const TileMap& map, int levels, int encoded) {
  std::vector<Image> stored(1);
  for (int level = 1; level < levels; ++level)
    stored.push_back(Image::unset({tile.width() >> level, tile.height() >> level}, tile.channels()));
  Image base;
  for (int done = 0; done + 1 < levels;) {
    const Image& from = done == 0 ? tile : done > encoded ? stored[as_size(done)] : base;
    const int last = last_of_task(done, levels, from.row(0).size());
    Image carried;
    if (last + 1 < levels && last <= encoded)
      carried = Image::unset(stored[as_size(last)].size(), tile.channels());
    const Work work{map, from, done, last, encoded, carried, stored};
    tbb::parallel_for(0, stored[as_size(last)].height(), [&](int y) { Descent(work).row(last, y); });
    base = std::move(carried);
    done = last;
  }
  return stored;
}

} // namespace tilepack
