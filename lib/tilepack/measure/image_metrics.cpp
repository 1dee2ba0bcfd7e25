#include "tilepack/measure/image_metrics.h"

#include "tilepack/error/error.h"
#include "tilepack/image/peak_to_noise.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace tilepack {
namespace {

void require_same_shape(const Image& a, const Image& b) {
  if (a.size() == b.size() && a.channels() == b.channels() && !a.empty()) return;
  throw Error(
      ErrorKind::invalid_content, "compare",
      fmt::format("{} x {} texels of {} channels and {} x {} of {}; only images of one size and number of "
                  "channels can be compared, crop or scale one of them",
                  a.width(), a.height(), a.channels(), b.width(), b.height(), b.channels()));
}

bool same(float a, float b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

bool comparable(float a, float b) {
  return (std::isfinite(a) && std::isfinite(b)) || same(a, b);
}

// Equal infinities would subtract to NaN.
double distance(float a, float b) {
  return same(a, b) ? 0.0 : std::abs(static_cast<double>(a) - static_cast<double>(b));
}

double largest_magnitude(const Image& image) {
  double largest = 0;
  for (const float v : image.data())
    if (std::isfinite(v)) largest = std::max(largest, std::abs(static_cast<double>(v)));
  return largest;
}

struct RowSums {
  double absolute = 0;
  double squared = 0;
  double largest = -1;
  int x = 0;
  int channel = 0;
  std::int64_t differing = 0;
  std::int64_t not_comparable = 0;
  std::int64_t values = 0;
};

RowSums sums_of_row(const Image& a, const Image& b, int y) {
  RowSums sums;
  for (int x = 0; x < a.width(); ++x) {
    const auto p = a.texel(x, y);
    const auto q = b.texel(x, y);
    bool differs = false;
    bool usable = true;
    for (std::size_t c = 0; c < p.size(); ++c) {
      differs = differs || !same(p[c], q[c]);
      usable = usable && comparable(p[c], q[c]);
    }
    sums.differing += differs;
    sums.not_comparable += !usable;
    if (!usable) continue;
    for (std::size_t c = 0; c < p.size(); ++c) {
      const double d = distance(p[c], q[c]);
      sums.absolute += d;
      sums.squared += d * d;
      ++sums.values;
      if (d > sums.largest) {
        sums.largest = d;
        sums.x = x;
        sums.channel = static_cast<int>(c);
      }
    }
  }
  return sums;
}

// exp(-r²/2σ²), σ = 1.5, normalised.
std::vector<double> gaussian(int side) {
  std::vector<double> weights(static_cast<std::size_t>(side));
  double sum = 0;
  for (int i = 0; i < side; ++i) {
    const double r = i - side / 2;
    weights[i] = std::exp(-r * r / (2 * 1.5 * 1.5));
    sum += weights[i];
  }
  for (double& w : weights) w /= sum;
  return weights;
}

int window_side(int length) {
  const int side = std::min(11, length);
  return side % 2 == 0 ? side - 1 : side;
}

// Values that are NaN or infinite would spoil every window they fall into; both images then count as 0 there,
// since not_comparable tells of them.
struct Moments {
  double a = 0, b = 0, aa = 0, bb = 0, ab = 0;
  void add(const Moments& m, double weight) {
    a += weight * m.a;
    b += weight * m.b;
    aa += weight * m.aa;
    bb += weight * m.bb;
    ab += weight * m.ab;
  }
};

Moments moments_of(float va, float vb) {
  const bool usable = std::isfinite(va) && std::isfinite(vb);
  const double a = usable ? static_cast<double>(va) : 0.0;
  const double b = usable ? static_cast<double>(vb) : 0.0;
  return {a, b, a * a, b * b, a * b};
}

double similarity(const Moments& m, double peak) {
  const double c1 = 0.01 * peak * 0.01 * peak;
  const double c2 = 0.03 * peak * 0.03 * peak;
  const double variance_a = m.aa - m.a * m.a;
  const double variance_b = m.bb - m.b * m.b;
  const double covariance = m.ab - m.a * m.b;
  return ((2 * m.a * m.b + c1) * (2 * covariance + c2)) /
         ((m.a * m.a + m.b * m.b + c1) * (variance_a + variance_b + c2));
}

} // namespace

double structural_similarity(const Image& a, const Image& b, double peak) {
  require_same_shape(a, b);
  const std::vector<double> across = gaussian(window_side(a.width()));
  const std::vector<double> down = gaussian(window_side(a.height()));
  const int wide = a.width() - static_cast<int>(across.size()) + 1;
  const int high = a.height() - static_cast<int>(down.size()) + 1;
  const auto channels = static_cast<std::size_t>(a.channels());
  // The window is separable: down the columns first, then along the row. Rows are summed on their own, so
  // that the result does not depend on threads.
  std::vector<double> row_sums(static_cast<std::size_t>(high), 0.0);
  tbb::parallel_for(0, high, [&](int y) {
    std::vector<Moments> columns(a.row(0).size());
    for (int k = 0; k < static_cast<int>(down.size()); ++k) {
      const auto p = a.row(y + k);
      const auto q = b.row(y + k);
      for (std::size_t i = 0; i < p.size(); ++i) columns[i].add(moments_of(p[i], q[i]), down[k]);
    }
    double sum = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(wide) * channels; ++i) {
      Moments window;
      for (std::size_t k = 0; k < across.size(); ++k) window.add(columns[i + k * channels], across[k]);
      sum += similarity(window, peak);
    }
    row_sums[y] = sum;
  });
  double sum = 0;
  for (const double s : row_sums) sum += s;
  return sum / (static_cast<double>(wide) * high * a.channels());
}

