#include "bench_spans.h"

#include "tilepack/pack/pack_read.h"
#include "tilepack/scanline/view_render.h"
#include "tilepack/verify/image_metrics.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

namespace tilepack::cli {
namespace {

constexpr Size picture{1920, 1080};
const Camera rolled{{0, 2, 0}, {0, 0, -6}, {0.4, 1, 0}, 60};
constexpr int span_pixels = 1920;
constexpr int runs = 9;
constexpr double shortest_run = 4e-3; // seconds
constexpr double negligible = 0.1;    // pixels nobody sees

const std::vector<SpanOptions>& contenders() {
  static const std::vector<SpanOptions> list{
      {SpanMethod::exact, 0},          {SpanMethod::estimate, 0},        {SpanMethod::newton_direct, 0},
      {SpanMethod::newton_direct, 32}, {SpanMethod::newton, 0},          {SpanMethod::newton, 32},
      {SpanMethod::newton_general, 0}, {SpanMethod::newton_general, 32}, {SpanMethod::euler1, 0},
      {SpanMethod::euler1, 8},         {SpanMethod::euler1, 32},         {SpanMethod::euler2, 0},
      {SpanMethod::euler2, 8},         {SpanMethod::euler2, 32},         {SpanMethod::affine, 8},
      {SpanMethod::affine, 16},        {SpanMethod::affine, 32}};
  return list;
}

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Timing {
  double median = 0; // seconds a call
  double spread = 0;
};

// Calls are bundled until a run is long enough for the clock; the first bundle also warms the caches.
Timing timed(const std::function<void()>& work) {
  int calls = 1;
  while (seconds_of([&] {
           for (int i = 0; i < calls; ++i) work();
         }) < shortest_run)
    calls *= 2;
  std::vector<double> seconds;
  for (int run = 0; run < runs; ++run) {
    seconds.push_back(seconds_of([&] {
                        for (int i = 0; i < calls; ++i) work();
                      }) /
                      calls);
  }
  std::sort(seconds.begin(), seconds.end());
  const double median = seconds[seconds.size() / 2];
  return {median, (seconds.back() - seconds.front()) / median};
}

// 32 scanlines with horizons from 1 to 10^6 pixels behind their ends.
std::vector<Span> timed_spans() {
  std::vector<Span> spans(scanlines_side_by_side);
  for (std::size_t i = 0; i < spans.size(); ++i) {
    spans[i].count = span_pixels;
    spans[i].du = 0.01;
    spans[i].dv = -0.004;
    spans[i].bend = 1 / (span_pixels - 1 + std::pow(10.0, static_cast<double>(i) * 6 / 31));
  }
  return spans;
}

template <class Real>
void time_method(SpanFigures& figures) {
  const std::vector<Span> spans = timed_spans();
  std::vector<Real> u(span_pixels), v(span_pixels);
  SpanBatch<Real> batch;
  fill_spans<Real>(spans, figures.options, batch);
  for (std::size_t lane = 0; lane < spans.size(); ++lane) {
    fill_span<Real>(spans[lane], figures.options, u, v);
    for (int n = 0; n < span_pixels; ++n) {
      const Real value = u[static_cast<std::size_t>(n)];
      if (!std::isfinite(value) || value != batch.u_at(static_cast<int>(lane), n)) {
        throw Error(ErrorKind::check_failed, name_of(figures.options),
                    fmt::format("pixel {} of scanline {} differs side by side; this is a fault of tilepack",
                                n, lane));
      }
    }
  }
  const double pixels = static_cast<double>(span_pixels) * static_cast<double>(spans.size());
  const auto one_by_one = [&] {
    for (const Span& span : spans) fill_span<Real>(span, figures.options, u, v);
  };
  figures.one_by_one = timed(one_by_one).median / pixels * 1e9;
  const Timing batched = timed([&] { fill_spans<Real>(spans, figures.options, batch); });
  figures.side_by_side = batched.median / pixels * 1e9;
  figures.spread = batched.spread;
  const auto fused = [&] { fill_spans<Real>(spans, figures.options, batch, BatchArithmetic::fused); };
  figures.fused = timed(fused).median / pixels * 1e9;
}

SpanFigures figures_of(const SpanOptions& options, SpanPrecision precision) {
  SpanFigures figures;
  figures.options = options;
  figures.precision = precision;
  for (const SpanCase& c : span_cases()) figures.errors.push_back(span_error(c.span, options, precision));
  if (precision == SpanPrecision::f32)
    time_method<float>(figures);
  else
    time_method<double>(figures);
  return figures;
}

std::vector<HardFigures> hard_figures() {
  std::vector<HardFigures> all;
  for (const HardCase& hard : hard_cases()) {
    HardFigures figures{hard.name, {}, {}};
    for (Contestant c : all_contestants) {
      figures.f32.push_back(run_contestant(c, hard, SpanPrecision::f32));
      figures.f64.push_back(run_contestant(c, hard, SpanPrecision::f64));
    }
    all.push_back(figures);
  }
  return all;
}

template <class Real>
double stepping_seconds(const std::vector<ViewSpan>& views, const ViewStepping& stepping) {
  std::vector<Span> spans;
  for (const ViewSpan& view : views) spans.push_back(view.span);
  SpanBatch<Real> batch;
  return timed([&] {
           for (std::size_t first = 0; first < spans.size(); first += scanlines_side_by_side) {
             const std::size_t count = std::min<std::size_t>(scanlines_side_by_side, spans.size() - first);
             fill_spans<Real>({spans.data() + first, count}, stepping.options, batch);
           }
         })
      .median;
}

Image textured(const ViewTexture& texture, const ProjectedScene& scene, const ViewStepping& stepping) {
  constexpr int band = scanlines_side_by_side;
  Image image(picture.width, picture.height, texture.channels());
  const std::vector<float> background(static_cast<std::size_t>(texture.channels()), 0.0f);
  tbb::parallel_for(0, (picture.height + band - 1) / band, [&](int i) {
    const int rows = std::min(band, picture.height - i * band);
    const auto pixels = view_pixels(scene.spans(i * band, rows), picture.width, i * band, rows, stepping);
    paste(image, texture.shade(pixels, background), 0, i * band);
  });
  return image;
}

void measure_views(SpanBench& bench, const std::string& pack_name, const Progress& progress) {
  const Projection projection(rolled, picture);
  Scene ground;
  ground.planes.push_back({});
  std::vector<ViewSpan> spans;
  std::optional<ProjectedScene> scene;
  const Timing set_up = timed([&] {
    scene.emplace(ground, projection);
    spans = scene->spans(0, picture.height);
  });
  for (const ViewSpan& view : spans) bench.view_pixels += view.span.count;
  const double pixels = static_cast<double>(bench.view_pixels);
  bench.set_up = set_up.median / pixels * 1e9;

  const ViewStepping truth{{SpanMethod::exact, 0}, SpanPrecision::f64, 0};
  const ViewPixels exact = view_pixels(spans, picture.width, 0, picture.height, truth);
  std::optional<Pack> pack;
  std::optional<ViewTexture> texture;
  Image exact_picture;
  Size tile{128, 128};
  if (!pack_name.empty()) {
    pack = read_pack(pack_name);
    tile = pack->tile_size;
    const PackedMap& map = pack->maps[0];
    texture.emplace(*pack, 0, RenderTarget{map.encoding, map.depth}, ViewFilter::trilinear);
    const std::vector<float> background(static_cast<std::size_t>(texture->channels()), 0.0f);
    bench.texturing = seconds_of([&] { texture->shade(exact, background); }) / pixels * 1e9;
    exact_picture = textured(*texture, *scene, truth);
  }

  const std::vector<ViewStepping> steppings{truth,
                                            {{SpanMethod::exact, 0}, SpanPrecision::f32, 0},
                                            {{SpanMethod::estimate, 0}, SpanPrecision::f32, 0},
                                            {{SpanMethod::newton_direct, 0}, SpanPrecision::f32, 0},
                                            {{SpanMethod::newton, 0}, SpanPrecision::f32, 0},
                                            {{SpanMethod::newton, 32}, SpanPrecision::f32, 0},
                                            {{SpanMethod::newton, 0}, SpanPrecision::f64, 0},
                                            {{SpanMethod::newton_general, 0}, SpanPrecision::f32, 0},
                                            {{SpanMethod::euler1, 0}, SpanPrecision::f32, 0},
                                            {{SpanMethod::euler2, 0}, SpanPrecision::f32, 0},
                                            {{SpanMethod::euler2, 0}, SpanPrecision::f32, 0.05},
                                            {{SpanMethod::affine, 8}, SpanPrecision::f32, 0},
                                            {{SpanMethod::affine, 16}, SpanPrecision::f32, 0}};
  for (const ViewStepping& stepping : steppings) {
    report(progress, "views",
           static_cast<double>(bench.views.size()) / static_cast<double>(steppings.size()));
    ViewFigures figures;
    figures.options = stepping.options;
    figures.precision = stepping.precision;
    figures.wanted_error = stepping.wanted_error;
    if (stepping.wanted_error == 0) {
      const bool single = stepping.precision == SpanPrecision::f32;
      const double seconds =
          single ? stepping_seconds<float>(spans, stepping) : stepping_seconds<double>(spans, stepping);
      figures.stepping = seconds / pixels * 1e9;
    }
    figures.shift = difference(exact, view_pixels(spans, picture.width, 0, picture.height, stepping), tile);
    if (texture) {
      const Image seen = textured(*texture, *scene, stepping);
      figures.psnr = difference(exact_picture, seen, ValueRange::unit, 255).psnr;
      figures.textured = true;
    }
    bench.views.push_back(figures);
  }
}

// The report appears whole or not at all.
void write_whole(const std::string& name, const std::string& text) {
  const std::string partial = name + ".partial";
  std::error_code fault;
  {
    std::ofstream file(partial, std::ios::binary);
    file << text;
    if (!file.flush()) fault = std::make_error_code(std::errc::io_error);
  }
  if (!fault) std::filesystem::rename(partial, name, fault);
  if (!fault) return;
  std::filesystem::remove(partial, fault);
  throw Error(ErrorKind::cannot_write, name,
              "the report can't be written there; name a file in a folder "
              "that exists and may be written to");
}

std::vector<std::string> advice_on(const SpanBench& bench) {
  std::vector<std::string> advice;
  for (SpanPrecision precision : {SpanPrecision::f32, SpanPrecision::f64}) {
    const SpanFigures* division = nullptr;
    const SpanFigures* fastest = nullptr;
    const SpanFigures* fastest_alone = nullptr;
    for (const SpanFigures& f : bench.methods) {
      if (f.precision != precision) continue;
      if (f.options.method == SpanMethod::exact) division = &f;
      // Steep spans, horizon 100 pixels behind the last: the third case.
      const bool good = f.errors[2].pixels <= negligible;
      if (good && (!fastest || f.side_by_side < fastest->side_by_side)) fastest = &f;
      if (good && (!fastest_alone || f.one_by_one < fastest_alone->one_by_one)) fastest_alone = &f;
    }
    if (!division || !fastest || !fastest_alone) continue;
    const auto verdict = [&](const char* how, const SpanFigures& best, double best_ns, double division_ns) {
      if (best_ns > 0.95 * division_ns) {
        return fmt::format("{}, {}: plain division has won; nothing within {} pixels (horizon 100 pixels "
                           "behind) is 5 % faster than its {:.2f} ns a pixel.",
                           name_of(precision), how, negligible, division_ns);
      }
      return fmt::format(
          "{}, {}: {} is the fastest within {} pixels (horizon 100 pixels behind), {:.2f} ns a "
          "pixel, {:.2f} times as fast as division ({:.2f} ns).",
          name_of(precision), how, name_of(best.options), negligible, best_ns, division_ns / best_ns,
          division_ns);
    };
    advice.push_back(
        verdict("32 scanlines side by side", *fastest, fastest->side_by_side, division->side_by_side));
    advice.push_back(
        verdict("one scanline at a time", *fastest_alone, fastest_alone->one_by_one, division->one_by_one));
  }
  for (const SpanFigures& f : bench.methods) {
    if (f.precision != SpanPrecision::f32 || f.options.reseed != 0) continue;
    const double beyond = f.errors.back().beyond;
    if (f.options.method == SpanMethod::newton || f.options.method == SpanMethod::newton_general)
      advice.push_back(fmt::format("f32, 16384 pixels: {} drifts {:.2g} pixels beyond its bound; re-seed it, "
                                   "or take newton-direct.",
                                   name_of(f.options), beyond));
  }
  if (bench.texturing > 0) {
    advice.push_back(fmt::format("In a textured view all of this is small change: set-up {:.2f}, stepping "
                                 "{:.2f} (division), texturing {:.0f} ns a pixel.",
                                 bench.set_up, bench.views[1].stepping, bench.texturing));
  }
  advice.push_back(
      "So: exact in f32 wherever the vector unit divides; newton-direct where division is slow or "
      "missing; affine between exact values only for nearly straight spans; f64 is never needed for "
      "offsets kept relative to the start of their span.");
  return advice;
}

} // namespace

std::string name_of(const SpanOptions& options) {
  std::string name(tilepack::name_of(options.method));
  return options.reseed > 0 ? fmt::format("{}, every {}", name, options.reseed) : name;
}

int bench_spans(const SpanBenchArguments& arguments, Console& console) {
  if (arguments.format != "text" && arguments.format != "json") {
    throw Error(ErrorKind::usage, "--format", fmt::format("'{}'; it is text or json", arguments.format));
  }
  const Progress progress = console.progress();
  SpanBench bench;
  bench.target = batch_target();
  for (SpanPrecision precision : {SpanPrecision::f32, SpanPrecision::f64})
    for (const SpanOptions& options : contenders()) {
      report(progress, "span methods",
             static_cast<double>(bench.methods.size()) / (2.0 * static_cast<double>(contenders().size())));
      bench.methods.push_back(figures_of(options, precision));
    }
  bench.hard = hard_figures();
  bench.curves = error_curves(16384, 2000, 64);
  measure_views(bench, arguments.pack, progress);
  bench.advice = advice_on(bench);

  if (!arguments.report.empty()) {
    write_whole(arguments.report, spans_html(bench));
  }
  console.print(arguments.format == "json" ? spans_json(bench) : spans_text(bench));
  return 0;
}

} // namespace tilepack::cli
