#include "tilepack/numeric/enum_names.h"

#include "tilepack/error/error.h"
#include "tilepack/error/nearest_name.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tilepack {

std::string alternatives(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, "|"));
}

void refuse_name(std::string_view name, const std::string& where, std::string_view noun,
                 const std::vector<std::string>& known) {
  std::string list;
  for (std::size_t i = 0; i < known.size(); ++i)
    list += fmt::format("{}{}", i == 0 ? "" : i + 1 == known.size() ? " and " : ", ", known[i]);
  const std::string nearest = nearest_name(name, known);
  throw Error(ErrorKind::usage, where,
              fmt::format("'{}' is no {}{}; there are {}", name, noun,
                          nearest.empty() ? "" : fmt::format(", did you mean '{}'?", nearest), list));
}

} // namespace tilepack
