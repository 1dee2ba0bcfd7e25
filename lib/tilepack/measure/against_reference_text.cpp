#include "tilepack/measure/against_reference.h"

#include <fmt/format.h>

namespace tilepack {
namespace {

std::string decibels(const ZoneError& error) {
  return error.lookups == 0 ? "" : error.psnr ? fmt::format("{:.2f}", *error.psnr) : "exact";
}

} // namespace

std::string reference_errors_text(const std::vector<ReferenceErrors>& errors) {
  std::string text;
  for (const ReferenceErrors& map : errors) {
    text += fmt::format("{}: bilinear lookups through the pack against the virtual texture's true mips\n"
                        "mips {}, guard {}; errors in 8-bit units of the encoded value\n"
                        "  level  zone        PSNR dB     mean      rms  largest  neighbours     jump\n",
                        map.map, map.mips, map.guard);
    for (const LevelError& level : map.levels)
      for (const ZoneError& zone : level.zones) {
        if (zone.lookups == 0) continue;
        text += fmt::format("  {:>5}  {:<9} {:>9} {:>8.3f} {:>8.3f} {:>8.3f} {:>11.3f}", level.level,
                            name_of(zone.zone), decibels(zone), zone.mean, zone.rms, zone.largest,
                            zone.neighbours);
        if (zone.zone != Zone::interior)
          text += fmt::format(" {:>8.3f}", zone.zone == Zone::edge ? level.jump : level.corner_jump);
        text += '\n';
      }
  }
  return text;
}

std::string reference_errors_csv(const std::vector<ReferenceErrors>& errors) {
  std::string text = "map,mips,guard,level,zone,lookups,psnr_db,mean,rms,largest,neighbours,jump\n";
  for (const ReferenceErrors& map : errors)
    for (const LevelError& level : map.levels)
      for (const ZoneError& zone : level.zones) {
        const double jump = zone.zone == Zone::edge     ? level.jump
                            : zone.zone == Zone::corner ? level.corner_jump
                                                        : 0;
        text += fmt::format("{},{},{},{},{},{},{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f}\n", map.map, map.mips,
                            map.guard, level.level, name_of(zone.zone), zone.lookups,
                            zone.psnr ? fmt::format("{:.4f}", *zone.psnr) : "", zone.mean, zone.rms,
                            zone.largest, zone.neighbours, jump);
      }
  return text;
}

JsonValue reference_errors_value(const std::vector<ReferenceErrors>& errors) {
  JsonValue list = JsonValue::array();
  for (const ReferenceErrors& map : errors) {
    JsonValue levels = JsonValue::array();
    for (const LevelError& level : map.levels) {
      JsonValue zones = JsonValue::array();
      for (const ZoneError& zone : level.zones)
        zones.push_back({{"zone", name_of(zone.zone)},
                         {"lookups", zone.lookups},
                         {"psnr", zone.psnr},
                         {"mean", zone.mean},
                         {"rms", zone.rms},
                         {"largest", zone.largest},
                         {"neighbours", zone.neighbours}});
      levels.push_back({{"level", level.level},
                        {"zones", std::move(zones)},
                        {"jump", level.jump},
                        {"corner_jump", level.corner_jump}});
    }
    list.push_back(
        {{"map", map.map}, {"mips", map.mips}, {"guard", map.guard}, {"levels", std::move(levels)}});
  }
  return list;
}

std::string reference_errors_json(const std::vector<ReferenceErrors>& errors) {
  return json_text(reference_errors_value(errors));
}

} // namespace tilepack
