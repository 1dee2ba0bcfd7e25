#include "tilepack/mip/srgb_tables.h"

#include "tilepack/image/encoding.h"
#include "tilepack/mip/downsample.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
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

// The 8-bit codes of `count` values. Returns other than 0 if some value is none. Comparisons are of the bit
// patterns, as integers, since those of floats keep the loop from vector registers.
int find_codes(const float* values, int* codes, std::size_t count) {
  constexpr int one = std::bit_cast<int>(1.0f);
  constexpr int least_off = std::bit_cast<int>(1e-4f); // in codes; a code's own rounding is below 2e-5
  int strays = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const int bits = std::bit_cast<int>(values[i]);
    const int kept = std::min(std::max(bits, 0), one); // below 0 the sign bit is set
    const float scaled = std::bit_cast<float>(kept) * 255.0f;
    const int code = static_cast<int>(scaled + 0.5f);
    const int off = std::bit_cast<int>(scaled - static_cast<float>(code)) & 0x7fffffff;
    codes[i] = code;
    strays |= (kept ^ bits) | (off > least_off ? 1 : 0);
  }
  return strays;
}

// Decodes two rows and halves them. Returns other than 0 if some value is no code of 8 bits.
template <std::size_t channels>
int halve_codes(const float* north, const float* south, float* to, std::size_t width, int* codes) {
  const DecodeTable& linear = decode_table();
  const std::size_t length = 2 * width * channels;
  // Apart from the look-ups, so that it runs in vector registers.
  const int strays = find_codes(north, codes, length) | find_codes(south, codes + length, length);
  const int* n = codes;
  const int* s = codes + length;
  const auto value = [&](int code) { return linear[static_cast<std::size_t>(code)]; };
  for (std::size_t x = 0; x < width; ++x, n += 2 * channels, s += 2 * channels, to += channels)
    for (std::size_t c = 0; c < channels; ++c)
      to[c] = ((value(n[c]) + value(n[c + channels])) + (value(s[c]) + value(s[c + channels]))) * 0.25f;
  return strays;
}

// Over the piece with number i from `first_bits`, the code of t in [0, 1) is a + t (b + t c).
struct Parabola {
  float a, b, c;
};
constexpr int piece_bits = 17;                   // of the 23 of a float's mantissa: 64 pieces an octave
constexpr float table_begin = 0.00323486328125f; // the first end of a piece past the linear segment
constexpr std::uint32_t first_bits = std::bit_cast<std::uint32_t>(table_begin);
constexpr std::size_t pieces = (std::bit_cast<std::uint32_t>(1.0f) - first_bits) >> piece_bits;
static_assert((first_bits & ((1u << piece_bits) - 1)) == 0);
using EncodeTable = std::array<Parabola, pieces>;

const EncodeTable& encode_table() {
  static const EncodeTable table = [] {
    EncodeTable t{};
    const auto at = [](std::uint32_t bits) {
      return linear_to_srgb(static_cast<double>(std::bit_cast<float>(bits)));
    };
    for (std::size_t i = 0; i < pieces; ++i) { // through the ends and the middle of the piece
      const std::uint32_t bits = first_bits + static_cast<std::uint32_t>(i << piece_bits);
      const double begin = at(bits);
      const double middle = at(bits + (1u << (piece_bits - 1)));
      const double end = at(bits + (1u << piece_bits));
      t[i] = {static_cast<float>(begin), static_cast<float>(4 * middle - 3 * begin - end),
              static_cast<float>(2 * begin - 4 * middle + 2 * end)};
    }
    return t;
  }();
  return table;
}

// A block at a time, so that all but the look-ups runs in vector registers. Values off the table are rare in
// pictures, and done exactly afterwards.
constexpr std::size_t block = 256;

void encode_block(float* values, std::size_t count, const EncodeTable& table) {
  constexpr int first = static_cast<int>(first_bits);
  constexpr int last = std::bit_cast<int>(1.0f) - 1;
  constexpr int within = (1 << piece_bits) - 1;
  std::array<int, block> piece;
  std::array<float, block> t;
  std::array<float, block> code;
  int strays = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const int bits = std::bit_cast<int>(values[i]);
    const int kept = std::min(std::max(bits, first), last);
    piece[i] = (kept - first) >> piece_bits;
    t[i] = static_cast<float>((kept - first) & within) * (1.0f / (1 << piece_bits));
    strays |= kept ^ bits;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Parabola& p = table[static_cast<std::size_t>(piece[i])];
    code[i] = p.a + t[i] * (p.b + t[i] * p.c);
  }
  if (strays != 0)
    for (std::size_t i = 0; i < count; ++i)
      if (!(values[i] >= table_begin && values[i] < 1.0f))
        code[i] = static_cast<float>(linear_to_srgb(static_cast<double>(values[i])));
  std::copy_n(code.begin(), count, values);
}

} // namespace

Image halved_from_srgb(const Image& image) {
  Image result(image.width() / 2, image.height() / 2, image.channels());
  std::vector<int> codes(image.row(0).size() * 2);
  for (int y = 0; y < result.height(); ++y) {
    const float* north = image.row(2 * y).data();
    const float* south = image.row(2 * y + 1).data();
    float* to = result.row(y).data();
    const auto width = static_cast<std::size_t>(result.width());
    const int strays = image.channels() == 1 ? halve_codes<1>(north, south, to, width, codes.data())
                                             : halve_codes<3>(north, south, to, width, codes.data());
    if (strays != 0) return halved(to_linear(image, Encoding::srgb), Weighting::plain);
  }
  return result;
}

void encode_srgb(Image& image) {
  const EncodeTable& table = encode_table();
  const auto channels = static_cast<std::size_t>(image.channels());
  auto& values = image.data();
  std::vector<float> alpha;
  if (channels % 2 == 0)
    for (std::size_t i = channels - 1; i < values.size(); i += channels) alpha.push_back(values[i]);
  for (std::size_t i = 0; i < values.size(); i += block)
    encode_block(values.data() + i, std::min(block, values.size() - i), table);
  for (std::size_t i = 0; i < alpha.size(); ++i) values[(i + 1) * channels - 1] = alpha[i];
}

} // namespace tilepack
