#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>
#include <zlib.h>

/// Files that OpenImageIO doesn't write, or not with these fields, put together by hand.
namespace tiny {

inline std::string big(std::uint32_t value, int bytes) {
  std::string text;
  for (int i = bytes - 1; i >= 0; --i) text += static_cast<char>(value >> (8 * i) & 0xFF);
  return text;
}

inline std::string little(std::uint32_t value, int bytes) {
  const std::string text = big(value, bytes);
  return {text.rbegin(), text.rend()};
}

inline std::string png_chunk(std::string_view type, const std::string& data) {
  const std::string body = std::string(type) + data;
  const auto crc = ::crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
  return big(static_cast<std::uint32_t>(data.size()), 4) + body + big(static_cast<std::uint32_t>(crc), 4);
}

inline std::string deflated(const std::string& data) {
  uLongf length = ::compressBound(static_cast<uLong>(data.size()));
  std::string out(length, '\0');
  ::compress(reinterpret_cast<Bytef*>(out.data()), &length, reinterpret_cast<const Bytef*>(data.data()),
             static_cast<uLong>(data.size()));
  out.resize(length);
  return out;
}

/// An 8-bit PNG of RGB or grey whose texels count up, with `chunks` before its data.
inline std::string png(std::uint32_t width, std::uint32_t height, int channels, const std::string& chunks) {
  std::string rows;
  for (std::uint32_t y = 0; y < height; ++y) {
    rows += '\0';
    for (std::uint32_t i = 0; i < width * static_cast<std::uint32_t>(channels); ++i)
      rows += static_cast<char>(y * 64 + i);
  }
  return std::string("\x89PNG\r\n\x1a\n") +
         png_chunk("IHDR", big(width, 4) + big(height, 4) + std::string("\x08") +
                               std::string(1, channels == 3 ? '\x02' : '\0') + std::string(3, '\0')) +
         chunks + png_chunk("IDAT", deflated(rows)) + png_chunk("IEND", "");
}

/// gAMA chunk of 1.0.
inline std::string gamma_1() {
  return png_chunk("gAMA", big(100000, 4));
}

/// An ICC profile (version 2, display, RGB) whose three curves are one exponent.
inline std::string profile(double exponent) {
  const auto gamma = static_cast<std::uint32_t>(exponent * 256 + 0.5);
  struct Tag {
    std::string name, data;
  };
  const auto xyz = [](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return std::string("XYZ ") + std::string(4, '\0') + big(x, 4) + big(y, 4) + big(z, 4);
  };
  const std::string curve =
      std::string("curv") + std::string(4, '\0') + big(1, 4) + big(gamma, 2) + std::string(2, '\0');
  const std::string name = "tiny";
  const Tag tags[] = {
      {"desc", std::string("desc") + std::string(4, '\0') + big(5, 4) + name + std::string(1 + 78 + 3, '\0')},
      {"cprt", std::string("text") + std::string(4, '\0') + name + std::string(4, '\0')},
      {"wtpt", xyz(0xF6D6, 0x10000, 0xD32D)},
      {"rXYZ", xyz(0x6FA2, 0x38F5, 0x390)},
      {"gXYZ", xyz(0x6299, 0xB785, 0x18DA)},
      {"bXYZ", xyz(0x24A0, 0xF84, 0xB6CF)},
      {"rTRC", curve},
      {"gTRC", curve},
      {"bTRC", curve},
  };
  std::string table = big(static_cast<std::uint32_t>(std::size(tags)), 4), data;
  const auto start = static_cast<std::uint32_t>(128 + 4 + 12 * std::size(tags));
  for (const Tag& tag : tags) {
    table += tag.name + big(start + static_cast<std::uint32_t>(data.size()), 4) +
             big(static_cast<std::uint32_t>(tag.data.size()), 4);
    data += tag.data + std::string((4 - tag.data.size() % 4) % 4, '\0');
  }
  std::string head = big(start + static_cast<std::uint32_t>(data.size()), 4) + std::string(4, '\0') +
                     big(0x02100000, 4) + "mntrRGB XYZ " + std::string(12, '\0') + "acsp" +
                     std::string(28, '\0') + big(0xF6D6, 4) + big(0x10000, 4) + big(0xD32D, 4);
  head.resize(128, '\0');
  return head + table + data;
}

inline std::string iccp(double exponent) {
  return png_chunk("iCCP", std::string("tiny") + std::string(2, '\0') + deflated(profile(exponent)));
}

/// An EXR of luminance and chroma, the latter at half the resolution. Its rows are not there.
inline std::string chroma_exr() {
  const auto attribute = [](const std::string& name, const std::string& type, const std::string& data) {
    return name + '\0' + type + '\0' + little(static_cast<std::uint32_t>(data.size()), 4) + data;
  };
  const auto channel = [](const std::string& name, std::uint32_t step) {
    return name + '\0' + little(1, 4) + little(0, 4) + little(step, 4) + little(step, 4);
  };
  const std::string window = little(0, 4) + little(0, 4) + little(7, 4) + little(7, 4);
  const std::string one("\0\0\x80\x3F", 4);
  return little(20000630, 4) + little(2, 4) +
         attribute("channels", "chlist", channel("BY", 2) + channel("RY", 2) + channel("Y", 1) + '\0') +
         attribute("compression", "compression", std::string(1, '\0')) +
         attribute("dataWindow", "box2i", window) + attribute("displayWindow", "box2i", window) +
         attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
         attribute("pixelAspectRatio", "float", one) +
         attribute("screenWindowCenter", "v2f", std::string(8, '\0')) +
         attribute("screenWindowWidth", "float", one) + std::string(1 + 8 * 8, '\0');
}

/// A grey TIFF in the least byte order, uncompressed, with `tags` beside the needed ones (all SHORT).
inline std::string tiff(std::uint32_t width, std::uint32_t height, std::uint32_t samples, std::uint32_t bits,
                        const std::string& texels,
                        std::vector<std::pair<std::uint32_t, std::uint32_t>> tags) {
  tags.insert(tags.end(),
              {{256, width}, {257, height}, {258, bits}, {259, 1}, {277, samples}, {278, height}});
  struct Entry {
    std::uint32_t tag, type, value;
  };
  std::vector<Entry> entries{{273, 4, 8}, {279, 4, static_cast<std::uint32_t>(texels.size())}};
  for (const auto& [tag, value] : tags) entries.push_back({tag, 3, value});
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.tag < b.tag; });
  const auto directory = static_cast<std::uint32_t>(8 + texels.size() + texels.size() % 2);
  std::string bits_of_samples; // behind the directory where they don't fit
  std::string list = little(static_cast<std::uint32_t>(entries.size()), 2);
  const auto after = static_cast<std::uint32_t>(directory + 2 + 12 * entries.size() + 4);
  for (const Entry& entry : entries) {
    const bool many = entry.tag == 258 && samples > 2;
    const std::uint32_t count = entry.tag == 258 ? samples : 1;
    std::string value = little(many ? after : entry.value, entry.type == 3 && !many ? 2 : 4);
    if (entry.tag == 258 && samples == 2) value += little(entry.value, 2);
    value.resize(4, '\0');
    list += little(entry.tag, 2) + little(entry.type, 2) + little(count, 4) + value;
    if (many)
      for (std::uint32_t s = 0; s < samples; ++s) bits_of_samples += little(entry.value, 2);
  }
  return std::string("II\x2A\0", 4) + little(directory, 4) + texels + std::string(texels.size() % 2, '\0') +
         list + little(0, 4) + bits_of_samples;
}

} // namespace tiny
