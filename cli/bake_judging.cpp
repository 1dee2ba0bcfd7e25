#include "bake_judging.h"

#include "tilepack/error/error.h"
#include "tilepack/numeric/enum_names.h"
#include "tilepack/report/advised_bake.h"
#include "tilepack/report/bake_verdict.h"

#include <fmt/format.h>

#include <utility>

namespace tilepack::cli {
namespace {

constexpr int most_tries = 2; // with what the verdict advises

void refuse_worse(const BakeJob& job, const BakeFacts& facts, const JudgingWatch& judging) {
  if (job.require.empty()) return;
  const BakeVerdict verdict = bake_verdict(facts);
  if (verdict.grade <= enum_called<Grade>(job.require, field("require"), "grade")) return;
  if (judging.refused) judging.refused(facts);
  const bool can_try = !job.apply_advice && job.transition.empty();
  throw Error(
      ErrorKind::check_failed, "",
      fmt::format("the set is {}, and {} asks for {}: nothing was written{}", name_of(verdict.grade),
                  field("require"), job.require,
                  can_try ? fmt::format("; {} tries what the verdict names", field("apply-advice")) : ""));
}

} // namespace

void judge(const BakeJob& job, JobWatch& watch, BakeFacts& facts, bool always, const JudgingWatch& judging) {
  const bool is_transition = !job.transition.empty();
  check_advice(job);
  if (is_transition && !job.require.empty()) {
    watch.accept = [&job, &facts, judging](const BakedJob& baked) {
      facts = bake_facts(baked.made, baked.samples);
      refuse_worse(job, facts, judging);
    };
  } else if (job.apply_advice || !job.require.empty()) {
    watch.make = [&job, &facts, judging](std::span<const SampleMap> samples, const BakeOptions&,
                                         const Progress& progress) {
      AdvisedBake best = advised_bake(samples, settings_of(job), job.apply_advice ? most_tries : 0, progress);
      if (judging.note)
        for (const std::string& line : best.story) judging.note(line);
      facts = std::move(best.facts);
      refuse_worse(job, facts, judging);
      return std::move(best.made);
    };
  } else if (always) {
    watch.made = [&facts](const BakedJob& baked) { facts = bake_facts(baked.made, baked.samples); };
  }
}

} // namespace tilepack::cli
