#pragma once

#include "tilepack/error/progress.h"

#include <functional>
#include <vector>

/// The one place of the library that reads clocks, but for the shares of time of a bake (bake/stage_clock.h).
namespace tilepack {

/// Processor time of this thread, seconds from some start: what other programs take away doesn't count.
double thread_seconds();

/// By the clock on the wall, and processor time of all threads of this program; seconds from some start.
struct BenchTime {
  double wall = 0;
  double processor = 0;
};
BenchTime bench_time();

/// How often and how long each piece of work is timed.
struct TimedRounds {
  int rounds = 9;          ///< 1..1000
  double shortest_run = 0; ///< seconds that a round of one piece of work lasts at least: what is over sooner
                           ///< is called again and again, twice as often each time, until it does
};

/// Thread time of `works` in nanoseconds an item, [work][round]; a call of a piece of work does `items`.
///
/// Run in turn, round by round after one unmeasured, so that a busy moment of the machine falls on all alike:
/// ratios are taken between times of one round, not between times of different minutes.
std::vector<std::vector<double>> in_turn(const std::vector<std::function<void()>>& works,
                                         const TimedRounds& timed, double items,
                                         const Progress& progress = {});

/// The middle value, the upper of two; there must be one.
double median(std::vector<double> values);

/// How far times of one thing lie apart: (largest - smallest) / median.
double spread(const std::vector<double>& values);

/// The same without the outliers of a busy machine: from the lower to the upper quartile, over the median.
double quartile_spread(std::vector<double> values);

} // namespace tilepack
