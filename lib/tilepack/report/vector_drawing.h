#pragma once

#include "tilepack/image/image.h"

#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// A place in a drawing, in pixels from its north-west corner: x east, y south. The centre of pixel (x, y) is
/// at (x + 0.5, y + 0.5).
struct DrawingPoint {
  double x = 0;
  double y = 0;
};

/// A flat color, 0..1 and sRGB-encoded, laid over what is there.
struct Paint {
  double red = 0;
  double green = 0;
  double blue = 0;
  double opacity = 1;
};

/// A filled polygon, even-odd.
struct DrawingShape {
  std::vector<DrawingPoint> points;
  Paint paint;
};

/// A whole number, centred, `height` pixels high.
struct DrawingNumber {
  DrawingPoint centre;
  double height = 0;
  int number = 0;
  Paint paint;
};

/// The characters that rasterised() has; every other is drawn as a box, so that it is seen to be missing.
constexpr std::string_view drawn_characters = "0123456789aceikmnpvxbdfghjloqrstuwyz-_";

/// A short name of drawn_characters, set as a number is.
struct DrawingWord {
  DrawingPoint centre;
  double height = 0;
  std::string word;
  Paint paint;
};

/// A picture with flat shapes and numbers over it, which can be had as pixels or as SVG.
struct VectorDrawing {
  Image background; ///< 3 channels, sRGB-encoded; its size is the drawing's
  std::vector<DrawingShape> shapes;
  std::vector<DrawingNumber> numbers; ///< above all shapes
  std::vector<DrawingWord> words{};   ///< above all shapes
};

/// All of it as pixels; the borders of shapes are smoothed by 4 x 4 samples a pixel. 3 channels,
/// sRGB-encoded.
Image rasterised(const VectorDrawing& drawing);

/// The same as an SVG document that stands for itself: the background as PNG within.
std::string svg(const VectorDrawing& drawing);

/// `image` as the PNG text that HTML and SVG take in place of an address.
std::string png_data_uri(const Image& image);

} // namespace tilepack
