#include "tilepack/report/bake_page.h"

#include "tilepack/error/field.h"
#include "tilepack/exemplar/feature_image.h"
#include "tilepack/report/bake_pictures.h"
#include "tilepack/report/html_page.h"
#include "tilepack/report/pack_picture.h"
#include "tilepack/report/size_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tilepack {
namespace {

// For whoever reads the page and types it.
std::string as_option(std::string_view name, std::string_view value = {}) {
  return spelled(field(name, value), FieldSpelling::option);
}

std::string figure(const Image& image, const std::string& caption) {
  return fmt::format(
      "<figure><img src=\"{}\" width=\"{}\" height=\"{}\" alt=\"\"/><figcaption>{}</figcaption>"
      "</figure>\n",
      png_data_uri(image), image.width(), image.height(), caption);
}

std::string swatch(const Paint& paint, const std::string& text) {
  // As it looks laid over middle grey.
  const auto code = [&](double v) {
    return static_cast<int>((v * paint.opacity + 0.5 * (1 - paint.opacity)) * 255 + 0.5);
  };
  return fmt::format("<span class=\"swatch\" style=\"background:#{:02x}{:02x}{:02x}\"></span>{}",
                     code(paint.red), code(paint.green), code(paint.blue), text);
}

std::string verdict_box(const BakeVerdict& verdict) {
  std::string out =
      fmt::format("<div class=\"verdict {0}\"><b class=\"{0}\">{0}</b>: {1}<ul>\n", name_of(verdict.grade),
                  verdict.grade == Grade::good   ? "nothing stands against this set."
                  : verdict.grade == Grade::fair ? "usable; what could be better comes first."
                                                 : "the eye will find faults; the worst come first.");
  for (const BakeRemark& remark : verdict.remarks)
    out += fmt::format("<li><b class=\"{0}\">{0}</b> {1}</li>\n", name_of(remark.grade),
                       escaped(spelled(remark.text, FieldSpelling::option)));
  return out + "</ul></div>\n";
}

std::string use_caption(int tiles) {
  std::string text = "How many tiles show each texel of the sample. Dark: none.";
  std::vector<int> steps{1};
  for (const int part : {8, 4, 2, 1})
    if (tiles / part > steps.back()) steps.push_back(tiles / part);
  for (const int shown : steps) text += swatch(use_paint(shown, tiles), std::to_string(shown));
  return text;
}

std::string cut_caption(double step, int drawn, int tiles) {
  std::string text =
      fmt::format("Cuts: where neighbouring texels come from different places of the sample. Color: by how "
                  "much they differ from "
                  "what was there, against the {:.1f} by which neighbouring texels of the sample differ.",
                  step);
  text += swatch(cut_paint(0, step), "not at all") + swatch(cut_paint(step / 2, step), "half as much") +
          swatch(cut_paint(step, step), "as much") + swatch(cut_paint(2 * step, step), "twice") +
          swatch(cut_paint(3 * step, step), "three times and more");
  if (drawn < tiles) text += fmt::format(" The {} tiles with the dearest cuts, of {}.", drawn, tiles);
  return text;
}

std::string worst_kinds(const std::vector<WorstPlace>& worst) {
  const auto tones = std::count_if(worst.begin(), worst.end(), [](const WorstPlace& p) { return p.tone; });
  if (tones == 0) return "Cuts are seen there. ";
  if (tones == static_cast<std::ptrdiff_t>(worst.size())) return "A tone ends in a straight line there. ";
  return fmt::format("In {} to {} a tone ends in a straight line, in the others cuts are seen. ", 1, tones);
}

std::string figures_table(const BakeFacts& facts) {
  const SetFigures& f = facts.report.figures;
  std::string out = "<table class=\"words\"><tr><th>figure</th><th>value</th><th>meaning</th></tr>\n";
  const auto row = [&](const char* name, const std::string& value, const std::string& meaning) {
    out += fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td></tr>\n", name, value, meaning);
  };
  const auto share = [](double v) { return fmt::format("{:.1f} %", v * 100); };
  row("length of cuts", fmt::format("{:.0f}", f.cut_length), "texels of cut in a tile, on average");
  row("visibility of cuts, mean", fmt::format("{:.2f}", f.cut_mean),
      "RMS difference a channel across a cut, 8-bit units");
  row("visibility of cuts, 95 %", fmt::format("{:.2f}", f.cut_p95), "19 of 20 texels of cut keep below");
  row("visibility of borders", fmt::format("{:.2f}", f.border_mean),
      "the same across borders between tiles; 0 where texels on both sides are neighbours in the sample");
  row("step across borders", fmt::format("{:.3f}", facts.seams.seam),
      "mean step between the texels on both sides of a border, over that inside tiles");
  row("step of the sample", fmt::format("{:.2f}", f.sample_step),
      "the same difference between neighbouring texels of the sample: what hides a cut");
  row("copied in pieces", share(f.in_pieces), "texels that lie in no 8 x 8 square copied whole");
  row("ends of tones", share(facts.report.tones.share),
      "of the length of borders: straight lines along cuts with more of a step in tone than 19 of 20 places "
      "of the "
      "sample have, and a quarter beyond");
  row("coverage", share(f.coverage), "of the sample's 16 x 16 cells, a quarter or more of each, are shown");
  row("fresh", share(f.fresh), "of the tiles' texels are shown by one tile alone");
  row("shown often", share(f.shown_often), "of the tiles' texels are shown by half of all tiles or more");
  row("variety", fmt::format("{:.1f} of {}", f.distinct_tiles, facts.tiles),
      "tiles without a texel in common that would be as varied");
  row("difference of distributions", share(f.histogram_distance),
      "RMS, between the tiles' values, slow brightness and contrast and the sample's");
  if (!facts.materials.empty()) return out + "</table>\n"; // the rest is about one sample
  const auto period = [](const Period& p) {
    return p.length > 0 ? fmt::format("{:.2f}", p.length) : std::string("none");
  };
  row("repeat of the sample",
      fmt::format("x {}, y {}", period(facts.nature.periods.x), period(facts.nature.periods.y)),
      fmt::format("texels; tiles should hold whole ones: {}", as_option("tile-size", "auto")));
  row("drift of the sample", share(facts.nature.drift),
      "of its variance lies between areas of a tile's size; tiles can't follow it");
  row("shading of the sample", share(facts.nature.shading),
      fmt::format("of its variance is slow and not patches without order: where tiles differ in tone, {}",
                  as_option("flatten")));
  row("two tones", share(facts.nature.two_tone),
      "of its variance are explained by two tones; 64 % in a bell curve");
  return out + "</table>\n";
}

// Each material of a transition as a set by itself, and the borders between them.
std::string materials_section(const BakeFacts& facts) {
  if (facts.materials.empty()) return {};
  std::string out =
      "<h2>Materials</h2>\n<table><tr><th>corner color</th><th>material</th><th>sample</th><th>of the tiles "
      "</th><th>shown of the sample</th><th>visibility of cuts, mean</th><th>95 %</th><th>by "
      "itself</th></tr>\n";
  for (std::size_t m = 0; m < facts.materials.size(); ++m) {
    const BakeFacts& material = facts.materials[m];
    const SetFigures& f = material.report.figures;
    out += fmt::format("<tr><td>{}</td><td>{}</td><td>{} x {}</td><td>{:.1f} %</td><td>{:.0f} %</td>"
                       "<td>{:.2f}</td><td>{:.2f}</td><td>{}</td></tr>\n",
                       m, escaped(material.material), material.sample.width, material.sample.height,
                       facts.transition.shown[m] * 100, f.coverage * 100, f.cut_mean, f.cut_p95,
                       name_of(bake_verdict(material).grade));
  }
  return out +
         fmt::format("</table>\n<p>A tile of several materials has {:.0f} texels of border between them, "
                     "{:.0f} % of which run through the inside of things; of straight ones {:.0f} % "
                     "would.</p>\n",
                     facts.transition.border_length, facts.transition.through_things * 100,
                     facts.transition.expected * 100);
}

std::string tiles_table(const SetReport& report, int most) {
  std::vector<std::size_t> order(report.tiles.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return report.tiles[a].cut_length * report.tiles[a].cut_mean >
           report.tiles[b].cut_length * report.tiles[b].cut_mean;
  });
  if (order.size() > static_cast<std::size_t>(most)) order.resize(static_cast<std::size_t>(most));
  std::string out =
      "<table><tr><th>tile</th><th>texels of cut</th><th>visibility, mean</th><th>95 %</th><th>in "
      "pieces</th><th>fresh</th></tr>\n";
  for (const std::size_t i : order) {
    const TileFigures& t = report.tiles[i];
    out += fmt::format("<tr><td>{}</td><td>{}</td><td>{:.2f}</td><td>{:.2f}</td><td>{:.1f} %</td><td>{:.1f} "
                       "%</td></tr>\n",
                       i, t.cut_length, t.cut_mean, t.cut_p95, t.in_pieces * 100, t.fresh * 100);
  }
  return out + "</table>\n";
}

