#include "tilepack/mip/srgb_tables.h"

#include "tilepack/image/encoding.h"
#include "tilepack/mip/downsample.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tilepack {
namespace {

using DecodeTable = std::array<float, 256>;

const DecodeTable& decode_table() {
  static const DecodeTable table = [] {
    DecodeTable t{};
    for (std::size_t code = 0; code < t.size(); ++code)
      t[code] = static_cast<float>(srgb_to_linear(static_cast<double>(static_cast<float>(code) / 255.0f)));
    return t;
  }();
  return table;
}

// Asking the processor what it can do takes longer than encoding a small tile.
const SrgbKernel& best_kernel() {
  static const SrgbKernel best = srgb_kernels().front();
  return best;
}

constexpr float table_begin = 0.00323486328125f; // the first end of a piece past the linear segment
constexpr std::uint32_t first_bits = std::bit_cast<std::uint32_t>(table_begin);
constexpr std::size_t pieces = (std::bit_cast<std::uint32_t>(1.0f) - first_bits) >> EncodeCurve::piece_bits;
static_assert((first_bits & ((1u << EncodeCurve::piece_bits) - 1)) == 0);
using EncodeTable = std::array<Parabola, pieces>;

const EncodeTable& encode_table() {
  static const EncodeTable table = [] {
    EncodeTable t{};
    const auto at = [](std::uint32_t bits) {
      return linear_to_srgb(static_cast<double>(std::bit_cast<float>(bits)));
    };
    for (std::size_t i = 0; i < pieces; ++i) { // through the ends and the middle of the piece
      const std::uint32_t bits = first_bits + static_cast<std::uint32_t>(i << EncodeCurve::piece_bits);
      const double begin = at(bits);
      const double middle = at(bits + (1u << (EncodeCurve::piece_bits - 1)));
      const double end = at(bits + (1u << EncodeCurve::piece_bits));
      t[i] = {static_cast<float>(begin), static_cast<float>(4 * middle - 3 * begin - end),
              static_cast<float>(2 * begin - 4 * middle + 2 * end)};
    }
    return t;
  }();
  return table;
}

// Values off the table are rare in pictures, and done exactly afterwards.
void encode_block(float* values, std::size_t count, const SrgbKernel& kernel, const EncodeCurve& curve) {
  std::array<float, SrgbKernel::block> codes;
  if (kernel.encode(values, codes.data(), count, curve) != 0)
    for (std::size_t i = 0; i < count; ++i)
      if (!(values[i] >= table_begin && values[i] < 1.0f))
        codes[i] = static_cast<float>(linear_to_srgb(static_cast<double>(values[i])));
  std::copy_n(codes.begin(), count, values);
}

// Many texels a task: large against what a task costs, small against a tile.
constexpr std::size_t values_a_task = std::size_t{1} << 16;

} // namespace

Image halved_from_srgb(const Image& image, const SrgbKernel& kernel) {
  Image result(image.width() / 2, image.height() / 2, image.channels());
  const DecodeTable& linear = decode_table();
  const auto channels = static_cast<std::size_t>(image.channels());
  const std::size_t length = image.row(0).size();
  using Range = tbb::blocked_range<int>;
  const Range rows(0, result.height(), std::max<std::size_t>(1, values_a_task / length));
  std::atomic<bool> strayed = false;
  tbb::parallel_for(rows, [&](const Range& some) {
    for (int y = some.begin(); y < some.end() && !strayed; ++y)
      if (kernel.halve(image.row(2 * y).data(), image.row(2 * y + 1).data(), linear.data(),
                       result.row(y).data(), static_cast<std::size_t>(result.width()), channels) != 0)
        strayed = true;
  });
  if (strayed) return halved(to_linear(image, Encoding::srgb), Weighting::plain);
  return result;
}

Image halved_from_srgb(const Image& image) {
  return halved_from_srgb(image, best_kernel());
}

void encode_srgb(Image& image, const SrgbKernel& kernel) {
  const EncodeCurve curve{static_cast<int>(first_bits), encode_table().data()};
  const auto channels = static_cast<std::size_t>(image.channels());
  auto& values = image.data();
  std::vector<float> alpha;
  if (channels % 2 == 0)
    for (std::size_t i = channels - 1; i < values.size(); i += channels) alpha.push_back(values[i]);
  using Range = tbb::blocked_range<std::size_t>;
  tbb::parallel_for(Range(0, values.size(), values_a_task), [&](const Range& some) {
    for (std::size_t i = some.begin(); i < some.end(); i += SrgbKernel::block)
      encode_block(values.data() + i, std::min(SrgbKernel::block, some.end() - i), kernel, curve);
  });
  for (std::size_t i = 0; i < alpha.size(); ++i) values[(i + 1) * channels - 1] = alpha[i];
}

void encode_srgb(Image& image) {
  encode_srgb(image, best_kernel());
}

} // namespace tilepack
