#include "tilepack/synth/polish.h"

#include "tilepack/tileset/random.h"

#include <algorithm>
#include <limits>

namespace tilepack {
namespace {

constexpr int half = 3; // squares are 2 half + 1 texels wide
constexpr int side = 2 * half + 1;

class Polish {
public:
  Polish(const FeatureImage& feature_image, const std::vector<std::uint8_t>& fixed_texels,
         const PolishOptions& polish_options, SourceCanvas& source_canvas)
      : image(feature_image), fixed(fixed_texels), options(polish_options), canvas(source_canvas),
        channels(static_cast<std::size_t>(image.channels)) {}

  void run() {
    find_active();
    if (active.empty()) return;
    shown.resize(canvas.texels.size() * channels);
    for (std::size_t i = 0; i < canvas.texels.size(); ++i) show(i);
    match.resize(canvas.texels.size());
    distance.resize(canvas.texels.size());
    for (const std::size_t i : active) match[i] = inside(canvas.texels[i]);
    for (int pass = 0; pass < options.passes; ++pass) {
      look_up(pass);
      vote();
    }
  }

private:
  int x_of(std::size_t i) const { return static_cast<int>(i % static_cast<std::size_t>(canvas.width)); }
  int y_of(std::size_t i) const { return static_cast<int>(i / static_cast<std::size_t>(canvas.width)); }

  // Middles of squares: texels near a seam whose square lies inside the canvas.
  void find_active() {
    const auto costs = seams_at_texels(image, canvas);
    is_active.assign(canvas.texels.size(), 0);
    for (std::size_t i = 0; i < costs.size(); ++i) {
      if (costs[i] <= options.seam_threshold) continue;
      for (int y = std::max(half, y_of(i) - options.reach);
           y <= std::min(canvas.height - 1 - half, y_of(i) + options.reach); ++y)
        for (int x = std::max(half, x_of(i) - options.reach);
             x <= std::min(canvas.width - 1 - half, x_of(i) + options.reach); ++x)
          is_active[canvas.index(x, y)] = 1;
    }
    for (std::size_t i = 0; i < is_active.size(); ++i)
      if (is_active[i]) active.push_back(i);
  }

  void show(std::size_t i) {
    const SourceTexel s = canvas.texels[i];
    std::copy_n(image.texel(s.x, s.y), channels, shown.begin() + static_cast<std::ptrdiff_t>(i * channels));
  }

  SourceTexel inside(SourceTexel s) const {
    return {std::clamp(s.x, half, image.width - 1 - half), std::clamp(s.y, half, image.height - 1 - half)};
  }

  // The squared difference of two squares, or some number >= limit if it is not below it.
  int difference(std::size_t i, SourceTexel s, int limit) const {
    int sum = 0;
    for (int dy = -half; dy <= half && sum < limit; ++dy) {
      const std::uint8_t* a =
          shown.data() + (i + static_cast<std::size_t>(dy) * static_cast<std::size_t>(canvas.width) -
                          static_cast<std::size_t>(half)) *
                             channels;
      const std::uint8_t* b = image.texel(s.x - half, s.y + dy);
      for (std::size_t k = 0; k < side * channels; ++k) {
        const auto d = static_cast<std::int16_t>(a[k] - b[k]);
        sum += d * d;
      }
    }
    return sum;
  }

  void try_match(std::size_t i, SourceTexel s) {
    if (s == match[i]) return;
    const int d = difference(i, s, distance[i]);
    if (d < distance[i]) {
      distance[i] = d;
      match[i] = s;
    }
  }

