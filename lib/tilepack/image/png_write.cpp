#include "tilepack/image/png_file.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <zlib.h>

namespace tilepack {
namespace {

// Texels of a block, which is compressed by itself: enough that what begins a block costs little.
constexpr std::size_t block_bytes = std::size_t{128} << 10;
// Blocks that wait until they are compressed together.
constexpr std::size_t blocks_at_once = 32;

using Bytes = std::vector<unsigned char>;

void append_number(Bytes& to, std::uint32_t value) {
  for (const int shift : {24, 16, 8, 0}) to.push_back(static_cast<unsigned char>(value >> shift));
}

/// A chunk with its length and checksum.
Bytes chunk(std::string_view type, const Bytes& content) {
  Bytes bytes;
  bytes.reserve(content.size() + 12);
  append_number(bytes, static_cast<std::uint32_t>(content.size()));
  bytes.insert(bytes.end(), type.begin(), type.end());
  bytes.insert(bytes.end(), content.begin(), content.end());
  append_number(bytes, static_cast<std::uint32_t>(::crc32_z(0, bytes.data() + 4, bytes.size() - 4)));
  return bytes;
}

unsigned char paeth(int left, int up, int corner) {
  const int to_left = std::abs(up - corner), to_up = std::abs(left - corner);
  const int to_corner = std::abs(left + up - 2 * corner);
  if (to_left <= to_up && to_left <= to_corner) return static_cast<unsigned char>(left);
  return static_cast<unsigned char>(to_up <= to_corner ? up : corner);
}

/// Filter `kind` of the PNG format on one row. `row` and `above` have `step` zeros before them, the bytes of
/// a texel, so that the first one has neighbours too.
void filter(int kind, const unsigned char* row, const unsigned char* above, std::size_t count,
            std::size_t step, unsigned char* to) {
  const auto apply = [&](auto guess) {
    for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<unsigned char>(row[i] - guess(i));
  };
  const unsigned char *left = row - step, *corner = above - step;
  if (kind == 0) apply([](std::size_t) { return 0; });
  if (kind == 1) apply([&](std::size_t i) { return left[i]; });
  if (kind == 2) apply([&](std::size_t i) { return above[i]; });
  if (kind == 3) apply([&](std::size_t i) { return (left[i] + above[i]) / 2; });
  if (kind == 4) apply([&](std::size_t i) { return paeth(left[i], above[i], corner[i]); });
}

/// Small differences either way compress well: the usual guess at the best filter.
std::uint64_t magnitude(const unsigned char* bytes, std::size_t count) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < count; ++i)
    sum += static_cast<unsigned>(std::min<int>(bytes[i], 256 - bytes[i]));
  return sum;
}

struct Block {
  Bytes deflated;
  uLong adler = 0;
  std::size_t filtered_bytes = 0;
};

