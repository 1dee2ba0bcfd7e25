// Mip chains against maketx, on the same image in the same run.
//
//   bench_mip_speed [SIDE]     SIDE: of the image, a multiple of 256; 4096 unless given

#include "tilepack/image/image_file.h"
#include "tilepack/layout/tile_index.h"
#include "tilepack/mip/mip_chain.h"
#include "tilepack/tileset/random.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>

using namespace tilepack;

namespace {

template <typename F>
double best_seconds(int times, F&& f) {
  double best = 1e9;
  for (int i = 0; i < times; ++i) {
    const auto start = std::chrono::steady_clock::now();
    f();
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return best;
}

} // namespace

int main(int argc, char** argv) {
  const int side = argc > 1 ? std::atoi(argv[1]) : 4096;
  const int colors = 4;
  const int tile = side / (colors * colors);
  TileSet set{{tile, tile}, {colors, colors, 0}, complete_edge_set(colors, colors), {}, 0};
  TileMap map{"color", Role::color, Encoding::srgb, Depth::u8, std::vector<Image>(256)};
  tbb::parallel_for(0, 256, [&](int id) {
    Image image(tile, tile, 3);
    for (std::size_t i = 0; i < image.data().size(); ++i)
      image.data()[i] =
          static_cast<float>(random_bits(1, "noise", i / 5 + static_cast<std::size_t>(id) * 1000000) & 255) /
          255.0f;
    map.tiles[static_cast<std::size_t>(id)] = image;
  });
  set.maps.push_back(map);
  const Layout layout = tile_index_layout(std::get<std::vector<EdgeTile>>(set.tiles));
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "tilepack_bench_mip_speed";
  std::filesystem::create_directories(folder);
  const std::string source = (folder / "image.png").string();
  const std::string target = (folder / "image.tx").string();
  write_image(source, atlas(set.maps[0].tiles, layout), Depth::u8, Encoding::srgb);

  const double megatexels = static_cast<double>(side) * side * 1e-6;
  const std::string command = fmt::format("maketx -u {} -o {} >/dev/null 2>&1", source, target);
  std::filesystem::remove(target);
  const double maketx = best_seconds(3, [&] {
    std::filesystem::remove(target);
    if (std::system(command.c_str()) != 0) fmt::print("maketx failed\n");
  });
  fmt::print("{:24} {:8.1f} ms {:8.1f} Mtexel/s\n", "maketx", maketx * 1e3, megatexels / maketx);
  for (const int threads : {4, 1}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    for (const MipMode mode : {MipMode::box, MipMode::edges, MipMode::corners, MipMode::least_squares}) {
      MipOptions options;
      options.mode = mode;
      const double ours = best_seconds(mode == MipMode::least_squares ? 1 : 7,
                                       [&] { coarser_levels(set, 0, options, &layout); });
      fmt::print("{:14} {} threads {:8.1f} ms {:8.1f} Mtexel/s {:6.1f} x maketx\n", name_of(mode), threads,
                 ours * 1e3, megatexels / ours, maketx / ours);
    }
  }
  std::filesystem::remove_all(folder);
}
