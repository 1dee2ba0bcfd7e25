#pragma once

#include "tilepack/lookup/pack_lookup.h"
#include "tilepack/pack/pack.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace tilepack {

/// The words of a pack's lookup, with the tables by tile that they point to. May be moved; the words stay
/// good.
class LookupTables {
public:
  /// `pack.mapping` must outlive this; nothing else of the pack is kept. Error (invalid_content) for sides beyond
  /// 2^31 tiles, and more than 65536 columns or rows. (read_pack() lets none of these through.)
  explicit LookupTables(const Pack& pack);

  /// The same pack with another mapping, which must outlive this in place of the pack's.
  LookupTables(const Pack& pack, const Mapping& mapping);

  LookupTables(LookupTables&&) noexcept = default;
  LookupTables& operator=(LookupTables&&) noexcept = default;
  LookupTables(const LookupTables&) = delete;
  LookupTables& operator=(const LookupTables&) = delete;

  const PackLookup& words() const { return lookup; }
  std::size_t bytes() const { return (places.size() + colors.size()) * sizeof(std::uint32_t); }

private:
  std::vector<std::uint32_t> places, colors;
  PackLookup lookup;
};

} // namespace tilepack
