#include "jobs.h"
#include "render_camera.h"
#include "render_window.h"
#include "value_check.h"
#include "verb.h"

#include "tilepack/bake/depfile.h"
#include "tilepack/bake/output_check.h"
#include "tilepack/bake/text_file.h"
#include "tilepack/image/image_file.h"
#include "tilepack/pack/staged_outputs.h"
#include "tilepack/scene/scene_render.h"
#include "tilepack/scene/scene_report.h"
#include "tilepack/scene/scene_texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tilepack::cli {
namespace {

constexpr int usual_side = 1024; // pixels of the window, unless the scene is smaller
constexpr int most_frames = 100000;
constexpr std::size_t band_values = 4 * 1024 * 1024; // floats rendered between two writes

struct ComposeArguments {
  std::string scene;
  std::string output;
  std::string map;
  std::optional<std::string> rect;
  std::string filter; // empty: trilinear for windows, anisotropic for camera views
  std::string encoding;
  std::string depfile;
  std::string format = "text";
  bool asks_for_report = false; // though quiet
  std::string frames;
  std::optional<double> time;
  double step = 1;
  int level = 0;
  double scale = 1;
  int jobs = 0;
  CameraArguments view;
};

// A picture of the sequence.
struct Frame {
  std::string file;
  double time = 0;
};

constexpr const char* elliptical = "elliptical"; // the mean over what a pixel covers, as `render` calls it

PatternFilter pattern_filter_of(const std::string& name, bool is_view) {
  if (name.empty()) return is_view ? PatternFilter::anisotropic : PatternFilter::trilinear;
  if (name == elliptical) return PatternFilter::supersampled;
  std::vector<std::string> known = names_of<PatternFilter>();
  known.emplace_back(elliptical);
  if (const auto filter = enum_named<PatternFilter>(name)) return *filter;
  refuse_name(name, "--filter", "filter", known);
}

// "walk.png" as "walk_0012.png".
std::string numbered(const std::string& file, std::int64_t number, int digits) {
  const std::filesystem::path path(file);
  const std::string sign = number < 0 ? "-" : "";
  return (path.parent_path() / fmt::format("{}_{}{:0{}}{}", path.stem().string(), sign, std::abs(number),
                                           digits, path.extension().string()))
      .string();
}

std::vector<Frame> frames_of(const ComposeArguments& arguments) {
  const double time = arguments.time.value_or(0);
  if (arguments.frames.empty()) return {{arguments.output, time}};
  std::int64_t first = 0, last = 0;
  const char* const end = arguments.frames.data() + arguments.frames.size();
  const auto [dots, fault] = std::from_chars(arguments.frames.data(), end, first);
  bool good = fault == std::errc() && end - dots > 2 && dots[0] == '.' && dots[1] == '.';
  if (good) {
    const auto [after, second_fault] = std::from_chars(dots + 2, end, last);
    good = second_fault == std::errc() && after == end && first <= last && std::abs(first) <= 1'000'000'000 &&
           last <= 1'000'000'000;
  }
  if (!good)
    throw Error(ErrorKind::usage, "--frames",
                fmt::format("'{}' is no sequence; give the first and the last frame as A..B, such as 0..23",
                            arguments.frames));
  if (last - first >= most_frames)
    throw Error(ErrorKind::usage, "--frames",
                fmt::format("{} frames; at most {} are made at once", last - first + 1, most_frames));
  const int digits =
      std::max<int>(4, static_cast<int>(std::to_string(std::max(std::abs(first), last)).size()));
  std::vector<Frame> frames;
  for (std::int64_t number = first; number <= last; ++number)
    frames.push_back(
        {numbered(arguments.output, number, digits), time + static_cast<double>(number) * arguments.step});
  return frames;
}

std::size_t map_called(const SceneFile& scene, const std::string& name) {
  if (name.empty()) return 0;
  std::vector<std::string> known;
  for (std::size_t i = 0; i < scene.maps.size(); ++i) {
    if (scene.maps[i].name == name) return i;
    known.push_back(scene.maps[i].name);
  }
  refuse_name(name, "--map", "map", known);
}

SceneView view_of(const ComposeArguments& arguments, const SceneFile& scene) {
  SceneView view;
  view.level = arguments.level;
  view.scale = arguments.scale;
  const auto side = [&](std::int64_t texels) {
    return static_cast<int>(std::clamp<std::int64_t>(texels >> view.level, 1, usual_side));
  };
  view.rect = arguments.rect ? parsed_rect(*arguments.rect)
                             : VirtualRect{0, 0, side(scene.size[0]), side(scene.size[1])};
  return view;
}

class Composer {
public:
  Composer(const ComposeArguments& of_arguments, Console& of_console)
      : arguments(of_arguments), console(of_console), scene(read_scene(arguments.scene)), files(scene),
        map(map_called(scene, arguments.map)),
        target(target_for(arguments.output, picture_format(scene.maps[map]), arguments.encoding)) {
    options.filter = pattern_filter_of(arguments.filter, arguments.view.camera.has_value());
    if (options.filter == PatternFilter::supersampled) options.coarse_map = 0;
  }

