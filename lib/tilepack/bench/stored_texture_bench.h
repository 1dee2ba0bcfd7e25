#pragma once

#include "tilepack/bench/lookup_bench.h"
#include "tilepack/error/progress.h"

#include <filesystem>

namespace tilepack {

/// The fast sampler against OpenImageIO's TextureSystem on the same virtual texture stored whole, 8192 texels
/// a side (or the nearest whole number of tiles below) with mips, 64 x 64 tiles, periodic; and mip_chain
/// against the chain that OpenImageIO (as maketx) makes of an image of 4096 texels a side.
///
/// Files go into `folder`, which must exist and is left to the caller to remove; about 400 MB. The texture
/// system is asked as its documentation advises for speed: by handle, 16 lookups a call, no anisotropy, a
/// cache that holds everything, and one frame unmeasured to fill it. Answers are compared first (Error,
/// check_failed, if the mean difference passes two 8-bit units; trilinear level selection differs a little
/// between the two). Throws Error (cannot_write) if the texture can't be written.
std::vector<BenchRatio> bench_stored_texture(const Pack& pack, int map, const std::filesystem::path& folder,
                                             const BenchOptions& options, const Progress& progress = {});

} // namespace tilepack
