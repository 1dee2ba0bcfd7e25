#include "tilepack/tileset/material_map.h"

namespace tilepack {

std::string_view name_of(Role role) {
  switch (role) {
  case Role::color:
    return "color";
  case Role::normal:
    return "normal";
  case Role::roughness:
    return "roughness";
  case Role::height:
    return "height";
  case Role::data:
    break;
  }
  return "data";
}

} // namespace tilepack