  int run() {
    const std::vector<Frame> frames = frames_of(arguments);
    scene_graph(scene, files, frames.front().time); // whatever is wrong is said before an output is looked at
    std::vector<OutputFile> outputs{{"--depfile", arguments.depfile}};
    for (const Frame& frame : frames) outputs.push_back({"--output", frame.file});
    const std::vector<std::string> inputs = inputs_read();
    check_outputs(outputs, inputs);
    check_text_name(outputs.front());
    if (!arguments.depfile.empty()) check_writable(arguments.depfile);
    report.scene = arguments.scene;
    report.map = scene.maps[map].name;
    report.frames = static_cast<int>(frames.size());
    StagedOutputs staged;
    const Progress progress = console.progress();
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const Progress part = [&](std::string_view stage, double done) {
        if (progress) progress(stage, (static_cast<double>(i) + done) / static_cast<double>(frames.size()));
      };
      draw(frames[i], staged, part);
    }
    report.files = files.uses();
    if (!console.quiet || arguments.asks_for_report)
      console.print(arguments.format == "json" ? scene_report_json(report) : scene_report_text(report));
    staged.commit(progress);
    if (!arguments.depfile.empty()) {
      write_text_file(arguments.depfile, depfile_text(frames.front().file, inputs));
    }
    return 0;
  }

private:
  std::vector<std::string> inputs_read() const {
    std::vector<std::string> inputs = files.inputs();
    if (!arguments.view.mesh.empty()) inputs.push_back(arguments.view.mesh);
    return inputs;
  }

  void draw(const Frame& frame, StagedOutputs& staged, const Progress& progress) {
    const SceneGraph made = scene_graph(scene, files, frame.time);
    options.time = frame.time;
    const PatternTexture texture(made.graph, static_cast<int>(map), options);
    if (arguments.view.camera) {
      const SceneTexture seen(texture, made.graph.unit);
      report.picture = draw_camera(arguments.view, seen, scene.maps[map].role == Role::color, target,
                                   staged.add_file(frame.file), progress);
    } else {
      const SceneWindow window(texture, made.graph, scene.size, view_of(arguments, scene), target);
      report.picture = window.size();
      const std::size_t row_values =
          static_cast<std::size_t>(window.size().width) * static_cast<std::size_t>(window.channels());
      const int band = static_cast<int>(std::max<std::size_t>(1, band_values / row_values));
      report.band_bytes =
          row_values * static_cast<std::size_t>(std::min(band, window.size().height)) * sizeof(float);
      ImageWriter writer(staged.add_file(frame.file), window.size(), window.channels(),
                         usual_format(target.depth, target.encoding));
      for (int row = 0; row < window.size().height; row += band) {
        tilepack::report(progress, "compose", static_cast<double>(row) / window.size().height);
        writer.write(window.rows(row, std::min(band, window.size().height - row)));
      }
      writer.finish();
    }
    report.texture_bytes = std::max(report.texture_bytes, texture.bytes());
    const auto nodes = scene_report_nodes(scene, made, texture.used_nodes());
    if (report.nodes.empty()) report.nodes = nodes;
    for (std::size_t i = 0; i < nodes.size(); ++i)
      report.nodes[i].is_used = report.nodes[i].is_used || nodes[i].is_used;
  }

