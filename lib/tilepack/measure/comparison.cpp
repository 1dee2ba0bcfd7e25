#include "tilepack/measure/comparison.h"

#include "tilepack/json/json_value.h"

#include <fmt/format.h>

#include <algorithm>

namespace tilepack {
namespace {

FullRange range_of(Depth depth) {
  return depth == Depth::u8 || depth == Depth::u16 ? FullRange::unit : FullRange::unbounded;
}

ComparedPart compared_part(std::string name, const Image& a, const Image& b, FullRange range) {
  ComparedPart part{std::move(name), "", range, std::nullopt};
  if (a.size() != b.size() || a.channels() != b.channels() || a.empty())
    part.mismatch = fmt::format("{} x {} of {} channels and {} x {} of {}", a.width(), a.height(),
                                a.channels(), b.width(), b.height(), b.channels());
  else
    part.figures = difference(a, b, range, range == FullRange::unit ? 255 : 1);
  return part;
}

// Collects what differs, in one sentence each.
class Facts {
public:
  template <typename T>
  void compare(std::string_view name, const T& a, const T& b) {
    if (a != b) list.push_back(fmt::format("{}: {} and {}", name, a, b));
  }
  void differ(bool same, std::string_view what) {
    if (!same) list.emplace_back(what);
  }
  std::vector<std::string> list;
};

std::string size_text(Size size) {
  return fmt::format("{} x {}", size.width, size.height);
}

std::string colors_text(const ColorCounts& colors) {
  const std::string variants = colors.variants > 1 ? fmt::format(", {} variants", colors.variants) : "";
  return (colors.corner > 0 ? fmt::format("{} corner", colors.corner)
                            : fmt::format("{} horizontal, {} vertical", colors.horizontal, colors.vertical)) +
         variants;
}

void compare_maps(const std::vector<PackedMap>& a, const std::vector<PackedMap>& b, const std::string& prefix,
                  Comparison& result, Facts& facts) {
  const auto named = [](const std::vector<PackedMap>& maps, const std::string& name) {
    return std::find_if(maps.begin(), maps.end(), [&](const PackedMap& map) { return map.name == name; });
  };
  for (const PackedMap& map : b)
    facts.differ(named(a, map.name) != a.end(),
                 fmt::format("{}map {}: only in the second", prefix, map.name));
  for (const PackedMap& map : a) {
    const auto other = named(b, map.name);
    if (other == b.end()) {
      facts.differ(false, fmt::format("{}map {}: only in the first", prefix, map.name));
      continue;
    }
    const std::string name = prefix + "map " + map.name;
    facts.compare(name + ", role", name_of(map.role), name_of(other->role));
    facts.compare(name + ", encoding", name_of(map.encoding), name_of(other->encoding));
    facts.compare(name + ", depth", name_of(map.depth), name_of(other->depth));
    facts.compare(name + ", levels", map.levels.size(), other->levels.size());
    const FullRange range = std::max(range_of(map.depth), range_of(other->depth));
    for (std::size_t level = 0; level < std::min(map.levels.size(), other->levels.size()); ++level)
      result.parts.push_back(compared_part(fmt::format("{}{}, level {}", prefix, map.name, level),
                                           map.levels[level], other->levels[level], range));
    facts.compare(name + ", far levels", map.far_levels.size(), other->far_levels.size());
    for (std::size_t level = 0; level < std::min(map.far_levels.size(), other->far_levels.size()); ++level)
      result.parts.push_back(
          compared_part(fmt::format("{}{}, level {}", prefix, map.name, map.levels.size() + level),
                        map.far_levels[level], other->far_levels[level], range));
  }
}

bool keeps(const ComparedPart& part, const CompareLimits& limits) {
  if (!part.figures) return false;
  const ImageDifference& d = *part.figures;
  if (d.equal) return true;
  const bool limited = limits.max_difference || limits.min_psnr || limits.min_ssim;
  return limited && d.not_comparable == 0 &&
         (!limits.max_difference || d.largest <= *limits.max_difference) &&
         (!limits.min_psnr || !d.psnr || *d.psnr >= *limits.min_psnr) &&
         (!limits.min_ssim || d.ssim >= *limits.min_ssim);
}

std::string_view unit_of(FullRange range) {
  return range == FullRange::unit ? "1/255" : "value";
}

std::string part_text(const ComparedPart& part) {
  std::string text = part.name.empty() ? "" : part.name + "\n";
  if (!part.figures) return text + fmt::format("  can't be compared: {}\n", part.mismatch);
  const ImageDifference& d = *part.figures;
  if (d.equal) return text + "  equal\n";
  const std::string unit = part.range == FullRange::unit ? "/255" : "";
  text += fmt::format("  PSNR                {}\n",
                      d.psnr ? fmt::format("{:.2f} dB (peak {:.6g})", *d.psnr, d.peak) : "infinite");
  text += fmt::format("  SSIM                {:.5f}\n", d.ssim);
  text += fmt::format("  largest difference  {:.6g}{} at texel ({}, {}) channel {}\n", d.largest, unit,
                      d.largest_x, d.largest_y, d.largest_channel);
  text += fmt::format("  mean, RMS           {:.6g}{}, {:.6g}{}\n", d.mean, unit, d.rms, unit);
  text += fmt::format("  texels that differ  {}\n", d.differing);
  if (d.not_comparable > 0)
    text += fmt::format("  NaN or infinite     {} texels, in one of the two only\n", d.not_comparable);
  return text;
}

JsonValue part_json(const ComparedPart& part, const CompareLimits& limits) {
  JsonValue json{{"name", part.name}, {"within", keeps(part, limits)}};
  if (!part.figures) {
    json["mismatch"] = part.mismatch;
    return json;
  }
  const ImageDifference& d = *part.figures;
  json["equal"] = d.equal;
  json["unit"] = unit_of(part.range);
  json["peak"] = d.peak;
  json["psnr"] = d.psnr;
  json["ssim"] = d.ssim;
  json["largest"] = {
      {"difference", d.largest}, {"x", d.largest_x}, {"y", d.largest_y}, {"channel", d.largest_channel}};
  json["mean"] = d.mean;
  json["rms"] = d.rms;
  json["differing_texels"] = d.differing;
  json["not_comparable_texels"] = d.not_comparable;
  return json;
}

} // namespace

Comparison compared(const ImageFile& a, const ImageFile& b) {
  const FullRange range = std::max(range_of(a.depth), range_of(b.depth));
  Comparison result;
  if (a.encoding == b.encoding) {
    result.parts.push_back(compared_part("", a.image, b.image, range));
  } else {
    const auto encoded = [](const ImageFile& file) {
      return file.encoding == Encoding::srgb ? file.image : from_linear(file.image, Encoding::srgb);
    };
    result.parts.push_back(compared_part("", encoded(a), encoded(b), range));
  }
  return result;
}

Comparison compared(const Pack& a, const Pack& b) {
  Comparison result;
  Facts facts;
  facts.compare("tile size", size_text(a.tile_size), size_text(b.tile_size));
  facts.compare("colors", colors_text(a.colors), colors_text(b.colors));
  facts.differ(a.tiles == b.tiles, "tiles: their colors differ");
  facts.compare("layout", name_of(a.layout.kind), name_of(b.layout.kind));
  facts.differ(a.layout.kind != b.layout.kind || a.layout == b.layout, "layout: tiles stand in other cells");
  facts.compare("mapping", name_of(a.mapping.kind), name_of(b.mapping.kind));
  facts.compare("virtual width", a.mapping.size.width, b.mapping.size.width);
  facts.compare("virtual height", a.mapping.size.height, b.mapping.size.height);
  facts.differ(a.mapping.table == b.mapping.table && a.mapping.seed == b.mapping.seed &&
                   a.mapping.ids == b.mapping.ids,
               "mapping: it chooses other tiles");
  facts.compare("mips", name_of(a.mip_mode), name_of(b.mip_mode));
  facts.compare("guard", a.guard, b.guard);
  facts.differ(a.corner_pack.has_value() == b.corner_pack.has_value(),
               "corner pack: only one of the two has it");
  compare_maps(a.maps, b.maps, "", result, facts);
  if (a.corner_pack && b.corner_pack)
    compare_maps(a.corner_pack->maps, b.corner_pack->maps, "corner pack, ", result, facts);
  result.facts = std::move(facts.list);
  return result;
}

bool equal(const Comparison& comparison) {
  return within(comparison, {});
}

bool within(const Comparison& comparison, const CompareLimits& limits) {
  return comparison.facts.empty() &&
         std::all_of(comparison.parts.begin(), comparison.parts.end(),
                     [&](const ComparedPart& part) { return keeps(part, limits); });
}

std::string comparison_text(const Comparison& comparison, const CompareLimits& limits) {
  std::string text;
  for (const std::string& fact : comparison.facts) text += fact + "\n";
  for (const ComparedPart& part : comparison.parts) text += part_text(part);
  const char* verdict = equal(comparison)            ? "equal"
                        : within(comparison, limits) ? "different, within the limits"
                                                     : "DIFFERENT";
  return text + fmt::format("{} and {}: {}\n", comparison.a, comparison.b, verdict);
}

std::string comparison_json(const Comparison& comparison, const CompareLimits& limits) {
  JsonValue parts = JsonValue::array();
  for (const ComparedPart& part : comparison.parts) parts.push_back(part_json(part, limits));
  const JsonValue json{{"a", comparison.a},          {"b", comparison.b},
                       {"equal", equal(comparison)}, {"within", within(comparison, limits)},
                       {"facts", comparison.facts},  {"parts", std::move(parts)}};
  return json_text(json);
}

} // namespace tilepack
