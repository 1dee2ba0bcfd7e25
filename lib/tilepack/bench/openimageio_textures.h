#pragma once

#include "tilepack/bench/lookup_bench.h"
#include "tilepack/image/encoding.h"

#include <filesystem>
#include <functional>
#include <span>

namespace tilepack {

/// Writes an image it holds as a texture file with mips. Throws std::runtime_error with OpenImageIO's reason.
using TextureMaker = std::function<void(const std::filesystem::path& file)>;

/// Looks up a whole frame, s and t over the whole texture, bilinear in level 0 or trilinear. `out` holds a
/// bucket and is filled over and over: texture_batch results of a channel, the next channel, the next batch.
using TextureLookup = std::function<void(const LookupFrame& frame, std::span<float> out, bool mips)>;

/// Lookups that OpenImageIO's texture system takes at once.
constexpr std::size_t texture_batch = 16;

/// What the module of openimageio_module.h can do with textures.
struct TextureSystem {
  static constexpr const char* symbol = "tilepack_texture_system";

  /// Takes an image in by bands of whole rows from the top, values as stored. The texture made of it repeats
  /// and has tiles of 64 x 64 and box-filtered mips, as maketx makes them.
  TextureMaker (*maker)(Size size, int channels, Depth depth,
                        const std::function<Image(int top, int rows)>& band);
  /// Makes a texture file of an image file as the program maketx does when told nothing more. Returns the
  /// seconds that its statistics give for the levels alone, to hundredths; 0 if they give none.
  double (*maketx)(const std::filesystem::path& image, const std::filesystem::path& texture);
  /// By handle, without anisotropy, with a cache that holds everything.
  TextureLookup (*open)(const std::filesystem::path& file, int channels, Size side);
};

} // namespace tilepack