  void look_up(int pass) {
    for (const std::size_t i : active) distance[i] = difference(i, match[i], std::numeric_limits<int>::max());
    for (int sweep = 0; sweep < options.sweeps; ++sweep) {
      const bool forward = sweep % 2 == 0;
      const int step = forward ? 1 : -1;
      for (std::size_t n = 0; n < active.size(); ++n) {
        const std::size_t i = forward ? active[n] : active[active.size() - 1 - n];
        if (distance[i] == 0) continue;
        const std::size_t beside = i - static_cast<std::size_t>(step);
        const std::size_t above = i - static_cast<std::size_t>(step * canvas.width);
        if (is_active[beside]) try_match(i, inside({match[beside].x + step, match[beside].y}));
        if (is_active[above]) try_match(i, inside({match[above].x, match[above].y + step}));
        std::uint64_t bits =
            random_bits(options.seed, "polish", (static_cast<std::uint64_t>(pass * 64 + sweep) << 32) + i);
        for (int radius = std::max(image.width, image.height); radius >= 1; radius /= 4) {
          const auto offset = [&](std::uint64_t word) {
            return static_cast<int>((word * static_cast<std::uint64_t>(2 * radius + 1)) >> 32) - radius;
          };
          const SourceTexel at = match[i];
          try_match(i, inside({at.x + offset(bits & 0xffffffffu), at.y + offset(bits >> 32)}));
          bits = mixed(bits + 0x9e3779b97f4a7c15u);
        }
      }
    }
  }

  void vote() {
    std::vector<SourceTexel> chosen(active.size());
    std::vector<SourceTexel> proposals;
    std::vector<double> weights;
    std::vector<double> mean(channels);
    const double doubt = options.doubt * side * side * static_cast<double>(channels);
    for (std::size_t n = 0; n < active.size(); ++n) {
      const std::size_t i = active[n];
      chosen[n] = canvas.texels[i];
      if (fixed[i]) continue;
      proposals.clear();
      weights.clear();
      std::fill(mean.begin(), mean.end(), 0.0);
      double total = 0.0;
      for (int dy = -half; dy <= half; ++dy)
        for (int dx = -half; dx <= half; ++dx) {
          const int x = x_of(i) + dx;
          const int y = y_of(i) + dy;
          if (x < 0 || y < 0 || x >= canvas.width || y >= canvas.height) continue;
          const std::size_t j = canvas.index(x, y);
          if (!is_active[j]) continue;
          const SourceTexel s{match[j].x - dx, match[j].y - dy};
          const double weight = 1.0 / (static_cast<double>(distance[j]) + doubt);
          const std::uint8_t* texel = image.texel(s.x, s.y);
          for (std::size_t c = 0; c < channels; ++c) mean[c] += weight * texel[c];
          total += weight;
          proposals.push_back(s);
          weights.push_back(weight);
        }
      if (proposals.empty()) continue;
      double least = std::numeric_limits<double>::max();
      for (std::size_t k = 0; k < proposals.size(); ++k) {
        const std::uint8_t* texel = image.texel(proposals[k].x, proposals[k].y);
        double d = 0.0;
        for (std::size_t c = 0; c < channels; ++c) {
          const double e = texel[c] - mean[c] / total;
          d += e * e;
        }
        if (d < least) {
          least = d;
          chosen[n] = proposals[k];
        }
      }
    }
    for (std::size_t n = 0; n < active.size(); ++n) {
      canvas.texels[active[n]] = chosen[n];
      show(active[n]);
    }
  }

  const FeatureImage& image;
  const std::vector<std::uint8_t>& fixed;
  const PolishOptions& options;
  SourceCanvas& canvas;
  std::size_t channels;
  std::vector<std::size_t> active;     // middles of squares, row by row
  std::vector<std::uint8_t> is_active; // by texel
  std::vector<std::uint8_t> shown;     // what the canvas shows
  std::vector<SourceTexel> match;      // middle of the like square in the sample, by texel
  std::vector<int> distance;
};

} // namespace

void polish(const FeatureImage& image, const std::vector<std::uint8_t>& fixed, const PolishOptions& options,
            SourceCanvas& canvas) {
  if (std::min({image.width, image.height, canvas.width, canvas.height}) < side) return;
  Polish(image, fixed, options, canvas).run();
}

} // namespace tilepack