std::string stages_table(const std::vector<StageShare>& stages) {
  std::string out = "<table class=\"words\"><tr><th>stage</th><th>share</th><th></th></tr>\n";
  for (const StageShare& s : stages)
    out +=
        fmt::format("<tr><td>{}</td><td>{:.0f} %</td><td><span class=\"bar\" style=\"width:{:.0f}px\"></span>"
                    "</td></tr>\n",
                    escaped(s.stage), s.share * 100, s.share * 400);
  return out + "</table>\n";
}

// As given or by default; then what was found for those that were left open.
std::string options_table(const Pack& pack) {
  const Generator& generator = pack.generator;
  std::string out = "<p><code>";
  std::string found;
  bool has_mapping = false;
  for (const auto& [name, value] : generator.options) {
    out += escaped(as_option(name, value)) + " ";
    if (name == "tile-size" && value == "auto")
      found += fmt::format(
          " {}", as_option("tile-size", fmt::format("{}x{}", pack.tile_size.width, pack.tile_size.height)));
    has_mapping = has_mapping || name == "mapping";
  }
  if (!has_mapping) found += fmt::format(" {}", as_option("mapping", name_of(pack.mapping.kind)));
  out += as_option("seed", std::to_string(generator.seed)) + "</code>";
  if (!found.empty()) out += fmt::format("; chosen: <code>{}</code>", found.substr(1));
  return out + fmt::format("; version {}</p>\n", escaped(generator.version));
}

} // namespace

