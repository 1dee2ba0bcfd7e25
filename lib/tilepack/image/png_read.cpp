#include "tilepack/image/orientation.h"
#include "tilepack/image/png_file.h"

#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <memory>
#include <png.h>
#include <stdexcept>

namespace tilepack {
namespace {

/// libpng reports errors by a long jump. So every call of it goes through `call`, whose argument owns nothing
/// that a jump would leak, and the decoder holds what lives longer.
class PngDecoder {
public:
  explicit PngDecoder(const std::filesystem::path& path) : file(std::fopen(path.c_str(), "rbe")) {
    if (!file) throw std::runtime_error(std::strerror(errno));
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, fail, ignore);
    if (png) info = png_create_info_struct(png);
    if (!info) {
      close();
      throw std::bad_alloc();
    }
    try {
      call([this] {
        // Sizes are judged by who asked, with a message; texts and times are nobody's business here.
        png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
        static constexpr char unread[] = "tEXt\0zTXt\0iTXt\0tIME\0hIST\0sPLT";
        png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, reinterpret_cast<png_const_bytep>(unread),
                                    static_cast<int>(sizeof unread / 5));
        // Younger than libpng 1.6.
        static constexpr char kept[] = "cICP";
        png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_ALWAYS, reinterpret_cast<png_const_bytep>(kept), 1);
        png_init_io(png, file);
        png_read_info(png, info);
      });
    } catch (...) {
      close();
      throw;
    }
  }
  ~PngDecoder() { close(); }
  PngDecoder(const PngDecoder&) = delete;
  PngDecoder& operator=(const PngDecoder&) = delete;

  RasterInfo described() const {
    RasterInfo result;
    result.width = png_get_image_width(png, info);
    result.height = png_get_image_height(png, info);
    const bool wide = png_get_bit_depth(png, info) == 16;
    result.samples = wide ? SampleType::u16 : SampleType::u8;
    result.sample_name = wide ? "uint16" : "uint8";
    const int type = png_get_color_type(png, info);
    const bool color = (type & PNG_COLOR_MASK_COLOR) != 0;
    const bool alpha = (type & PNG_COLOR_MASK_ALPHA) != 0 || png_get_valid(png, info, PNG_INFO_tRNS) != 0;
    result.channels = (color ? 3 : 1) + (alpha ? 1 : 0);
    result.channel_names = color ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"Y"};
    if (alpha) result.channel_names.emplace_back("A");
    if (alpha) result.alpha_channel = result.channels - 1;
    describe_encoding(result);
    png_bytep exif = nullptr;
    png_uint_32 exif_bytes = 0;
    if (png_get_eXIf_1(png, info, &exif_bytes, &exif) != 0)
      result.orientation = orientation_of_exif(std::as_bytes(std::span(exif, exif_bytes)));
    return result;
  }

  void read(int rows, std::span<std::byte> texels) {
    if (!started) start();
    const std::size_t bytes = texels.size() / static_cast<std::size_t>(rows);
    auto* to = reinterpret_cast<png_bytep>(texels.data());
    if (!whole.empty()) {
      std::memcpy(to, whole.data() + next_row * bytes, texels.size());
    } else {
      if (bytes != row_bytes) throw std::logic_error("rows of another length than the image's");
      call([this, to, rows] {
        for (int y = 0; y < rows; ++y)
          png_read_row(png, to + static_cast<std::size_t>(y) * row_bytes, nullptr);
      });
    }
    next_row += static_cast<std::size_t>(rows);
  }

private:
  // cICP goes before iCCP, sRGB and gAMA, in this order [PNG3, 11.3.2].
  void describe_encoding(RasterInfo& result) const {
    result.encoding = Encoding::srgb;
    png_unknown_chunkp chunks = nullptr;
    const int count = png_get_unknown_chunks(png, info, &chunks);
    for (int i = 0; i < count; ++i) {
      if (std::memcmp(chunks[i].name, "cICP", 4) != 0 || chunks[i].size != 4) continue;
      const int curve = chunks[i].data[1]; // of ITU-T H.273
      if (curve == 8) result.encoding = Encoding::linear;
      if (curve == 16 || curve == 18)
        result.notes.emplace_back("has the transfer curve of high dynamic range (cICP) and is taken as sRGB; "
                                  "convert it to a linear EXR");
      return;
    }
    png_charp name = nullptr;
    int compression = 0;
    png_bytep profile = nullptr;
    png_uint_32 bytes = 0;
    if (png_get_iCCP(png, info, &name, &compression, &profile, &bytes) != 0) {
      const auto data = std::as_bytes(std::span(profile, bytes));
      result.profile.assign(data.begin(), data.end());
      return;
    }
    int intent = 0;
    double gamma = 0;
    if (png_get_sRGB(png, info, &intent) != 0 || png_get_gAMA(png, info, &gamma) == 0) return;
    // To a hundredth: writers round differently.
    if (!(gamma > 0 && std::floor(100.0 / gamma + 0.5) == 100.0)) return;
    result.encoding = Encoding::linear;
    // Color of 8 bits is hardly ever linear; many programs have written this chunk without meaning it.
    if (result.channels >= 3 && result.samples == SampleType::u8)
      result.doubtful_linear = "its gAMA chunk of 1.0 alone";
  }

  void start() {
    call([this] {
      png_set_expand(png); // palettes and fewer than 8 bits to bytes, a transparent color to alpha
      if constexpr (std::endian::native == std::endian::little) png_set_swap(png);
      png_set_interlace_handling(png);
      png_read_update_info(png, info);
      row_bytes = png_get_rowbytes(png, info);
    });
    started = true;
    if (png_get_interlace_type(png, info) == PNG_INTERLACE_NONE) return;
    const std::size_t height = png_get_image_height(png, info);
    whole.resize(row_bytes * height);
    std::vector<png_bytep> rows(height);
    for (std::size_t y = 0; y < height; ++y) rows[y] = whole.data() + y * row_bytes;
    call([this, at = rows.data()] { png_read_image(png, at); });
  }

  template <typename F>
  void call(F f) {
    if (setjmp(png_jmpbuf(png)) != 0) throw std::runtime_error(reason.data());
    f();
  }

  [[noreturn]] static void fail(png_structp at, png_const_charp message) {
    auto* decoder = static_cast<PngDecoder*>(png_get_error_ptr(at));
    std::snprintf(decoder->reason.data(), decoder->reason.size(), "%s", message);
    png_longjmp(at, 1);
  }
  static void ignore(png_structp, png_const_charp) {}

  void close() {
    if (png) png_destroy_read_struct(&png, &info, nullptr);
    if (file) std::fclose(file);
    file = nullptr;
  }

  std::FILE* file = nullptr;
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::array<char, 128> reason{};
  bool started = false;
  std::size_t row_bytes = 0;
  std::size_t next_row = 0;
  std::vector<unsigned char> whole; // of an interlaced image
};

} // namespace

RasterReader open_png(const std::filesystem::path& file) {
  auto decoder = std::make_shared<PngDecoder>(file);
  RasterInfo info = decoder->described();
  return {std::move(info),
          [decoder](int, int rows, std::span<std::byte> texels) { decoder->read(rows, texels); }};
}

} // namespace tilepack
