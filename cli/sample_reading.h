#pragma once

#include "console.h"
#include "options.h"

#include "tilepack/image/image_file.h"
#include "tilepack/tileset/material_map.h"

#include <string>

namespace tilepack::cli {

/// What the command line says of image files that are read.
struct ReadingArguments {
  std::string encoding; ///< "srgb", "linear"; empty: as files say
  std::string channels; ///< "R,G,B"; empty: by their names
  std::int64_t max_texels = usual_most_texels;
};

/// Adds --encoding, --channels and --max-texels, which notes and messages about files name.
void add_reading_options(Options& options, ReadingArguments& arguments);

/// Reads an image of that role, and prints what its file leaves in doubt.
ImageFile read_noted(const std::string& file, const ReadingArguments& arguments, Role role, Console& console);

} // namespace tilepack::cli
