#pragma once

namespace tilepack {

/// A width and a height, in texels or in tiles as the context says.
struct Size {
  int width = 0;
  int height = 0;
  bool operator==(const Size&) const = default;
};

/// A rectangle of texels: x, y of its north-west texel, then its size.
struct Rect {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  bool operator==(const Rect&) const = default;
};

} // namespace tilepack
