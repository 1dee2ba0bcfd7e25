#include "bench_spans.h"

#include "output_file.h"

#include "tilepack/measure/image_metrics.h"
#include "tilepack/pack/pack_read.h"
#include "tilepack/scanline/view_render.h"
#include "tilepack/scanline/span_method.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <memory>

namespace tilepack::cli {
namespace {

const Camera rolled{{0, 2, 0}, {0, 0, -6}, {0.4, 1, 0}, 60};
constexpr int span_pixels = 1920;
constexpr double negligible = 0.1; // pixels nobody sees

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

// Time of this thread on a processor: what others do on the machine counts less than by a clock on the wall.
double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Timing {
  double median = 0; // seconds a call
  double spread = 0; // (largest - smallest) / median
};

// Measures many things in turn, round by round, so that a busy moment of the machine falls on all of them
// alike. A thing is called often enough in a row for the clock to be fine.
class Stopwatch {
public:
  explicit Stopwatch(bool quick) : rounds(quick ? 1 : 11), shortest_run(quick ? 1e-4 : 3e-3) {}

  // `work` must stay callable until run(); its result will be timing(the number returned).
  std::size_t add(std::function<void()> work) {
    entries.push_back({std::move(work), 1, {}});
    return entries.size() - 1;
  }

  void run(const Progress& progress) {
    for (Entry& entry : entries) {
      while (seconds_of(entry) < shortest_run) entry.calls *= 2;
    }
    for (int round = 0; round < rounds; ++round) {
      report(progress, "timing", static_cast<double>(round) / rounds);
      for (Entry& entry : entries) entry.seconds.push_back(seconds_of(entry) / entry.calls);
    }
  }

  Timing timing(std::size_t number) const {
    std::vector<double> seconds = entries[number].seconds;
    std::sort(seconds.begin(), seconds.end());
    const double median = seconds[seconds.size() / 2];
    return {median, (seconds.back() - seconds.front()) / median};
  }

private:
  struct Entry {
    std::function<void()> work;
    int calls;
    std::vector<double> seconds;
  };

  static double seconds_of(const Entry& entry) {
    const double start = thread_seconds();
    for (int i = 0; i < entry.calls; ++i) entry.work();
    return thread_seconds() - start;
  }

  int rounds;
  double shortest_run;
  std::vector<Entry> entries;
};

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

// Wrong answers are not worth timing.
template <class Real>
void check_answers(const std::vector<Span>& spans, const SpanOptions& options) {
  std::vector<Real> u(span_pixels), v(span_pixels);
  SpanBatch<Real> batch;
  fill_spans<Real>(spans, options, batch);
  for (std::size_t lane = 0; lane < spans.size(); ++lane) {
    fill_span<Real>(spans[lane], options, u, v);
    for (int n = 0; n < span_pixels; ++n) {
      const Real value = u[static_cast<std::size_t>(n)];
      if (std::isfinite(value) && value == batch.u_at(static_cast<int>(lane), n)) continue;
      throw Error(
          ErrorKind::check_failed, name_of(options),
          fmt::format("pixel {} of scanline {} differs side by side; this is a fault of tilepack", n, lane));
    }
  }
}

// The numbers of a method's three measurements.
struct MethodEntries {
  std::size_t one_by_one, side_by_side, fused;
};

template <class Real>
MethodEntries add_method(Stopwatch& watch, const std::vector<Span>& spans, const SpanOptions& options) {
  check_answers<Real>(spans, options);
  const auto u = std::make_shared<std::vector<Real>>(span_pixels),
             v = std::make_shared<std::vector<Real>>(span_pixels);
  const auto batch = std::make_shared<SpanBatch<Real>>();
  const auto alone = [=, &spans] {
    for (const Span& span : spans) fill_span<Real>(span, options, *u, *v);
  };
  const auto together = [=, &spans](BatchArithmetic arithmetic) {
    return [=, &spans] { fill_spans<Real>(spans, options, *batch, arithmetic); };
  };
  return {watch.add(alone), watch.add(together(BatchArithmetic::repeatable)),
          watch.add(together(BatchArithmetic::fused))};
}

std::vector<SpanFigures> method_figures(bool quick, const Progress& progress) {
  const std::vector<Span> spans = timed_spans();
  Stopwatch watch(quick);
  std::vector<SpanFigures> all;
  std::vector<MethodEntries> entries;
  for (SpanPrecision precision : {SpanPrecision::f32, SpanPrecision::f64})
    for (const SpanOptions& options : contenders()) {
      SpanFigures figures;
      figures.options = options;
      figures.precision = precision;
      for (const SpanCase& c : span_cases()) figures.errors.push_back(span_error(c.span, options, precision));
      all.push_back(figures);
      entries.push_back(precision == SpanPrecision::f32 ? add_method<float>(watch, spans, options)
                                                        : add_method<double>(watch, spans, options));
    }
  watch.run(progress);
  const double ns_a_pixel = 1e9 / (static_cast<double>(span_pixels) * static_cast<double>(spans.size()));
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].one_by_one = watch.timing(entries[i].one_by_one).median * ns_a_pixel;
    all[i].side_by_side = watch.timing(entries[i].side_by_side).median * ns_a_pixel;
    all[i].spread = watch.timing(entries[i].side_by_side).spread;
    all[i].fused = watch.timing(entries[i].fused).median * ns_a_pixel;
  }
  return all;
}

