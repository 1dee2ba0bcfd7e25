#include "tilepack/mip/srgb_tables.h"

#include "tilepack/image/encoding.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

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
              static_cast<float>(2 * begin - 4 * middle + 2 * end), 0.0f};
    }
    return t;
  }();
  return table;
}

// linear_to_srgb(), to the bit, with the ends of the range, where pictures have much, at less cost.
float encoded_exactly(float linear) {
  constexpr double linear_segment_end = 0.0031308;
  const double v = static_cast<double>(linear);
  if (v >= 0 && v <= linear_segment_end) return static_cast<float>(v * 12.92);
  static const float white = static_cast<float>(linear_to_srgb(1.0));
  return linear == 1.0f ? white : static_cast<float>(linear_to_srgb(v));
}

} // namespace

bool halve_srgb_codes(std::span<const float> north, std::span<const float> south, int channels,
                      std::span<float> to, const SrgbKernel& kernel) {
  return kernel.halve(north.data(), south.data(), decode_table().data(), to.data(),
                      to.size() / static_cast<std::size_t>(channels),
                      static_cast<std::size_t>(channels)) == 0;
}

bool halve_srgb_codes(std::span<const float> north, std::span<const float> south, int channels,
                      std::span<float> to) {
  return halve_srgb_codes(north, south, channels, to, best_kernel());
}

void encode_srgb(std::span<const float> linear, int channels, std::span<float> to, const SrgbKernel& kernel) {
  const EncodeCurve curve{static_cast<int>(first_bits), encode_table().data()};
  const auto step = static_cast<std::size_t>(channels);
  const bool alpha = color_channels(channels) != channels;
  static_assert(SrgbKernel::block % 4 == 0); // whole texels, where there is alpha
  std::array<float, SrgbKernel::block> block;
  const bool in_place = linear.data() == to.data();
  for (std::size_t at = 0; at < linear.size(); at += block.size()) {
    const std::span<const float> values = linear.subspan(at, std::min(block.size(), linear.size() - at));
    float* const codes = in_place || values.size() < block.size() ? block.data() : to.data() + at;
    if (kernel.encode(values.data(), codes, values.size(), curve) != 0)
      for (std::size_t i = 0; i < values.size(); ++i)
        if (!(values[i] >= table_begin && values[i] < 1.0f) && !(alpha && i % step == step - 1))
          codes[i] = encoded_exactly(values[i]);
    if (alpha)
      for (std::size_t i = step - 1; i < values.size(); i += step) codes[i] = values[i];
    if (codes == block.data()) std::copy_n(codes, values.size(), to.data() + at);
  }
}

void encode_srgb(std::span<const float> linear, int channels, std::span<float> to) {
  encode_srgb(linear, channels, to, best_kernel());
}

} // namespace tilepack
