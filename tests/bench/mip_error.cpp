// What each mip mode is worth: bilinear lookups through packs against the true mips of a random expansion.
//
//   bench_mip_error [--tile N] [--guard G] [--colors K] [--corner] [--quilt] [--float] IMAGE...
//
// For every image a tile set is synthesised. Figures are of levels past the guard band, in 8-bit units of the
// encoded value. Three tables are printed, ready for a README:
//   * the median over images of the PSNR over the whole plane, by level and mode;
//   * medians over images and levels of the RMS error inside tiles, within half a texel of an edge and within
//     half a texel of a lattice point, and of the jump across borders; with the *floor*: the error that no
//     texels of a pack can go below, since a lookup knows its tile but not the tile's neighbours in the plane
//     (the spread of the true value over these);
//   * for each image, least squares with the least jump weight whose jump is no larger than that of `edges`.

#include "tilepack/image/image_file.h"
#include "tilepack/layout/de_bruijn.h"
#include "tilepack/layout/tile_index.h"
#include "tilepack/mapping/mapping.h"
#include "tilepack/mip/border_path.h"
#include "tilepack/mip/mip_chain.h"
#include "tilepack/synth/synthesize.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

using namespace tilepack;

namespace {

std::size_t as_size(int i) {
  return static_cast<std::size_t>(i);
}

struct Sum {
  double squares = 0;
  double count = 0;
  void add(double difference) {
    squares += difference * difference;
    count += 1;
  }
  double rms() const { return count > 0 ? std::sqrt(squares / count) : 0; }
};

struct Figures {
  Sum interior, edge, corner, jump;
  Sum edge_floor, corner_floor;

  Sum all() const {
    return {interior.squares + edge.squares + corner.squares, interior.count + edge.count + corner.count};
  }
  Sum border() const { return {edge.squares + corner.squares, edge.count + corner.count}; }
};

// The true values seen at one place of one tile, in all surroundings drawn.
struct Spread {
  double sum = 0;
  double squares = 0;
  double count = 0;
  double variance() const {
    return count > 1 ? std::max(0.0, (squares - sum * sum / count) / (count - 1)) : 0;
  }
};

double encode(double v, Encoding encoding) {
  return 255 * (encoding == Encoding::srgb ? linear_to_srgb(std::clamp(v, 0.0, 1.0)) : v);
}

// The tile of a cell with the ring of texels around it.
template <typename Neighbour>
Image padded(const std::vector<Image>& tiles, int tile, Neighbour&& neighbour) {
  const Image& own = tiles[as_size(tile)];
  Image result(own.width() + 2, own.height() + 2, own.channels());
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const Image& there = dx == 0 && dy == 0 ? own : tiles[as_size(neighbour(dx, dy))];
      for (int y = dy < 0 ? -1 : dy > 0 ? own.height() : 0; y < (dy < 0 ? 0 : own.height() + (dy > 0)); ++y)
        for (int x = dx < 0 ? -1 : dx > 0 ? own.width() : 0; x < (dx < 0 ? 0 : own.width() + (dx > 0)); ++x) {
          const auto from = there.texel(x - dx * own.width(), y - dy * own.height());
          std::copy(from.begin(), from.end(), result.texel(x + 1, y + 1).begin());
        }
    }
  return result;
}

// Bilinear at (x, y) texels from the tile's north-west corner.
double bilinear(const Image& p, double x, double y, std::size_t c) {
  const double fx = x + 0.5;
  const double fy = y + 0.5;
  const int ix = std::min(static_cast<int>(fx), p.width() - 2);
  const int iy = std::min(static_cast<int>(fy), p.height() - 2);
  const double u = fx - ix;
  const double v = fy - iy;
  const auto at = [&](int i, int j) { return static_cast<double>(p.texel(ix + i, iy + j)[c]); };
  return (1 - v) * ((1 - u) * at(0, 0) + u * at(1, 0)) + v * ((1 - u) * at(0, 1) + u * at(1, 1));
}