std::vector<HardFigures> hard_figures() {
  std::vector<HardFigures> all;
  for (const HardCase& hard : hard_cases()) {
    HardFigures figures{hard.name, {}, {}};
    for (StepMethod c : all_contestants) {
      figures.f32.push_back(run_contestant(c, hard, SpanPrecision::f32));
      figures.f64.push_back(run_contestant(c, hard, SpanPrecision::f64));
    }
    all.push_back(figures);
  }
  return all;
}

// The stepping of a whole view: 32 spans at a time, as view_pixels does it.
template <class Real>
std::function<void()> stepping_of(const std::vector<Span>& spans, const SpanOptions& options) {
  const auto batch = std::make_shared<SpanBatch<Real>>();
  return [=, &spans] {
    for (std::size_t first = 0; first < spans.size(); first += scanlines_side_by_side) {
      const std::size_t count = std::min<std::size_t>(scanlines_side_by_side, spans.size() - first);
      fill_spans<Real>({spans.data() + first, count}, options, *batch);
    }
  };
}

Image textured(const ViewTexture& texture, const ProjectedScene& scene, const ViewStepping& stepping) {
  constexpr int band = scanlines_side_by_side;
  const Size size = scene.size();
  Image image(size.width, size.height, texture.channels());
  const std::vector<float> background(static_cast<std::size_t>(texture.channels()), 0.0f);
  tbb::parallel_for(0, (size.height + band - 1) / band, [&](int i) {
    const int rows = std::min(band, size.height - i * band);
    const auto pixels = view_pixels(scene.spans(i * band, rows), size.width, i * band, rows, stepping);
    paste(image, texture.shade(pixels, background), 0, i * band);
  });
  return image;
}

const std::vector<ViewStepping>& view_contenders() {
  constexpr SpanPrecision f32 = SpanPrecision::f32, f64 = SpanPrecision::f64;
  static const std::vector<ViewStepping> list{
      {{SpanMethod::exact, 0}, f64, 0},         {{SpanMethod::exact, 0}, f32, 0},
      {{SpanMethod::estimate, 0}, f32, 0},      {{SpanMethod::newton_direct, 0}, f32, 0},
      {{SpanMethod::newton_direct, 0}, f64, 0}, {{SpanMethod::newton, 0}, f32, 0},
      {{SpanMethod::newton, 32}, f32, 0},       {{SpanMethod::newton_general, 0}, f32, 0},
      {{SpanMethod::euler1, 0}, f32, 0},        {{SpanMethod::euler2, 0}, f32, 0},
      {{SpanMethod::euler2, 8}, f32, 0},        {{SpanMethod::euler2, 0}, f32, 0.05},
      {{SpanMethod::affine, 8}, f32, 0},        {{SpanMethod::affine, 16}, f32, 0}};
  return list;
}

