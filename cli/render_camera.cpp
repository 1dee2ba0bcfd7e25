#include "render_camera.h"

#include "value_check.h"

#include "tilepack/image/image_file.h"
#include "tilepack/pack/staged_outputs.h"
#include "tilepack/scanline/mesh.h"
#include "tilepack/scanline/view_render.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace tilepack::cli {
namespace {

constexpr int band_rows = 256;
constexpr std::array camera_options{"--size",   "--mesh",       "--repeat",    "--span",
                                    "--reseed", "--span-error", "--precision", "--background"};

constexpr std::array window_options{"--rect", "--level", "--scale"};

Size parsed_size(const std::string& text) {
  Size size;
  const char* const end = text.data() + text.size();
  const auto [cross, fault] = std::from_chars(text.data(), end, size.width);
  if (fault == std::errc() && cross != end && (*cross == 'x' || *cross == 'X')) {
    const auto [after, second_fault] = std::from_chars(cross + 1, end, size.height);
    if (second_fault == std::errc() && after == end) return size;
  }
  throw Error(ErrorKind::usage, "--size",
              fmt::format("'{}' is no size; give WIDTHxHEIGHT in pixels, such as 1920x1080", text));
}

std::vector<float> parsed_background(const std::string& text) {
  std::vector<float> values;
  if (text.empty()) return values;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (;;) {
    float value = 0;
    const auto [after, fault] = std::from_chars(at, end, value);
    if (fault != std::errc() || (after != end && *after != ',')) {
      throw Error(
          ErrorKind::usage, "--background",
          fmt::format("'{}' is no list of numbers with commas, one a channel, such as 0.5,0.6,0.8", text));
    }
    values.push_back(value);
    if (after == end) return values;
    at = after + 1;
  }
}

std::string text_of(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream.is_open() || std::filesystem::is_directory(file)) {
    throw Error(ErrorKind::cannot_read, file, "can't be read; give a Wavefront OBJ file");
  }
  return {std::istreambuf_iterator<char>(stream), {}};
}

Scene scene_of(const CameraArguments& arguments) {
  Scene scene;
  if (!arguments.mesh.empty()) {
    scene.triangles = parse_obj(text_of(arguments.mesh), arguments.mesh, arguments.repeat);
  } else {
    const double tile = 1 / arguments.repeat;
    scene.planes.push_back({{0, 0, 0}, {tile, 0, 0}, {0, 0, tile}});
  }
  return scene;
}

} // namespace

void add_camera_options(Options& options, CameraArguments& a) {
  options.group("Camera views");
  options
      .option("--camera", a.camera,
              "view in perspective: eye x,y,z, target x,y,z, up x,y,z and the vertical field of view in "
              "degrees, ten numbers; the ground is the plane y = 0, v growing with z")
      .value("EYE,TARGET,UP,FOV");
  options.option("--size", a.size, "size of the view in pixels (default 1280x720)").value("WxH");
  options.option("--mesh", a.mesh, "triangles with texture coordinates instead of the ground, an OBJ file")
      .value("FILE.obj");
  options
      .option(
          "--repeat", a.repeat,
          "tiles a world unit of the ground or a unit of texture coordinate, 0.000001 to 1000000 (default "
          "1)")
      .check(number(1e-6, 1e6, " tiles a unit"))
      .value("N");
  options
      .option("--span", a.span,
              "how scanlines are stepped: exact (default), euler1, euler2, newton, newton-direct, "
              "newton-general, affine, estimate")
      .value("METHOD");
  options.option("--reseed", a.reseed, "an exact value every N pixels (default: only at the near end)")
      .check(whole_number(0, max_span_pixels, " (0: only at the near end)"))
      .value("N");
  options
      .option("--span-error", a.span_error,
              "choose --reseed so that no pixel is off by more than this many, at most 1000")
      .check(positive_number(1000, " pixels"))
      .value("PIXELS");
  options.option("--precision", a.precision, "of the stepping; f32 unless given").one_of("f32|f64");
  options
      .option(
          "--background", a.background,
          "what shows where nothing is: sky, or one stored value a channel (default sky for color maps, 0 "
          "for others)")
      .value("sky|V,V,V");
}

void refuse_camera_options(const Options& options) {
  for (const char* name : camera_options) {
    if (options.given(name)) {
      throw Error(ErrorKind::usage, name, "is for camera views only; add --camera or leave it out");
    }
  }
}

void refuse_window_options(const Options& options) {
  for (const char* name : window_options) {
    if (options.given(name)) {
      throw Error(ErrorKind::usage, name, "is for windows of the texture; leave it or --camera out");
    }
  }
}

Size draw_camera(const CameraArguments& arguments, const Texture& texture, bool shows_color,
                 const RenderTarget& target, StagedFile& output, const Progress& progress) {
  if (arguments.span_error > 0 && arguments.reseed > 0) {
    throw Error(ErrorKind::usage, "--span-error", "chooses --reseed; give one of the two");
  }
  ViewOptions options;
  options.stepping = {{span_method_of(arguments.span), arguments.reseed},
                      arguments.precision == "f64" ? SpanPrecision::f64 : SpanPrecision::f32,
                      arguments.span_error};
  options.sky = arguments.background == "sky" || (arguments.background.empty() && shows_color);
  if (!options.sky) options.background = parsed_background(arguments.background);
  const ViewRenderer renderer(texture, scene_of(arguments), camera_of(*arguments.camera),
                              parsed_size(arguments.size), options, target);

  const Size size = renderer.size();
  ImageWriter writer(output, size, renderer.channels(), usual_format(target.depth, target.encoding));
  for (int row = 0; row < size.height; row += band_rows) {
    report(progress, "render", static_cast<double>(row) / size.height);
    writer.write(renderer.rows(row, std::min(band_rows, size.height - row)));
  }
  writer.finish();
  return size;
}

int render_camera(const CameraArguments& arguments, const Texture& texture, bool shows_color,
                  const RenderTarget& target, const std::string& output, Console& console) {
  const Progress progress = console.progress();
  StagedOutputs outputs;
  const Size size = draw_camera(arguments, texture, shows_color, target, outputs.add_file(output), progress);
  outputs.commit(progress);
  console.made(fmt::format("{}: {} x {} pixels, as a camera sees them", output, size.width, size.height),
               output);
  return 0;
}

} // namespace tilepack::cli
