#pragma once

#include "tilepack/image/encoding.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tilepack {

/// The samples of a file as its decoder hands them over, in the machine's byte order.
enum class SampleType { u8, u16, u32, f16, f32, f64, other };

/// What a decoder says about an image before any texel is decoded. Nothing is checked yet.
struct RasterInfo {
  std::int64_t width = 0, height = 0, depth = 1;
  int channels = 0;
  bool deep = false;
  SampleType samples = SampleType::u8;
  std::string sample_name;          ///< for messages: "uint8"
  std::optional<Encoding> encoding; ///< if the file says
  std::vector<std::byte> profile;   ///< the ICC profile, empty if there is none; it goes before `encoding`
  std::vector<std::string> channel_names;
  bool names_are_free = false;           ///< channels are what their names say, in any order and number (EXR)
  int alpha_channel = -1;                ///< -1: none
  bool associated_alpha = false;         ///< color is multiplied by alpha already
  bool alpha_is_unsaid = false;          ///< the file has a channel more and doesn't say what it is
  std::vector<int> whole_numbers;        ///< channels of EXR that hold integers: numbers of things, as a rule
  bool white_is_zero = false;            ///< and the decoder did not invert it
  const char* doubtful_linear = nullptr; ///< the only word that says "linear" where that is unusual
  int orientation = 1;                   ///< see orientation.h
  std::vector<std::string> notes;        ///< sentences about what was passed over
  int tile_width = 0, tile_height = 0;   ///< 0 if stored in rows
  int strip_rows = 32;                   ///< rows that are decoded together
};

/// A file being decoded. `read` fills `texels` with whole rows from `top` on, in order; rows of tiles are not
/// split. Both opening and reading throw std::runtime_error with the decoder's reason.
struct RasterReader {
  RasterInfo info;
  std::function<void(int top, int rows, std::span<std::byte> texels)> read;
};

/// Where an encoder's bytes go.
using ByteSink = std::function<void(std::uint64_t offset, std::span<const std::byte> bytes)>;

/// A file being encoded: whole rows in order, then `finish`. Dropped before, it gives up quietly. Throws
/// std::runtime_error with the encoder's reason, and what the sink throws.
struct RasterWriter {
  std::function<void(int top, int rows, std::span<const std::byte> texels)> write;
  std::function<void()> finish;
};

/// Bytes of a sample; not of `other`.
constexpr std::size_t size_of(SampleType type) {
  switch (type) {
  case SampleType::u8:
    return 1;
  case SampleType::u16:
  case SampleType::f16:
    return 2;
  case SampleType::f64:
    return 8;
  default:
    return 4;
  }
}

} // namespace tilepack
