// The figures on which the verdict of a bake rests, beside the limits of report/verdict_thresholds.h and the
// verdict itself, for samples to be looked at:
//
//   bench_verdict_figures [--tile-size N|auto] [--effort N] SAMPLE.png…
//
// Sets are baked as `tilepack bake` does by default, of square tiles of 128 texels at effort 0 unless told otherwise.
// With auto, sizes and tones follow the sample, as they do in bakes that are told nothing.

#include "tilepack/bake/bake.h"
#include "tilepack/image/image_file.h"
#include "tilepack/report/bake_verdict.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

using namespace tilepack;

namespace {

std::string limit_text(const std::optional<double>& limit) {
  return limit ? fmt::format("{:.3g}", *limit) : "-";
}

BakeFacts facts_of(const std::string& file, const BakeOptions& options) {
  ImageFile image = read_image(file);
  const std::vector<SampleMap> samples{
      {"color", Role::color, image.encoding, image.depth, std::move(image.image)}};
  return bake_facts(baked(samples, options), samples);
}

void print_heading(const std::vector<JudgedFigure>& figures) {
  std::string names = fmt::format("{:<18}", "sample");
  std::string fair = fmt::format("{:<18}", "fair from");
  std::string poor = fmt::format("{:<18}", "poor from");
  for (const JudgedFigure& figure : figures) {
    names += fmt::format(" {:>11}", figure.name);
    fair += fmt::format(" {:>11}", limit_text(figure.fair));
    poor += fmt::format(" {:>11}", limit_text(figure.poor));
  }
  std::fputs((names + "  verdict\n" + fair + "\n" + poor + "\n").c_str(), stdout);
}

} // namespace

int main(int argc, char** argv) {
  BakeOptions options;
  options.synth.tile_size = {128, 128};
  options.synth.effort = 0;
  std::vector<std::string> files;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--tile-size" && i + 1 < argc) {
      const std::string size = argv[++i];
      options.fit_tile_size = options.fit_flatten = size == "auto";
      const int side = options.fit_tile_size ? 128 : std::stoi(size);
      options.synth.tile_size = {side, side};
    } else if (word == "--effort" && i + 1 < argc) {
      options.synth.effort = std::stoi(argv[++i]);
    } else {
      files.push_back(word);
    }
  }
  bool headed = false;
  for (const std::string& file : files) {
    try {
      const BakeFacts facts = facts_of(file, options);
      const std::vector<JudgedFigure> figures = judged_figures(facts);
      if (!headed) print_heading(figures);
      headed = true;
      std::string line = fmt::format("{:<18}", std::filesystem::path(file).stem().string());
      for (const JudgedFigure& figure : figures) line += fmt::format(" {:>11.3f}", figure.value);
      line += fmt::format("  {}\n", name_of(bake_verdict(facts).grade));
      std::fputs(line.c_str(), stdout);
      std::fflush(stdout);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s: %s\n", file.c_str(), error.what());
    }
  }
  return files.empty() ? 1 : 0;
}
