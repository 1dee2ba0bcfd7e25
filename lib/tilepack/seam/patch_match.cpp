#include "tilepack/seam/patch_match.h"

#include "tilepack/match/row_ssd.h"
#include "tilepack/match/use_counts.h"
#include "tilepack/numeric/random.h"
#include "tilepack/numeric/side_by_side.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

namespace tilepack {
namespace {

constexpr int half = 3; // squares are 2 half + 1 texels wide
constexpr int side = 2 * half + 1;

// Radii of random search are divided by this from trial to trial. [Barnes09] halves them; here propagation finds
// most, and few trials (anywhere, near and beside) made the search quicker and its finds more varied.
constexpr int radius_step = 16;

constexpr double most_often = 4.0; // times the average use; being shown more often is no worse
constexpr int penalty_square = 4;  // texels of the sample at full size to each penalty, along both axes

// By how much a match in each part of the sample counts as less like than it is, in 1 / unit of its distance.
struct MatchPenalties {
  static constexpr int unit = 64;
  int square = 1; // each holds for so many texels a side, by where a match has its middle
  int columns = 0;
  std::vector<std::uint16_t> values;

  int at(SourceTexel s) const {
    return values[static_cast<std::size_t>(s.y / square) * static_cast<std::size_t>(columns) +
                  static_cast<std::size_t>(s.x / square)];
  }
};

SourceTexel inside(const FeatureImage& image, SourceTexel s) {
  return {std::clamp(s.x, half, image.width - 1 - half), std::clamp(s.y, half, image.height - 1 - half)};
}

// The squares of a canvas that are matched, those near seams: few, so that a large canvas takes little room.
struct Matches {
  std::vector<std::uint32_t> at;     // the middle of each, as an index of the canvas's texels, ascending
  std::vector<SourceTexel> like;     // the middle of the square in the sample that is like it
  std::vector<std::size_t> first_of; // row of the canvas → the first in it or below; one more at the end
};

// Of each square near a seam the square it stems from.
Matches first_matches(const FeatureImage& image, const PatchMatchOptions& options,
                      const SourceCanvas& canvas) {
  std::vector<std::uint8_t> near(canvas.texels.size());
  seams_by_rows(image, canvas, [&](int seam_y, const std::vector<std::int64_t>& costs) {
    const int last_y = std::min(canvas.height - 1 - half, seam_y + options.reach);
    for (int seam_x = 0; seam_x < canvas.width; ++seam_x) {
      if (costs[static_cast<std::size_t>(seam_x)] <= options.seam_threshold) continue;
      const int first_x = std::max(half, seam_x - options.reach);
      const int last_x = std::min(canvas.width - 1 - half, seam_x + options.reach);
      if (first_x > last_x) continue;
      for (int y = std::max(half, seam_y - options.reach); y <= last_y; ++y)
        std::fill_n(near.begin() + static_cast<std::ptrdiff_t>(canvas.index(first_x, y)),
                    last_x - first_x + 1, std::uint8_t{1});
    }
  });
  Matches matches;
  for (int y = 0; y < canvas.height; ++y) {
    matches.first_of.push_back(matches.at.size());
    for (int x = 0; x < canvas.width; ++x) {
      const std::size_t i = canvas.index(x, y);
      if (!near[i]) continue;
      matches.at.push_back(static_cast<std::uint32_t>(i));
      matches.like.push_back(inside(image, canvas.texels[i]));
    }
  }
  matches.first_of.push_back(matches.at.size());
  return matches;
}

// One pass over one canvas: the field of nearest neighbours is made better, then the texels are voted on.
class PatchMatchPass {
public:
  PatchMatchPass(const FeatureImage& feature_image, const MatchPenalties& match_penalties,
                 const std::vector<std::uint8_t>& fixed_texels, const PatchMatchOptions& match_options,
                 SourceCanvas& source_canvas, Matches& matches)
      : image(feature_image), penalties(match_penalties), fixed(fixed_texels), options(match_options),
        canvas(source_canvas), at(matches.at), match(matches.like), first_of(matches.first_of),
        channels(static_cast<std::size_t>(image.channels)),
        image_end(image.values.data() + image.values.size()) {}

