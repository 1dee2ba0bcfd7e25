#pragma once

#include "tilepack/bake/bake.h"
#include "tilepack/exemplar/sample_traits.h"
#include "tilepack/measure/seams.h"
#include "tilepack/numeric/enum_names.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// A tile size as its option has it: "128", or "128x88".
std::string tile_size_value(Size size);

/// All that can be said about a finished bake, in numbers.
struct BakeFacts {
  SetReport report;
  SeamFigures seams;     ///< of level 0 of the first map
  SampleTraits nature;   ///< of the sample as used: after straightening and flattening
  SynthOptions synth;    ///< as used
  int flatten = 0;       ///< percent, as used
  double flat_drift = 0; ///< nature.drift with --flatten 100; only found where it matters, else 0
  Size sample;
  int tiles = 0;
  std::string fireflies = {}; ///< how many of the sample and where, as listed() has it; empty: none
  bool size_chosen = false;   ///< synth.tile_size was found to suit the sample
  double straightened = 0;    ///< texels, the furthest that a course of the sample was moved; 0: none was
  bool tones_chosen = false;  ///< flatten, more than 0, was found to suit the sample
  bool levelled = false;      ///< flattening went course by course, each by itself

  std::string material =
      {}; ///< these are the facts of a material of a transition, as a set by itself; else empty
  std::vector<BakeFacts> materials = {}; ///< of a transition: its materials'
  TransitionFigures transition = {};     ///< of a transition
};

/// `samples`: those that baked() got; of a transition, any.
BakeFacts bake_facts(const BakedPack& made, std::span<const SampleMap> samples);

enum class Grade { good, fair, poor };
template <>
inline constexpr auto enum_names<Grade> =
    std::array{EnumName{Grade::good, "good"}, EnumName{Grade::fair, "fair"}, EnumName{Grade::poor, "poor"}};

/// What to bake with instead: an option by its field, and the value to give it. An empty value leaves the
/// choice: another seed, a larger tile.
struct Cure {
  std::string field;
  std::string value;
  bool operator==(const Cure&) const = default;
};

/// One finding: what was found, and where it is not good, which option to turn.
struct BakeRemark {
  Grade grade = Grade::good;
  std::string code;         ///< what is meant, for programs: "cuts-seen", "sample-small", … (remark_codes)
  std::string text;         ///< in plain words, options as marked fields (error/field.h)
  std::optional<Cure> cure; ///< the first that `text` names
  bool operator==(const BakeRemark&) const = default;
};

/// By fixed rules from the figures; the limits stand in verdict_thresholds.h with what set them.
struct BakeVerdict {
  Grade grade = Grade::good;       ///< the worst of the remarks
  std::vector<BakeRemark> remarks; ///< the worst first
};

/// Every code that a remark can have.
std::span<const std::string_view> remark_codes();

BakeVerdict bake_verdict(const BakeFacts& facts);

/// What can be judged of a finished pack, whose sample isn't there: cuts, borders and variety by its
/// Pack::synthesis. No remarks where it holds no such figures, or options that can't be read.
BakeVerdict pack_verdict(const Pack& pack);

/// A figure as it is held against the limits of verdict_thresholds.h, in their units; a limit that is absent
/// does not exist. Some count only together: two tones with ink, coverage with variety, both of a mark.
struct JudgedFigure {
  std::string_view name;
  double value = 0;
  std::optional<double> fair;
  std::optional<double> poor;
};

/// All of them but those of repeats, in a fixed order: for setting the limits again.
std::vector<JudgedFigure> judged_figures(const BakeFacts& facts);

} // namespace tilepack
