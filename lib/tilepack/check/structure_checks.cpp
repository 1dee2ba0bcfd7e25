#include "tilepack/check/structure_checks.h"

#include <iterator>

namespace tilepack {

std::vector<Issue> check_structure(const Pack& pack) {
  std::vector<Issue> all;
  for (const auto check : {check_tiles, check_layout, check_mapping, check_levels, check_texels,
                           check_layer_borders, check_chain, check_fitted_borders}) {
    std::vector<Issue> found = check(pack);
    all.insert(all.end(), std::make_move_iterator(found.begin()), std::make_move_iterator(found.end()));
  }
  return all;
}

} // namespace tilepack
