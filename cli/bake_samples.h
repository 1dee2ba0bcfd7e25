#pragma once

#include "tilepack/tileset/map.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tilepack::cli {

/// An image file of a material, and what it is in it.
struct SampleFile {
  std::string name; ///< of the map in the pack
  Role role = Role::color;
  std::string file;
};

/// "ROLE=FILE" or "NAME:ROLE=FILE" as given to --map; without NAME the map is called like its role.
SampleFile parsed_map_option(const std::string& option);

/// Reads the maps side by side. Color maps are taken to be encoded as `asked`, or as their file says; all
/// others are plain values.
std::vector<SampleMap> read_samples(std::span<const SampleFile> files, std::optional<Encoding> asked);

} // namespace tilepack::cli
