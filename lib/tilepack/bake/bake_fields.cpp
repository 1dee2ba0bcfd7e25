#include "tilepack/bake/bake_fields.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <map>

namespace tilepack {
namespace {

[[noreturn]] void refuse(const std::string& text, const std::string& allowed) {
  throw Error(ErrorKind::usage, "", fmt::format("'{}' is not allowed; it must be {}", text, allowed));
}

// Digits only: no sign, no blank, no fraction; beyond 64 bits is out of range as well.
bool parse_whole(std::string_view text, std::int64_t lowest, std::int64_t highest, std::int64_t& value) {
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  return fault == std::errc() && end == text.data() + text.size() && value >= lowest && value <= highest;
}

std::int64_t whole(const std::string& text, std::int64_t lowest, std::int64_t highest) {
  std::int64_t value = 0;
  if (!parse_whole(text, lowest, highest, value))
    refuse(text, fmt::format("a whole number of {} to {}", lowest, highest));
  return value;
}

struct Extent {
  std::int64_t width;
  std::int64_t height;
};

// "5" or "5x7".
Extent extent(const std::string& text, std::int64_t lowest, std::int64_t highest,
              const std::string& words = "", const char* form = "WxH") {
  const std::size_t cross = text.find('x');
  Extent e{};
  if (!parse_whole(std::string_view(text).substr(0, cross), lowest, highest, e.width) ||
      !parse_whole(std::string_view(text).substr(cross == std::string::npos ? 0 : cross + 1), lowest, highest,
                   e.height))
    refuse(text, fmt::format("N or {} with {} to {}{}", form, lowest, highest, words));
  return e;
}

std::string shown(std::int64_t width, std::int64_t height) {
  return width == height ? fmt::format("{}", width) : fmt::format("{}x{}", width, height);
}

template <typename Enum>
struct Choice {
  const char* name;
  Enum value;
};
template <typename Enum>
Choice(const char*, Enum) -> Choice<Enum>; // clang 14 deduces none for aggregates

constexpr std::array colorings{Choice{"edge", Coloring::edge}, Choice{"corner", Coloring::corner}};
constexpr std::array interiors{Choice{"patch", Construction::framed}, Choice{"quilt", Construction::quilt}};
constexpr std::array layouts{Choice{"tile-index", LayoutKind::tile_index},
                             Choice{"de-bruijn", LayoutKind::de_bruijn},
                             Choice{"rotated", LayoutKind::rotated}, Choice{"array", LayoutKind::array}};
constexpr std::array mip_modes{Choice{"none", MipMode::none}, Choice{"box", MipMode::box},
                               Choice{"edges", MipMode::edges}, Choice{"corners", MipMode::corners},
                               Choice{"least-squares", MipMode::least_squares}};
constexpr std::array mappings{Choice{"permutation", MappingKind::permutation},
                              Choice{"mix", MappingKind::mix}, Choice{"even", MappingKind::even},
                              Choice{"index", MappingKind::index}};
constexpr std::array tile_choices{Choice{"complete", SetKind::complete},
                                  Choice{"sequential", SetKind::sequential}};
constexpr std::array turn_filters{Choice{"bilinear", ResampleFilter::bilinear},
                                  Choice{"bicubic", ResampleFilter::bicubic},
                                  Choice{"lanczos", ResampleFilter::lanczos}};
constexpr std::array formats{Choice{"png", PackFormat::png}, Choice{"exr", PackFormat::exr}};
constexpr std::array depths{Choice{"u8", Depth::u8}, Choice{"u16", Depth::u16}, Choice{"f16", Depth::f16},
                            Choice{"f32", Depth::f32}};

// "edge|corner"
template <typename Choices>
std::string alternatives(const Choices& choices) {
  std::string list;
  for (const auto& choice : choices) {
    if (!list.empty()) list += '|';
    list += choice.name;
  }
  return list;
}

template <typename Choices>
auto chosen(const Choices& choices, const std::string& text) {
  for (const auto& choice : choices)
    if (text == choice.name) return choice.value;
  refuse(text, alternatives(choices));
}

template <typename Choices, typename Enum>
std::string name_in(const Choices& choices, Enum value) {
  for (const auto& choice : choices)
    if (choice.value == value) return choice.name;
  return "";
}

void set_coloring(BakeOptions& o, const std::string& text) {
  o.synth.coloring = chosen(colorings, text);
  const bool corner = o.synth.coloring == Coloring::corner;
  o.synth.colors = corner ? ColorCounts{0, 0, 2} : ColorCounts{2, 2, 0};
  o.layout = corner ? LayoutKind::de_bruijn : LayoutKind::tile_index;
}

void set_colors(BakeOptions& o, const std::string& text) {
  if (o.synth.coloring == Coloring::corner) {
    std::int64_t count = 0;
    if (!parse_whole(text, 1, 4, count))
      refuse(text, "a whole number of 1 to 4, of corners; 1 to 8 or HxV with --coloring edge");
    o.synth.colors = {0, 0, static_cast<int>(count)};
  } else {
    const Extent e = extent(text, 1, 8, ": H horizontal and V vertical colors", "HxV");
    o.synth.colors = {static_cast<int>(e.width), static_cast<int>(e.height), 0};
  }
}

std::string get_colors(const BakeOptions& o) {
  if (o.synth.coloring == Coloring::corner) return fmt::format("{}", o.synth.colors.corner);
  return shown(o.synth.colors.horizontal, o.synth.colors.vertical);
}

void set_tile_size(BakeOptions& o, const std::string& text) {
  o.fit_tile_size = text == "auto";
  if (o.fit_tile_size) return;
  const Extent e = extent(text, 4, 4096, ", or auto");
  o.synth.tile_size = {static_cast<int>(e.width), static_cast<int>(e.height)};
}

std::string get_tile_size(const BakeOptions& o) {
  return o.fit_tile_size ? "auto" : shown(o.synth.tile_size.width, o.synth.tile_size.height);
}

void set_flag(bool& flag, const std::string& text) {
  if (text != "true" && text != "false") refuse(text, "true or false");
  flag = text == "true";
}

// A small set only goes with what can hold it, so these follow, as the layout follows the coloring.
void set_tile_choice(BakeOptions& o, const std::string& text) {
  o.set = chosen(tile_choices, text);
  if (o.set != SetKind::sequential) return;
  o.layout = LayoutKind::rotated;
  o.mapping = MappingKind::index;
}

// "3,1" or "3,1,2".
void set_scheme(BakeOptions& o, const std::string& text) {
  const auto refused = [&] { refuse(text, "N,K or N,K,2 with 1 <= N <= 256 and 0 <= K <= N"); };
  std::array<std::int64_t, 3> part{0, 0, 1};
  std::size_t count = 0;
  for (std::size_t at = 0; at <= text.size() && count < 4; ++count) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    if (count == 3 || !parse_whole(std::string_view(text).substr(at, end - at), count == 1 ? 0 : 1,
                                   count == 2 ? 2 : 256, part[count]))
      refused();
    at = end + 1;
  }
  if (count < 2 || part[1] > part[0]) refused();
  o.scheme = RotatedScheme{static_cast<int>(part[0]), static_cast<int>(part[1]), static_cast<int>(part[2])};
}

std::string get_scheme(const BakeOptions& o) {
  if (!o.scheme) return "";
  const std::string both = fmt::format("{},{}", o.scheme->n, o.scheme->k);
  return o.scheme->squares == 1 ? both : both + ",2";
}

void set_virtual_size(BakeOptions& o, const std::string& text) {
  const Extent e = extent(text, 1, std::int64_t{1} << 31);
  o.virtual_size = {e.width, e.height};
}

std::vector<BakeField> make_fields() {
  using Type = BakeFieldType;
  using O = BakeOptions;
  using T = std::string;
  return {
      {"tile-size", Type::extent, "N|WxH|auto",
       "side of a tile in texels, 4 to 4096; auto: whole periods of the sample near 128", set_tile_size,
       get_tile_size},
      {"flatten", Type::integer, "N",
       "percent of slow shading (uneven light, a tone that drifts) taken out of color and height, 0 to 100",
       [](O& o, const T& text) { o.flatten = static_cast<int>(whole(text, 0, 100)); },
       [](const O& o) { return o.flatten > 0 ? fmt::format("{}", o.flatten) : ""; }},
      {"coloring", Type::choice, alternatives(colorings),
       "what neighbouring tiles agree on; corner unless another option is for edge colors only", set_coloring,
       [](const O& o) { return name_in(colorings, o.synth.coloring); }},
      {"colors", Type::extent, "N|HxV",
       "colors of horizontal and vertical edges, 1 to 8, or of corners, 1 to 4", set_colors, get_colors},
      {"set", Type::choice, alternatives(tile_choices),
       "tiles made: every combination of colors, or two for each north and west color, for an index map",
       set_tile_choice, [](const O& o) { return name_in(tile_choices, o.set); }},
      {"interior", Type::choice, alternatives(interiors),
       "how the inside of a tile is made: its own window of the sample, or the patches of its edges alone",
       [](O& o, const T& text) { o.synth.interior = chosen(interiors, text); },
       [](const O& o) { return name_in(interiors, o.synth.interior); }},
      {"guard", Type::integer, "N",
       "texels either side of an edge that all tiles of its color share, 0 to an eighth of the tile",
       [](O& o, const T& text) { o.synth.guard = static_cast<int>(whole(text, 0, 512)); },
       [](const O& o) { return fmt::format("{}", o.synth.guard); }},
      {"effort", Type::integer, "N", "time for quality, 0 (fast) to 9",
       [](O& o, const T& text) { o.synth.effort = static_cast<int>(whole(text, 0, 9)); },
       [](const O& o) { return fmt::format("{}", o.synth.effort); }},
      {"seed", Type::integer, "N", "another number gives other tiles, 0 to 2^53 - 1",
       [](O& o, const T& text) {
         o.synth.seed = static_cast<std::uint64_t>(whole(text, 0, static_cast<std::int64_t>(largest_seed)));
       },
       [](const O& o) { return fmt::format("{}", o.synth.seed); }},
      {"layout", Type::choice, alternatives(layouts), "how tiles lie in the texture",
       [](O& o, const T& text) { o.layout = chosen(layouts, text); },
       [](const O& o) { return name_in(layouts, o.layout); }},
      {"scheme", Type::choice, "N,K[,2]",
       "rotated layout: N² + K² tiles in a square texture, or that twice; the best unless given", set_scheme,
       get_scheme},
      {"gutter", Type::integer, "N",
       "rotated layout: texels round each tile; unless given, 0 where neighbours match and 2 elsewhere",
       [](O& o, const T& text) { o.gutter = static_cast<int>(whole(text, 0, 4096)); },
       [](const O& o) { return o.gutter ? fmt::format("{}", *o.gutter) : ""; }},
      {"power-of-two", Type::flag, "true|false", "rotated layout: sides of the texture are powers of two",
       [](O& o, const T& text) { set_flag(o.power_of_two, text); },
       [](const O& o) { return std::string(o.power_of_two ? "true" : "false"); }},
      {"turn-filter", Type::choice, alternatives(turn_filters),
       "rotated layout: how turned tiles are resampled",
       [](O& o, const T& text) { o.turn_filter = chosen(turn_filters, text); },
       [](const O& o) { return name_in(turn_filters, o.turn_filter); }},
      {"border", Type::integer, "N", "array layout: texels round each tile, 0 or a power of two",
       [](O& o, const T& text) { o.border = static_cast<int>(whole(text, 0, 2048)); },
       [](const O& o) { return fmt::format("{}", o.border); }},
      {"corner-pack", Type::flag, "true|false",
       "add a pack of the surroundings of tile corners (edge coloring)",
       [](O& o, const T& text) { set_flag(o.corner_pack, text); },
       [](const O& o) { return std::string(o.corner_pack ? "true" : "false"); }},
      {"mips", Type::choice, alternatives(mip_modes),
       "what is done to the border texels of coarser levels; none: level 0 only",
       [](O& o, const T& text) { o.mips.mode = chosen(mip_modes, text); },
       [](const O& o) { return name_in(mip_modes, o.mips.mode); }},
      {"jump-weight", Type::integer, "N",
       "mips least-squares: cost of a jump across a border against that of an error, 0 to 1000",
       [](O& o, const T& text) { o.mips.jump_weight = static_cast<int>(whole(text, 0, 1000)); },
       [](const O& o) { return fmt::format("{}", o.mips.jump_weight); }},
      {"roughness-from-normals", Type::flag, "true|false",
       "coarser levels of roughness take up the spread of the normals they average",
       [](O& o, const T& text) { set_flag(o.mips.roughness_from_normals, text); },
       [](const O& o) { return std::string(o.mips.roughness_from_normals ? "true" : "false"); }},
      {"alpha-coverage", Type::integer, "N",
       "coarser levels keep the share of texels whose alpha reaches N percent, 1 to 100; 0: they don't",
       [](O& o, const T& text) { o.mips.alpha_coverage = static_cast<int>(whole(text, 0, 100)); },
       [](const O& o) { return fmt::format("{}", o.mips.alpha_coverage); }},
      {"mapping", Type::choice, alternatives(mappings),
       "how the tile of a cell is found: hash table, integer hash, a pattern without near repeats placed by "
       "the "
       "hash (corner colors; then the default), or a stored map",
       [](O& o, const T& text) { o.mapping = chosen(mappings, text); },
       [](const O& o) { return o.mapping ? name_in(mappings, *o.mapping) : std::string(); }},
      {"virtual-size", Type::extent, "N|WxH", "size of the virtual texture in tiles, 1 to 2^31",
       set_virtual_size, [](const O& o) { return shown(o.virtual_size.width, o.virtual_size.height); }},
      {"format", Type::choice, alternatives(formats),
       "image files of the pack; as the depth asks for unless given",
       [](O& o, const T& text) { o.format = chosen(formats, text); },
       [](const O& o) { return o.format ? name_in(formats, *o.format) : ""; }},
      {"depth", Type::choice, alternatives(depths), "of the stored channels; as in the sample unless given",
       [](O& o, const T& text) { o.depth = chosen(depths, text); },
       [](const O& o) { return o.depth ? name_in(depths, *o.depth) : ""; }},
  };
}

// Whether something is asked for that only edge-colored tiles have.
bool asks_for_edge_colors(const std::map<std::string, const BakeSetting*>& settings) {
  const auto value = [&](const char* field) {
    const auto found = settings.find(field);
    return found == settings.end() ? std::string() : found->second->value;
  };
  const std::string colors = value("colors");
  return value("layout") == "tile-index" || value("corner-pack") == "true" || value("set") == "sequential" ||
         value("interior") == "quilt" || colors.find('x') != std::string::npos ||
         (colors.size() == 1 && colors >= "5" && colors <= "8");
}

} // namespace

