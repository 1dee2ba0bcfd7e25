#include "tilepack/image/file_bytes.h"
#include "tilepack/image/image_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>
#include <zlib.h>

namespace tilepack {
namespace {

// ---- PNG -------------------------------------------------------------------------------------------------

constexpr std::uint64_t png_signature_bytes = 8;

// Some decoders take memory for all an image's header promises before they look at the rest, so a promise
// beyond what the format can deliver is refused first. Deflate makes at most 1032 bytes of one.
void check_png_promise(const FileBytes& file) {
  std::array<unsigned char, 10> header{}; // width, height, bits per sample, color type
  file.read(png_signature_bytes + 8, header);
  constexpr std::array<std::uint64_t, 7> samples = {1, 0, 3, 1, 2, 0, 4};
  const std::uint64_t width = big_endian(std::span(header).first(4));
  const std::uint64_t height = big_endian(std::span(header).subspan(4, 4));
  const std::uint64_t row = (width * header[8] * samples[std::min<std::size_t>(header[9], 6)] + 7) / 8 + 1;
  if (height > file.size() * 1032 / row + 1) file.truncated();
}

void check_png(const FileBytes& file) {
  std::uint64_t offset = png_signature_bytes;
  std::vector<unsigned char> block(1 << 16);
  for (bool first = true;; first = false) {
    std::array<unsigned char, 8> head{};
    file.read(offset, head);
    const std::uint64_t length = big_endian(std::span(head).first(4));
    const std::string type(head.begin() + 4, head.end());
    if (first && type != "IHDR") file.damaged("it does not begin with a header chunk");
    if (!file.holds(offset + 8, length + 4)) file.truncated();
    if (first) check_png_promise(file);

    uLong crc = ::crc32_z(0, head.data() + 4, 4);
    for (std::uint64_t done = 0; done < length;) {
      const auto part = std::span(block).first(
          static_cast<std::size_t>(std::min<std::uint64_t>(length - done, block.size())));
      file.read(offset + 8 + done, part);
      crc = ::crc32_z(crc, part.data(), part.size());
      done += part.size();
    }
    std::array<unsigned char, 4> stored{};
    file.read(offset + 8 + length, stored);
    if (big_endian(stored) != crc)
      file.damaged(fmt::format("the chunk at byte {} fails its checksum", offset));
    if (type == "IEND") return;
    offset += length + 12;
  }
}

// ---- JPEG ------------------------------------------------------------------------------------------------

/// Walks a file byte by byte through a buffer.
class ByteStream {
public:
  ByteStream(const FileBytes& source, std::uint64_t from) : file(source), next_block(from) {}

  unsigned char next() {
    if (position == block.size()) refill();
    return block[position++];
  }
  void skip(std::uint64_t count) {
    const std::uint64_t buffered = block.size() - position;
    if (count <= buffered) {
      position += static_cast<std::size_t>(count);
    } else {
      next_block += count - buffered;
      position = block.size();
    }
  }

private:
  void refill() {
    if (!file.holds(next_block, 1)) file.truncated();
    block.resize(static_cast<std::size_t>(std::min<std::uint64_t>(1 << 16, file.size() - next_block)));
    file.read(next_block, block);
    next_block += block.size();
    position = 0;
  }

