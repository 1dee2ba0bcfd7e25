#include "tilepack/bake/bake_fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace tilepack {
namespace {

template <typename Enum>
struct Choice {
  const char* name;
  Enum value;
};
template <typename Enum>
Choice(const char*, Enum) -> Choice<Enum>; // clang 14 deduces none for aggregates

constexpr std::array colorings{Choice{"edge", Coloring::edge}, Choice{"corner", Coloring::corner}};
constexpr std::array constructions{Choice{"patch", Construction::framed},
                                   Choice{"quilt", Construction::quilt}};
constexpr std::array layouts{Choice{"tile-index", LayoutKind::tile_index},
                             Choice{"de-bruijn", LayoutKind::de_bruijn},
                             Choice{"rotated", LayoutKind::rotated}, Choice{"array", LayoutKind::array}};
constexpr std::array mip_modes{Choice{"none", MipMode::none}, Choice{"box", MipMode::box},
                               Choice{"edges", MipMode::edges}, Choice{"corners", MipMode::corners},
                               Choice{"least-squares", MipMode::least_squares}};
constexpr std::array mappings{Choice{"permutation", MappingKind::permutation},
                              Choice{"mix", MappingKind::mix}, Choice{"even", MappingKind::even},
                              Choice{"index", MappingKind::index}};
constexpr std::array set_kinds{Choice{"complete", SetKind::complete},
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
auto choice_named(const Choices& choices, const std::string& text) {
  for (const auto& choice : choices)
    if (text == choice.name) return choice.value;
  refuse_value(text, alternatives(choices));
}

template <typename Choices, typename Enum>
std::string name_in(const Choices& choices, Enum value) {
  for (const auto& choice : choices)
    if (choice.value == value) return choice.name;
  return "";
}

// A place in the options, which may be in one of their groups.
template <typename Value, typename Options>
auto at(Value Options::*member) {
  return [=](auto& o) -> auto& {
    return o.*member;
  };
}

template <typename Group, typename Options, typename Value>
auto at(Group Options::*group, Value Group::*member) {
  return [=](auto& o) -> auto& {
    return (o.*group).*member;
  };
}

// The value that is there or, of an optional one that is unset, nothing.
template <typename Value>
std::optional<Value> held(const Value& value) {
  return value;
}
template <typename Value>
std::optional<Value> held(const std::optional<Value>& value) {
  return value;
}

template <typename Place>
FieldValue whole_number(std::int64_t lowest, std::int64_t highest, Place place) {
  return {BakeFieldType::integer, "N",
          [=](BakeOptions& o, const std::string& text) {
            using Number = typename decltype(held(place(o)))::value_type;
            place(o) = static_cast<Number>(parsed_whole(text, lowest, highest));
          },
          [=](const BakeOptions& o) {
            const auto number = held(place(o));
            return number ? fmt::format("{}", *number) : "";
          }};
}

template <typename Place>
FieldValue flag(Place place) {
  return {BakeFieldType::flag, "true|false",
          [=](BakeOptions& o, const std::string& text) { place(o) = parsed_flag(text); },
          [=](const BakeOptions& o) { return std::string(place(o) ? "true" : "false"); }};
}

template <typename Choices, typename Place>
FieldValue choice(const Choices& choices, Place place) {
  return {BakeFieldType::choice, alternatives(choices),
          [=](BakeOptions& o, const std::string& text) { place(o) = choice_named(choices, text); },
          [=](const BakeOptions& o) {
            const auto chosen = held(place(o));
            return chosen ? name_in(choices, *chosen) : std::string();
          }};
}

FieldValue read_by(BakeFieldType type, const char* shown, void (*set)(BakeOptions&, const std::string&),
                   std::string (*get)(const BakeOptions&)) {
  return {type, shown, set, get};
}

// One that has others follow it.
FieldValue with_consequence(FieldValue value, void (*follow)(BakeOptions& options)) {
  value.set = [set = value.set, follow](BakeOptions& o, const std::string& text) {
    set(o, text);
    follow(o);
  };
  return value;
}

void follow_coloring(BakeOptions& o) {
  const bool corner = o.synth.coloring == Coloring::corner;
  o.synth.colors = corner ? ColorCounts{0, 0, 2} : ColorCounts{2, 2, 0};
  o.layout = corner ? LayoutKind::de_bruijn : LayoutKind::tile_index;
}

// A small set only goes with what can hold it.
void follow_set(BakeOptions& o) {
  if (o.set != SetKind::sequential) return;
  o.layout = LayoutKind::rotated;
  o.mapping = MappingKind::index;
}

void set_colors(BakeOptions& o, const std::string& text) {
  if (o.synth.coloring == Coloring::corner) {
    std::int64_t count = 0;
    if (!parse_whole(text, 1, 4, count))
      refuse_value(text,
                   "a whole number of 1 to 4, of corners; 1 to 8 or HxV with " + field("coloring", "edge"));
    o.synth.colors = {0, 0, static_cast<int>(count)};
  } else {
    const Extent e = parsed_extent(text, 1, 8, ": H horizontal and V vertical colors", "HxV");
    o.synth.colors = {static_cast<int>(e.width), static_cast<int>(e.height), 0};
  }
}

std::string get_colors(const BakeOptions& o) {
  if (o.synth.coloring == Coloring::corner) return fmt::format("{}", o.synth.colors.corner);
  return extent_text(o.synth.colors.horizontal, o.synth.colors.vertical);
}

void set_tile_size(BakeOptions& o, const std::string& text) {
  o.fit_tile_size = text == "auto";
  if (o.fit_tile_size) return;
  const Extent e = parsed_extent(text, 4, 4096, ", or auto");
  o.synth.tile_size = {static_cast<int>(e.width), static_cast<int>(e.height)};
}

std::string get_tile_size(const BakeOptions& o) {
  return o.fit_tile_size ? "auto" : extent_text(o.synth.tile_size.width, o.synth.tile_size.height);
}

// "3,1" or "3,1,2".
void set_scheme(BakeOptions& o, const std::string& text) {
  const auto refused = [&] { refuse_value(text, "N,K or N,K,2 with 1 <= N <= 256 and 0 <= K <= N"); };
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
  o.rotated.scheme =
      RotatedScheme{static_cast<int>(part[0]), static_cast<int>(part[1]), static_cast<int>(part[2])};
}

std::string get_scheme(const BakeOptions& o) {
  if (!o.rotated.scheme) return "";
  const std::string both = fmt::format("{},{}", o.rotated.scheme->n, o.rotated.scheme->k);
  return o.rotated.scheme->squares == 1 ? both : both + ",2";
}

void set_virtual_size(BakeOptions& o, const std::string& text) {
  const Extent e = parsed_extent(text, 1, std::int64_t{1} << 31);
  o.virtual_size = {e.width, e.height};
}

std::string get_virtual_size(const BakeOptions& o) {
  return extent_text(o.virtual_size.width, o.virtual_size.height);
}

// Not recorded where nothing was done.
std::string get_flatten(const BakeOptions& o) {
  return o.flatten > 0 ? fmt::format("{}", o.flatten) : "";
}

std::vector<BakeField> make_fields() {
  using O = BakeOptions;
  using enum FieldScope;
  using Type = BakeFieldType;
  FieldValue flatten = whole_number(0, 100, at(&O::flatten));
  flatten.get = get_flatten;
  return {
      {"tile-size", tiles, read_by(Type::extent, "N|WxH|auto", set_tile_size, get_tile_size),
       "side of a tile in texels, 4 to 4096; auto: whole periods of the sample near 128"},
      {"flatten", tiles, flatten,
       "percent of slow shading (uneven light, a tone that drifts) taken out of color and height, 0 to 100"},
      {"coloring", tiles,
       with_consequence(choice(colorings, at(&O::synth, &SynthOptions::coloring)), follow_coloring),
       "what neighbouring tiles agree on; corner unless another option is for edge colors only"},
      {"colors", tiles, read_by(Type::extent, "N|HxV", set_colors, get_colors),
       "colors of horizontal and vertical edges, 1 to 8, or of corners, 1 to 4"},
      {"set", tiles, with_consequence(choice(set_kinds, at(&O::set)), follow_set),
       "tiles made: every combination of colors, or two for each north and west color, for an index map"},
      {"interior", tiles, choice(constructions, at(&O::synth, &SynthOptions::interior)),
       "how the inside of a tile is made: its own window of the sample, or the patches of its edges alone"},
      {"guard", tiles, whole_number(0, 512, at(&O::synth, &SynthOptions::guard)),
       "texels either side of an edge that all tiles of its color share, 0 to an eighth of the tile"},
      {"effort", tiles, whole_number(0, 9, at(&O::synth, &SynthOptions::effort)),
       "time for quality, 0 (fast) to 9"},
      {"seed", packing,
       whole_number(0, static_cast<std::int64_t>(largest_seed), at(&O::synth, &SynthOptions::seed)),
       "another number gives other tiles, 0 to 2^53 - 1"},
      {"layout", packing, choice(layouts, at(&O::layout)), "how tiles lie in the texture"},
      {"scheme", packing, read_by(Type::choice, "N,K[,2]", set_scheme, get_scheme),
       "rotated layout: N² + K² tiles in a square texture, or that twice; the best unless given"},
      {"gutter", packing, whole_number(0, 4096, at(&O::rotated, &RotatedOptions::gutter)),
       "rotated layout: texels round each tile; unless given, 0 where neighbours match and 2 elsewhere"},
      {"power-of-two", packing, flag(at(&O::rotated, &RotatedOptions::power_of_two)),
       "rotated layout: sides of the texture are powers of two"},
      {"turn-filter", packing, choice(turn_filters, at(&O::rotated, &RotatedOptions::turn_filter)),
       "rotated layout: how turned tiles are resampled"},
      {"border", packing, whole_number(0, 2048, at(&O::array, &ArrayOptions::border)),
       "array layout: texels round each tile, 0 or a power of two"},
      {"corner-pack", packing, flag(at(&O::corner_pack)),
       "add a pack of the surroundings of tile corners (edge coloring)"},
      {"mips", packing, choice(mip_modes, at(&O::mips, &MipOptions::mode)),
       "what is done to the border texels of coarser levels; none: level 0 only"},
      {"jump-weight", packing, whole_number(0, 1000, at(&O::mips, &MipOptions::jump_weight)),
       "mips least-squares: cost of a jump across a border against that of an error, 0 to 1000"},
      {"roughness-from-normals", material, flag(at(&O::mips, &MipOptions::roughness_from_normals)),
       "coarser levels of roughness take up the spread of the normals they average"},
      {"alpha-coverage", material, whole_number(0, 100, at(&O::mips, &MipOptions::alpha_coverage)),
       "coarser levels keep the share of texels whose alpha reaches N percent, 1 to 100; 0: they don't"},
      {"mapping", packing, choice(mappings, at(&O::mapping)),
       "how the tile of a cell is found: hash table, integer hash, a pattern without near repeats placed by "
       "the hash (corner colors; then the default), or a stored map"},
      {"virtual-size", packing, read_by(Type::extent, "N|WxH", set_virtual_size, get_virtual_size),
       "size of the virtual texture in tiles, 1 to 2^31"},
      {"format", packing, choice(formats, at(&O::format)),
       "image files of the pack; as the depth asks for unless given"},
      {"depth", packing, choice(depths, at(&O::depth)),
       "of the stored channels; as in the sample unless given"},
  };
}

// Whether something is asked for that only edge-colored tiles have.
bool asks_for_edge_colors(std::span<const BakeSetting> settings) {
  const auto value = [&](const char* field) {
    const BakeSetting* found = setting_of(settings, field);
    return found ? found->value : std::string();
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

std::vector<BakeField> packing_fields() {
  std::vector<BakeField> fields(bake_fields().begin(), bake_fields().end());
  std::erase_if(fields, [](const BakeField& field) { return field.scope != FieldScope::packing; });
  return fields;
}

std::vector<std::string> bake_field_names() {
  std::vector<std::string> names;
  for (const BakeField& field : bake_fields()) names.push_back(field.name);
  return names;
}

const BakeSetting* setting_of(std::span<const BakeSetting> settings, std::string_view field) {
  const auto found = std::find_if(settings.rbegin(), settings.rend(),
                                  [&](const BakeSetting& setting) { return setting.field == field; });
  return found == settings.rend() ? nullptr : &*found;
}

Error blamed(const Error& error, std::span<const BakeSetting> settings) {
  const BakeSetting* setting = setting_of(settings, error.field());
  return setting ? Error(setting->kind, setting->where, error.what_happened()) : error;
}

BakeOptions bake_options(std::span<const BakeSetting> settings) {
  BakeOptions options;
  if (!setting_of(settings, "coloring"))
    options.synth.coloring = asks_for_edge_colors(settings) ? Coloring::edge : Coloring::corner;
  follow_coloring(options);
  for (const BakeField& field : bake_fields())
    if (const BakeSetting* setting = setting_of(settings, field.name)) {
      try {
        field.set(options, setting->value);
      } catch (const Error& error) {
        throw Error(setting->kind, setting->where, error.what_happened());
      }
    }
  return options;
}

std::vector<std::pair<std::string, std::string>> recorded_options(const BakeOptions& options,
                                                                  std::span<const BakeField> fields) {
  std::vector<std::pair<std::string, std::string>> list;
  for (const BakeField& field : fields)
    if (std::string value = field.get(options); !value.empty() && field.name != "seed")
      list.emplace_back(field.name, std::move(value));
  return list;
}

} // namespace tilepack
