#include "tilepack/bench/timing.h"

#include <algorithm>
#include <chrono>
#include <ctime>

namespace tilepack {
namespace {

double seconds_of(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double seconds_of(const std::function<void()>& work, int calls) {
  const double start = thread_seconds();
  for (int i = 0; i < calls; ++i) work();
  return thread_seconds() - start;
}

} // namespace

double thread_seconds() {
  return seconds_of(CLOCK_THREAD_CPUTIME_ID);
}

BenchTime bench_time() {
  const auto wall = std::chrono::steady_clock::now().time_since_epoch();
  return {std::chrono::duration<double>(wall).count(), seconds_of(CLOCK_PROCESS_CPUTIME_ID)};
}

std::vector<std::vector<double>> in_turn(const std::vector<std::function<void()>>& works,
                                         const TimedRounds& timed, double items, const Progress& progress) {
  std::vector<int> calls(works.size(), 1);
  for (std::size_t i = 0; i < works.size(); ++i)
    while (seconds_of(works[i], calls[i]) < timed.shortest_run) calls[i] *= 2;
  std::vector<std::vector<double>> times(works.size());
  for (int round = 0; round < timed.rounds; ++round) {
    report(progress, "timing", static_cast<double>(round) / timed.rounds);
    for (std::size_t i = 0; i < works.size(); ++i)
      times[i].push_back(1e9 * seconds_of(works[i], calls[i]) / (calls[i] * items));
  }
  return times;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double spread(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return (*most - *least) / median(values);
}

double quartile_spread(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t quarter = values.size() / 4;
  return (values[values.size() - 1 - quarter] - values[quarter]) / values[values.size() / 2];
}

} // namespace tilepack
