#pragma once

#include <tbb/parallel_for.h>

#include <cstddef>
#include <exception>
#include <vector>

namespace tilepack {

/// work(0), work(1) … work(count - 1), on all threads. What the first of them threw is thrown when all have ended.
///
/// For work that has parallel loops of its own: in tbb::parallel_for and tbb::parallel_invoke, what one piece
/// throws ends the loops within all others half-way and without a word, and these go on with results that are
/// not there.
template <typename Work>
void each_side_by_side(std::size_t count, const Work& work) {
  std::vector<std::exception_ptr> faults(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    try {
      work(i);
    } catch (...) {
      faults[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& fault : faults)
    if (fault) std::rethrow_exception(fault);
}

/// The same of two works that are not alike.
template <typename First, typename Second>
void both_side_by_side(const First& first, const Second& second) {
  each_side_by_side(2, [&](std::size_t i) { i == 0 ? first() : second(); });
}

} // namespace tilepack
