#pragma once

#include <cmath>
#include <cstdint>

namespace tilepack {

/// The cycle of an animated pattern: `length` (n) frames, of which frame 0 is the pattern at rest, and before them
/// `rest` more steps at rest: a Z of [LN03, section 3.4], Z the rest of a cell and a >= 0 the density for all (0: no
/// extra rest at all). Steps of time are whole numbers.
struct AnimationCycle {
  int length = 1;         ///< n >= 1
  std::int64_t rest = 0;  ///< a Z, rounded down, >= 0
  std::int64_t phase = 0; ///< φ, any

  /// The frame at time t, any integer: max(0, (t + φ) mod (n + aZ) - aZ), 0..n-1.
  int frame(std::int64_t t) const {
    const std::int64_t period = length + rest;
    const std::int64_t r = ((t + phase) % period + period) % period;
    return r < rest ? 0 : static_cast<int>(r - rest);
  }
};

/// a Z as whole steps; NaN and what is below 0 count as 0, and 2^40 is the most.
inline std::int64_t rest_steps(double density, double rest) {
  const double steps = std::floor(density * rest);
  return steps > 0 ? static_cast<std::int64_t>(steps < 0x1p40 ? steps : 0x1p40) : 0;
}

/// From the cycle `before` to `after` at time `start` (t₀) without a jump: what plays is played to its end, then comes the
/// new cycle; where that has begun already, rest until it begins anew.   [LN03, section 3.4]
///
///   t_f = t₀ + n - p'(t₀), or t₀ if p'(t₀) = 0;  t <= t_f: p'(t);  if p(t_f) = 0, from then on p(t);  else 0 up to
///   t_end = t_f + n - p(t_f), and p(t) after.
///
/// The paper has t_f = t₀ - 1 where p'(t₀) = 0. That jumps where frame n - 1 of the old cycle was shown at t₀ - 1 and
/// frame 1 of the new one is due at t₀: the pattern at rest between them is left out. A step later it is shown.
///
/// It is over at t₀ + 2n - 2 at the latest. A second change before that would start from what `after` shows, not from
/// what is seen, and may jump; hence the paper's rule to leave 2n steps between changes. Before t₀ frames are those of
/// the old cycle. `before` and `after` have one length.
struct TemporalTransition {
  AnimationCycle before, after;
  std::int64_t start = 0;

  int frame(std::int64_t t) const {
    if (t <= start) return before.frame(t);
    const int n = before.length;
    const int old = before.frame(start);
    const std::int64_t last = old == 0 ? start : start + n - old;
    if (t <= last) return before.frame(t);
    const int entering = after.frame(last);
    if (entering > 0 && t <= last + n - entering) return 0;
    return after.frame(t);
  }
};

/// Whether frame `to` may follow frame `from` of n: the next one, rest after rest, or the end of the cycle.
constexpr bool follows(int from, int to, int length) {
  return to == from + 1 || (to == 0 && (from == 0 || from == length - 1));
}

} // namespace tilepack