std::string bake_page(const BakeSummary& story, const BakedPack& made, std::span<const SampleMap> given) {
  const std::span<const SampleMap> samples = made.samples_used(given);
  constexpr int most_tiles = 64;
  const BakeFacts& facts = story.facts;
  const SetReport& report = facts.report;
  const SampleMap& main = samples[0];
  const Image sample = viewable(main.image, main.role, main.encoding);
  const Size tile = made.pack.tile_size;
  std::string page = fmt::format(
      "<h1>{}</h1>\n<p>{}{} x {} texels, {} map{}{}{}; {} tile{} of {} x {} texels.</p>\n",
      escaped(story.sample),
      facts.materials.empty() ? "" : fmt::format("{} materials side by side: ", facts.materials.size()),
      facts.sample.width, facts.sample.height, samples.size(), samples.size() == 1 ? "" : "s",
      made.straightened > 0
          ? fmt::format(", straightened: courses were moved by up to {:.1f} texels", made.straightened)
          : "",
      made.levelled      ? ", the tones of its courses made alike"
      : made.flatten > 0 ? fmt::format(", flattened by {} %", made.flatten)
                         : "",
      facts.tiles, facts.tiles == 1 ? "" : "s", tile.width, tile.height);
  page += verdict_box(bake_verdict(facts));
  if (facts.size_chosen)
    page += fmt::format("<p>Tile size: {}</p>\n",
                        escaped(spelled(size_choice_text(facts), FieldSpelling::option)));

  page += materials_section(facts);
  page += "<h2>The texture and its tiles</h2>\n<div class=\"row\">\n";
  PackPictureOptions bare;
  bare.marks = false;
  bare.min_tile_side = 1;
  bare.max_side = 1024;
  page += figure(rasterised(expansion_picture(made.pack, 6, 4, bare)),
                 "Six by four tiles of the endless texture, as they fall.");
  PackPictureOptions marked;
  marked.max_side = 1024;
  page += figure(rasterised(pack_picture(made.pack, marked)),
                 "The pack, with the colors on which neighbours agree.");
  page += "</div>\n";

  page += "<h2>Cuts</h2>\n";
  constexpr int most_places = 9;
  const std::vector<WorstPlace> worst = worst_places(made, most_places);
  page +=
      figure(rasterised(cut_picture(sample, made.sample.features, made.sources, report, most_tiles, worst)),
             cut_caption(report.figures.sample_step, std::min(facts.tiles, most_tiles), facts.tiles));
  if (!worst.empty())
    page += "<h2>The worst places</h2>\n" +
            figure(rasterised(worst_places_picture(sample, made.sources, worst)),
                   "Left, three times as large: where the set can be told from its sample most easily, by "
                   "the numbers "
                   "on the tiles above. " +
                       worst_kinds(worst) + "Right: the place of the sample that it is most like.");

  page += "<h2>What the tiles show of the sample</h2>\n<div class=\"row\">\n";
  // What a sample that wraps is continued by is its own.
  const Image once =
      made.wrap == SampleWrap{} ? sample : crop(sample, {0, 0, facts.sample.width, facts.sample.height});
  page += figure(use_picture(once, made.sources), use_caption(facts.tiles));
  page += figure(
      rasterised(source_picture(sample, made.sources)),
      "Where the pieces come from. White, with the tile's id: the largest piece of each tile's inside. In "
      "the color of their border: pieces that reach one.");
  page += "</div>\n<h2>Figures</h2>\n" + figures_table(facts);
  page += facts.tiles > most_tiles ? fmt::format("<h2>The {} tiles with the dearest cuts</h2>\n", most_tiles)
                                   : std::string("<h2>Tiles, those with the dearest cuts first</h2>\n");
  page += tiles_table(report, most_tiles);
  if (!story.stages.empty()) page += "<h2>Where the time went</h2>\n" + stages_table(story.stages);
  return html_page("tilepack bake", page + "<h2>Options</h2>\n" + options_table(made.pack));
}

} // namespace tilepack
