#pragma once

#include <string>

namespace tilepack {

/// The JSON Schema of scenes, made from scene_blocks(): scene.schema.json, which a test holds against it. It knows
/// the names, types and ranges of all inputs; which node may stand where, scene_reading() knows.
std::string scene_schema();

} // namespace tilepack
