#pragma once

#include "tilepack/pack/pack.h"
#include "tilepack/sampler/address.h"

#include <cstdint>
#include <vector>

namespace tilepack {

/// A window of the virtual texture in texels of one level: any x and y.
struct VirtualRect {
  std::int64_t x = 0;
  std::int64_t y = 0;
  int width = 0;
  int height = 0;
};

/// The virtual texture written out: what a user without tiles would have stored at this level.
///
/// The tiles of pack.maps[map] at `level` as they are in the pack (see tiles_at_level), side by side as the
/// mapping says; values and encoding as stored. Throws Error (usage) for a map or level the pack doesn't
/// hold, or sides below 1.
Image virtual_texture(const Pack& pack, int map, int level, VirtualRect rect);

/// The same from `tiles`, one image a tile id, all of one size: `rect` is in their texels.
Image virtual_texture(const Pack& pack, const std::vector<Image>& tiles, VirtualRect rect,
                      WrapMode border = WrapMode::wrap);

} // namespace tilepack
