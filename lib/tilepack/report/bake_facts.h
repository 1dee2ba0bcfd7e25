#pragma once

#include "tilepack/bake/bake.h"
#include "tilepack/exemplar/sample_traits.h"
#include "tilepack/measure/seams.h"

#include <span>
#include <string>
#include <vector>

namespace tilepack {

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

  bool clear = false; ///< the sample has alpha, which is 0 everywhere
  Size coarsest = {}; ///< of a tile: its last level, where levels end with those of tiles; else empty

  std::string material =
      {}; ///< these are the facts of a material of a transition, as a set by itself; else empty
  std::vector<BakeFacts> materials = {}; ///< of a transition: its materials'
  TransitionFigures transition = {};     ///< of a transition
};

/// Whether its slow tones vary so much that they are remarked upon (verdict_thresholds.h).
bool has_shading(const SampleTraits& nature);

/// Whether all texels of the sample look alike, or none is seen.
bool shows_nothing(const BakeFacts& facts);

/// `samples`: those that baked() got; of a transition, any.
BakeFacts bake_facts(const BakedPack& made, std::span<const SampleMap> samples);

} // namespace tilepack