// edge_floor and corner_floor.
Figures floors(const std::vector<Image>& truth, const Mapping& mapping, const ColorCounts& colors,
               Encoding encoding, int cells) {
  const int n = truth.front().width();
  const int h = truth.front().height();
  const auto channels = as_size(truth.front().channels());
  std::vector<std::vector<Spread>> spreads(truth.size(), std::vector<Spread>(as_size(4 * n * h) * channels));
  for (int row = 0; row < cells; ++row)
    for (int column = 0; column < cells; ++column) {
      const int x0 = column * 3;
      const int y0 = row * 3;
      const int tile = tile_at(mapping, colors, x0, y0);
      const Image t =
          padded(truth, tile, [&](int dx, int dy) { return tile_at(mapping, colors, x0 + dx, y0 + dy); });
      for (int j = 0; j < 2 * h; ++j)
        for (int i = 0; i < 2 * n; ++i) {
          if (i > 0 && i < 2 * n - 1 && j > 0 && j < 2 * h - 1) continue;
          for (std::size_t c = 0; c < channels; ++c) {
            const double v = encode(bilinear(t, (i + 0.5) / 2, (j + 0.5) / 2, c), encoding);
            Spread& spread = spreads[as_size(tile)][as_size(j * 2 * n + i) * channels + c];
            spread.sum += v;
            spread.squares += v * v;
            spread.count += 1;
          }
        }
    }
  Figures result;
  for (const auto& tile : spreads)
    for (std::size_t k = 0; k < tile.size(); ++k) {
      const int i = static_cast<int>(k / channels) % (2 * n);
      const int j = static_cast<int>(k / channels) / (2 * n);
      const bool corner = (i == 0 || i == 2 * n - 1) && (j == 0 || j == 2 * h - 1);
      Sum& sum = corner ? result.corner_floor : result.edge_floor;
      sum.squares += tile[k].variance() * tile[k].count;
      sum.count += tile[k].count;
    }
  return result;
}

Figures measured(const std::vector<Image>& truth, const std::vector<Image>& stored,
                 const PackNeighbours& pack, const Mapping& mapping, const ColorCounts& colors,
                 Encoding encoding, int cells) {
  const int n = truth.front().width();
  const int h = truth.front().height();
  std::vector<Figures> rows(as_size(cells));
  const auto stored_at = [&](int tile) {
    return padded(stored, tile, [&](int dx, int dy) {
      const int place = (dy + 1) * 3 + dx + 1;
      return pack.around[as_size(tile)][as_size(place < 4 ? place : place - 1)];
    });
  };
  tbb::parallel_for(0, cells, [&](int row) {
    Figures& f = rows[as_size(row)];
    for (int column = 0; column < cells; ++column) {
      const int x0 = column * 3;
      const int y0 = row * 3;
      const int tile = tile_at(mapping, colors, x0, y0);
      const Image t =
          padded(truth, tile, [&](int dx, int dy) { return tile_at(mapping, colors, x0 + dx, y0 + dy); });
      const Image s = stored_at(tile);
      const Image s_east = stored_at(tile_at(mapping, colors, x0 + 1, y0));
      const Image s_south = stored_at(tile_at(mapping, colors, x0, y0 + 1));
      for (std::size_t c = 0; c < as_size(t.channels()); ++c) {
        for (int j = 0; j < 2 * h; ++j)
          for (int i = 0; i < 2 * n; ++i) {
            const double x = (i + 0.5) / 2;
            const double y = (j + 0.5) / 2;
            const bool bx = i == 0 || i == 2 * n - 1;
            const bool by = j == 0 || j == 2 * h - 1;
            const double d = encode(bilinear(s, x, y, c), encoding) - encode(bilinear(t, x, y, c), encoding);
            (bx && by ? f.corner : bx || by ? f.edge : f.interior).add(d);
          }
        for (int i = 0; i < 2 * n; ++i) {
          const double x = (i + 0.5) / 2;
          f.jump.add(encode(bilinear(s, x, h, c), encoding) - encode(bilinear(s_south, x, 0, c), encoding));
        }
        for (int j = 0; j < 2 * h; ++j) {
          const double y = (j + 0.5) / 2;
          f.jump.add(encode(bilinear(s, n, y, c), encoding) - encode(bilinear(s_east, 0, y, c), encoding));
        }
      }
    }
  });
  Figures all = floors(truth, mapping, colors, encoding, cells);
  for (const Figures& f : rows)
    for (const auto member : {&Figures::interior, &Figures::edge, &Figures::corner, &Figures::jump}) {
      (all.*member).squares += (f.*member).squares;
      (all.*member).count += (f.*member).count;
    }
  return all;
}

