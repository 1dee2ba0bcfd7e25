#include "tilepack/measure/layout_losses.h"

#include "tilepack/bake/round_trip.h"

namespace tilepack {
namespace {

double percent(std::int64_t part, std::int64_t whole) {
  return 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

JsonValue layout_value(const LayoutAnswer& answer) {
  const LayoutCandidate& layout = answer.candidate;
  JsonValue json{{"scheme", formula(layout.scheme)},
                 {"n", layout.scheme.n},
                 {"k", layout.scheme.k},
                 {"squares", layout.scheme.squares},
                 {"nested", nested_counts(layout.scheme)},
                 {"angle", angle_in_degrees(layout.scheme)},
                 {"size", JsonValue::array({layout.size.width, layout.size.height})},
                 {"copied", layout.copied},
                 {"wasted_texels", layout.wasted},
                 {"wasted_percent", answer.wasted_percent}};
  for (const RoundTrip& trip : answer.losses) json["psnr"][name_of(trip.filter)] = trip.psnr;
  return json;
}

} // namespace

LayoutAnswers layout_answers(int tiles, const LayoutQuestion& question) {
  LayoutRequest request;
  request.tiles = tiles;
  request.tile_side = question.tile_side;
  request.gutter = question.gutter;
  request.power_of_two = question.power_of_two;
  LayoutAnswers answers;
  answers.tiles = tiles;
  for (const LayoutCandidate& candidate : layout_plans(request)) {
    const std::int64_t texels = std::int64_t{candidate.size.width} * candidate.size.height;
    answers.layouts.push_back({candidate, percent(candidate.wasted, texels), {}});
    if (question.sample)
      answers.layouts.back().losses = round_trips(*question.sample, candidate, question.tile_side);
  }
  answers.padded_texels = padded_texels(tiles, question.tile_side);
  const std::int64_t used = std::int64_t{tiles} * question.tile_side * question.tile_side;
  answers.padded_percent = percent(answers.padded_texels - used, answers.padded_texels);
  return answers;
}

std::vector<int> counts_without_waste(int most) {
  std::vector<int> counts;
  for (int tiles = 1; tiles <= most; ++tiles)
    if (!rotated_schemes(tiles).empty()) counts.push_back(tiles);
  return counts;
}

JsonValue layout_answers_value(const LayoutAnswers& answers) {
  JsonValue layouts = JsonValue::array();
  for (const LayoutAnswer& answer : answers.layouts) layouts.push_back(layout_value(answer));
  return {{"tiles", answers.tiles},
          {"plans", std::move(layouts)},
          {"padded_texels", answers.padded_texels},
          {"padded_percent", answers.padded_percent}};
}

} // namespace tilepack
