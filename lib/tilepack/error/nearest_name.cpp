#include "tilepack/error/nearest_name.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tilepack {
namespace {

// Damerau's distance in its restricted form: a swapped pair is one mistake, and is not edited again.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  const std::size_t width = b.size() + 1;
  std::vector<std::size_t> d((a.size() + 1) * width);
  const auto at = [&](std::size_t i, std::size_t j) -> std::size_t& { return d[i * width + j]; };
  for (std::size_t i = 0; i <= a.size(); ++i) at(i, 0) = i;
  for (std::size_t j = 0; j <= b.size(); ++j) at(0, j) = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replace = at(i - 1, j - 1) + (a[i - 1] == b[j - 1] ? 0 : 1);
      at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, replace});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
    }
  }
  return at(a.size(), b.size());
}

} // namespace

std::string nearest_name(std::string_view name, std::span<const std::string> known) {
  const auto bare = [](std::string_view text) {
    std::string letters(text.substr(std::min(text.find_first_not_of('-'), text.size())));
    for (char& c : letters) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return letters;
  };
  const std::string asked = bare(name);
  std::string best;
  std::string begun; // with what was asked for
  std::size_t best_distance = ~std::size_t{0};
  for (const std::string& candidate : known) {
    const std::string other = bare(candidate);
    if (asked.size() >= 2 && other.starts_with(asked) && (begun.empty() || candidate.size() < begun.size()))
      begun = candidate;
    const std::size_t distance = edit_distance(asked, other);
    const std::size_t limit = (std::max(asked.size(), other.size()) + 2) / 4;
    if (distance <= limit && distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return begun.empty() ? best : begun;
}

} // namespace tilepack
