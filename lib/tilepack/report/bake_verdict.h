#pragma once

#include "tilepack/numeric/enum_names.h"
#include "tilepack/report/bake_facts.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// A tile size as its option has it: "128", or "128x88".
std::string tile_size_value(Size size);

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
