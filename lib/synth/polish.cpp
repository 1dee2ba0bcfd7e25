#include "tilepack/synth/polish.h"

#include "tilepack/synth/byte_rows.h"
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
        channels(static_cast<std::size_t>(image.channels)),
        image_end(image.values.data() + image.values.size()) {}

  void run() {
    find_active();
    if (active.empty()) return;
    shown.resize(canvas.texels.size() * channels + byte_row_slack);
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
      const int first_x = std::max(half, x_of(i) - options.reach);
      const int last_x = std::min(canvas.width - 1 - half, x_of(i) + options.reach);
      const int last_y = std::min(canvas.height - 1 - half, y_of(i) + options.reach);
      for (int y = std::max(half, y_of(i) - options.reach); y <= last_y; ++y)
        for (int x = first_x; x <= last_x; ++x) is_active[canvas.index(x, y)] = 1;
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
    const std::size_t corner = i - static_cast<std::size_t>(half) * static_cast<std::size_t>(canvas.width) -
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
    weight.resize(canvas.texels.size());
    for (const std::size_t i : active) weight[i] = 1.0 / (static_cast<double>(distance[i]) + doubt);
    for (std::size_t n = 0; n < active.size(); ++n) {
      const std::size_t i = active[n];
      chosen[n] = canvas.texels[i];
      if (fixed[i]) continue;
      proposals.clear();
      weights.clear();
      bool news = false;
      const int x = x_of(i);
      const int y = y_of(i);
      const int left = std::max(-half, -x);
      const int right = std::min(half, canvas.width - 1 - x);
      const int bottom = std::min(half, canvas.height - 1 - y);
      for (int dy = std::max(-half, -y); dy <= bottom; ++dy)
        for (int dx = left; dx <= right; ++dx) {
          const std::size_t j = i + static_cast<std::size_t>(dy * canvas.width + dx);
          if (!is_active[j]) continue;
          const SourceTexel s{match[j].x - dx, match[j].y - dy};
          news = news || s != chosen[n];
          proposals.push_back(s);
          weights.push_back(weight[j]);
        }
      if (!news) continue;
      double total = 0.0;
      std::fill(mean.begin(), mean.end(), 0.0);
      for (std::size_t k = 0; k < proposals.size(); ++k) {
        const std::uint8_t* texel = image.texel(proposals[k].x, proposals[k].y);
        for (std::size_t c = 0; c < channels; ++c) mean[c] += weights[k] * texel[c];
        total += weights[k];
      }
      for (double& m : mean) m /= total;
      double least = std::numeric_limits<double>::max();
      for (std::size_t k = 0; k < proposals.size(); ++k) {
        const std::uint8_t* texel = image.texel(proposals[k].x, proposals[k].y);
        double d = 0.0;
        for (std::size_t c = 0; c < channels; ++c) {
          const double e = texel[c] - mean[c];
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
  const std::uint8_t* image_end;
  std::vector<std::size_t> active;     // middles of squares, row by row
  std::vector<std::uint8_t> is_active; // by texel
  std::vector<std::uint8_t> shown;     // what the canvas shows
  std::vector<SourceTexel> match;      // middle of the like square in the sample, by texel
  std::vector<int> distance;
  std::vector<double> weight; // of a square's proposals
};

} // namespace

void polish(const FeatureImage& image, const std::vector<std::uint8_t>& fixed, const PolishOptions& options,
            SourceCanvas& canvas) {
  if (std::min({image.width, image.height, canvas.width, canvas.height}) < side) return;
  Polish(image, fixed, options, canvas).run();
}

void polish_at_half_size(const FeatureImage& half_image, const std::vector<std::uint8_t>& fixed,
                         const PolishOptions& options, SourceCanvas& canvas) {
  SourceCanvas small(canvas.width / 2, canvas.height / 2);
  std::vector<std::uint8_t> small_fixed(small.texels.size());
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      const SourceTexel s = canvas.at(2 * x, 2 * y);
      small.at(x, y) = {std::clamp((s.x + 1) / 2, 0, half_image.width - 1),
                        std::clamp((s.y + 1) / 2, 0, half_image.height - 1)};
      small_fixed[small.index(x, y)] =
          fixed[canvas.index(2 * x, 2 * y)] | fixed[canvas.index(2 * x + 1, 2 * y)] |
          fixed[canvas.index(2 * x, 2 * y + 1)] | fixed[canvas.index(2 * x + 1, 2 * y + 1)];
    }
  const SourceCanvas before = small;
  polish(half_image, small_fixed, options, small);
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x) {
      const SourceTexel s = small.at(x, y);
      if (s == before.at(x, y)) continue;
      for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) canvas.at(2 * x + i, 2 * y + j) = {2 * s.x + i, 2 * s.y + j};
    }
}

} // namespace tilepack
