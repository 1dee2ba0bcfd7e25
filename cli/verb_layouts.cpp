#include "sample_reading.h"
#include "value_check.h"
#include "verb.h"

#include "tilepack/image/image_file.h"
#include "tilepack/json/json_value.h"
#include "tilepack/measure/layout_losses.h"
#include "tilepack/tileset/limits.h"

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
  ReadingArguments reading;
};

LayoutQuestion question_of(const LayoutsArguments& arguments, Console& console) {
  LayoutQuestion question{arguments.tile_side, arguments.gutter, arguments.power_of_two, {}};
  if (!arguments.sample.empty()) {
    ImageFile file = read_noted(arguments.sample, arguments.reading, Role::color, console);
    question.sample =
        SampleMap{arguments.sample, Role::color, file.encoding, file.depth, std::move(file.image)};
  }
  return question;
}

std::string nesting(const RotatedScheme& scheme) {
  std::string text;
  for (const int count : nested_counts(scheme)) text += fmt::format("{}{}", text.empty() ? "" : " · ", count);
  return text;
}

std::string layout_text(const LayoutAnswer& answer) {
  const LayoutCandidate& layout = answer.candidate;
  return fmt::format("{:<18} {:>6.2f}°  {:>5} x {:<5}  {:>6.2f} %  {}", formula(layout.scheme),
                     angle_in_degrees(layout.scheme), layout.size.width, layout.size.height,
                     answer.wasted_percent, layout.copied ? "copied" : "turned");
}

std::string table_text(const std::vector<int>& counts, const LayoutQuestion& question) {
  std::string text =
      fmt::format("Tiles of {0} x {0} texels, gutter {1}. Waste in percent of the texture.\n\n"
                  "tiles  scheme              angle    texture          waste  stored   padded  nested\n",
                  question.tile_side, question.gutter);
  for (const int tiles : counts) {
    const LayoutAnswers answers = layout_answers(tiles, question);
    const LayoutAnswer& best = answers.layouts.front();
    text += fmt::format("{:>5}  {}  {:>6.2f} %  {}\n", tiles, layout_text(best), answers.padded_percent,
                        nesting(best.candidate.scheme));
  }
  return text;
}

std::string advice_text(int tiles, const LayoutQuestion& question) {
  const LayoutAnswers answers = layout_answers(tiles, question);
  std::string text = fmt::format("{0} tiles of {1} x {1} texels, best first:\n\n", tiles, question.tile_side);
  int place = 1;
  for (const LayoutAnswer& answer : answers.layouts) {
    const RotatedScheme& scheme = answer.candidate.scheme;
    text += fmt::format("  {}  {}  --layout rotated --scheme {},{}{}\n", place++, layout_text(answer),
                        scheme.n, scheme.k, scheme.squares == 2 ? ",2" : "");
    for (const RoundTrip& trip : answer.losses)
      text += fmt::format("       stored and read back, {}: {}\n", name_of(trip.filter),
                          trip.psnr ? fmt::format("{:.1f} dB", *trip.psnr) : "exact");
  }
  text += fmt::format("\nPadded to powers of two they would leave {:.2f} % of the texture empty.\n"
                      "The nearest other counts without waste are {} and {}.\n",
                      answers.padded_percent, tiles > 1 ? reachable_counts(tiles - 1).below : 0,
                      reachable_counts(tiles + 1).above);
  return text;
}

int run_layouts(const LayoutsArguments& arguments, Console& console) {
  if (!arguments.sample.empty() && !arguments.tiles)
    throw Error(ErrorKind::usage, "--sample", "goes with --tiles: name the count that is to be measured");
  const bool json = arguments.format == "json";
  const LayoutQuestion question = question_of(arguments, console);
  if (arguments.tiles) {
    console.print(json ? json_text(layout_answers_value(layout_answers(*arguments.tiles, question)))
                       : advice_text(*arguments.tiles, question));
    return 0;
  }
  const std::vector<int> counts = counts_without_waste(arguments.up_to);
  if (!json) {
    console.print(table_text(counts, question));
    return 0;
  }
  JsonValue rows = JsonValue::array();
  for (const int tiles : counts) rows.push_back(layout_answers_value(layout_answers(tiles, question)));
  console.print(json_text({{"tile_size", arguments.tile_side}, {"layouts", std::move(rows)}}));
  return 0;
}

Action declare_layouts(Options& options) {
  auto arguments = std::make_shared<LayoutsArguments>();
  options
      .option("--tiles", arguments->tiles,
              fmt::format("advice for this many tiles, 1 to {}", max_rotated_tiles - 1))
      .check(whole_number(1, max_rotated_tiles - 1))
      .value("N");
  options
      .option("--up-to", arguments->up_to,
              fmt::format("largest tile count of the table, 1 to {} (default 200)", limits::most_tiles))
      .check(whole_number(1, limits::most_tiles))
      .value("N");
  options
      .option("--tile-size", arguments->tile_side,
              fmt::format("side of a tile in texels, 1 to {} (default 128)", limits::largest_tile_side))
      .check(whole_number(1, limits::largest_tile_side))
      .value("N");
  options.option("--gutter", arguments->gutter, "texels round each tile, 0 to the tile's side (default 0)")
      .check(whole_number(0, limits::largest_gutter, ", and at most the tile's side"))
      .value("N");
  options
      .option("--sample", arguments->sample,
              "with --tiles: measure what turning loses on windows of this image")
      .value("IMAGE");
  options.flag("--power-of-two", arguments->power_of_two, "sides of the texture are powers of two");
  options.option("--format", arguments->format, "of the table (default text)").one_of("text|json");
  options.explain_extra([](const std::string& extra) {
    return whole_number(1, max_rotated_tiles - 1)(extra).empty()
               ? fmt::format("; for advice on so many tiles: --tiles {}", extra)
               : std::string();
  });
  add_reading_options(options, arguments->reading);
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
