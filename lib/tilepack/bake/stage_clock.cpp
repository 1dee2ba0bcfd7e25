#include "tilepack/bake/stage_clock.h"

#include <utility>

namespace tilepack {

Progress StageClock::around(Progress onward) {
  return [this, onward = std::move(onward)](std::string_view stage, double done) {
    begin(stage);
    report(onward, stage, done);
  };
}

void StageClock::begin(std::string_view stage) {
  const auto now = std::chrono::steady_clock::now();
  if (current < stages.size()) stages[current].share += std::chrono::duration<double>(now - since).count();
  since = now;
  current = 0;
  while (current < stages.size() && stages[current].stage != stage) ++current;
  if (current == stages.size()) stages.push_back({std::string(stage), 0.0});
}

std::vector<StageShare> StageClock::shares() {
  begin(stages.empty() ? "reading" : stages[current].stage); // counts what has passed
  double total = 0.0;
  for (const StageShare& s : stages) total += s.share;
  std::vector<StageShare> result;
  for (const StageShare& s : stages)
    if (s.share >= 0.01 * total && total > 0) result.push_back({s.stage, s.share / total});
  return result;
}

} // namespace tilepack
