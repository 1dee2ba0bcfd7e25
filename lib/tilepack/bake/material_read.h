#pragma once

#include "tilepack/bake/material_files.h"
#include "tilepack/image/image_file.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tilepack {

/// The files that `sample` stands for: one image, all maps of the material in a folder, or those of one of
/// several there ("textures/rock" for textures/rock_albedo.png, textures/rock_normal.png …). Looks at names
/// alone. Throws as material_files does, and Error (cannot_read) for a folder that can't be listed.
std::vector<MaterialFile> sample_files(const std::string& sample);

/// "ROLE=FILE" or "NAME:ROLE=FILE"; without NAME the map is called like its role. Throws Error (usage) for the
/// field "map".
MaterialFile parsed_map(const std::string& text);

/// The maps of a material as read, and what their files left in doubt: "FILE: sentence", fields marked.
struct ReadSamples {
  std::vector<SampleMap> maps;
  std::vector<std::string> notes;
};

/// Reads the maps side by side. `options` are for color maps; of all others only the limit of texels, for
/// their values are plain and mean what is stored. Throws as read_image does.
ReadSamples read_samples(std::span<const MaterialFile> files, const ReadOptions& options);

/// A line for the user, with marked fields, if a sample, read as `map`, is a color only because nothing else
/// was said, while its name says that it is another map; else empty.
std::string doubt_about_color(const SampleMap& map, std::optional<Encoding> asked);

} // namespace tilepack
