#include "tilepack/mip/mip_mode.h"

namespace tilepack {

std::string_view name_of(MipMode mode) {
  switch (mode) {
  case MipMode::none:
    return "none";
  case MipMode::box:
    return "box";
  case MipMode::edges:
    return "edges";
  case MipMode::corners:
    return "corners";
  case MipMode::least_squares:
    break;
  }
  return "least-squares";
}

} // namespace tilepack
