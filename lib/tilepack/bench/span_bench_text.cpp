#include "tilepack/bench/span_bench.h"
#include "tilepack/json/json_value.h"

#include <fmt/format.h>

#include <cmath>

namespace tilepack {
namespace {

std::string short_number(double value) {
  if (!std::isfinite(value)) return "broken";
  return value == 0 ? "0" : fmt::format("{:.2g}", value);
}

std::string pixels_text(const HardResult& result) {
  return std::isfinite(result.relative) ? short_number(result.pixels) : "broken";
}

// JSON has no infinity.
JsonValue number(double value) {
  return JsonValue(value);
}

JsonValue numbers(const std::vector<double>& values) {
  JsonValue list = JsonValue::array();
  for (double value : values) list.push_back(number(value));
  return list;
}

std::string name_of_view(const ViewFigures& view) {
  if (view.wanted_error == 0) return name_of(view.options);
  return fmt::format("{}, within {:g} pixels", name_of(view.options), view.wanted_error);
}

std::string psnr_text(const ViewFigures& view) {
  if (!view.textured) return "-";
  return view.psnr ? fmt::format("{:.1f}", *view.psnr) : "equal";
}

JsonValue hard_json(const std::vector<HardResult>& results) {
  JsonValue list = JsonValue::array();
  for (std::size_t i = 0; i < results.size(); ++i) {
    list.push_back({{"method", std::string(name_of(all_contestants[i]))},
                    {"pixels", number(results[i].pixels)},
                    {"relative", number(results[i].relative)}});
  }
  return list;
}

} // namespace

std::string span_bench_text(const SpanBench& bench) {
  std::string text =
      fmt::format("Span methods, vectors: {}. ns a pixel (u and v), medians; errors in pixels of "
                  "the screen, case by case:\n",
                  bench.target);
  const auto cases = span_cases();
  for (std::size_t i = 0; i < cases.size(); ++i) text += fmt::format("  ({}) {}\n", i + 1, cases[i].name);
  text += fmt::format("\n{:26} {:>4} {:>7} {:>7} {:>7}", "method", "", "alone", "by 32", "fused");
  for (std::size_t i = 0; i < cases.size(); ++i) text += fmt::format(" {:>8}", fmt::format("({})", i + 1));
  for (const SpanFigures& f : bench.methods) {
    text += fmt::format("\n{:26} {:>4} {:7.2f} {:7.2f} {:7.2f}", name_of(f.options), name_of(f.precision),
                        f.one_by_one, f.side_by_side, f.fused);
    for (const SpanError& error : f.errors) text += fmt::format(" {:>8}", short_number(error.pixels));
  }
  text += "\n\nHard cases, largest error in pixels, f32|f64; broken: infinite or NaN somewhere\n";
  text += fmt::format("{:52}", "");
  for (const char* name : {"division", "Listing 1", "Listing 2", "euler2", "newton", "n-direct", "n-general"})
    text += fmt::format(" {:>15}", name);
  for (const HardFigures& hard : bench.hard) {
    text += fmt::format("\n{:52}", hard.name);
    for (std::size_t i = 0; i < hard.f32.size(); ++i)
      text += fmt::format(" {:>15}", pixels_text(hard.f32[i]) + "|" + pixels_text(hard.f64[i]));
  }
  text += "\n";
  text += fmt::format("\nThe ground in {} x {}, camera rolled: {} pixels; set-up {:.3f} ns a pixel{}\n",
                      bench.view_size.width, bench.view_size.height, bench.view_pixels, bench.set_up,
                      bench.texturing > 0 ? fmt::format(", texturing {:.0f}", bench.texturing) : "");
  text += fmt::format("{:30} {:>4} {:>9} {:>10} {:>10} {:>10} {:>7}\n", "method", "", "stepping", "pixels",
                      "texels", "mip texels", "PSNR");
  for (const ViewFigures& view : bench.views) {
    text +=
        fmt::format("{:30} {:>4} {:>9} {:>10} {:>10} {:>10} {:>7}\n", name_of_view(view),
                    name_of(view.precision), view.stepping > 0 ? fmt::format("{:.2f}", view.stepping) : "-",
                    short_number(view.shift.largest_pixels), short_number(view.shift.largest_texels),
                    short_number(view.shift.largest_mip_texels), psnr_text(view));
  }
  text += "\n";
  for (const std::string& line : bench.advice) text += "* " + line + "\n";
  return text;
}

std::string span_bench_json(const SpanBench& bench) {
  JsonValue json;
  json["target"] = bench.target;
  const auto cases = span_cases();
  for (const SpanFigures& f : bench.methods) {
    JsonValue errors = JsonValue::array();
    for (std::size_t i = 0; i < f.errors.size(); ++i) {
      const SpanError& e = f.errors[i];
      errors.push_back({{"case", cases[i].name},
                        {"pixels", number(e.pixels)},
                        {"texels", number(e.texels)},
                        {"bound_pixels", number(e.bound)},
                        {"beyond_bound", number(e.beyond)},
                        {"worst_pixel", e.worst}});
    }
    json["methods"].push_back({{"method", std::string(name_of(f.options.method))},
                               {"reseed", f.options.reseed},
                               {"precision", std::string(name_of(f.precision))},
                               {"ns_one_by_one", f.one_by_one},
                               {"ns_side_by_side", f.side_by_side},
                               {"ns_fused", f.fused},
                               {"spread", f.spread},
                               {"errors", errors}});
  }
  for (const HardFigures& hard : bench.hard) {
    json["hard_cases"].push_back(
        {{"case", hard.name}, {"f32", hard_json(hard.f32)}, {"f64", hard_json(hard.f64)}});
  }
  for (const ErrorCurve& curve : bench.curves) {
    json["curves"].push_back({{"name", curve.name},
                              {"pixel", numbers(curve.n)},
                              {"error_pixels", numbers(curve.total)},
                              {"rounding_pixels", numbers(curve.rounding)},
                              {"bound_pixels", numbers(curve.bound)}});
  }
  JsonValue views = JsonValue::array();
  for (const ViewFigures& view : bench.views) {
    views.push_back({{"method", std::string(name_of(view.options.method))},
                     {"reseed", view.options.reseed},
                     {"precision", std::string(name_of(view.precision))},
                     {"wanted_error", view.wanted_error},
                     {"ns_stepping", view.stepping > 0 ? JsonValue(view.stepping) : JsonValue(nullptr)},
                     {"largest_pixels", view.shift.largest_pixels},
                     {"largest_texels", view.shift.largest_texels},
                     {"largest_mip_texels", view.shift.largest_mip_texels},
                     {"psnr", view.psnr}});
  }
  json["view"] = {{"size", JsonValue::array({bench.view_size.width, bench.view_size.height})},
                  {"pixels", bench.view_pixels},
                  {"ns_set_up", bench.set_up},
                  {"ns_texturing", bench.texturing > 0 ? JsonValue(bench.texturing) : JsonValue(nullptr)},
                  {"methods", views}};
  json["advice"] = bench.advice;
  return json_text(json);
}

} // namespace tilepack
