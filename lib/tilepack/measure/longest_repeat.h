#pragma once

#include <vector>

namespace tilepack {

/// The longest stretch of a text that occurs at two places (which may overlap): its length, and where the two
/// start. Length 0 if every letter is different.
struct LongestRepeat {
  int length = 0;
  int start[2] = {};
};

/// By a suffix array built by doubling: O(n log² n), some 0.1 s for 65536 letters. Letters are any integers
/// >= 0.
LongestRepeat longest_repeat(const std::vector<int>& text);

} // namespace tilepack
