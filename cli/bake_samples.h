#pragma once

#include "tilepack/bake/material_files.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tilepack::cli {

/// The files that SAMPLE stands for: one image, all maps of the material in a folder, or those of one of
/// several there ("textures/rock" for textures/rock_albedo.png, textures/rock_normal.png …).
std::vector<MaterialFile> sample_files(const std::string& sample);

/// "ROLE=FILE" or "NAME:ROLE=FILE" as given to --map; without NAME the map is called like its role.
MaterialFile parsed_map_option(const std::string& option);

/// Reads the maps side by side. Color maps are taken to be encoded as `asked`, or as their file says; all
/// others are plain values.
std::vector<SampleMap> read_samples(std::span<const MaterialFile> files, std::optional<Encoding> asked);

/// A line for the user if SAMPLE, read as `map`, is a color only because nothing else was said, while its
/// name says that it is another map; else empty.
std::string doubt_about_color(const SampleMap& map, std::optional<Encoding> asked);

} // namespace tilepack::cli