  const FileBytes& file;
  std::uint64_t next_block;
  std::vector<unsigned char> block;
  std::size_t position = 0;
};

bool is_frame_header(unsigned char marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

void check_jpeg(const FileBytes& file) {
  ByteStream bytes(file, 2); // past the start marker
  bool in_scan = false;
  for (;;) {
    unsigned char byte = bytes.next();
    if (byte != 0xFF) {
      if (!in_scan) file.damaged("a segment does not begin with a marker");
      continue;
    }
    while (byte == 0xFF) byte = bytes.next();
    // Within a scan, FF 00 stands for the byte FF, and D0 to D7 are restart markers.
    if (in_scan && (byte == 0x00 || (byte >= 0xD0 && byte <= 0xD7))) continue;
    if (byte == 0xD9) return; // end of image
    in_scan = byte == 0xDA;
    const std::uint64_t high = bytes.next();
    const std::uint64_t length = high << 8 | bytes.next();
    if (length < 2) file.damaged("a segment is shorter than its length field");
    std::uint64_t left = length - 2;
    if (is_frame_header(byte) && left >= 5) {
      std::array<unsigned char, 5> frame{}; // bits, height, width
      for (unsigned char& b : frame) b = bytes.next();
      left -= frame.size();
      const std::uint64_t texels =
          big_endian(std::span(frame).subspan(1, 2)) * big_endian(std::span(frame).subspan(3));
      // The mean of a block of 8 x 8 texels takes a bit at least; see check_png_promise.
      if (texels / 512 > file.size()) file.truncated();
    }
    bytes.skip(left);
  }
}

// ---- TIFF ------------------------------------------------------------------------------------------------

class TiffWalk {
public:
  explicit TiffWalk(const FileBytes& source) : file(source) {
    std::array<unsigned char, 4> head{};
    file.read(0, head);
    little = head[0] == 'I';
    big = (little ? head[2] : head[3]) == 43;
  }

  /// Only the first directory counts: the others describe images that are not read.
  void check() const { check_directory(big ? number(8, 8) : number(4, 4)); }

private:
  struct Entry {
    std::uint64_t type = 0, count = 0, at = 0; // `at`: offset of the first value in the file
  };

  std::uint64_t number(std::uint64_t offset, std::size_t bytes) const {
    std::array<unsigned char, 8> raw{};
    const auto part = std::span(raw).first(bytes);
    file.read(offset, part);
    if (little) std::reverse(part.begin(), part.end());
    return big_endian(part);
  }

  static std::size_t size_of(std::uint64_t type) {
    constexpr std::array<unsigned char, 19> sizes = {0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 4, 0, 0, 8, 8, 8};
    return type < sizes.size() ? sizes[static_cast<std::size_t>(type)] : 0;
  }

  void check_directory(std::uint64_t directory) const {
    const std::size_t word = big ? 8 : 4, count_size = big ? 8 : 2, entry_size = big ? 20 : 12;
    const std::uint64_t entries = number(directory, count_size);
    if (entries > file.size() / entry_size) file.truncated();
    Entry offsets, counts;
    for (std::uint64_t i = 0; i < entries; ++i) {
      const std::uint64_t at = directory + count_size + i * entry_size;
      const std::uint64_t tag = number(at, 2);
      Entry entry{number(at + 2, 2), number(at + 4, word), at + 4 + word};
      const std::size_t size = size_of(entry.type);
      if (size == 0) continue; // an unknown type is to be skipped, says the format
      if (entry.count > file.size()) file.truncated();
      if (entry.count * size > word) entry.at = number(entry.at, word);
      if (!file.holds(entry.at, entry.count * size)) file.truncated();
      if (tag == 273 || tag == 324) offsets = entry; // strips, tiles
      if (tag == 279 || tag == 325) counts = entry;
    }
    for (std::uint64_t i = 0; i < std::min(offsets.count, counts.count); ++i)
      if (!file.holds(value(offsets, i), value(counts, i))) file.truncated();
  }

  std::uint64_t value(const Entry& entry, std::uint64_t i) const {
    const std::size_t size = size_of(entry.type);
    return number(entry.at + i * size, size);
  }

  const FileBytes& file;
  bool little = true, big = false;
};

// ---- BMP, WebP, JPEG 2000 --------------------------------------------------------------------------------

// All but compressed BMP files (field 30) are rows of known length.
void check_bmp(const FileBytes& file) {
  std::array<unsigned char, 34> head{};
  file.read(0, head);
  const auto field = [&](std::size_t at, std::size_t bytes) {
    return little_endian(std::span(head).subspan(at, bytes));
  };
  if (field(14, 4) < 40 || (field(30, 4) != 0 && field(30, 4) != 3)) return;
  const auto height = static_cast<std::int32_t>(field(22, 4)); // negative: from the top
  const std::uint64_t rows = static_cast<std::uint64_t>(height < 0 ? -std::int64_t{height} : height);
  const std::uint64_t row = (field(18, 4) * field(28, 2) + 31) / 32 * 4;
  if (rows > 0 && row > file.size() / rows) file.truncated();
  if (!file.holds(field(10, 4), rows * row)) file.truncated();
}

void check_webp(const FileBytes& file) {
  std::array<unsigned char, 8> head{};
  file.read(0, head);
  if (!file.holds(8, little_endian(std::span(head).subspan(4)))) file.truncated();
}

// A code stream ends with its end marker, or its decoder has made the rest up.
void check_jpeg2000(const FileBytes& file) {
  std::uint64_t end = file.size();
  std::array<unsigned char, 16> box{};
  file.read(0, std::span(box).first(2));
  if (box[0] != 0xFF) { // boxes, one of which holds the code stream
    for (std::uint64_t at = 0;;) {
      file.read(at, std::span(box).first(8));
      std::uint64_t length = big_endian(std::span(box).first(4));
      const bool last = length == 0;
      if (length == 1) {
        file.read(at, box);
        length = big_endian(std::span(box).subspan(8));
      }
      if (!last && length < 8) file.damaged("a box is shorter than its header");
      if (!last && !file.holds(at, length)) file.truncated();
      const bool found = big_endian(std::span(box).subspan(4, 4)) == 0x6A703263; // "jp2c"
      end = last ? file.size() : at + length;
      if (found || last) break;
      at = end;
    }
  }
  std::array<unsigned char, 2> marker{};
  file.read(end - marker.size(), marker);
  if (marker[0] != 0xFF || marker[1] != 0xD9) file.truncated();
}

} // namespace

void check_complete(const std::filesystem::path& path, ImageFormat format) {
  const FileBytes file(path);
  switch (format) {
  case ImageFormat::png:
    return check_png(file);
  case ImageFormat::jpeg:
    return check_jpeg(file);
  case ImageFormat::tiff:
    return TiffWalk(file).check();
  case ImageFormat::bmp:
    return check_bmp(file);
  case ImageFormat::webp:
    return check_webp(file);
  case ImageFormat::jpeg2000:
    return check_jpeg2000(file);
  case ImageFormat::exr:
  case ImageFormat::tga:
  case ImageFormat::hdr:
  case ImageFormat::dds:
  case ImageFormat::psd:
    break;
  }
}

} // namespace tilepack
