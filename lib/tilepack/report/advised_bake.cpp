#include "tilepack/report/advised_bake.h"

#include "tilepack/error/error.h"
#include "tilepack/error/field.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

namespace tilepack {
namespace {

int remarks_of(const BakeVerdict& verdict, Grade grade) {
  return static_cast<int>(std::count_if(verdict.remarks.begin(), verdict.remarks.end(),
                                        [&](const BakeRemark& remark) { return remark.grade == grade; }));
}

std::string value_of(std::span<const BakeSetting> settings, std::string_view name) {
  const BakeSetting* found = setting_of(settings, name);
  return found ? found->value : std::string();
}

// What the verdict advises, the worst first and one value a field; what leaves the value open is settled.
std::vector<BakeSetting> advised(const BakeFacts& facts, std::span<const BakeSetting> now) {
  std::vector<BakeSetting> list;
  for (const BakeRemark& remark : bake_verdict(facts).remarks) {
    if (remark.grade == Grade::good || !remark.cure) continue;
    Cure cure = *remark.cure;
    if (cure.field == "seed" && cure.value.empty()) cure.value = std::to_string(facts.synth.seed + 1);
    if (cure.value.empty() || cure.value == value_of(now, cure.field) || setting_of(list, cure.field))
      continue;
    list.push_back({cure.field, cure.value, field(cure.field), ErrorKind::usage});
  }
  return list;
}

std::string spelled_out(std::span<const BakeSetting> settings) {
  std::string text;
  for (const BakeSetting& setting : settings)
    text = fmt::format("{}{}{}", text, text.empty() ? "" : " ", field(setting.field, setting.value));
  return text;
}

AdvisedBake baked_with(std::span<const SampleMap> samples, std::vector<BakeSetting> settings,
                       const Progress& progress) {
  AdvisedBake result;
  result.made = baked(samples, bake_options(settings), progress);
  result.facts = bake_facts(result.made, samples);
  result.settings = std::move(settings);
  return result;
}

} // namespace

bool is_better(const BakeVerdict& one, const BakeVerdict& other) {
  const auto rank = [](const BakeVerdict& v) {
    return std::tuple(v.grade, remarks_of(v, Grade::poor), remarks_of(v, Grade::fair));
  };
  return rank(one) < rank(other);
}

AdvisedBake advised_bake(std::span<const SampleMap> samples, std::span<const BakeSetting> given,
                         int most_tries, const Progress& progress) {
  AdvisedBake best = baked_with(samples, {given.begin(), given.end()}, progress);
  std::vector<std::vector<BakeSetting>> tried;
  for (int n = 0; n < most_tries; ++n) {
    const BakeVerdict so_far = bake_verdict(best.facts);
    const std::vector<BakeSetting> advice = advised(best.facts, best.settings);
    if (so_far.grade == Grade::good || advice.empty()) break;
    std::vector<BakeSetting> settings = best.settings;
    if (best.facts.size_chosen) {
      const Size tile = best.facts.synth.tile_size;
      settings.push_back(
          {"tile-size", fmt::format("{}x{}", tile.width, tile.height), field("tile-size"), ErrorKind::usage});
    }
    settings.insert(settings.end(), advice.begin(), advice.end());
    const auto same = [&](const std::vector<BakeSetting>& before) {
      return spelled_out(before) == spelled_out(settings);
    };
    if (std::any_of(tried.begin(), tried.end(), same)) break;
    tried.push_back(settings);
    try {
      AdvisedBake next = baked_with(samples, settings, progress);
      const BakeVerdict verdict = bake_verdict(next.facts);
      const bool kept = is_better(verdict, so_far);
      std::vector<std::string> story = std::move(best.story);
      story.push_back(fmt::format("advice {}: {}: {} after {}, {}", n + 1, spelled_out(advice),
                                  name_of(verdict.grade), name_of(so_far.grade),
                                  kept ? "kept" : "no better, so not kept"));
      if (kept) best = std::move(next);
      best.story = std::move(story);
      if (!kept) break;
    } catch (const Error& error) {
      best.story.push_back(fmt::format("advice {}: {}: can't be followed: {}", n + 1, spelled_out(advice),
                                       error.what_happened()));
      break;
    }
  }
  return best;
}

} // namespace tilepack