double median(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return v.empty() ? 0 : v[v.size() / 2];
}

struct Settings {
  int tile = 128;
  int guard = 0;
  int colors = 2;
  bool corner = false;
  Construction interior = Construction::framed;
  Depth depth = Depth::u8;
  std::vector<std::string> images;
};

Settings settings_of(int argc, char** argv) {
  Settings s;
  for (int i = 1; i < argc; ++i) {
    const std::string a = argv[i];
    if (a == "--tile")
      s.tile = std::atoi(argv[++i]);
    else if (a == "--guard")
      s.guard = std::atoi(argv[++i]);
    else if (a == "--colors")
      s.colors = std::atoi(argv[++i]);
    else if (a == "--corner")
      s.corner = true;
    else if (a == "--quilt")
      s.interior = Construction::quilt;
    else if (a == "--float")
      s.depth = Depth::f32;
    else
      s.images.push_back(a);
  }
  return s;
}

struct Mode {
  std::string name;
  MipOptions options;
};

constexpr std::array weights{0, 1, 2, 4, 8, 16, 32, 64, 128, 256, 1000};

std::vector<Mode> all_modes() {
  std::vector<Mode> modes;
  for (const MipMode mode : {MipMode::box, MipMode::edges, MipMode::corners, MipMode::least_squares}) {
    MipOptions o;
    o.mode = mode;
    modes.push_back({std::string(name_of(mode)), o});
  }
  for (const int weight : weights) {
    MipOptions o;
    o.mode = MipMode::least_squares;
    o.jump_weight = weight;
    modes.push_back({fmt::format("weight {}", weight), o});
  }
  return modes;
}

using Levels = std::map<int, Figures>;          // by level
using Measured = std::map<std::string, Levels>; // by mode

Measured measure(const std::string& file, const Settings& s) {
  const ImageFile read = read_image(file);
  SynthOptions options;
  options.tile_size = {s.tile, s.tile};
  options.guard = s.guard;
  options.interior = s.interior;
  options.colors = {s.colors, s.colors, 0};
  if (s.corner) {
    options.coloring = Coloring::corner;
    options.colors = {0, 0, s.colors};
  }
  const SampleMap sample{"color", Role::color, read.encoding, read.depth, read.image};
  const TileSet set = assembled(synthesize(std::span(&sample, 1), options), std::span(&sample, 1));
  const Layout layout = s.corner ? de_bruijn_layout(std::get<std::vector<CornerTile>>(set.tiles))
                                 : tile_index_layout(std::get<std::vector<EdgeTile>>(set.tiles));
  const PackNeighbours pack = pack_neighbours(layout);
  const Mapping mapping = mix_mapping({1 << 20, 1 << 20}, 1);
  MipOptions box;
  box.mode = MipMode::box;
  const auto truth = mip_chain(set, 0, box);
  const auto linear = [&](const std::vector<Image>& tiles, Depth depth) {
    std::vector<Image> result;
    for (const Image& image : tiles) result.push_back(to_linear(quantised(image, depth), sample.encoding));
    return result;
  };
  Measured result;
  for (const Mode& mode : all_modes()) {
    const auto chain = mip_chain(set, 0, mode.options, &layout);
    for (int level = 1; level < static_cast<int>(chain.size()); ++level)
      if (!exact_through_guard(s.guard, level))
        result[mode.name][level] = measured(linear(truth[as_size(level)].tiles, Depth::f32),
                                            linear(chain[as_size(level)].tiles, s.depth), pack, mapping,
                                            set.colors, sample.encoding, level < 3 ? 12 : 30);
  }
  return result;
}

