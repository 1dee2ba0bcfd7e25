#include "tilepack/report/size_choice.h"

#include "tilepack/error/field.h"
#include "tilepack/tileset/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace tilepack {
namespace {

double texels_of(Size size) {
  return static_cast<double>(size.width) * size.height;
}

int fourth_power(int x) {
  return x * x * x * x;
}

std::string spelled_out(const std::vector<Cure>& options) {
  std::string text;
  for (const Cure& option : options)
    text = fmt::format("{}{}{}", text, text.empty() ? "" : " ", field(option.field, option.value));
  return text;
}

// "2.6", and "26" where the fraction has nothing to say.
std::string times(double factor) {
  return factor < 10 ? fmt::format("{:.1f}", factor) : fmt::format("{:.0f}", factor);
}

} // namespace

SizeChoice size_choice(const BakeFacts& facts) {
  const SynthOptions& o = facts.synth;
  SizeChoice choice;
  choice.times_sample = facts.tiles * texels_of(o.tile_size) / texels_of(facts.sample);
  if (shows_nothing(facts)) return choice; // any size shows the same
  const auto side = static_cast<int>(
      std::bit_floor(static_cast<unsigned>(std::min(o.tile_size.width, o.tile_size.height) - 1)));
  if (side >= 16) {
    choice.smaller.push_back({"tile-size", tile_size_value(Size{side, side})});
    choice.smaller_memory = texels_of({side, side}) / texels_of(o.tile_size);
    // Met by pebbles, gravel and grass to within 8 points of a hundred.
    choice.smaller_shows =
        1 - std::pow(1 - std::min(facts.report.figures.coverage, 0.99), std::pow(choice.smaller_memory, 1.4));
  }
  const bool corner = o.coloring == Coloring::corner;
  const int colors = corner ? o.colors.corner : std::max(o.colors.horizontal, o.colors.vertical);
  const bool complete = facts.tiles == (corner ? fourth_power(colors)
                                               : o.colors.horizontal * o.colors.horizontal *
                                                     o.colors.vertical * o.colors.vertical);
  if (colors < (corner ? limits::most_corner_colors : limits::most_edge_colors)) {
    choice.richer = {{"colors", fmt::format("{}", colors + 1)}, {"tile-size", tile_size_value(o.tile_size)}};
    choice.richer_tiles = complete ? fourth_power(colors + 1) : 2 * (colors + 1) * (colors + 1);
  }
  return choice;
}

std::string size_choice_text(const BakeFacts& facts) {
  const SizeChoice choice = size_choice(facts);
  std::string text =
      fmt::format("chosen for this sample; the tiles hold {} times its texels", times(choice.times_sample));
  if (!choice.smaller.empty())
    text += fmt::format(". Smaller: {}, {:.0f} % of the memory, shows about {:.0f} % of the sample",
                        spelled_out(choice.smaller), choice.smaller_memory * 100, choice.smaller_shows * 100);
  if (!choice.richer.empty())
    text += fmt::format(". Richer: {}, {} tiles, {} times the memory", spelled_out(choice.richer),
                        choice.richer_tiles, times(static_cast<double>(choice.richer_tiles) / facts.tiles));
  return text + ".";
}

} // namespace tilepack