  const ComposeArguments& arguments;
  Console& console;
  SceneFile scene;
  SceneFiles files;
  std::size_t map;
  RenderTarget target;
  PatternOptions options;
  SceneReport report;
};

Action declare_compose(Options& options) {
  auto a = std::make_shared<ComposeArguments>();
  options
      .option("SCENE", a->scene,
              "a scene, a JSON file; lib/tilepack/scene/SCENES.md tells of its blocks; a tile of camera "
              "views is 256 texels")
      .required();
  options
      .option("-o,--output", a->output,
              "picture to write, .png or .exr; its folder is made if it is not there")
      .required()
      .value("FILE");
  options.option("--map", a->map, "name of the scene's map (default: the first)").value("NAME");
  options
      .option("--rect", a->rect,
              "window in texels of the level, anywhere; the scene repeats (default: all of it, but 1024 x "
              "1024 texels at most)")
      .value("X,Y,W,H");
  options
      .option("--level", a->level, "mip level, 0 the finest; a level halves the texels of a side (default 0)")
      .check(whole_number(0, 30))
      .value("L");
  options
      .option("--filter", a->filter,
              "how texels are filtered: nearest, bilinear, trilinear (default), anisotropic (default for "
              "camera views), or "
              "elliptical, the mean of many samples over what a pixel covers")
      .value("NAME");
  options.option("--scale", a->scale, "pixels a texel (default 1): pixel i samples X + (i + 0.5) / S")
      .check(positive_number(65536, " (1: a pixel a texel)"))
      .value("S");
  options
      .option("--encoding", a->encoding,
              "encoding of the picture: srgb or linear (default: srgb for color in PNG, else linear)")
      .value("NAME");
  options.option("--time", a->time, "time of the picture in steps of animations (default 0)")
      .check(number(-1e12, 1e12))
      .value("T");
  options
      .option("--frames", a->frames,
              "pictures A to B of a sequence: FILE_0000.png and so on; picture n shows the time T + n times "
              "--step")
      .value("A..B");
  options.option("--step", a->step, "steps of time from picture to picture (default 1)")
      .check(number(-1e6, 1e6))
      .value("N");
  options
      .option("--format", a->format, "of the report on stdout: what was used, read and held (default text)")
      .one_of("text|json");
  options.option("--depfile", a->depfile, "write a rule for make or ninja: what the picture depends on")
      .value("FILE");
  add_jobs_option(options, a->jobs);
  add_camera_options(options, a->view);
  return [a, &options](Console& console) {
    (a->view.camera ? refuse_window_options : refuse_camera_options)(options);
    if (options.given("--step") && a->frames.empty())
      throw Error(ErrorKind::usage, "--step", "goes with --frames; give both, or --time alone");
    a->asks_for_report = options.given("--format");
    const JobLimit limit(a->jobs);
    return Composer(*a, console).run();
  };
}

} // namespace

Verb compose_verb() {
  return {"compose", "draw a scene: packs and patterns combined by maps",
          "  tilepack compose landscape.json -o landscape.png\n"
          "  tilepack compose landscape.json -o far.png --rect 0,0,1024,1024 --level 10\n"
          "  tilepack compose landscape.json -o view.png --camera 0,4,0,0,0,-9,0,1,0,60\n"
          "  tilepack compose board.json -o board.png --frames 0..23\n",
          declare_compose};
}

} // namespace tilepack::cli
