#include "tilepack/measure/longest_repeat.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>

namespace tilepack {
namespace {

std::size_t as_size(int i) {
  return static_cast<std::size_t>(i);
}

// The starts of all suffixes in lexicographic order. After the step with `reach`, rank orders suffixes by
// their first 2 * reach letters.
std::vector<int> suffix_array(const std::vector<int>& text, std::vector<int>& rank) {
  const int n = static_cast<int>(text.size());
  std::vector<int> order(text.size());
  std::iota(order.begin(), order.end(), 0);
  rank = text;
  std::vector<std::uint64_t> key(text.size());
  for (int reach = 0;; reach = std::max(1, 2 * reach)) {
    for (int i = 0; i < n; ++i) {
      const std::uint64_t after =
          reach == 0 || i + reach >= n ? 0 : static_cast<std::uint64_t>(rank[as_size(i + reach)]) + 1;
      key[as_size(i)] = static_cast<std::uint64_t>(rank[as_size(i)]) << 32 | after;
    }
    std::sort(order.begin(), order.end(), [&](int a, int b) { return key[as_size(a)] < key[as_size(b)]; });
    int classes = 0;
    for (int i = 0; i < n; ++i) {
      if (i > 0 && key[as_size(order[as_size(i)])] != key[as_size(order[as_size(i - 1)])]) ++classes;
      rank[as_size(order[as_size(i)])] = classes;
    }
    if (classes + 1 >= n || reach >= n) return order;
  }
}

} // namespace

LongestRepeat longest_repeat(const std::vector<int>& text) {
  LongestRepeat longest;
  if (text.size() < 2) return longest;
  const int n = static_cast<int>(text.size());
  std::vector<int> rank;
  const std::vector<int> order = suffix_array(text, rank);
  // Kasai's walk: going to the next suffix of the text shortens the common prefix by at most one letter.
  int common = 0;
  for (int i = 0; i < n; ++i) {
    const int place = rank[as_size(i)];
    if (place == 0) {
      common = 0;
      continue;
    }
    const int other = order[as_size(place - 1)];
    while (i + common < n && other + common < n && text[as_size(i + common)] == text[as_size(other + common)])
      ++common;
    if (common > longest.length) longest = {common, {std::min(i, other), std::max(i, other)}};
    common = std::max(0, common - 1);
  }
  return longest;
}

} // namespace tilepack