void time_view(SpanBench& bench, const ProjectedScene& scene, const Scene& ground,
               const Projection& projection, bool quick, const Progress& progress) {
  std::vector<Span> spans;
  for (const ViewSpan& view : scene.spans(0, scene.size().height)) {
    spans.push_back(view.span);
    bench.view_pixels += view.span.count;
  }
  Stopwatch watch(quick);
  const std::size_t set_up =
      watch.add([&] { return ProjectedScene(ground, projection).spans(0, projection.size.height); });
  std::vector<std::size_t> entries;
  for (const ViewFigures& view : bench.views) {
    entries.push_back(watch.add(view.precision == SpanPrecision::f32
                                    ? stepping_of<float>(spans, view.options)
                                    : stepping_of<double>(spans, view.options)));
  }
  watch.run(progress);
  const double ns_a_pixel = 1e9 / static_cast<double>(bench.view_pixels);
  bench.set_up = watch.timing(set_up).median * ns_a_pixel;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (bench.views[i].wanted_error == 0)
      bench.views[i].stepping = watch.timing(entries[i]).median * ns_a_pixel;
  }
}

void measure_view(SpanBench& bench, const std::string& pack_name, bool quick, const Progress& progress) {
  bench.view_size = quick ? Size{480, 270} : Size{1920, 1080};
  const Size size = bench.view_size;
  const Projection projection(rolled, size);
  Scene ground;
  ground.planes.push_back({});
  const ProjectedScene scene(ground, projection);
  const ViewStepping& truth = view_contenders().front();
  const ViewPixels exact = view_pixels(scene.spans(0, size.height), size.width, 0, size.height, truth);

  std::optional<Pack> pack;
  std::optional<ViewTexture> texture;
  Image exact_picture;
  Size tile{128, 128};
  if (!pack_name.empty()) {
    pack = read_pack(pack_name);
    tile = pack->tile_size;
    const PackedMap& map = pack->maps[0];
    texture.emplace(*pack, 0, RenderTarget{map.encoding, map.depth}, ViewFilter::trilinear);
    exact_picture = textured(*texture, scene, truth);
  }
  for (const ViewStepping& stepping : view_contenders()) {
    report(progress, "views",
           static_cast<double>(bench.views.size()) / static_cast<double>(view_contenders().size()));
    ViewFigures figures;
    figures.options = stepping.options;
    figures.precision = stepping.precision;
    figures.wanted_error = stepping.wanted_error;
    figures.shift = difference(
        exact, view_pixels(scene.spans(0, size.height), size.width, 0, size.height, stepping), tile);
    if (texture) {
      figures.psnr =
          difference(exact_picture, textured(*texture, scene, stepping), ValueRange::unit, 255).psnr;
      figures.textured = true;
    }
    bench.views.push_back(figures);
  }
  time_view(bench, scene, ground, projection, quick, progress);
  if (texture) {
    const std::vector<float> background(static_cast<std::size_t>(texture->channels()), 0.0f);
    const double start = thread_seconds();
    texture->shade(exact, background);
    bench.texturing = (thread_seconds() - start) * 1e9 / static_cast<double>(bench.view_pixels);
  }
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
      if (division_ns < 1.1 * best_ns) {
        return fmt::format("{}, {}: plain division has won, {:.2f} ns a pixel; nothing within {} pixels "
                           "(horizon 100 pixels behind) is 10 % faster.",
                           name_of(precision), how, division_ns, negligible);
      }
      return fmt::format(
          "{}, {}: {} is the fastest within {} pixels (horizon 100 pixels behind), {:.2f} ns a "
          "pixel; division takes {:.2f}, {:.2f} times as long.",
          name_of(precision), how, name_of(best.options), negligible, best_ns, division_ns,
          division_ns / best_ns);
    };
    advice.push_back(
        verdict("32 scanlines side by side", *fastest, fastest->side_by_side, division->side_by_side));
    advice.push_back(
        verdict("one scanline at a time", *fastest_alone, fastest_alone->one_by_one, division->one_by_one));
  }
  const auto figures = [&](SpanMethod method, int reseed) -> const SpanFigures& {
    return *std::find_if(bench.methods.begin(), bench.methods.end(), [&](const SpanFigures& f) {
      return f.precision == SpanPrecision::f32 && f.options.method == method && f.options.reseed == reseed;
    });
  };
  advice.push_back("One scanline at a time a recurrence waits for each of its steps, while divisions of "
                   "neighbouring pixels overlap: recurrences want many scanlines at once.");
  advice.push_back(fmt::format(
      "Of the recurrences take newton-direct: over 16384 pixels in f32 it is {:.2g} pixels off, newton "
      "{:.2g} and "
      "newton-general {:.2g}, whose coefficients are sums that drift; an exact value every 32 pixels brings "
      "newton to {:.2g}.",
      figures(SpanMethod::newton_direct, 0).errors.back().pixels,
      figures(SpanMethod::newton, 0).errors.back().pixels,
      figures(SpanMethod::newton_general, 0).errors.back().pixels,
      figures(SpanMethod::newton, 32).errors.back().pixels));
  advice.push_back(fmt::format("euler2 every 8 pixels is the most exact of them near the horizon: {:.2g} "
                               "pixels where it is 5 pixels behind "
                               "the last, newton-direct {:.2g}, affine every 8 pixels {:.2g}.",
                               figures(SpanMethod::euler2, 8).errors[3].pixels,
                               figures(SpanMethod::newton_direct, 0).errors[3].pixels,
                               figures(SpanMethod::affine, 8).errors[3].pixels));
  if (bench.texturing > 0) {
    advice.push_back(fmt::format("In a textured view all of this is small change: set-up {:.2f}, stepping "
                                 "{:.2f} (division), texturing {:.0f} ns a pixel.",
                                 bench.set_up, bench.views[1].stepping, bench.texturing));
  }
  advice.push_back(
      fmt::format("f64 is not needed: offsets from the start of a span are within {:.2g} pixels in f32 "
                  "by division, over 16384 pixels.",
                  figures(SpanMethod::exact, 0).errors.back().pixels));
  std::vector<double> spreads;
  for (const SpanFigures& f : bench.methods) spreads.push_back(f.spread);
  std::sort(spreads.begin(), spreads.end());
  if (const double typical = spreads[spreads.size() / 2]; typical > 0.5) {
    advice.push_back(
        fmt::format("The machine was busy: runs of one method differ by {:.0f} % of their median. "
                    "Times near each other mean nothing then; measure again.",
                    100 * typical));
  }
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
  check_page_name({"--report", arguments.report});
  if (!arguments.report.empty()) check_writable(arguments.report); // before the measurements
  const Progress progress = console.progress();
  SpanBench bench;
  bench.target = batch_target();
  bench.methods = method_figures(arguments.quick, progress);
  bench.hard = hard_figures();
  bench.curves = error_curves(16384, 2000, 64);
  measure_view(bench, arguments.pack, arguments.quick, progress);
  bench.advice = advice_on(bench);

  if (!arguments.report.empty()) write_text_file(arguments.report, spans_html(bench));
  console.print(arguments.format == "json" ? spans_json(bench) : spans_text(bench));
  return 0;
}

} // namespace tilepack::cli
