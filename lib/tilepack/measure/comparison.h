#pragma once

#include "tilepack/image/image_file.h"
#include "tilepack/measure/image_metrics.h"
#include "tilepack/pack/pack.h"

#include <optional>
#include <string>
#include <vector>

namespace tilepack {

/// Two images, or one level of one map of two packs.
struct ComparedPart {
  std::string name;                       ///< "color, level 0"; empty for two files
  std::string mismatch;                   ///< why they can't be compared: sizes or channels; else empty
  FullRange range = FullRange::unit;      ///< unit: figures in 1/255 of the range, else plain values
  std::optional<ImageDifference> figures; ///< absent with a mismatch
};

/// Two images or two packs, compared.
struct Comparison {
  std::string a; ///< as the user named them
  std::string b;
  std::vector<std::string>
      facts; ///< packs: what else differs, a sentence each: "tile size: 64 x 64 and 128 x 128"
  std::vector<ComparedPart> parts;
};

/// Compares values as stored. If only one of the two is sRGB-encoded, the other is encoded first; two of
/// integers are held against 0..1 in units of 1/255, others against their own range.
Comparison compared(const ImageFile& a, const ImageFile& b);

/// Every map and level that both packs have, and all that a sampler reads from pack.json. Who made the packs,
/// when they sample alike, makes no difference.
Comparison compared(const Pack& a, const Pack& b);

/// Limits of what counts as alike; none set: only equal will do.
struct CompareLimits {
  std::optional<double> max_difference = std::nullopt; ///< in the part's unit, >= 0
  std::optional<double> min_psnr = std::nullopt;       ///< dB
  std::optional<double> min_ssim = std::nullopt;       ///< -1..1
};

bool equal(const Comparison& comparison);

/// Nothing but values differs, none is NaN or infinite in one only, and every part keeps every limit set.
bool within(const Comparison& comparison, const CompareLimits& limits);

/// For people, and for programs (held to lib/tilepack/measure/compare.schema.json by a test).
std::string comparison_text(const Comparison& comparison, const CompareLimits& limits);
std::string comparison_json(const Comparison& comparison, const CompareLimits& limits);

} // namespace tilepack
