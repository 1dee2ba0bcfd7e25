#pragma once

#include "tilepack/bake/material_files.h"
#include "tilepack/image/image_file.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// The files that `sample` stands for: one image, all maps of the material in a folder, or those of one of
/// several there ("textures/rock" for textures/rock_albedo.png, textures/rock_normal.png …). Looks at names
/// alone. Throws as material_files does, and Error (cannot_read) for a folder that can't be listed.
FoundMaterial sample_files(const std::string& sample);

/// "FILE is passed over: its format is not read …; to take it: …", with marked fields.
std::string note_on(const PassedOver& file);

/// "ROLE=FILE" or "NAME:ROLE=FILE"; without NAME the map is called like its role. ROLE is "data", or the name or an
/// ending of one of map_kinds(): "normal", "normal-dx", "orm". Throws Error (usage) for the field "map".
MaterialFile parsed_map(const std::string& text);

/// What a word for a role stands for, as in parsed_map(), called like it and without a file. Throws Error (usage)
/// for `field_to_blame`.
MaterialFile meant_map(const std::string& word, std::string_view field_to_blame);

/// How a map of that role is read: light as `options` have it; of all others only the limit of texels counts, for
/// their values are plain and mean what is stored.
ReadOptions reading_of(Role role, const ReadOptions& options);

/// The maps of a material as read, and what their files left in doubt: "FILE: sentence", fields marked.
struct ReadSamples {
  std::vector<SampleMap> maps;
  std::vector<std::string> notes;
};

/// Reads the maps side by side, each as reading_of() has it. Throws as read_image does.
ReadSamples read_samples(std::span<const MaterialFile> files, const ReadOptions& options);

/// A line for the user, with marked fields, if a sample, read as `map`, is a color only because nothing else
/// was said, while its name says that it is another map; else empty.
std::string doubt_about_color(const SampleMap& map, std::optional<Encoding> asked);

} // namespace tilepack