  // Makes the match of each square better [Barnes09]: sweeps go forward and backward in turn, and at each
  // square propagation comes before random search. `stream` tells passes and canvases apart.
  void search(std::uint64_t stream) {
    if (at.empty()) return;
    shown.resize(canvas.texels.size() * channels + byte_row_slack);
    for (std::size_t i = 0; i < canvas.texels.size(); ++i) {
      const SourceTexel s = canvas.texels[i];
      std::copy_n(image.texel(s.x, s.y), channels, shown.begin() + static_cast<std::ptrdiff_t>(i * channels));
    }
    number.assign(canvas.texels.size(), none);
    for (std::size_t n = 0; n < at.size(); ++n) number[at[n]] = static_cast<std::uint32_t>(n);
    distance.resize(at.size());
    for (std::size_t n = 0; n < at.size(); ++n)
      distance[n] = penalized(match[n], difference(n, match[n], std::numeric_limits<int>::max()));
    changed.assign(at.size(), 0);
    for (int sweep = 0; sweep < options.sweeps; ++sweep) {
      const std::uint64_t trials = random_bits(stream, "polish trials", static_cast<std::uint64_t>(sweep));
      const bool forward = sweep % 2 == 0;
      for (std::size_t k = 0; k < at.size(); ++k) {
        const std::size_t n = forward ? k : at.size() - 1 - k;
        if (distance[n] == 0) continue;
        const SourceTexel before = match[n];
        propagate(n, forward ? 1 : -1, sweep);
        random_search(n, mixed(trials + at[n]));
        if (match[n] != before) changed[n] = sweep;
      }
    }
    shown = {};
    number = {};
  }

  // Replaces each texel by what is nearest to the mean of what the matches of its squares show in its place:
  // the vote of [Wexler07] and the M step of [Kwatra05], but for the mean itself, which is in no sample.
  void vote() {
    for (int y = 0; y < canvas.height; y += voted_rows) {
      switch (channels) {
      case 1:
        vote_in_band<1>(y);
        break;
      case 3:
        vote_in_band<3>(y);
        break;
      case 4:
        vote_in_band<4>(y);
        break;
      default:
        vote_in_band<0>(y);
      }
    }
  }

private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  static constexpr int voted_rows = 64; // at a time, so that what is counted stays in the cache

  // Tries the matches of the two neighbours that the sweep came from, moved along with the square. One that has
  // not changed since two sweeps ago was tried in vain then, and is not tried again: matches only get better.
  void propagate(std::size_t n, int step, int sweep) {
    const auto is_new = [&](std::uint32_t other) { return other != none && changed[other] >= sweep - 1; };
    const std::uint32_t beside = number[at[n] - static_cast<std::size_t>(step)];
    const std::uint32_t above = number[at[n] - static_cast<std::size_t>(step * canvas.width)];
    if (is_new(beside)) try_match(n, inside(image, {match[beside].x + step, match[beside].y}));
    if (is_new(above)) try_match(n, inside(image, {match[above].x, match[above].y + step}));
  }

  // Tries places round the match so far, within radii that shrink by `radius_step`.
  void random_search(std::size_t n, std::uint64_t bits) {
    for (int radius = std::max(image.width, image.height); radius >= 1; radius /= radius_step) {
      const auto offset = [&](std::uint64_t word) {
        return static_cast<int>((word * static_cast<std::uint64_t>(2 * radius + 1)) >> 32) - radius;
      };
      const SourceTexel from = match[n];
      try_match(n, inside(image, {from.x + offset(bits & 0xffffffffu), from.y + offset(bits >> 32)}));
      bits = mixed(bits + 0x9e3779b97f4a7c15u);
    }
  }

  // Of the texels of some rows from `top` on. `known`: the number of channels, if the compiler shall know it.
  template <std::size_t known>
  void vote_in_band(int top) {
    const std::size_t n = known > 0 ? known : channels;
    const int bottom = std::min(canvas.height, top + voted_rows);
    const std::size_t begin = first_of[static_cast<std::size_t>(top)];
    const std::size_t end = first_of[static_cast<std::size_t>(bottom)];
    if (begin == end) return; // none of them may change
    const std::size_t texels = canvas.index(0, bottom) - canvas.index(0, top);
    std::vector<std::uint16_t> sum(texels * n); // 49 × 255 at most
    std::vector<std::uint8_t> votes(texels);
    for_each_row(top, bottom, [&](std::size_t i, SourceTexel, const std::uint8_t* row) {
      for (std::size_t k = 0; k < side * n; ++k)
        sum[i * n + k] = static_cast<std::uint16_t>(sum[i * n + k] + row[k]);
      for (std::size_t k = 0; k < side; ++k) ++votes[i + k];
    });
    // Differences from the mean, times the number of votes: (49 × 255)² × 16 fits 32 bits.
    std::vector<std::uint32_t> least(texels, std::numeric_limits<std::uint32_t>::max());
    std::vector<SourceTexel> nearest(texels);
    for_each_row(top, bottom, [&](std::size_t i, SourceTexel s, const std::uint8_t* row) {
      for (std::size_t k = 0; k < side; ++k, ++i, ++s.x, row += n) {
        std::uint32_t d = 0;
        for (std::size_t c = 0; c < n; ++c) {
          const int e = votes[i] * row[c] - sum[i * n + c];
          d += static_cast<std::uint32_t>(e * e);
        }
        if (d < least[i]) {
          least[i] = d;
          nearest[i] = s;
        }
      }
    });
    for (std::size_t k = begin; k < end; ++k)
      if (!fixed[at[k]]) canvas.texels[at[k]] = nearest[at[k] - canvas.index(0, top)];
  }

