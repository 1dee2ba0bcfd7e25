#include "tilepack/shader/shader_text.h"

#include "tilepack/error/error.h"
#include "tilepack/error/field.h"
#include "tilepack/lookup/lookup_tables.h"
#include "tilepack/shader/lookup_description.h"
#include "tilepack/shader/program_printer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace tilepack {
namespace {

bool is_name(const std::string& name) {
  const auto fits = [](unsigned char c) { return c < 128 && std::isalnum(c) != 0; };
  return !name.empty() && name.size() <= 32 && std::isalpha(static_cast<unsigned char>(name[0])) != 0 &&
         std::all_of(name.begin(), name.end(), fits);
}

// What a language has no way to say.
struct LanguageLimits {
  int side = 16384;  ///< of a texture, texels
  int layers = 2048; ///< of an array; 0: there are none
  bool ids = true;   ///< textures of whole numbers
};

LanguageLimits limits_of(ShaderLanguage language) {
  switch (language) {
  case ShaderLanguage::c:
    return {65536 * 4096, 65536, true};
  case ShaderLanguage::wgsl: // what every WebGPU device has
  case ShaderLanguage::tsl:
    return {8192, 256, true};
  case ShaderLanguage::osl:
    return {65536, 0, false};
  case ShaderLanguage::gdshader: // Godot imports no textures of whole numbers
    return {16384, 2048, false};
  default:
    break;
  }
  return {};
}

[[noreturn]] void refuse(ShaderLanguage language, const std::string& what, const std::string& instead) {
  throw Error(ErrorKind::invalid_content, "shader",
              fmt::format("{} {}; {}", name_of(language), what, instead));
}

void check(const Pack& pack, const ShaderSettings& settings) {
  if (!is_name(settings.name))
    throw Error(
        ErrorKind::usage, field("name"),
        fmt::format("'{}'; it is a letter followed by letters and digits, 32 at most", settings.name));
  const ShaderLanguage language = settings.language;
  const LanguageLimits limits = limits_of(language);
  const bool layered = pack.layout.kind == LayoutKind::array;
  const int layers = layered ? pack.layout.rows : 1;
  Size side = texture_size(pack.layout, pack.tile_size, 0);
  if (layered) side.height /= layers;
  if (layered && limits.layers == 0)
    refuse(language, "has no texture arrays",
           "bake with " + field("layout", "de-bruijn") + " or " + field("layout", "tile-index"));
  if (layered && layers > limits.layers)
    refuse(language,
           fmt::format("can count on {} layers of a texture array, the pack has {}", limits.layers, layers),
           "bake with fewer " + field("colors") + ", or in one texture (" + field("layout", "de-bruijn") +
               " or " + field("layout", "tile-index") + ")");
  if (std::max(side.width, side.height) > limits.side)
    refuse(language,
           fmt::format("can count on textures of {0} x {0} texels, the pack's are {1} x {2}", limits.side,
                       side.width, side.height),
           "bake with a smaller " + field("tile-size") + ", or a layer a tile (" + field("layout", "array") +
               ")");
  // Mirrored, cells are counted to twice the side, which an int does not hold.
  constexpr std::int64_t half_of_int = std::int64_t{1} << 30;
  const std::int64_t longest = std::max(pack.mapping.size.width, pack.mapping.size.height);
  if (language == ShaderLanguage::osl && settings.border == WrapMode::mirror && longest > half_of_int)
    refuse(language, fmt::format("has no whole numbers for a mirrored texture of {} tiles", longest),
           "bake with " + field("virtual-size") + " of at most 2^30 a side");
  if (pack.mapping.kind != MappingKind::index) return;
  if (!limits.ids)
    refuse(language, "reads no textures of whole numbers, which an index map is",
           "bake a complete set with " + field("mapping", "mix"));
  if (std::max(pack.mapping.size.width, pack.mapping.size.height) > limits.side)
    refuse(language,
           fmt::format("can count on textures of {0} x {0} texels, the index map is {1} x {2}", limits.side,
                       pack.mapping.size.width, pack.mapping.size.height),
           "bake with a smaller " + field("virtual-size") + ", or with " + field("mapping", "mix"));
}

std::unique_ptr<ProgramPrinter> printer_of(ShaderLanguage language, PrintSettings settings) {
  switch (language) {
  case ShaderLanguage::c:
    return c_printer(std::move(settings));
  case ShaderLanguage::hlsl:
    return hlsl_printer(std::move(settings));
  case ShaderLanguage::wgsl:
    return wgsl_printer(std::move(settings));
  case ShaderLanguage::osl:
    return osl_printer(std::move(settings));
  case ShaderLanguage::tsl:
    return tsl_printer(std::move(settings));
  default:
    break;
  }
  return glsl_printer(std::move(settings), language == ShaderLanguage::gdshader);
}

std::string maps_text(const Pack& pack) {
  std::string text;
  for (const PackedMap& map : pack.maps)
    text += fmt::format("{}{} ({}, {} channel{})", text.empty() ? "" : ", ", map.name, name_of(map.encoding),
                        map.channels, map.channels == 1 ? "" : "s");
  return text;
}

// What whoever includes the text has to know.
std::vector<std::string> usage(const Pack& pack, const ShaderSettings& settings, std::uint32_t levels) {
  const bool layered = pack.layout.kind == LayoutKind::array;
  const bool corners = pack.corner_pack.has_value();
  const std::string name = settings.name;
  std::vector<std::string> lines{"Maps: " + maps_text(pack) + "."};
  if (settings.language == ShaderLanguage::c) {
    lines.push_back(fmt::format("`tiles` holds a map's {} levels in linear light{}{}.", levels,
                                layered ? ", of an array its layers one below the other" : "",
                                corners ? ", `corners` those of the corner pack" : ""));
    lines.push_back(
        fmt::format("{0}_tile(cell_x, cell_y) is the id of a cell's tile; {0}_nearest, {0}_level{1} read "
                    "texels.",
                    name, pack.layout.kind == LayoutKind::rotated ? "" : ", " + name + "_exact"));
  } else {
    lines.push_back(fmt::format("Each is a texture{} of {} levels, as stored, row 0 first, sRGB ones decoded "
                                "when read: filtered linearly, "
                                "also between levels,",
                                layered ? fmt::format(" array of {} layers", pack.layout.rows) : "", levels));
    lines.push_back(fmt::format("{}, its last level {}{}.", layered ? "clamped to its edge" : "repeating",
                                levels - 1, pack.full_chain ? ", the mean" : ""));
    if (settings.language == ShaderLanguage::osl)
      lines.push_back(fmt::format(
          "{0}_shader is a shader, {0}_grad what it calls, by cell, fraction and derivatives.", name));
    else
      lines.push_back(fmt::format(
          "{0}_sample(map, place) is the texture at `place`, in tiles; {0}_grad the same by cell, "
          "fraction and derivatives.",
          name));
    lines.emplace_back(
        corners ? "It costs one fetch a map, and near corners of tiles one more from the corner pack."
        : pack.mapping.kind == MappingKind::index
            ? "It costs one fetch a map, and one from the index map (`ids`: whole numbers, one level)."
            : "It costs one fetch a map, as a plain texture does.");
  }
  if (pack.mapping.kind == MappingKind::index && settings.language == ShaderLanguage::c)
    lines.emplace_back("`ids` is the index map, row by row.");
  if (settings.language == ShaderLanguage::osl)
    lines.emplace_back(
        "Not run in this language by the tests of tilepack, which run others of the same description.");
  if (settings.language == ShaderLanguage::gdshader)
    lines.emplace_back("The tests of tilepack run it in Godot 3.2, its literals and tables in older words.");
  return lines;
}

// GLSL ES has no precision for floats in fragment programs, nor for most samplers, until it is told one; of places and
// hashes no bit may be lost.
std::string embedded_precisions(const Pack& pack) {
  std::string text = "#ifdef GL_ES\nprecision highp float;\nprecision highp int;\n";
  text += pack.layout.kind == LayoutKind::array ? "precision highp sampler2DArray;\n"
                                                : "precision highp sampler2D;\n";
  if (pack.mapping.kind == MappingKind::index) text += "precision highp usampler2D;\n";
  return text + "#endif\n";
}

std::string comment_of(ShaderLanguage language, const std::string& line) {
  return language == ShaderLanguage::c ? "/* " + line + " */\n" : "// " + line + "\n";
}

} // namespace

std::string shader_text(const Pack& pack, const ShaderSettings& settings, const std::string& made_by,
                        std::uint64_t content) {
  check(pack, settings);
  const LookupTables tables(pack);
  LookupFeatures features;
  features.border = settings.border;
  features.levels = settings.language != ShaderLanguage::osl;
  features.gradients = settings.language != ShaderLanguage::c;
  const LookupProgram program = describe_lookup(tables.words(), features);

  PrintSettings print;
  print.prefix = settings.name + "_";
  print.layers = pack.layout.kind == LayoutKind::array;
  print.wraps = !print.layers;
  const std::string lookup = printer_of(settings.language, print)->text(program);
  if (!settings.has_head) return lookup;
  std::string text = comment_of(settings.language, "Made by: " + made_by);
  text += comment_of(settings.language, fmt::format("Content of the pack: {:016x}", content));
  for (const std::string& line : usage(pack, settings, tables.words().chain_levels))
    text += comment_of(settings.language, line);
  if (settings.language == ShaderLanguage::glsl) text += embedded_precisions(pack);
  return text + "\n" + lookup;
}

} // namespace tilepack
