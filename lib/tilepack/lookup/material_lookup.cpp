#include "tilepack/lookup/material_lookup.h"

#include "tilepack/error/error.h"
#include "tilepack/pack/pack.h"

#include <algorithm>

namespace tilepack {

MaterialLookup material_lookup(const Pack& pack) {
  if (pack.colors.corner == 0)
    throw Error(ErrorKind::invalid_content, "",
                "the pack has edge colors, and materials are given at corners: bake it with " +
                    field("transition"));
  if (!is_complete_set(pack.tiles))
    throw Error(ErrorKind::invalid_content, "",
                "the pack's set is not complete: some corners have no tile; bake it with " +
                    field("transition"));
  MaterialLookup lookup;
  lookup.materials = static_cast<std::uint32_t>(pack.colors.corner);
  if (!pack.materials.empty()) {
    lookup.colors_of_material = static_cast<std::uint32_t>(
        std::count(pack.materials.begin(), pack.materials.end(), pack.materials.front()));
    lookup.materials /= lookup.colors_of_material;
  }
  lookup.variants = static_cast<std::uint32_t>(pack.colors.variants);
  lookup.corner_keys = mix_keys(pack.generator.seed, MixAxis::corner);
  lookup.variant_keys = mix_keys(pack.generator.seed, MixAxis::variant);
  return lookup;
}

} // namespace tilepack
