#include "tilepack/bake/bake_fields.h"

#include "tilepack/error/nearest_name.h"
#include "tilepack/numeric/enum_names.h"
#include "tilepack/tileset/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <utility>

namespace tilepack {
namespace {

template <NamedEnum Enum>
Enum choice_named(const std::string& text) {
  if (const std::optional<Enum> value = enum_named<Enum>(text)) return *value;
  const std::string nearest = nearest_name(text, names_of<Enum>());
  refuse_value(text, alternatives_of<Enum>() +
                         (nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)));
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

// One of the names of the enumeration that stands there.
template <typename Place>
FieldValue choice(Place place) {
  using Enum = typename decltype(held(place(std::declval<BakeOptions&>())))::value_type;
  return {BakeFieldType::choice, alternatives_of<Enum>(),
          [=](BakeOptions& o, const std::string& text) { place(o) = choice_named<Enum>(text); },
          [=](const BakeOptions& o) {
            const auto chosen = held(place(o));
            return chosen ? std::string(name_of(*chosen)) : std::string();
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
    if (!parse_whole(text, 1, limits::most_corner_colors, count))
      refuse_value(text, fmt::format("a whole number of 1 to {}, of corners; 1 to {} or HxV with {}",
                                     limits::most_corner_colors, limits::most_edge_colors,
                                     field("coloring", "edge")));
    o.synth.colors = {0, 0, static_cast<int>(count), o.synth.colors.variants};
  } else {
    const Extent e =
        parsed_extent(text, 1, limits::most_edge_colors, ": H horizontal and V vertical colors", "HxV");
    o.synth.colors = {static_cast<int>(e.width), static_cast<int>(e.height), 0, o.synth.colors.variants};
  }
}

std::string get_colors(const BakeOptions& o) {
  if (o.synth.coloring == Coloring::corner) return fmt::format("{}", o.synth.colors.corner);
  return extent_text(o.synth.colors.horizontal, o.synth.colors.vertical);
}

void set_tile_size(BakeOptions& o, const std::string& text) {
  o.fit_tile_size = text == "auto";
  if (o.fit_tile_size) return;
  const Extent e =
      parsed_extent(text, limits::smallest_tile_side_made, limits::largest_tile_side, ", or auto");
  o.synth.tile_size = {static_cast<int>(e.width), static_cast<int>(e.height)};
}

std::string get_tile_size(const BakeOptions& o) {
  return o.fit_tile_size ? "auto" : extent_text(o.synth.tile_size.width, o.synth.tile_size.height);
}

// "3,1" or "3,1,2".
void set_scheme(BakeOptions& o, const std::string& text) {
  const auto refused = [&] {
    refuse_value(text,
                 fmt::format("N,K or N,K,2 with 1 <= N <= {} and 0 <= K <= N", limits::largest_scheme_n));
  };
  std::array<std::int64_t, 3> part{0, 0, 1};
  std::size_t count = 0;
  for (std::size_t at = 0; at <= text.size() && count < 4; ++count) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    if (count == 3 || !parse_whole(std::string_view(text).substr(at, end - at), count == 1 ? 0 : 1,
                                   count == 2 ? 2 : limits::largest_scheme_n, part[count]))
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
  const Extent e = parsed_extent(text, 1, limits::longest_virtual_side);
  o.virtual_size = {e.width, e.height};
}

std::string get_virtual_size(const BakeOptions& o) {
  return extent_text(o.virtual_size.width, o.virtual_size.height);
}

// Not recorded where it was left to the sample.
std::string get_flatten(const BakeOptions& o) {
  return o.fit_flatten ? "" : fmt::format("{}", o.flatten);
}

void set_flatten(BakeOptions& o, const std::string& text) {
  o.fit_flatten = text == "auto";
  if (o.fit_flatten) return;
  std::int64_t percent = 0;
  if (!parse_whole(text, 0, 100, percent)) refuse_value(text, "a whole number of 0 to 100, or auto");
  o.flatten = static_cast<int>(percent);
}

void set_normal_y(BakeOptions& o, const std::string& text) {
  o.material.normal_y = text == "auto" ? std::nullopt : enum_named<NormalY>(text);
  if (!o.material.normal_y && text != "auto") refuse_value(text, alternatives_of<NormalY>() + "|auto");
}

std::string get_normal_y(const BakeOptions& o) {
  return o.material.normal_y ? std::string(name_of(*o.material.normal_y)) : "";
}

void set_height_range(BakeOptions& o, const std::string& text) {
  o.material.height_range.reset();
  o.material.fit_height_range = text == "auto";
  if (o.material.fit_height_range) return;
  ValueRange range;
  const char* const end = text.data() + text.size();
  const auto low = std::from_chars(text.data(), end, range.low);
  bool good = low.ec == std::errc() && low.ptr != end && *low.ptr == ',';
  if (good) {
    const auto high = std::from_chars(low.ptr + 1, end, range.high);
    constexpr double most = 1e30;
    good = high.ec == std::errc() && high.ptr == end && range.low < range.high && range.low >= -most &&
           range.high <= most;
  }
  if (!good) refuse_value(text, "A,B: two numbers, A less than B, such as -1.5,20; or auto");
  o.material.height_range = range;
}

std::string get_height_range(const BakeOptions& o) {
  if (o.material.fit_height_range) return "auto";
  if (!o.material.height_range) return "";
  return fmt::format("{},{}", o.material.height_range->low, o.material.height_range->high);
}

// Not recorded where there is one.
std::string get_variants(const BakeOptions& o) {
  return o.synth.colors.variants > 1 ? fmt::format("{}", o.synth.colors.variants) : "";
}

// Not recorded where it was left to the sample.
std::string get_wraps(const BakeOptions& o) {
  return o.wraps == WrapChoice::found ? "" : std::string(name_of(o.wraps));
}

// Recorded only where it is on, as in packs of before there was such a chain.
std::string get_full_mips(const BakeOptions& o) {
  return o.full_mips ? "true" : "";
}

// Recorded only where it is off: a sample that is straight makes the same pack either way.
std::string get_straighten(const BakeOptions& o) {
  return o.straighten ? "" : "false";
}

std::vector<BakeField> make_fields() {
  using O = BakeOptions;
  using enum FieldScope;
  using Type = BakeFieldType;
  FieldValue variants = whole_number(
      1, limits::most_variants, [](auto& o) -> auto& { return o.synth.colors.variants; });
  variants.get = get_variants;
  FieldValue wraps = choice(at(&O::wraps));
  wraps.get = get_wraps;
  FieldValue full_mips = flag(at(&O::full_mips));
  full_mips.get = get_full_mips;
  FieldValue straighten = flag(at(&O::straighten));
  straighten.get = get_straighten;
  return {
      {"tile-size", tiles, read_by(Type::extent, "N|WxH|auto", set_tile_size, get_tile_size),
       fmt::format(
           "side of a tile in texels, {} to {}; auto: about a quarter of the sample's side, so that the "
           "tiles show most of it, in whole periods where it repeats",
           limits::smallest_tile_side_made, limits::largest_tile_side)},
      {"flatten", tiles, read_by(Type::extent, "N|auto", set_flatten, get_flatten),
       "percent of slow shading (uneven light, a tone that drifts) taken out of color and height, 0 to 100; "
       "auto: "
       "boards are made alike in tone, and wood is flattened, where tiles would cut their tones off"},
      {"wraps", tiles, wraps,
       "whether the sample was made to repeat, so that tiles may show what lies across its borders; auto: "
       "found out "
       "(the default)"},
      {"straighten", tiles, straighten,
       "make courses that repeat unevenly (planks, rows of tiles) even, by moving them a few texels; on "
       "unless told "
       "otherwise"},
      {"coloring", tiles, with_consequence(choice(at(&O::synth, &SynthOptions::coloring)), follow_coloring),
       "what neighbouring tiles agree on; corner unless another option is for edge colors only"},
      {"colors", tiles, read_by(Type::extent, "N|HxV", set_colors, get_colors),
       fmt::format("colors of horizontal and vertical edges, 1 to {}, or of corners, 1 to {}",
                   limits::most_edge_colors, limits::most_corner_colors)},
      {"variants", tiles, variants,
       fmt::format("tiles of each combination of colors, with insides of their own, of which a hash picks "
                   "one a cell, "
                   "1 to {}",
                   limits::most_variants)},
      {"set", tiles, with_consequence(choice(at(&O::set)), follow_set),
       "tiles made: every combination of colors, or two for each north and west color, for an index map"},
      {"interior", tiles, choice(at(&O::synth, &SynthOptions::interior)),
       "how the inside of a tile is made: its own window of the sample, or the patches of its edges alone"},
      {"guard", tiles, whole_number(0, limits::largest_guard_made, at(&O::synth, &SynthOptions::guard)),
       "texels either side of an edge that all tiles of its color share, 0 to an eighth of the tile"},
      {"effort", tiles, whole_number(0, limits::highest_effort, at(&O::synth, &SynthOptions::effort)),
       fmt::format("time for quality, 0 (fast) to {}", limits::highest_effort)},
      {"seed", packing,
       whole_number(0, static_cast<std::int64_t>(largest_seed), at(&O::synth, &SynthOptions::seed)),
       "another number gives other tiles, 0 to 2^53 - 1"},
      {"layout", packing, choice(at(&O::layout)), "how tiles lie in the texture"},
      {"scheme", packing, read_by(Type::choice, "N,K[,2]", set_scheme, get_scheme),
       "rotated layout: N² + K² tiles in a square texture, or that twice; the best unless given"},
      {"gutter", packing, whole_number(0, limits::largest_gutter, at(&O::rotated, &RotatedOptions::gutter)),
       "rotated layout: texels round each tile; unless given, 0 where neighbours match and 2 elsewhere"},
      {"power-of-two", packing, flag(at(&O::rotated, &RotatedOptions::power_of_two)),
       "rotated layout: sides of the texture are powers of two"},
      {"turn-filter", packing, choice(at(&O::rotated, &RotatedOptions::turn_filter)),
       "rotated layout: how turned tiles are resampled"},
      {"border", packing, whole_number(0, limits::largest_layer_border, at(&O::array, &ArrayOptions::border)),
       "array layout: texels round each tile, 0 or a power of two"},
      {"corner-pack", packing, flag(at(&O::corner_pack)),
       "add a pack of the surroundings of tile corners (edge coloring)"},
      {"mips", packing, choice(at(&O::mips, &MipOptions::mode)),
       "what is done to the border texels of coarser levels; none: level 0 only"},
      {"full-mips", packing, full_mips,
       "levels go on past one texel a tile, down to the mean of the pack: for engines that can't be told "
       "which "
       "level is the last"},
      {"jump-weight", packing,
       whole_number(0, limits::most_jump_weight, at(&O::mips, &MipOptions::jump_weight)),
       "mips least-squares: cost of a jump across a border against that of an error, 0 to 1000"},
      {"roughness-from-normals", material, flag(at(&O::mips, &MipOptions::roughness_from_normals)),
       "coarser levels of roughness take up the spread of the normals they average"},
      {"alpha-coverage", material, whole_number(0, 100, at(&O::mips, &MipOptions::alpha_coverage)),
       "coarser levels keep the share of texels whose alpha reaches N percent, 1 to 100; 0: they don't"},
      {"normal-y", material, read_by(Type::choice, "up|down|auto", set_normal_y, get_normal_y),
       "which way green of the normals points in the pack, up (OpenGL) or down (DirectX), turned where the "
       "sample's points the other way, by its name or its slopes; auto: as the sample's"},
      {"height-range", material, read_by(Type::choice, "A,B|auto", set_height_range, get_height_range),
       "heights that are stored as 0 and 1, kept in pack.json: of floats, which are brought there, and of "
       "integers, which fill it already; auto: the least and the greatest of floats"},
      {"mapping", packing, choice(at(&O::mapping)),
       "how the tile of a cell is found: hash table, integer hash, a pattern without near repeats placed by "
       "the hash (corner colors; then the default), or a stored map"},
      {"virtual-size", packing, read_by(Type::extent, "N|WxH", set_virtual_size, get_virtual_size),
       "size of the virtual texture in tiles, 1 to 2^31"},
      {"image-format", packing, choice(at(&O::format)),
       "image files of the pack; as the depth asks for unless given"},
      {"depth", packing, choice(at(&O::depth)),
       "depth of the stored channels; as in the sample unless given"},
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
         value("interior") == "quilt" || colors.find_first_of("xX") != std::string::npos ||
         (colors.size() == 1 && colors > std::to_string(limits::most_corner_colors) &&
          colors <= std::to_string(limits::most_edge_colors));
}

} // namespace

std::span<const BakeField> bake_fields() {
  static const std::vector<BakeField> fields = make_fields();
  return fields;
}

std::vector<BakeField> packing_fields() {
  std::vector<BakeField> fields(bake_fields().begin(), bake_fields().end());
  std::erase_if(fields, [](const BakeField& field) { return field.scope != FieldScope::packing; });
  for (BakeField& field : fields)
    if (field.name == "seed")
      field.help =
          "another number lays the tiles in another order, 0 to 2^53 - 1; they are as they were drawn";
  return fields;
}

std::vector<std::string> bake_field_names() {
  std::vector<std::string> names;
  for (const BakeField& field : bake_fields()) names.push_back(field.name);
  return names;
}

std::string_view field_name_now(std::string_view name) {
  return name == "format" ? std::string_view("image-format") : name;
}

const BakeSetting* setting_of(std::span<const BakeSetting> settings, std::string_view field) {
  const auto found = std::find_if(settings.rbegin(), settings.rend(), [&](const BakeSetting& setting) {
    return field_name_now(setting.field) == field_name_now(field);
  });
  return found == settings.rend() ? nullptr : &*found;
}

Error blamed(const Error& error, std::span<const BakeSetting> settings) {
  const BakeSetting* setting = setting_of(settings, error.field());
  return setting ? Error(setting->kind, setting->where, error.what_happened()) : error;
}

Error blamed(const Error& error, std::string_view place, std::span<const BakeSetting> settings) {
  const std::string name = error.field();
  if (name.empty()) return error;
  if (setting_of(settings, name)) return blamed(error, settings);
  if (place.empty()) return error;
  const ErrorKind kind = error.kind() == ErrorKind::usage ? ErrorKind::invalid_content : error.kind();
  return Error(kind, fmt::format("{} \"{}\"", place, name), error.what_happened());
}

BakeOptions bake_options(std::span<const BakeSetting> settings) {
  BakeOptions options;
  if (!setting_of(settings, "coloring"))
    options.synth.coloring = asks_for_edge_colors(settings) ? Coloring::edge : Coloring::corner;
  follow_coloring(options);
  options.fit_tile_size = true; // unless a size is set
  options.fit_flatten = true;   // likewise
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