Bytes deflated(const Bytes& filtered, bool last) {
  z_stream stream{};
  // A stream without header or checksum. With run lengths only, nothing refers to the block before.
  if (deflateInit2(&stream, 1, Z_DEFLATED, -MAX_WBITS, 8, Z_RLE) != Z_OK) throw std::bad_alloc();
  Bytes out(deflateBound(&stream, static_cast<uLong>(filtered.size())) + 16);
  stream.next_in = const_cast<Bytef*>(filtered.data()); // zlib's interface; it only reads
  stream.avail_in = static_cast<uInt>(filtered.size());
  stream.next_out = out.data();
  stream.avail_out = static_cast<uInt>(out.size());
  // Flushed to a whole byte, so that the next block can follow.
  const int result = deflate(&stream, last ? Z_FINISH : Z_SYNC_FLUSH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  if (result != (last ? Z_STREAM_END : Z_OK)) throw std::runtime_error("zlib gave up");
  return out;
}

class PngEncoder {
public:
  PngEncoder(ByteSink to, Size image_size, int channels, Depth depth, Encoding encoding)
      : sink(std::move(to)), size(image_size), wide(depth == Depth::u16),
        step(static_cast<std::size_t>(channels) * (wide ? 2 : 1)),
        row_bytes(static_cast<std::size_t>(size.width) * step),
        block_rows(std::max<std::size_t>(1, block_bytes / row_bytes)) {
    emit({0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'});
    Bytes header;
    append_number(header, static_cast<std::uint32_t>(size.width));
    append_number(header, static_cast<std::uint32_t>(size.height));
    constexpr std::array<unsigned char, 5> color_types = {0, 0, 4, 2, 6};
    const unsigned char bits = wide ? 16 : 8;
    header.insert(header.end(), {bits, color_types[static_cast<std::size_t>(channels)], 0, 0, 0});
    emit(chunk("IHDR", header));
    if (encoding == Encoding::srgb) {
      emit(chunk("sRGB", {0})); // perceptual intent
      Bytes gamma;              // 1 / 2.2, for readers that do not know sRGB
      append_number(gamma, 45455);
      emit(chunk("gAMA", gamma));
    }
    rows.assign(step + row_bytes, 0); // the row above the first counts as zeros
  }

  void write(std::span<const std::byte> texels) {
    for (std::size_t at = 0; at < texels.size(); at += row_bytes) {
      rows.resize(rows.size() + step, 0);
      const auto* from = reinterpret_cast<const unsigned char*>(texels.data()) + at;
      rows.insert(rows.end(), from, from + row_bytes);
      if (wide && std::endian::native == std::endian::little)
        for (std::size_t i = rows.size() - row_bytes; i < rows.size(); i += 2)
          std::swap(rows[i], rows[i + 1]);
      ++rows_taken;
      if (waiting_rows() == block_rows * blocks_at_once) compress();
    }
  }

  void finish() {
    compress();
    emit(chunk("IEND", {}));
  }

private:
  // Rows in `rows`, but for the one above them.
  std::size_t waiting_rows() const { return rows.size() / (step + row_bytes) - 1; }

  Block compressed(std::size_t first, std::size_t count, bool last) const {
    Bytes filtered((row_bytes + 1) * count), candidate(row_bytes);
    for (std::size_t y = 0; y < count; ++y) {
      const unsigned char* row = rows.data() + (first + y + 1) * (step + row_bytes) + step;
      unsigned char* best = filtered.data() + y * (row_bytes + 1);
      std::uint64_t least = ~std::uint64_t{0};
      for (const int kind : {0, 1, 2, 3, 4}) {
        filter(kind, row, row - row_bytes - step, row_bytes, step, candidate.data());
        const std::uint64_t sum = magnitude(candidate.data(), row_bytes);
        if (sum >= least) continue;
        least = sum;
        best[0] = static_cast<unsigned char>(kind);
        std::memcpy(best + 1, candidate.data(), row_bytes);
      }
    }
    return {deflated(filtered, last),
            ::adler32_z(::adler32_z(0, nullptr, 0), filtered.data(), filtered.size()), filtered.size()};
  }

  // What waits, as one IDAT chunk a block.
  void compress() {
    const std::size_t count = (waiting_rows() + block_rows - 1) / block_rows;
    if (count == 0) return;
    const bool all = rows_taken == static_cast<std::size_t>(size.height);
    std::vector<Block> blocks(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
      const std::size_t first = i * block_rows;
      blocks[i] = compressed(first, std::min(block_rows, waiting_rows() - first), all && i + 1 == count);
    });
    for (std::size_t i = 0; i < count; ++i) {
      Bytes content;
      if (!begun) content = {0x78, 0x01}; // zlib's header: a window of 32 KiB, compressed for speed
      begun = true;
      content.insert(content.end(), blocks[i].deflated.begin(), blocks[i].deflated.end());
      adler = ::adler32_combine(adler, blocks[i].adler, static_cast<z_off_t>(blocks[i].filtered_bytes));
      if (all && i + 1 == count) append_number(content, static_cast<std::uint32_t>(adler));
      emit(chunk("IDAT", content));
    }
    rows.erase(rows.begin(), rows.end() - static_cast<std::ptrdiff_t>(step + row_bytes));
  }

  void emit(const Bytes& bytes) {
    sink(offset, std::as_bytes(std::span(bytes)));
    offset += bytes.size();
  }

  ByteSink sink;
  Size size;
  bool wide;
  std::size_t step;       // bytes of a texel
  std::size_t row_bytes;  // without the zeros before
  std::size_t block_rows; // of a block
  Bytes rows;             // each after `step` zeros: the last one compressed, then those that wait
  std::size_t rows_taken = 0;
  std::uint64_t offset = 0;
  uLong adler = ::adler32_z(0, nullptr, 0);
  bool begun = false;
};

} // namespace

RasterWriter create_png(ByteSink sink, Size size, int channels, Depth depth, Encoding encoding) {
  auto encoder = std::make_shared<PngEncoder>(std::move(sink), size, channels, depth, encoding);
  return {[encoder](int, int, std::span<const std::byte> texels) { encoder->write(texels); },
          [encoder] { encoder->finish(); }};
}

} // namespace tilepack
