#pragma once

#include "tilepack/bake/bake.h"
#include "tilepack/bake/bake_fields.h"
#include "tilepack/report/bake_verdict.h"

#include <span>
#include <string>
#include <vector>

namespace tilepack {

/// A pack that was made again with what its verdict advised.
struct AdvisedBake {
  BakedPack made; ///< the best of all
  BakeFacts facts;
  std::vector<BakeSetting> settings; ///< that it was made with: those given and, after them, the advised ones
  std::vector<std::string>
      story; ///< a line a further bake, fields marked: what was tried and what came of it
};

/// Bakes, and as long as the verdict is not good and names cures that were not tried, bakes again with all of
/// them, at most `most_tries` times; the better pack is kept. A cure that leaves the value open takes the next
/// seed; one that a sample or option forbids ends the tries. Tiles keep the size that was chosen at first, unless a
/// cure names another. `most_tries` 0: one bake. Throws what baked() throws of the first.
AdvisedBake advised_bake(std::span<const SampleMap> samples, std::span<const BakeSetting> settings,
                         int most_tries, const Progress& progress = {});

/// Whether the first is the better one: by grade, then by how many remarks are poor, then fair.
bool is_better(const BakeVerdict& one, const BakeVerdict& other);

} // namespace tilepack
