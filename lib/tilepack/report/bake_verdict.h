#pragma once

#include "tilepack/bake/bake.h"
#include "tilepack/exemplar/sample_traits.h"
#include "tilepack/measure/seams.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// All that can be said about a finished bake, in numbers.
struct BakeFacts {
  SetReport report;
  SeamFigures seams;     ///< of level 0 of the first map
  SampleTraits nature;   ///< of the sample as used: after flattening
  SynthOptions synth;    ///< as used
  int flatten = 0;       ///< percent, as used
  double flat_drift = 0; ///< nature.drift with --flatten 100; only found where it matters, else 0
  Size sample;
  int tiles = 0;
};

/// `samples`: those that baked() got.
BakeFacts bake_facts(const BakedPack& made, std::span<const SampleMap> samples);

enum class Grade { good, fair, poor };
std::string_view name_of(Grade grade);

/// One finding in plain words: what was found, and where it is not good, which option to turn.
struct BakeRemark {
  Grade grade = Grade::good;
  std::string text;
  bool operator==(const BakeRemark&) const = default;
};

/// By fixed rules from the figures; the limits stand in bake_verdict.cpp with the samples they come from.
struct BakeVerdict {
  Grade grade = Grade::good;       ///< the worst of the remarks
  std::vector<BakeRemark> remarks; ///< the worst first
};

BakeVerdict bake_verdict(const BakeFacts& facts);

} // namespace tilepack
