#include "support/noise_pack.h"

#include "tilepack/error/error.h"
#include "tilepack/shader/shader_text.h"

#include <catch2/catch.hpp>

using namespace tilepack;

namespace {

std::string refusal(const Pack& pack, const ShaderSettings& settings) {
  try {
    shader_text(pack, settings, "", 0);
  } catch (const Error& error) {
    CHECK((error.kind() == ErrorKind::invalid_content || error.kind() == ErrorKind::usage));
    return error.what();
  }
  return {};
}

} // namespace

TEST_CASE(
    "a table that is too long for constants is refused in every language, with the mapping to bake with") {
  Pack pack = test::noise_pack(MappingKind::permutation);
  pack.mapping.table = permutation_table(8192, 1); // the longest that a bake makes
  ShaderSettings settings;
  for (const auto& [language, name] : enum_names<ShaderLanguage>) {
    settings.language = language;
    CHECK(refusal(pack, settings).empty());
  }
  pack.mapping.table = permutation_table(65536, 1);
  for (const auto& [language, name] : enum_names<ShaderLanguage>) {
    INFO(name);
    settings.language = language;
    const std::string message = refusal(pack, settings);
    CHECK(message.find("65536 entries") != std::string::npos);
    CHECK(message.find("mix") != std::string::npos);
  }
}

TEST_CASE("OSL refuses mirrored textures whose cells its ints can't count") {
  Pack pack = test::noise_pack(MappingKind::even);
  pack.mapping.size = {(std::int64_t{1} << 30) + 1, 5};
  ShaderSettings settings;
  settings.language = ShaderLanguage::osl;
  CHECK(refusal(pack, settings).empty());
  settings.border = WrapMode::mirror;
  CHECK(refusal(pack, settings).find("2^30") != std::string::npos);
  settings.language = ShaderLanguage::c;
  CHECK(refusal(pack, settings).empty());
}

TEST_CASE("texts need no texels, and are the same for the same words") {
  Pack pack = test::noise_pack(MappingKind::mix);
  const std::string before = shader_text(pack, {}, "tilepack shader x", 7);
  for (PackedMap& map : pack.maps) map.levels.clear();
  CHECK(shader_text(pack, {}, "tilepack shader x", 7) == before);
  CHECK(before.find("0000000000000007") != std::string::npos);
  ++pack.mapping.seed;
  CHECK(shader_text(pack, {}, "tilepack shader x", 7) != before);
}
