#pragma once

#include "tilepack/sampler/sample_batch.h"

#include <cstdint>

namespace tilepack {

struct PackLookup;

/// Of lookup/pack_lookup.h, said here for the kernels: place of the tile in cell (x, y) within the virtual
/// texture, column + 65536 * row.
std::uint32_t packed_place_of_cell(const PackLookup& lookup, std::uint32_t x, std::uint32_t y);

/// Everything the kernels of FastSampler read, as plain pointers: they are compiled once for each instruction
/// set, and nothing of the standard library may be compiled with them.
struct FastTables {
  static constexpr int max_levels = 32;

  // Texels of all levels in one block, four channels each. A level is stored with one more texel on each
  // side, wrapped, so that no tap has to wrap; of an array each layer, with the texels a filter reads beyond
  // it. `base` is where texel (0, 0) stands, in texels.
  TexelStorage storage = TexelStorage::u8;
  const void* texels = nullptr;
  int levels = 0;
  float tile_width[max_levels] = {};
  float tile_height[max_levels] = {};
  std::int32_t pitch_x[max_levels] = {}; // texels from a tile to the next: its side, in arrays and a border
  std::int32_t pitch_y[max_levels] = {};
  std::int32_t base[max_levels] = {};
  std::int32_t stride[max_levels] = {}; // texels a row
  float unit = 1;                       // value of the stored code 1
  bool alpha = false;                   // premultiplied: divide at the end
  int channels = 0;

  // How a cell of the virtual texture becomes a place in the pack; null for a plain texture: always place 0.
  const PackLookup* lookup = nullptr;
  std::int64_t width = 1; // of the virtual texture, in tiles
  std::int64_t height = 1;
};

/// The slow way to cell and fraction along one axis, for what the kernels don't handle: coordinates far out,
/// NaN, and those beyond a side that is no power of two. In place: tile[i] becomes the cell, 0..side-1.
void settle_coordinates(std::int32_t* tile, float* fraction, int count, std::int64_t side);

} // namespace tilepack
