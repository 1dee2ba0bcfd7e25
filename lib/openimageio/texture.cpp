#include "texture_functions.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/texture.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>

namespace tilepack {
namespace {

static_assert(texture_batch == OIIO::Tex::BatchWidth);

OIIO::TypeDesc type_of(Depth depth) {
  switch (depth) {
  case Depth::u8:
    return OIIO::TypeDesc::UINT8;
  case Depth::u16:
    return OIIO::TypeDesc::UINT16;
  case Depth::f16:
    return OIIO::TypeDesc::HALF;
  case Depth::f32:
    break;
  }
  return OIIO::TypeDesc::FLOAT;
}

struct SystemDeleter {
  void operator()(OIIO::TextureSystem* system) const { OIIO::TextureSystem::destroy(system); }
};

class StoredTexture {
public:
  StoredTexture(const std::filesystem::path& file, int channels, Size size)
      : system(OIIO::TextureSystem::create(false)), channel_count(static_cast<std::size_t>(channels)),
        side(size) {
    system->attribute("max_memory_MB", 4096.0f);
    handle = system->get_texture_handle(OIIO::ustring(file.string()));
    thread = system->get_perthread_info();
    options.interpmode = OIIO::Tex::InterpMode::Bilinear;
    options.swrap = options.twrap = OIIO::Tex::Wrap::Periodic;
    options.anisotropic = 1;
    // Not initialised by their constructor.
    std::fill_n(options.sblur, texture_batch, 0.0f);
    std::fill_n(options.tblur, texture_batch, 0.0f);
    std::fill_n(options.rblur, texture_batch, 0.0f);
    std::fill_n(options.swidth, texture_batch, 1.0f);
    std::fill_n(options.twidth, texture_batch, 1.0f);
    std::fill_n(options.rwidth, texture_batch, 1.0f);
  }

  void look_up(const LookupFrame& frame, std::span<float> out, bool mips) {
    options.mipmode = mips ? OIIO::Tex::MipMode::Trilinear : OIIO::Tex::MipMode::NoMIP;
    alignas(64) float ds_dx[texture_batch], dt_dx[texture_batch], ds_dy[texture_batch], dt_dy[texture_batch];
    const auto step = static_cast<float>(frame.texels_a_pixel);
    const auto cosine = static_cast<float>(std::cos(frame.angle));
    const auto sine = static_cast<float>(std::sin(frame.angle));
    for (std::size_t k = 0; k < texture_batch; ++k) {
      ds_dx[k] = step * cosine / static_cast<float>(side.width);
      dt_dx[k] = step * sine / static_cast<float>(side.height);
      ds_dy[k] = -step * sine / static_cast<float>(side.width);
      dt_dy[k] = step * cosine / static_cast<float>(side.height);
    }
    for (std::size_t at = 0; at + texture_batch <= frame.x.size(); at += texture_batch)
      system->texture(handle, thread, options, OIIO::Tex::RunMaskOn, frame.x.data() + at, frame.y.data() + at,
                      ds_dx, dt_dx, ds_dy, dt_dy, static_cast<int>(channel_count),
                      out.data() + at % LookupFrame::bucket * channel_count);
  }

private:
  std::unique_ptr<OIIO::TextureSystem, SystemDeleter> system;
  OIIO::TextureSystem::TextureHandle* handle = nullptr;
  OIIO::TextureSystem::Perthread* thread = nullptr;
  OIIO::TextureOptBatch options;
  std::size_t channel_count;
  Size side;
};

} // namespace

TextureMaker texture_maker(Size size, int channels, Depth depth,
                           const std::function<Image(int top, int rows)>& band) {
  auto buffer =
      std::make_shared<OIIO::ImageBuf>(OIIO::ImageSpec(size.width, size.height, channels, type_of(depth)));
  // In bands, so that floats of the whole are never in memory.
  constexpr int band_rows = 256;
  for (int y = 0; y < size.height; y += band_rows) {
    const int rows = std::min(band_rows, size.height - y);
    buffer->set_pixels(OIIO::ROI(0, size.width, y, y + rows, 0, 1, 0, channels), OIIO::TypeDesc::FLOAT,
                       band(y, rows).data().data());
  }
  return [buffer](const std::filesystem::path& file) {
    OIIO::ImageSpec config;
    config.tile_width = 64;
    config.tile_height = 64;
    config.attribute("maketx:filtername", "box");
    config.attribute("wrapmodes", "periodic,periodic");
    if (!OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture, *buffer, file.string(), config))
      throw std::runtime_error(OIIO::geterror());
  };
}

double maketx(const std::filesystem::path& image, const std::filesystem::path& texture) {
  OIIO::ImageSpec config;
  config.attribute("maketx:runstats", 1);
  std::ostringstream statistics;
  if (!OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture, image.string(), texture.string(),
                                        config, &statistics))
    throw std::runtime_error(OIIO::geterror());
  const std::string text = statistics.str();
  const std::string label = "mip computation:";
  const std::size_t at = text.find(label);
  return at == std::string::npos ? 0 : std::strtod(text.c_str() + at + label.size(), nullptr);
}

TextureLookup open_texture(const std::filesystem::path& file, int channels, Size side) {
  auto texture = std::make_shared<StoredTexture>(file, channels, side);
  return [texture](const LookupFrame& frame, std::span<float> out, bool mips) {
    texture->look_up(frame, out, mips);
  };
}

} // namespace tilepack
