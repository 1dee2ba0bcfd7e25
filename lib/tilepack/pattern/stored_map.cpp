#include "tilepack/pattern/stored_map.h"

#include "tilepack/error/error.h"
#include "tilepack/numeric/wrap.h"

#include <fmt/format.h>

namespace tilepack {

const Grid<float>& StoredMap::all() const {
  if (ready.load(std::memory_order_acquire)) return values;
  const std::scoped_lock lock(opening);
  if (!ready.load(std::memory_order_relaxed)) {
    Grid<float> read = opener();
    if (read.size() != extent)
      throw Error(ErrorKind::internal, "",
                  fmt::format("a stored map of {} x {} was read as one of {} x {}", extent.width,
                              extent.height, read.width, read.height));
    values = std::move(read);
    ready.store(true, std::memory_order_release);
  }
  return values;
}

float StoredMap::at(std::int64_t x, std::int64_t y) const {
  if (x >= 0 && y >= 0 && x < extent.width && y < extent.height)
    return all().at(static_cast<int>(x), static_cast<int>(y));
  return all().at(static_cast<int>(wrapped(x, std::int64_t{extent.width})),
                  static_cast<int>(wrapped(y, std::int64_t{extent.height})));
}

} // namespace tilepack
