// What each mip mode is worth: bilinear lookups through a pack against the true mips of a random expansion.
//
//   bench_mip_error [--tile N] [--guard G] [--colors K] [--levels A-B] IMAGE...
//
// For every image a tile set is synthesised; for every mode and level past the guard band the root mean
// square error, in 8-bit units of the encoded value, inside tiles, within half a texel of an edge, and within
// half a texel of a lattice point, and the jump across borders.

#include "tilepack/image/image_file.h"
#include "tilepack/layout/de_bruijn.h"
#include "tilepack/layout/tile_index.h"
#include "tilepack/mapping/mapping.h"
#include "tilepack/mip/mip_chain.h"
#include "tilepack/mip/tile_frame.h"
#include "tilepack/synth/synthesize.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
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
  Figures all;
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

} // namespace

int main(int argc, char** argv) {
  int tile = 128;
  int guard = 0;
  int colors = 2;
  bool corner = false;
  Depth depth = Depth::u8;
  std::vector<int> weights{0, 1, 4, 10, 100};
  std::vector<std::string> images;
  for (int i = 1; i < argc; ++i) {
    const std::string a = argv[i];
    if (a == "--tile")
      tile = std::atoi(argv[++i]);
    else if (a == "--guard")
      guard = std::atoi(argv[++i]);
    else if (a == "--colors")
      colors = std::atoi(argv[++i]);
    else if (a == "--corner")
      corner = true;
    else if (a == "--float")
      depth = Depth::f32;
    else if (a == "--weights") {
      weights.clear();
      for (std::string list = argv[++i]; !list.empty();) {
        weights.push_back(std::atoi(list.c_str()));
        const auto comma = list.find(',');
        list = comma == std::string::npos ? "" : list.substr(comma + 1);
      }
    } else
      images.push_back(a);
  }
  struct Row {
    std::string mode;
    MipOptions options;
  };
  std::vector<Row> modes;
  for (const MipMode mode : {MipMode::box, MipMode::edges, MipMode::corners}) {
    MipOptions o;
    o.mode = mode;
    modes.push_back({std::string(name_of(mode)), o});
  }
  for (const int w : weights) {
    MipOptions o;
    o.mode = MipMode::least_squares;
    o.jump_weight = w;
    modes.push_back({fmt::format("lsq {}", w), o});
  }

  std::map<std::pair<std::string, int>, std::vector<std::vector<double>>> table; // (mode, level) → figures
  for (const std::string& file : images) {
    try {
      const ImageFile read = read_image(file);
      SynthOptions options;
      options.tile_size = {tile, tile};
      options.guard = guard;
      if (corner) {
        options.coloring = Coloring::corner;
        options.colors = {0, 0, colors};
      } else
        options.colors = {colors, colors, 0};
      const SampleMap sample{"color", Role::color, read.encoding, read.depth, read.image};
      const TileSet set = assembled(synthesize(std::span(&sample, 1), options), std::span(&sample, 1));
      const Layout layout = corner ? de_bruijn_layout(std::get<std::vector<CornerTile>>(set.tiles))
                                   : tile_index_layout(std::get<std::vector<EdgeTile>>(set.tiles));
      const PackNeighbours pack = pack_neighbours(layout);
      const Mapping mapping = mix_mapping({1 << 20, 1 << 20}, 1);
      MipOptions plain;
      plain.mode = MipMode::box;
      const auto truth = mip_chain(set, 0, plain);
      fmt::print("{}\n", file.substr(file.rfind('/') + 1));
      for (const Row& row : modes) {
        const auto chain = mip_chain(set, 0, row.options, &layout);
        fmt::print("  {:10}", row.mode);
        for (int level = 1; level < static_cast<int>(chain.size()); ++level) {
          if (exact_through_guard(guard, level)) continue;
          std::vector<Image> t, s;
          for (std::size_t id = 0; id < truth[0].tiles.size(); ++id) {
            t.push_back(to_linear(truth[as_size(level)].tiles[id], sample.encoding));
            s.push_back(to_linear(quantised(chain[as_size(level)].tiles[id], depth), sample.encoding));
          }
          const Figures f = measured(t, s, pack, mapping, set.colors, sample.encoding, level < 3 ? 12 : 30);
          fmt::print(" | {} {:.2f} {:.2f} {:.2f} j {:.2f}", level, f.interior.rms(), f.edge.rms(),
                     f.corner.rms(), f.jump.rms());
          table[{row.mode, level}].push_back({f.interior.rms(), f.edge.rms(), f.corner.rms(), f.jump.rms()});
        }
        fmt::print("\n");
      }
    } catch (const std::exception& e) {
      fmt::print("{}: {}\n", file, e.what());
    }
  }
  fmt::print("medians over images: interior edge corner jump\n");
  for (const Row& row : modes) {
    fmt::print("  {:10}", row.mode);
    std::vector<double> over[4];
    for (const auto& [key, figures] : table) {
      if (key.first != row.mode) continue;
      fmt::print(" | {}", key.second);
      for (std::size_t k = 0; k < 4; ++k) {
        std::vector<double> v;
        for (const auto& f : figures) v.push_back(f[k]);
        over[k].insert(over[k].end(), v.begin(), v.end());
        fmt::print(" {:.2f}", median(v));
      }
    }
    fmt::print(" | all {:.2f} {:.2f} {:.2f} j {:.2f}\n", median(over[0]), median(over[1]), median(over[2]),
               median(over[3]));
  }
}
