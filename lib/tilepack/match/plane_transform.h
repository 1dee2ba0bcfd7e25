#pragma once

#include "tilepack/numeric/rect.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace tilepack {

/// Complex numbers row by row, real and imaginary parts apart. New ones hold anything.
struct ComplexPlane {
  ComplexPlane(int row_count, int column_count);

  std::size_t count() const { return static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns); }
  double* real_row(int y) const {
    return real.get() + static_cast<std::ptrdiff_t>(y) * columns; // of a const plane too, as with pointers
  }
  double* imaginary_row(int y) const { return imaginary.get() + static_cast<std::ptrdiff_t>(y) * columns; }

  int rows;
  int columns;
  std::unique_ptr<double[]> real, imaginary;
};

/// The least number from `size` on that is a product of 2, 3 and 5; size >= 1.
int transform_size(int size);

/// How lines of one length are transformed: in each step pieces of a line, whose parts are combined.
struct TransformStep {
  int radix;                    ///< parts of a piece: 2, 3, 4 or 5
  int length;                   ///< of a piece
  std::vector<double> twiddles; ///< for each number of a part: real and imaginary part of radix - 1 factors
};
using TransformSteps = std::vector<TransformStep>;

/// The discrete Fourier transform of planes of one size, whose sides are such products, by decimation in
/// frequency, and its inverse, by decimation in time: the values of a transform lie in the order that the first
/// leaves and the second wants, the same for all planes of a size. Products of two transforms, value by value,
/// are all that is made of them, so nothing is ever sorted.
///
/// Eight rows or columns are transformed side by side, one a lane of vectors.
class PlaneTransform {
public:
  PlaneTransform(int rows, int columns);

  /// Transforms `plane`, of which only the first rows and columns are `filled`: the rest counts as 0 and need not
  /// be set.
  void forward(ComplexPlane& plane, Size filled) const;

  /// Back again. Of the result only the real part is written, and of that the first rows and columns: those
  /// `wanted`.
  void inverse(ComplexPlane& plane, Size wanted) const;

private:
  TransformSteps of_row, of_column;
};

/// sum += image · the conjugate of patch, value by value; with `first`, sum = that.
void add_correlation(const ComplexPlane& image, const ComplexPlane& patch, ComplexPlane& sum, bool first);

} // namespace tilepack