  // visit(index of the first of `side` texels, from the band's first on, the sample texel proposed for it, the values
  // of these texels), row by row of each square that reaches into the rows from `top` to before `bottom`.
  template <typename Visit>
  void for_each_row(int top, int bottom, Visit&& visit) const {
    for (int y = std::max(0, top - half); y < std::min(canvas.height, bottom + half); ++y)
      for (std::size_t k = first_of[static_cast<std::size_t>(y)];
           k < first_of[static_cast<std::size_t>(y) + 1]; ++k)
        for (int row = std::max(top, y - half); row < std::min(bottom, y + half + 1); ++row) {
          const SourceTexel s{match[k].x - half, match[k].y + row - y};
          const std::size_t x = at[k] - canvas.index(0, y) - half;
          visit(canvas.index(0, row - top) + x, s, image.texel(s.x, s.y));
        }
  }

  // The squared difference of two squares, or some number >= limit if it is not below it.
  int difference(std::size_t n, SourceTexel s, int limit) const {
    const std::size_t corner = at[n] -
                               static_cast<std::size_t>(half) * static_cast<std::size_t>(canvas.width) -
                               static_cast<std::size_t>(half);
    const std::uint8_t* other = image.texel(s.x - half, s.y - half);
    const auto stride = static_cast<std::ptrdiff_t>(image.width) * image.channels;
    const auto own_stride = static_cast<std::ptrdiff_t>(canvas.width) * image.channels;
    if (other + side * stride + byte_row_slack < image_end) {
      return squared_difference_of_rows(shown.data() + corner * channels, own_stride, other, stride,
                                        side * channels, side, limit);
    }
    int sum = 0; // too near to the end of the image to be read in whole vectors
    for (int y = 0; y < side && sum < limit; ++y)
      for (std::size_t k = 0; k < side * channels; ++k) {
        const int d = shown[corner * channels + static_cast<std::size_t>(y * own_stride) + k] -
                      other[y * stride + static_cast<std::ptrdiff_t>(k)];
        sum += d * d;
      }
    return sum;
  }

  int penalized(SourceTexel s, int d) const {
    return static_cast<int>(std::min<std::int64_t>(
        std::numeric_limits<int>::max(),
        static_cast<std::int64_t>(d) * (MatchPenalties::unit + penalties.at(s)) / MatchPenalties::unit));
  }

  void try_match(std::size_t n, SourceTexel s) {
    if (s == match[n]) return;
    const int d = difference(n, s, distance[n]);
    if (d >= distance[n]) return;
    const int cost = penalized(s, d);
    if (cost >= distance[n]) return;
    distance[n] = cost;
    match[n] = s;
  }

