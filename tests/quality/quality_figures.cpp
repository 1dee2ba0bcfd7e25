// Bakes the project's own samples with the settings of `tilepack bake` and holds what comes out against
// committed figures, so that quality can't slip unseen.
//
//   quality_figures                prints a table; exit code 1 if a figure is beyond its fail limit
//   quality_figures --write FILE   writes the figures of now; the limits stay
//
// In figures.json, `limits` say which way is better, and how far a figure may move the other way before it
// warns or fails: a share of its value, but at least `least` units.

#include "border_contrast.h"
#include "patch_coherence.h"

#include "tilepack/bake/bake.h"
#include "tilepack/bake/bake_fields.h"
#include "tilepack/error/error.h"
#include "tilepack/image/image_file.h"
#include "tilepack/measure/seams.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

using namespace tilepack;
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

namespace {

struct Subject {
  const char* name;
  std::vector<std::pair<const char*, Role>> maps; // file without its ending → role
};

const Subject subjects[] = {
    {"pebbles", {{"pebbles", Role::color}}},
    {"meadow", {{"meadow", Role::color}}},
    {"bricks", {{"bricks", Role::color}}},
    {"planks", {{"planks", Role::color}}},
    {"cracked", {{"cracked", Role::color}}},
    {"rock",
     {{"rock_albedo", Role::color},
      {"rock_normal", Role::normal},
      {"rock_roughness", Role::roughness},
      {"rock_height", Role::height}}},
};

struct Figure {
  std::string name;
  double value;
};

std::vector<SampleMap> samples_of(const Subject& subject, const fs::path& folder) {
  std::vector<SampleMap> samples;
  for (const auto& [file, role] : subject.maps) {
    ImageFile read = read_image(folder / (std::string(file) + ".png"),
                                role == Role::color ? Encoding::srgb : Encoding::linear);
    samples.push_back({std::string(name_of(role)), role, read.encoding, read.depth, std::move(read.image)});
  }
  return samples;
}

std::vector<Figure> figures_of(const Subject& subject, const fs::path& folder) {
  constexpr int patches = 600;
  const std::vector<SampleMap> samples = samples_of(subject, folder);
  std::vector<BakeSetting> settings;
  if (std::string(subject.name) == "bricks" || std::string(subject.name) == "planks")
    settings.push_back({"tile-size", "auto", "--tile-size", ErrorKind::usage});
  BakeOptions options = bake_options(settings);
  options.mips.mode = MipMode::none;
  const BakedPack made = baked(samples, options);
  const quality::Coherence coherence =
      quality::patch_coherence(made.sample.features, made.sources, patches, 1);
  const SetFigures& f = made.report.figures;
  return {{"coherence_p50", coherence.p50},
          {"coherence_p95", coherence.p95},
          {"cut_length", f.cut_length},
          {"cut_mean", f.cut_mean},
          {"cut_p95", f.cut_p95},
          {"border_mean", f.border_mean},
          {"border_step", seam_figures(made.pack, 0, 0, 0).seam},
          {"border_contrast", quality::border_contrast(made.sample.features, made.sources)},
          {"in_pieces", f.in_pieces},
          {"coverage", f.coverage},
          {"distinct_tiles", f.distinct_tiles},
          {"shown_often", f.shown_often},
          {"histogram_distance", f.histogram_distance}};
}

struct Limits {
  std::string better;
  double warn = 0;
  double fail = 0;
  double least = 0;
};

Limits limits_of(const Json& file, const std::string& figure) {
  const Json& l = file.at("limits").at(figure);
  return {l.at("better"), l.at("warn"), l.at("fail"), l.at("least")};
}

enum class Outcome { kept, warned, failed };

Outcome held(double value, double committed, const Limits& limits) {
  double worse = value - committed;
  if (limits.better == "higher") worse = -worse;
  if (limits.better == "same") worse = std::abs(worse);
  const auto allowed = [&](double share) { return std::max(share * std::abs(committed), limits.least); };
  if (!(worse <= allowed(limits.fail))) return Outcome::failed; // not a number fails
  return worse > allowed(limits.warn) ? Outcome::warned : Outcome::kept;
}

int write(const fs::path& file, const fs::path& folder, Json committed) {
  Json made = Json::object();
  for (const Subject& subject : subjects)
    for (const Figure& figure : figures_of(subject, folder))
      made[subject.name][figure.name] = std::round(figure.value * 1000) / 1000;
  committed["figures"] = std::move(made);
  std::ofstream out(file, std::ios::binary);
  out << committed.dump(2) << '\n';
  out.close();
  if (!out) throw Error(ErrorKind::cannot_write, file.string(), "can't be written");
  return 0;
}

int check(const Json& committed, const fs::path& folder) {
  int failed = 0;
  int warned = 0;
  for (const Subject& subject : subjects) {
    fmt::print("{}\n", subject.name);
    const Json& known = committed.at("figures").at(subject.name);
    for (const Figure& figure : figures_of(subject, folder)) {
      const double before = known.at(figure.name);
      const Outcome outcome = held(figure.value, before, limits_of(committed, figure.name));
      failed += outcome == Outcome::failed;
      warned += outcome == Outcome::warned;
      fmt::print("  {:<20}{:>12.3f}{:>12.3f}{}\n", figure.name, figure.value, before,
                 outcome == Outcome::kept     ? ""
                 : outcome == Outcome::warned ? "  warning"
                                              : "  FAILED");
    }
  }
  fmt::print("{} figures beyond their fail limit, {} beyond their warn limit (now, committed)\n", failed,
             warned);
  return failed > 0 ? 1 : 0;
}

} // namespace

int main(int count, char** arguments) {
  const std::vector<std::string> words(arguments + 1, arguments + count);
  const fs::path source(TILEPACK_SOURCE_DIR);
  const fs::path file = source / "tests" / "quality" / "figures.json";
  if (!words.empty() && (words.size() != 2 || words[0] != "--write")) {
    fmt::print(stderr, "usage: quality_figures [--write FILE]\n");
    return 2;
  }
  try {
    std::ifstream stream(file);
    const Json committed = Json::parse(stream);
    stream.close();
    return words.empty() ? check(committed, source / "samples")
                         : write(words[1], source / "samples", committed);
  } catch (const std::exception& error) {
    fmt::print(stderr, "quality_figures: {}\n", error.what());
    return 2;
  }
}
