#include "value_check.h"
#include "verb.h"

#include "tilepack/bake/round_trip.h"
#include "tilepack/image/image_file.h"
#include "tilepack/json/json_value.h"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

namespace tilepack::cli {
namespace {

struct LayoutsArguments {
  std::optional<int> tiles;
  int up_to = 200;
  int tile_side = 128;
  int gutter = 0;
  bool power_of_two = false;
  std::string format = "text";
  std::string sample; ///< advice: measure the loss on it
};

LayoutRequest request_for(int tiles, const LayoutsArguments& arguments) {
  LayoutRequest request;
  request.tiles = tiles;
  request.tile_side = arguments.tile_side;
  request.gutter = arguments.gutter;
  request.power_of_two = arguments.power_of_two;
  return request;
}

double share(std::int64_t wasted, std::int64_t texels) {
  return 100.0 * static_cast<double>(wasted) / static_cast<double>(texels);
}

std::string nesting(const RotatedScheme& scheme) {
  std::string text;
  for (const int count : nested_counts(scheme)) text += fmt::format("{}{}", text.empty() ? "" : " · ", count);
  return text;
}

// What padding to a power of two would leave empty, in percent of the texture.
double padding(int tiles, int tile_side) {
  const std::int64_t padded = padded_texels(tiles, tile_side);
  return share(padded - std::int64_t{tiles} * tile_side * tile_side, padded);
}

JsonValue plan_json(const LayoutCandidate& plan) {
  const std::int64_t texels = std::int64_t{plan.size.width} * plan.size.height;
  return {{"scheme", formula(plan.scheme)},
          {"n", plan.scheme.n},
          {"k", plan.scheme.k},
          {"squares", plan.scheme.squares},
          {"nested", nested_counts(plan.scheme)},
          {"angle", angle_in_degrees(plan.scheme)},
          {"size", JsonValue::array({plan.size.width, plan.size.height})},
          {"copied", plan.copied},
          {"wasted_texels", plan.wasted},
          {"wasted_percent", share(plan.wasted, texels)}};
}

std::vector<RoundTrip> losses(const LayoutCandidate& plan, const LayoutsArguments& arguments) {
  if (arguments.sample.empty()) return {};
  ImageFile file = read_image(arguments.sample);
  const SampleMap sample{arguments.sample, Role::color, file.encoding, file.depth, std::move(file.image)};
  return round_trips(sample, plan, arguments.tile_side);
}

JsonValue row_json(int tiles, const LayoutsArguments& arguments) {
  JsonValue plans = JsonValue::array();
  for (const LayoutCandidate& plan : layout_plans(request_for(tiles, arguments))) {
    JsonValue json = plan_json(plan);
    for (const RoundTrip& trip : losses(plan, arguments))
      json["psnr"][std::string(name_of(trip.filter))] = trip.psnr;
    plans.push_back(std::move(json));
  }
  return {{"tiles", tiles},
          {"plans", std::move(plans)},
          {"padded_texels", padded_texels(tiles, arguments.tile_side)},
          {"padded_percent", padding(tiles, arguments.tile_side)}};
}

std::string plan_text(const LayoutCandidate& plan) {
  const std::int64_t texels = std::int64_t{plan.size.width} * plan.size.height;
  return fmt::format("{:<18} {:>6.2f}°  {:>5} x {:<5}  {:>6.2f} %  {}", formula(plan.scheme),
                     angle_in_degrees(plan.scheme), plan.size.width, plan.size.height,
                     share(plan.wasted, texels), plan.copied ? "copied" : "turned");
}

std::string table_text(const std::vector<int>& counts, const LayoutsArguments& arguments) {
  std::string text =
      fmt::format("Tiles of {0} x {0} texels, gutter {1}. Waste in percent of the texture.\n\n"
                  "tiles  scheme              angle    texture          waste  stored   padded  nested\n",
                  arguments.tile_side, arguments.gutter);
  for (const int tiles : counts) {
    const LayoutCandidate best = layout_plans(request_for(tiles, arguments)).front();
    text += fmt::format("{:>5}  {}  {:>6.2f} %  {}\n", tiles, plan_text(best),
                        padding(tiles, arguments.tile_side), nesting(best.scheme));
  }
  return text;
}

std::string advice_text(int tiles, const LayoutsArguments& arguments) {
  std::string text =
      fmt::format("{0} tiles of {1} x {1} texels, best first:\n\n", tiles, arguments.tile_side);
  int place = 1;
  for (const LayoutCandidate& plan : layout_plans(request_for(tiles, arguments))) {
    text += fmt::format("  {}  {}  --layout rotated --scheme {},{}{}\n", place++, plan_text(plan),
                        plan.scheme.n, plan.scheme.k, plan.scheme.squares == 2 ? ",2" : "");
    for (const RoundTrip& trip : losses(plan, arguments))
      text += fmt::format("       stored and read back, {}: {}\n", name_of(trip.filter),
                          trip.psnr ? fmt::format("{:.1f} dB", *trip.psnr) : "exact");
  }
  text += fmt::format("\nPadded to powers of two they would leave {:.2f} % of the texture empty.\n"
                      "The nearest other counts without waste are {} and {}.\n",
                      padding(tiles, arguments.tile_side), tiles > 1 ? reachable_counts(tiles - 1).below : 0,
                      reachable_counts(tiles + 1).above);
  return text;
}

int run_layouts(const LayoutsArguments& arguments, Console& console) {
  if (!arguments.sample.empty() && !arguments.tiles)
    throw Error(ErrorKind::usage, "--sample", "goes with --tiles: name the count that is to be measured");
  const bool json = arguments.format == "json";
  if (arguments.tiles) {
    console.print(json ? json_text(row_json(*arguments.tiles, arguments))
                       : advice_text(*arguments.tiles, arguments));
    return 0;
  }
  std::vector<int> counts;
  for (int tiles = 1; tiles <= arguments.up_to; ++tiles)
    if (!rotated_schemes(tiles).empty()) counts.push_back(tiles);
  if (!json) {
    console.print(table_text(counts, arguments));
    return 0;
  }
  JsonValue rows = JsonValue::array();
  for (const int tiles : counts) rows.push_back(row_json(tiles, arguments));
  console.print(json_text({{"tile_size", arguments.tile_side}, {"layouts", std::move(rows)}}));
  return 0;
}

Action declare_layouts(Options& options) {
  auto arguments = std::make_shared<LayoutsArguments>();
  options.option("--tiles", arguments->tiles, "advice for this many tiles, 1 to 65535")
      .check(whole_number(1, max_rotated_tiles - 1))
      .value("N");
  options.option("--up-to", arguments->up_to, "largest tile count of the table, 1 to 4096")
      .check(whole_number(1, 4096))
      .value("N");
  options.option("--tile-size", arguments->tile_side, "side of a tile in texels, 1 to 4096")
      .check(whole_number(1, 4096))
      .value("N");
  options.option("--gutter", arguments->gutter, "texels round each tile, 0 to the tile's side")
      .check(whole_number(0, 4096, ", and at most the tile's side"))
      .value("N");
  options
      .option("--sample", arguments->sample,
              "with --tiles: measure what turning loses on windows of this image")
      .value("IMAGE");
  options.flag("--power-of-two", arguments->power_of_two, "sides of the texture are powers of two");
  options.option("--format", arguments->format, "of the table").one_of("text|json");
  return [arguments](Console& console) { return run_layouts(*arguments, console); };
}

} // namespace

Verb layouts_verb() {
  return {"layouts", "list which tile counts pack without waste, and how",
          "  tilepack layouts --up-to 50 --tile-size 64\n"
          "  tilepack layouts --tiles 18\n"
          "  tilepack layouts --tiles 13 --sample gravel.png\n",
          declare_layouts};
}

} // namespace tilepack::cli
