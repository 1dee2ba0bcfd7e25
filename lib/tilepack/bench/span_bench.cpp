#include "tilepack/bench/span_bench.h"

#include "tilepack/bench/timing.h"
#include "tilepack/error/error.h"
#include "tilepack/measure/image_metrics.h"
#include "tilepack/sampler/pack_texture.h"
#include "tilepack/scanline/span_method.h"
#include "tilepack/scanline/view_render.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

namespace tilepack {
namespace {

const Camera rolled{{0, 2, 0}, {0, 0, -6}, {0.4, 1, 0}, 60};
constexpr int span_pixels = 1920;

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

TimedRounds timed_rounds(bool quick) {
  return quick ? TimedRounds{1, 1e-4} : TimedRounds{11, 3e-3};
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

// Adds a method's three measurements, alone, side by side and fused; `spans` must outlive `works`.
template <class Real>
void add_method(std::vector<std::function<void()>>& works, const std::vector<Span>& spans,
                const SpanOptions& options) {
  check_answers<Real>(spans, options);
  const auto u = std::make_shared<std::vector<Real>>(span_pixels),
             v = std::make_shared<std::vector<Real>>(span_pixels);
  const auto batch = std::make_shared<SpanBatch<Real>>();
  works.push_back([=, &spans] {
    for (const Span& span : spans) fill_span<Real>(span, options, *u, *v);
  });
  const auto together = [=, &spans](BatchArithmetic arithmetic) {
    return [=, &spans] { fill_spans<Real>(spans, options, *batch, arithmetic); };
  };
  works.push_back(together(BatchArithmetic::repeatable));
  works.push_back(together(BatchArithmetic::fused));
}

std::vector<SpanFigures> method_figures(bool quick, const Progress& progress) {
  const std::vector<Span> spans = timed_spans();
  std::vector<std::function<void()>> works;
  std::vector<SpanFigures> all;
  for (SpanPrecision precision : {SpanPrecision::f32, SpanPrecision::f64})
    for (const SpanOptions& options : contenders()) {
      SpanFigures figures;
      figures.options = options;
      figures.precision = precision;
      for (const SpanCase& c : span_cases()) figures.errors.push_back(span_error(c.span, options, precision));
      all.push_back(figures);
      if (precision == SpanPrecision::f32)
        add_method<float>(works, spans, options);
      else
        add_method<double>(works, spans, options);
    }
  const double pixels = static_cast<double>(span_pixels) * static_cast<double>(spans.size());
  const auto times = in_turn(works, timed_rounds(quick), pixels, progress);
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].one_by_one = median(times[3 * i]);
    all[i].side_by_side = median(times[3 * i + 1]);
    all[i].spread = spread(times[3 * i + 1]);
    all[i].fused = median(times[3 * i + 2]);
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

Image textured(const Texture& texture, const RenderTarget& target, const ProjectedScene& scene,
               const ViewStepping& stepping) {
  constexpr int band = scanlines_side_by_side;
  const Size size = scene.size();
  Image image(size.width, size.height, texture.channels());
  const std::vector<float> background(static_cast<std::size_t>(texture.channels()), 0.0f);
  tbb::parallel_for(0, (size.height + band - 1) / band, [&](int i) {
    const int rows = std::min(band, size.height - i * band);
    const auto pixels = view_pixels(scene.spans(i * band, rows), size.width, i * band, rows, stepping);
    paste(image, shade(texture, pixels, target, background), 0, i * band);
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
  std::vector<std::function<void()>> works{
      [&] { ProjectedScene(ground, projection).spans(0, projection.size.height); }};
  for (const ViewFigures& view : bench.views)
    works.push_back(view.precision == SpanPrecision::f32 ? stepping_of<float>(spans, view.options)
                                                         : stepping_of<double>(spans, view.options));
  const auto times = in_turn(works, timed_rounds(quick), static_cast<double>(bench.view_pixels), progress);
  bench.set_up = median(times[0]);
  for (std::size_t i = 0; i < bench.views.size(); ++i)
    if (bench.views[i].wanted_error == 0) bench.views[i].stepping = median(times[i + 1]);
}

void measure_view(SpanBench& bench, const Pack* pack, bool quick, const Progress& progress) {
  bench.view_size = quick ? Size{480, 270} : Size{1920, 1080};
  const Size size = bench.view_size;
  const Projection projection(rolled, size);
  Scene ground;
  ground.planes.push_back({});
  const ProjectedScene scene(ground, projection);
  const ViewStepping& truth = view_contenders().front();
  const ViewPixels exact = view_pixels(scene.spans(0, size.height), size.width, 0, size.height, truth);

  std::optional<PackTexture> texture;
  RenderTarget target;
  Image exact_picture;
  Size tile{128, 128};
  if (pack) {
    tile = pack->tile_size;
    const PackedMap& map = pack->maps[0];
    target = {map.encoding, map.depth};
    texture.emplace(*pack, 0, ViewFilter::trilinear);
    exact_picture = textured(*texture, target, scene, truth);
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
          difference(exact_picture, textured(*texture, target, scene, stepping), FullRange::unit, 255).psnr;
      figures.textured = true;
    }
    bench.views.push_back(figures);
  }
  time_view(bench, scene, ground, projection, quick, progress);
  if (texture) {
    const std::vector<float> background(static_cast<std::size_t>(texture->channels()), 0.0f);
    const double start = thread_seconds();
    shade(*texture, exact, target, background);
    bench.texturing = (thread_seconds() - start) * 1e9 / static_cast<double>(bench.view_pixels);
  }
}

} // namespace

std::string name_of(const SpanOptions& options) {
  std::string name(tilepack::name_of(options.method));
  return options.reseed > 0 ? fmt::format("{}, every {}", name, options.reseed) : name;
}

const SpanError& error_of(const SpanFigures& figures, SpanShape shape) {
  return figures.errors[static_cast<std::size_t>(shape)];
}

SpanBench span_bench(const Pack* pack, bool quick, const Progress& progress) {
  SpanBench bench;
  bench.target = batch_target();
  bench.methods = method_figures(quick, progress);
  bench.hard = hard_figures();
  bench.curves = error_curves(16384, 2000, 64);
  measure_view(bench, pack, quick, progress);
  bench.advice = span_advice(bench);
  return bench;
}

} // namespace tilepack
