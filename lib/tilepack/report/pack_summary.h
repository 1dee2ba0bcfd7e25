#pragma once

#include "tilepack/measure/seams.h"
#include "tilepack/pack/pack_json.h"
#include "tilepack/report/bake_verdict.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace tilepack {

/// What an artist or a programmer wants to know of a pack before using it.
struct PackSummary {
  std::string subject; ///< the pack, as the user named it
  PackDescription description;
  std::map<std::string, std::uint64_t> file_bytes; ///< file → bytes on disk, as far as known
  std::optional<SeamFigures> seams;                ///< of level 0 of the first map, if the images were read
};

/// Bytes of the files that are there.
std::uint64_t bytes_on_disk(const PackSummary& summary);

/// Figures of synthesis that tell how good a set is, in a line without its end. Steps are RMS differences in
/// 8-bit units, as in SetFigures.
std::string figures_text(const SetFigures& figures);

std::string summary_text(const PackSummary& summary);
std::string summary_json(const PackSummary& summary);

/// What bake and pack say in JSON of the pack they made in `folder`; with `facts`, how good its set is.
std::string made_json(const PackDescription& made, const std::string& folder,
                      const BakeFacts* facts = nullptr);

/// The part of it about the set alone: figures and verdict.
std::string judged_json(const BakeFacts& facts);

} // namespace tilepack
