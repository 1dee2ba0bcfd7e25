#include "tilepack/bake/bake_options.h"
// Bakes an image into tiles and prints what lies at some points of the endless texture they make:
//   look_up SAMPLE.png
#include <array>
#include <cstdio>
#include <tilepack/bake/bake.h>
#include <tilepack/error/error.h>
#include <tilepack/image/image_file.h>
#include <tilepack/sampler/reference_sampler.h>
#include <vector>

int main(int count, char** arguments) try {
  if (count != 2) {
    std::fprintf(stderr, "usage: look_up SAMPLE.png\n");
    return 1;
  }
  const tilepack::ImageFile file = tilepack::read_image(arguments[1]);
  const tilepack::SampleMap sample{"color", tilepack::Role::color, file.encoding, file.depth, file.image};

  tilepack::BakeOptions options; // what is not set has its default
  options.synth.tile_size = {64, 64};
  const tilepack::Pack pack = tilepack::bake(std::array{sample}, options);

  const tilepack::ReferenceSampler sampler(pack, 0);
  std::vector<double> texel(static_cast<std::size_t>(sampler.channels())); // linear light
  for (const double x : {0.5, 100.25, 12345.75}) {
    sampler.sample(tilepack::from_texels(x, 64), tilepack::from_texels(7.5, 64), 0.5,
                   tilepack::Filter::trilinear, texel);
    std::printf("%10.2f", x);
    for (int c = 0; c < sampler.channels(); ++c) std::printf("  %.4f", texel[static_cast<std::size_t>(c)]);
    std::printf("\n");
  }
} catch (const tilepack::Error& error) {
  std::fprintf(stderr, "look_up: %s\n", error.what());
  return tilepack::exit_code(error.kind());
}