  const FeatureImage& image;
  const MatchPenalties& penalties;
  const std::vector<std::uint8_t>& fixed;
  const PatchMatchOptions& options;
  SourceCanvas& canvas;
  const std::vector<std::uint32_t>& at;
  std::vector<SourceTexel>& match;
  const std::vector<std::size_t>& first_of;
  std::size_t channels;
  const std::uint8_t* image_end;
  std::vector<std::uint32_t> number; // texel of the canvas → the square round it, or none
  std::vector<std::uint8_t> shown;   // what the canvas shows
  std::vector<int> distance;         // of each square to its match, penalties counted
  std::vector<int> changed;          // the last sweep that changed it
};

// For low contrast alone.
MatchPenalties contrast_penalties(const FeatureImage& image, const ContrastRanks& ranks, int square,
                                  double contrast_weight) {
  MatchPenalties penalties{square, (image.width + square - 1) / square, {}};
  for (int y = square / 2; y - square / 2 < image.height; y += square)
    for (int x = square / 2; x - square / 2 < image.width; x += square) {
      const int rank =
          contrast_weight > 0 ? ranks.at(std::min(x, image.width - 1), std::min(y, image.height - 1)) : 0;
      penalties.values.push_back(static_cast<std::uint16_t>(
          MatchPenalties::unit * contrast_weight * (ContrastRanks::count - rank) / ContrastRanks::count));
    }
  return penalties;
}

// Adds what it costs that canvases show the surroundings of a texel already.
void add_reuse_penalties(const FeatureImage& image, const std::vector<SourceCanvas>& canvases, Rect counted,
                         double reuse_weight, MatchPenalties& penalties) {
  const int square = penalties.square;
  UseCounts counts(image.width, image.height, square);
  for (const SourceCanvas& canvas : canvases)
    for (int y = counted.y; y < counted.y + counted.height; ++y)
      for (int x = counted.x; x < counted.x + counted.width; ++x) {
        const SourceTexel s = canvas.at(x, y);
        counts.add_texel(s.x, s.y);
      }
  const UseTable uses = prepared(counts);
  const double average = uses.mean();
  const int rows = static_cast<int>(penalties.values.size()) / penalties.columns;
  tbb::parallel_for(0, rows, [&](int j) {
    for (int i = 0; i < penalties.columns; ++i) {
      const double often = uses.mean({(i - 2) * square, (j - 2) * square, 5 * square, 5 * square}) / average;
      std::uint16_t& penalty =
          penalties.values[static_cast<std::size_t>(j) * static_cast<std::size_t>(penalties.columns) +
                           static_cast<std::size_t>(i)];
      penalty = static_cast<std::uint16_t>(penalty +
                                           MatchPenalties::unit * reuse_weight * std::min(often, most_often));
    }
  });
}

SourceCanvas shrunk(const FeatureImage& image, const SourceCanvas& canvas, int scale) {
  SourceCanvas small(canvas.width / scale, canvas.height / scale);
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      const SourceTexel s = canvas.at(scale * x, scale * y);
      small.at(x, y) = {std::clamp((s.x + scale / 2) / scale, 0, image.width - 1),
                        std::clamp((s.y + scale / 2) / scale, 0, image.height - 1)};
    }
  return small;
}

// Brings what changed back to a canvas at full size.
void enlarge_changes(const SourceCanvas& before, const SourceCanvas& after, int scale, SourceCanvas& canvas) {
  for (int y = 0; y < after.height; ++y)
    for (int x = 0; x < after.width; ++x) {
      const SourceTexel s = after.at(x, y);
      if (s == before.at(x, y)) continue;
      for (int j = 0; j < scale; ++j)
        for (int i = 0; i < scale; ++i)
          canvas.at(scale * x + i, scale * y + j) = {scale * s.x + i, scale * s.y + j};
    }
}

std::vector<std::uint8_t> shrunk_mask(const std::vector<std::uint8_t>& fixed, const SourceCanvas& canvas,
                                      int scale) {
  std::vector<std::uint8_t> small;
  for (int y = 0; y + scale <= canvas.height; y += scale)
    for (int x = 0; x + scale <= canvas.width; x += scale) {
      std::uint8_t any = 0;
      for (int j = 0; j < scale; ++j)
        for (int i = 0; i < scale; ++i) any |= fixed[canvas.index(x + i, y + j)];
      small.push_back(any);
    }
  return small;
}

} // namespace

void match_and_vote(const PatchMatchInput& input, const PatchMatchOptions& options,
                    std::vector<SourceCanvas>& canvases) {
  if (canvases.empty() || options.passes == 0) return;
  const FeatureImage& image = input.image;
  const int scale = input.scale;
  const SourceCanvas& one = canvases.front();
  if (std::min({image.width, image.height, one.width / scale, one.height / scale}) < side) return;
  const auto fixed = shrunk_mask(input.fixed, one, scale);
  const Rect& all = input.counted;
  const Rect counted{all.x / scale, all.y / scale, all.width / scale, all.height / scale};
  const std::size_t count = canvases.size();
  // At full size canvases are worked on where they are.
  std::vector<SourceCanvas> before, small;
  if (scale > 1) {
    before.resize(count);
    each_side_by_side(count, [&](std::size_t n) { before[n] = shrunk(image, canvases[n], scale); });
    small = before;
  }
  std::vector<SourceCanvas>& after = scale > 1 ? small : canvases;
  std::vector<Matches> matches(count);
  each_side_by_side(count, [&](std::size_t n) { matches[n] = first_matches(image, options, after[n]); });
  const MatchPenalties by_contrast =
      contrast_penalties(image, input.ranks, std::max(1, penalty_square / scale), options.contrast_weight);
  for (int pass = 0; pass < options.passes; ++pass) {
    MatchPenalties penalties = by_contrast;
    if (options.reuse_weight > 0.0)
      add_reuse_penalties(image, after, counted, options.reuse_weight, penalties);
    each_side_by_side(count, [&](std::size_t n) {
      PatchMatchPass run(image, penalties, fixed, options, after[n], matches[n]);
      run.search(random_bits(options.seed, "polish pass", n * 64 + static_cast<std::size_t>(pass)));
      run.vote();
    });
  }
  for (std::size_t n = 0; n < before.size(); ++n) enlarge_changes(before[n], after[n], scale, canvases[n]);
}

} // namespace tilepack