double psnr(const Sum& error) {
  return 20 * std::log10(255 / std::max(error.rms(), 1e-9));
}

// Root of the mean over levels of the squares.
template <typename Figure>
double over_levels(const Levels& levels, Figure&& figure) {
  double sum = 0;
  for (const auto& [level, figures] : levels) sum += figure(figures) * figure(figures);
  return std::sqrt(sum / static_cast<double>(levels.size()));
}

void print_psnr(const std::vector<std::pair<std::string, Measured>>& images) {
  fmt::print("| median PSNR, dB |");
  for (const auto& [level, figures] : images.front().second.at("box")) fmt::print(" level {} |", level);
  fmt::print("\n");
  for (const char* mode : {"box", "edges", "corners", "least-squares"}) {
    fmt::print("| {} |", mode);
    for (const auto& [level, ignored] : images.front().second.at("box")) {
      std::vector<double> values;
      for (const auto& [name, measured] : images)
        if (const auto found = measured.at(mode).find(level); found != measured.at(mode).end())
          values.push_back(psnr(found->second.all()));
      fmt::print(" {:.1f} |", median(values));
    }
    fmt::print("\n");
  }
}

void print_zones(const std::vector<std::pair<std::string, Measured>>& images) {
  fmt::print("\n| medians over images and levels | interior | edge | corner | jump |\n");
  const auto line = [&](const std::string& mode) {
    fmt::print("| {} |", mode);
    for (const auto zone : {&Figures::interior, &Figures::edge, &Figures::corner, &Figures::jump}) {
      std::vector<double> values;
      for (const auto& [name, measured] : images)
        for (const auto& [level, figures] : measured.at(mode)) values.push_back((figures.*zone).rms());
      fmt::print(" {:.2f} |", median(values));
    }
    fmt::print("\n");
  };
  for (const Mode& mode : all_modes()) line(mode.name);
  fmt::print("| floor | |");
  for (const auto zone : {&Figures::edge_floor, &Figures::corner_floor}) {
    std::vector<double> values;
    for (const auto& [name, measured] : images)
      for (const auto& [level, figures] : measured.at("box")) values.push_back((figures.*zone).rms());
    fmt::print(" {:.2f} |", median(values));
  }
  fmt::print(" |\n");
}

void print_duel(const std::vector<std::pair<std::string, Measured>>& images) {
  fmt::print(
      "\n| image | edges: border error | jump | least squares: weight | border error | jump | better by |\n");
  const auto border = [](const Figures& f) { return f.border().rms(); };
  const auto jump = [](const Figures& f) { return f.jump.rms(); };
  int won = 0;
  for (const auto& [name, measured] : images) {
    const Levels& edges = measured.at("edges");
    for (const int weight : weights) {
      const Levels& ours = measured.at(fmt::format("weight {}", weight));
      if (over_levels(ours, jump) > over_levels(edges, jump) && weight != weights.back()) continue;
      const double gain = 1 - over_levels(ours, border) / over_levels(edges, border);
      won += gain > 0 && over_levels(ours, jump) <= over_levels(edges, jump);
      fmt::print("| {} | {:.2f} | {:.2f} | {} | {:.2f} | {:.2f} | {:.0f} % |\n", name,
                 over_levels(edges, border), over_levels(edges, jump), weight, over_levels(ours, border),
                 over_levels(ours, jump), 100 * gain);
      break;
    }
  }
  fmt::print("least squares is better on {} of {} images\n", won, images.size());
}

} // namespace

int main(int argc, char** argv) {
  const Settings settings = settings_of(argc, argv);
  std::vector<std::pair<std::string, Measured>> images;
  for (const std::string& file : settings.images) try {
      images.emplace_back(file.substr(file.rfind('/') + 1), measure(file, settings));
      fmt::print(stderr, "{}\n", images.back().first);
    } catch (const std::exception& e) {
      fmt::print(stderr, "{}: {}\n", file, e.what());
    }
  if (images.empty()) return 1;
  print_psnr(images);
  print_zones(images);
  print_duel(images);
}
