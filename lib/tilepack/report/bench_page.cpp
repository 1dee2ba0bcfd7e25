#include "tilepack/report/bench_page.h"

#include "tilepack/report/html_page.h"
#include "tilepack/report/plot.h"

#include <fmt/format.h>

#include <algorithm>

namespace tilepack {
namespace {

std::string cost_plot(const Bench& bench) {
  Plot plot{"Speed against error", "ns a sample (log)", "RMS from the truth, 8-bit units", true, false, {}};
  for (const BenchFilter filter : {BenchFilter::bilinear, BenchFilter::trilinear, BenchFilter::elliptical})
    for (const BenchSampler sampler : {BenchSampler::fast, BenchSampler::reference}) {
      PlotSeries series{fmt::format("{} {}", name_of(sampler), name_of(filter)), {}, {}, false};
      for (const LookupCost& c : bench.lookups.costs) {
        if (c.filter != filter || c.sampler != sampler) continue;
        series.points.emplace_back(c.nanoseconds, c.rms_truth);
        series.labels.push_back(fmt::format("{}, {} weights: {:.2f} ns, {:.3f}", name_of(c.mapping),
                                            name_of(c.weights), c.nanoseconds, c.rms_truth));
      }
      if (!series.points.empty()) plot.series.push_back(std::move(series));
    }
  return svg(plot);
}

std::string size_plot(const Bench& bench) {
  Plot plot{"Cost against size",
            "tiles a side (log)",
            "ns a sample",
            true,
            false,
            {{"tiled", {}, {}, true}, {"stored whole", {}, {}, true}}};
  for (const SizeCost& s : bench.lookups.sizes) {
    plot.series[0].points.emplace_back(static_cast<double>(s.tiles), s.tiled);
    if (s.stored) plot.series[1].points.emplace_back(static_cast<double>(s.tiles), *s.stored);
  }
  if (plot.series[1].points.empty()) plot.series.pop_back();
  return svg(plot);
}

std::string coordinate_plot(const Bench& bench) {
  Plot plot{"Error of far coordinates",
            "log2 of texels from the origin",
            "RMS, 8-bit units (log)",
            false,
            true,
            {{"float", {}, {}, true}, {"double", {}, {}, true}, {"tile + float", {}, {}, true}}};
  for (const CoordinateError& e : bench.coordinates) {
    plot.series[0].points.emplace_back(e.log2_texels, e.as_float);
    plot.series[1].points.emplace_back(e.log2_texels, e.as_double);
    plot.series[2].points.emplace_back(e.log2_texels, e.as_tile_and_float);
  }
  return svg(plot);
}

std::string mip_plot(const Bench& bench, Zone zone) {
  Plot plot{fmt::format("Mips against the truth: {}", name_of(zone)),
            "level",
            "RMS, 8-bit units",
            false,
            false,
            {}};
  for (const ReferenceErrors& errors : bench.mips) {
    PlotSeries series{errors.mips, {}, {}, true};
    for (const LevelError& level : errors.levels)
      for (const ZoneError& z : level.zones)
        if (z.zone == zone && z.lookups > 0) series.points.emplace_back(level.level, z.rms);
    plot.series.push_back(std::move(series));
  }
  return svg(plot);
}

std::string jump_plot(const Bench& bench) {
  Plot plot{"Jump across borders", "level", "RMS, 8-bit units", false, false, {}};
  for (const ReferenceErrors& errors : bench.mips) {
    PlotSeries series{errors.mips, {}, {}, true};
    for (const LevelError& level : errors.levels) series.points.emplace_back(level.level, level.jump);
    plot.series.push_back(std::move(series));
  }
  return svg(plot);
}

// One square a pixel, black where exact, white from 8 units on.
std::string corner_picture(const CornerPicture& picture) {
  std::string out =
      fmt::format("<figure><svg width=\"230\" viewBox=\"0 0 {0} {0}\" shape-rendering=\"crispEdges\"><rect "
                  "width=\"{0}\" height=\"{0}\" fill=\"#000\"/>\n",
                  picture.side);
  for (int y = 0; y < picture.side; ++y)
    for (int x = 0; x < picture.side; ++x) {
      const double error = picture.error[static_cast<std::size_t>(y * picture.side + x)];
      const int grey = static_cast<int>(std::min(255.0, error * 32));
      if (grey > 0)
        out += fmt::format(
            "<rect x=\"{0}\" y=\"{1}\" width=\"1\" height=\"1\" fill=\"#{2:02x}{2:02x}{2:02x}\"/>", x, y,
            grey);
    }
  out += fmt::format("<path d=\"M {0} 0 V {1} M 0 {0} H {1}\" stroke=\"#56b4e9\" stroke-width=\"0.15\" "
                     "stroke-dasharray=\"0.6 0.6\"/>",
                     picture.side / 2.0, picture.side);
  return out + fmt::format("</svg><figcaption>{}, level {}</figcaption></figure>\n", escaped(picture.mips),
                           picture.level);
}

std::string ratio_table(const Bench& bench) {
  std::string out = "<table><tr><th>ratio</th><th>measured</th><th>developers ask for</th></tr>\n";
  for (const auto* list : {&bench.stored, &bench.lookups.ratios})
    for (const BenchRatio& r : *list)
      out += fmt::format("<tr><td>{}</td><td class=\"{}\">{:.2f}</td><td>{}</td></tr>\n", escaped(r.name),
                         !r.at_least ? ""
                         : r.met()   ? "good"
                                     : "bad",
                         r.value, r.at_least ? fmt::format("{:g}", *r.at_least) : "");
  return out + "</table>\n";
}

std::string cost_table(const Bench& bench) {
  std::string out = "<table "
                    "class=\"costs\"><tr><th>sampler</th><th>mapping</th><th>corners</th><th>filter</"
                    "th><th>weights</th><th>ns a "
                    "sample</th><th>M/s</th>"
                    "<th>off the reference, of 255</th><th>RMS from the truth</th></tr>\n";
  for (const LookupCost& c : bench.lookups.costs)
    out +=
        fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{}</td><td>{:.2f}</td><td>{:.1f}</"
                    "td><td>{:.5f}</td><td>{:.3f}</td></tr>\n",
                    name_of(c.sampler), name_of(c.mapping), corners_of(c), name_of(c.filter),
                    name_of(c.weights), c.nanoseconds, 1000 / c.nanoseconds, c.off_reference, c.rms_truth);
  return out + "</table>\n";
}

// All modes; the least of each column stands out.
std::string mip_table(const Bench& bench) {
  const std::vector<MipSummary> mips = mip_summaries(bench);
  std::string out = "<table><tr><th>mips</th><th>error inside tiles</th><th>at borders</th><th>jump across "
                    "borders</th><th>together</th></tr>\n";
  for (const MipSummary& m : mips) {
    out += fmt::format("<tr><td>{}</td>", escaped(m.mips));
    for (const auto figure :
         {&MipSummary::interior, &MipSummary::border, &MipSummary::jump, &MipSummary::together}) {
      const bool least = std::all_of(mips.begin(), mips.end(),
                                     [&](const MipSummary& other) { return m.*figure <= other.*figure; });
      out += fmt::format("<td class=\"{}\">{:.2f}</td>", least ? "best" : "", m.*figure);
    }
    out += "</tr>\n";
  }
  return out + "</table>\n";
}

std::string hard_table(const Bench& bench) {
  std::string out =
      "<table class=\"told\"><tr><th>input</th><th>promised</th><th>reference sampler</th><th>fast "
      "sampler</th></tr>\n";
  for (const HardLookup& c : bench.stress_lookups)
    out += fmt::format("<tr><td>{}</td><td>{}</td><td class=\"{}\">{:.2g}</td><td>{}</td></tr>\n",
                       escaped(c.input), escaped(c.promise), c.kept() ? "good" : "bad", c.reference,
                       c.fast ? fmt::format("{:.2g}", *c.fast) : "");
  return out + "</table>\n";
}

} // namespace