ImageDifference difference(const Image& a, const Image& b, FullRange range, double scale) {
  require_same_shape(a, b);
  ImageDifference result;
  if (range == FullRange::unbounded) {
    const double largest = std::max(largest_magnitude(a), largest_magnitude(b));
    result.peak = largest > 0 ? largest : 1;
  }
  std::vector<RowSums> rows(static_cast<std::size_t>(a.height()));
  tbb::parallel_for(0, a.height(), [&](int y) { rows[y] = sums_of_row(a, b, y); });
  RowSums all;
  for (int y = 0; y < a.height(); ++y) {
    const RowSums& row = rows[y];
    all.absolute += row.absolute;
    all.squared += row.squared;
    all.values += row.values;
    all.differing += row.differing;
    all.not_comparable += row.not_comparable;
    if (row.largest > all.largest) {
      all.largest = row.largest;
      result.largest_x = row.x;
      result.largest_y = y;
      result.largest_channel = row.channel;
    }
  }
  result.equal = all.differing == 0;
  result.differing = all.differing;
  result.not_comparable = all.not_comparable;
  result.largest = std::max(0.0, all.largest) * scale;
  const double values = static_cast<double>(std::max<std::int64_t>(1, all.values));
  result.mean = all.absolute / values * scale;
  result.rms = std::sqrt(all.squared / values) * scale;
  result.psnr = peak_to_noise(result.peak * scale, result.rms);
  result.ssim = structural_similarity(a, b, result.peak);
  return result;
}

Image difference_picture(const Image& a, const Image& b, double gain) {
  require_same_shape(a, b);
  Image picture(a.width(), a.height(), 3);
  const bool grey = a.channels() < 3;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x) {
      const auto p = a.texel(x, y);
      const auto q = b.texel(x, y);
      const auto to = picture.texel(x, y);
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t from = grey ? 0 : c;
        to[c] = static_cast<float>(std::min(1.0, distance(p[from], q[from]) * gain));
      }
      for (std::size_t c = 0; c < p.size(); ++c)
        if (!comparable(p[c], q[c])) std::copy_n(std::array{1.0f, 0.0f, 1.0f}.begin(), 3, to.begin());
    }
  return picture;
}

} // namespace tilepack
