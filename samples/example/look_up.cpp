// Prints what lies at some points of the endless texture that a pack makes:
//   look_up PACK
#include <cstdio>
#include <tilepack/error/error.h>
#include <tilepack/pack/pack_read.h>
#include <tilepack/sampler/reference_sampler.h>
#include <vector>

int main(int count, char** arguments) try {
  if (count != 2) {
    std::fprintf(stderr, "usage: look_up PACK\n");
    return 1;
  }
  const tilepack::Pack pack = tilepack::read_pack(arguments[1]);
  const tilepack::ReferenceSampler sampler(pack, 0);
  const tilepack::Size tile = pack.tile_size;
  std::vector<double> texel(static_cast<std::size_t>(sampler.channels())); // linear light
  for (const double x : {0.5, 100.25, 12345.75}) {
    sampler.sample(tilepack::from_texels(x, tile.width), tilepack::from_texels(7.5, tile.height), 0.5,
                   tilepack::Filter::trilinear, texel);
    std::printf("%10.2f", x);
    for (int c = 0; c < sampler.channels(); ++c) std::printf("  %.4f", texel[static_cast<std::size_t>(c)]);
    std::printf("\n");
  }
} catch (const tilepack::Error& error) {
  std::fprintf(stderr, "look_up: %s\n", error.what());
  return tilepack::exit_code(error.kind());
}