std::string bench_page(const Bench& bench) {
  std::string page = fmt::format(
      "<h1>{}, map {}</h1>\n<p>Best instruction set here: {}; {} threads. Errors in 8-bit units.</p>\n",
      escaped(bench.pack), escaped(bench.map), escaped(bench.target), bench.lookups.threads);
  page += "<div class=\"advice\"><b>What to choose</b><ul>\n";
  for (const std::string& line : advice(bench)) page += "<li>" + escaped(line) + "</li>\n";
  page += "</ul></div>\n<h2>Ratios, medians of rounds run in turn</h2>\n" + ratio_table(bench);
  page += "<h2>Lookups</h2>\n<div class=\"row\">" + cost_plot(bench) + size_plot(bench) + "</div>\n" +
          cost_table(bench);
  page += "<h2>Mip levels: bilinear lookups through the pack against the virtual texture's true mips</h2>\n";
  if (bench.mips.size() > 1)
    page += "<p>RMS over levels 1 and up, 8-bit units of the encoded value.</p>\n" + mip_table(bench);
  page += "<div class=\"row\">";
  for (const Zone zone : {Zone::interior, Zone::edge, Zone::corner}) page += mip_plot(bench, zone);
  page += jump_plot(bench) + "</div>\n";
  if (!bench.corners.empty()) {
    page += "<h2>Round one corner of tiles, 4 x 4 texels: error, white from 8 units on; dashed: borders of "
            "tiles</h2>\n<div class=\"row\">";
    for (const CornerPicture& picture : bench.corners) page += corner_picture(picture);
    page += "</div>\n";
  }
  page +=
      "<h2>Coordinates far from the origin</h2>\n<div class=\"row\">" + coordinate_plot(bench) + "</div>\n";
  if (!bench.stress_lookups.empty())
    page += "<h2>Hard cases</h2>\n<p>Largest difference from what is promised, in 8-bit units of linear "
            "light.</p>\n" +
            hard_table(bench);
  page += "<h2>All mip figures</h2>\n<pre>" + escaped(reference_errors_text(bench.mips)) + "</pre>\n";
  return html_page("tilepack bench", page);
}

} // namespace tilepack
