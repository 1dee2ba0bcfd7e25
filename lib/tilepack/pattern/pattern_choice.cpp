#include "tilepack/pattern/pattern_choice.h"

#include "tilepack/error/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tilepack {

std::vector<int> probability_map(std::span<const double> shares, int entries) {
  constexpr double tolerance = 1e-6;
  const double sum = std::accumulate(shares.begin(), shares.end(), 0.0);
  const auto negative = [](double share) { return !(share >= 0); };
  if (entries < 1 || entries > 65536 || std::any_of(shares.begin(), shares.end(), negative) ||
      !(std::fabs(sum - 1) <= tolerance))
    throw Error(
        ErrorKind::invalid_content, "probabilities",
        fmt::format(
            "{} of them sum to {:.6g} for a map of {} entries; none may be negative, they must sum to 1, "
            "and a map has 1 to 65536 entries",
            shares.size(), sum, entries));
  std::vector<int> counts;
  std::vector<std::pair<double, int>> remainders; // the largest first, of equals the first pattern
  int given = 0;
  for (const double share : shares) {
    const double wanted = share * entries;
    const int whole = static_cast<int>(std::floor(wanted + 1e-9));
    remainders.emplace_back(whole - wanted, static_cast<int>(counts.size()));
    counts.push_back(whole);
    given += whole;
  }
  std::sort(remainders.begin(), remainders.end());
  for (std::size_t i = 0; given < entries; ++i, ++given)
    ++counts[static_cast<std::size_t>(remainders[i].second)];
  std::vector<int> map;
  for (std::size_t pattern = 0; pattern < counts.size(); ++pattern)
    map.insert(map.end(), static_cast<std::size_t>(counts[pattern]), static_cast<int>(pattern));
  map.resize(static_cast<std::size_t>(entries), map.empty() ? 0 : map.back());
  return map;
}

std::vector<double> shares_of(std::span<const int> map, int patterns) {
  std::vector<double> shares(static_cast<std::size_t>(patterns));
  for (const int pattern : map)
    if (pattern >= 0) shares[static_cast<std::size_t>(pattern)] += 1.0 / static_cast<double>(map.size());
  return shares;
}

} // namespace tilepack