std::span<const BakeField> bake_fields() {
  static const std::vector<BakeField> fields = make_fields();
  return fields;
}

std::vector<std::string> bake_field_names() {
  std::vector<std::string> names;
  for (const BakeField& field : bake_fields()) names.push_back(field.name);
  return names;
}

BakeOptions bake_options(std::span<const BakeSetting> settings) {
  std::map<std::string, const BakeSetting*> last;
  for (const BakeSetting& setting : settings) last[setting.field] = &setting;
  BakeOptions options;
  if (!last.contains("coloring")) set_coloring(options, asks_for_edge_colors(last) ? "edge" : "corner");
  const auto apply = [&](const BakeField& field) {
    const auto found = last.find(field.name);
    if (found == last.end()) return;
    const BakeSetting& setting = *found->second;
    try {
      field.set(options, setting.value);
    } catch (const Error& error) {
      throw Error(setting.blame, setting.where, error.what());
    }
  };
  for (const BakeField& field : bake_fields()) apply(field);
  return options;
}

std::vector<std::pair<std::string, std::string>> recorded_options(const BakeOptions& options) {
  std::vector<std::pair<std::string, std::string>> list;
  for (const BakeField& field : bake_fields())
    if (std::string value = field.get(options); !value.empty() && field.name != "seed")
      list.emplace_back(field.name, std::move(value));
  return list;
}

} // namespace tilepack
