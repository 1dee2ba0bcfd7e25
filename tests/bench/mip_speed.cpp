// Mip chains against maketx, on the same image in the same run.
//
//   bench_mip_speed [SIDE]     SIDE: of the image, a multiple of 256; 4096 unless given

#include "tilepack/image/image_file.h"
#include "tilepack/layout/tile_index.h"
#include "tilepack/mip/mip_chain.h"
#include "tilepack/numeric/random.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <sys/resource.h>
#include <sys/time.h>

using namespace tilepack;

namespace {

// Wall time, and processor time of all threads and of finished children: the latter hardly depends on what
// else the machine does.
struct Seconds {
  double wall = 1e9;
  double processor = 1e9;
};

double processor_seconds() {
  double sum = 0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    getrusage(who, &usage);
    for (const timeval& t : {usage.ru_utime, usage.ru_stime})
      sum += static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_usec) * 1e-6;
  }
  return sum;
}

template <typename F>
Seconds least(int times, F&& f) {
  Seconds best;
  for (int i = 0; i < times; ++i) {
    const auto start = std::chrono::steady_clock::now();
    const double before = processor_seconds();
    f();
    best.processor = std::min(best.processor, processor_seconds() - before);
    best.wall =
        std::min(best.wall, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return best;
}

void print_line(const std::string& name, Seconds s, double megatexels, Seconds maketx) {
  fmt::print("{:24} {:8.1f} ms wall {:8.1f} ms processor {:7.1f} Mtexel/s   x maketx: {:6.1f} wall {:6.1f} "
             "processor\n",
             name, s.wall * 1e3, s.processor * 1e3, megatexels / s.wall, maketx.wall / s.wall,
             maketx.processor / s.processor);
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
  const Seconds maketx = least(2, [&] {
    std::filesystem::remove(target);
    if (std::system(command.c_str()) != 0) fmt::print("maketx failed\n");
  });
  print_line("maketx", maketx, megatexels, maketx);
  for (const int threads : {4, 1}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    for (const MipMode mode : {MipMode::box, MipMode::edges, MipMode::corners, MipMode::least_squares}) {
      MipOptions options;
      options.mode = mode;
      const Seconds ours =
          least(mode == MipMode::least_squares ? 1 : 9, [&] { coarser_levels(set, 0, options, &layout); });
      print_line(fmt::format("{} {} threads", name_of(mode), threads), ours, megatexels, maketx);
    }
  }
  std::filesystem::remove_all(folder);
}
