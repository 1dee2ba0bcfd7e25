#pragma once

#include "tilepack/error/progress.h"
#include "tilepack/json/json_value.h"
#include "tilepack/numeric/enum_names.h"
#include "tilepack/pack/pack.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// Where in its tile a bilinear lookup lies: what it reads is within the tile, across one border, or across
/// two.
enum class Zone { interior, edge, corner };

template <>
inline constexpr auto enum_names<Zone> = std::array{
    EnumName{Zone::interior, "interior"}, EnumName{Zone::edge, "edge"}, EnumName{Zone::corner, "corner"}};

/// How far bilinear lookups through the pack are from the ground truth, in one zone of one level.
///
/// Errors are of encoded values in 8-bit units (255 is full scale), over all channels, at places drawn at
/// random.
struct ZoneError {
  Zone zone = Zone::interior;
  int lookups = 0;            ///< 0 where a level has no such places: tiles of one texel have no interior
  double mean = 0;            ///< absolute
  double rms = 0;             ///<
  double largest = 0;         ///<
  std::optional<double> psnr; ///< dB against full scale; absent where rms is no more than rounding of doubles
  double neighbours = 0; ///< largest error due to wrong neighbours alone: against the levels as stored, so
                         ///< that neither rounding nor sanitizing counts. 0 means exactly 0
};

struct LevelError {
  int level = 0;
  std::vector<ZoneError> zones; ///< interior, edge, corner
  double jump = 0;              ///< RMS of the step that a lookup makes across a border, away from corners
  double corner_jump = 0;       ///< the same within half a texel of corners
};

/// One map of a pack held against what it stands for.
struct ReferenceErrors {
  std::string map;
  std::string mips; ///< how the levels were made: name_of(MipMode)
  int guard = 0;
  std::vector<LevelError> levels;
};

/// Bilinear lookups at `lookups` places a zone and level, the same for every pack of a seed. Deterministic.
ReferenceErrors against_reference(const Pack& pack, int map, int lookups, std::uint64_t seed,
                                  const Progress& progress = {});

/// All maps of `pack`.
std::vector<ReferenceErrors> against_reference(const Pack& pack, int lookups, std::uint64_t seed,
                                               const Progress& progress = {});

/// A table for people; one line a level and zone, comma separated, with a header; and JSON, an array.
std::string reference_errors_text(const std::vector<ReferenceErrors>& errors);
std::string reference_errors_csv(const std::vector<ReferenceErrors>& errors);
JsonValue reference_errors_value(const std::vector<ReferenceErrors>& errors);
std::string reference_errors_json(const std::vector<ReferenceErrors>& errors);

} // namespace tilepack
