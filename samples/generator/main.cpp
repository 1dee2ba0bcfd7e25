// Makes the samples of this folder: `make_samples FOLDER [NAME]...` writes them all, or those named.

#include "scenes.h"

#include "tilepack/error/error.h"
#include "tilepack/image/image_file.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using namespace tilepack;

constexpr int side = 512;
constexpr int oversampling = 2;

struct Subject {
  const char* name;
  samples::Surface (*surface)(int size, int oversampling, std::uint64_t seed);
};

constexpr std::array<Subject, 5> photos{{{"pebbles", samples::pebbles},
                                         {"meadow", samples::meadow},
                                         {"bricks", samples::bricks},
                                         {"planks", samples::planks},
                                         {"cracked", samples::cracked}}};

void write_photo(const std::filesystem::path& folder, const Subject& subject) {
  const samples::Surface surface = subject.surface(side, oversampling, 1);
  const Image linear = samples::shrunken(samples::photographed(surface, 2), oversampling);
  write_image(folder / (std::string(subject.name) + ".png"), from_linear(linear, Encoding::srgb), Depth::u8,
              Encoding::srgb);
}

// Heights keep 16 bits and span the whole range; the normals are those of the heights, upright on the whole.
void write_rock(const std::filesystem::path& folder) {
  const samples::Surface surface = samples::rock(side, oversampling, 1);
  const Image albedo = samples::shrunken(surface.albedo, oversampling);
  Image height = samples::shrunken(surface.height, oversampling);
  for (float& v : height.data()) v /= oversampling;
  samples::make_upright(height);
  write_image(folder / "rock_albedo.png", from_linear(albedo, Encoding::srgb), Depth::u8, Encoding::srgb);
  write_image(folder / "rock_normal.png", samples::normals_of(height, 1.0), Depth::u8, Encoding::linear);
  write_image(folder / "rock_roughness.png", samples::shrunken(surface.roughness, oversampling), Depth::u8,
              Encoding::linear);
  float lowest = height.data().front(), highest = lowest;
  for (const float v : height.data()) {
    lowest = std::min(lowest, v);
    highest = std::max(highest, v);
  }
  for (float& v : height.data()) v = (v - lowest) / (highest - lowest);
  write_image(folder / "rock_height.png", height, Depth::u16, Encoding::linear);
}

} // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.empty()) {
    std::fputs("usage: make_samples FOLDER [pebbles|meadow|bricks|planks|cracked|rock]...\n", stderr);
    return 1;
  }
  const auto wanted = [&](const std::string& name) {
    return arguments.size() == 1 ||
           std::find(arguments.begin() + 1, arguments.end(), name) != arguments.end();
  };
  try {
    for (const Subject& photo : photos)
      if (wanted(photo.name)) write_photo(arguments[0], photo);
    if (wanted("rock")) write_rock(arguments[0]);
  } catch (const Error& error) {
    std::fprintf(stderr, "make_samples: %s\n", error.what());
    return exit_code(error.kind());
  }
  return 0;
}
