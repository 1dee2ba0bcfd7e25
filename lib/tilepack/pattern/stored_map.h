#pragma once

#include "tilepack/numeric/grid.h"
#include "tilepack/pattern/tile_map.h"

#include <atomic>
#include <cstddef>
#include <functional>
#include <mutex>

namespace tilepack {

/// An explicit map of [LN03]: a value a cell, stored. What it is read from is opened when the first value is asked
/// for, once, and by one thread; so a map that no visible texel needs costs nothing.
///
/// Values are floats: integers to 2^24 are exact, which is what index maps hold (-1: no pattern).
class StoredMap {
public:
  /// `open` gives size.width x size.height values, row by row (Error, internal, for another size); what it throws is
  /// thrown to who asked, and asked again it is called again.
  StoredMap(Size size, std::function<Grid<float>()> open) : extent(size), opener(std::move(open)) {}
  explicit StoredMap(Grid<float> map) : extent(map.size()), values(std::move(map)), ready(true) {}

  Size size() const { return extent; }
  PatternGrid grid() const { return {extent.width, extent.height}; }

  /// The value of a cell, any integers: the map wraps.
  float at(std::int64_t x, std::int64_t y) const;
  const Grid<float>& all() const;

  bool opened() const { return ready.load(); }
  std::size_t bytes() const { return opened() ? values.values.size() * sizeof(float) : 0; }

private:
  Size extent;
  std::function<Grid<float>()> opener;
  mutable Grid<float> values;
  mutable std::mutex opening;
  mutable std::atomic<bool> ready{false};
};

} // namespace tilepack
