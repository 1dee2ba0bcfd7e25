#pragma once

#include <cstdint>
#include <string_view>

namespace tilepack {

/// Every random choice of tilepack: a hash of (seed, purpose, index), never a running state. So a choice does
/// not depend on how many were made before it, on threads or on order.
///
/// `purpose` is a short fixed text ("permutation", "patch start"); equal purposes share a sequence.
std::uint64_t random_bits(std::uint64_t seed, std::string_view purpose, std::uint64_t index);

/// An integer of 0..count-1 from random_bits, by the multiply-shift method (bias below 2^-32); count >= 1.
std::uint32_t random_below(std::uint64_t seed, std::string_view purpose, std::uint64_t index,
                           std::uint32_t count);

/// The finalising mix of splitmix64: a bijection of 64-bit words in which each input bit moves about half of
/// the output bits. The building block of the above, and of the "mix" mapping.
std::uint64_t mixed(std::uint64_t word);

} // namespace tilepack
