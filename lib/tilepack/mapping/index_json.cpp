#include "tilepack/mapping/index_json.h"

#include "tilepack/error/error.h"
#include "tilepack/tileset/limits.h"

#include <fmt/format.h>

namespace tilepack {

std::string index_map_json(const Mapping& mapping) {
  if (mapping.kind != MappingKind::index)
    throw Error(ErrorKind::usage, field("index-map"),
                fmt::format("the pack's mapping is '{}'; only an index mapping is a stored map",
                            name_of(mapping.kind)));
  if (mapping.size.width * mapping.size.height > limits::most_index_cells_as_json)
    throw Error(ErrorKind::usage, field("index-map"),
                fmt::format("{} x {} cells; at most {} are written as JSON, the image holds them all",
                            mapping.size.width, mapping.size.height, limits::most_index_cells_as_json));
  std::string text = fmt::format("{{\n  \"virtual_size\": [{}, {}],\n  \"tiles\": [", mapping.size.width,
                                 mapping.size.height);
  std::size_t cell = 0;
  for (std::int64_t y = 0; y < mapping.size.height; ++y) {
    text += y == 0 ? "\n    [" : ",\n    [";
    for (std::int64_t x = 0; x < mapping.size.width; ++x)
      text += fmt::format("{}{}", x == 0 ? "" : ", ", mapping.ids[cell++]);
    text += "]";
  }
  return text + "\n  ]\n}\n";
}

} // namespace tilepack
