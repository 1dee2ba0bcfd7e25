#include "support/noise_pack.h"
#include "support/scratch_folder.h"

#include "tilepack/bake/bake_job.h"
#include "tilepack/bake/text_file.h"
#include "tilepack/image/image_file.h"

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <map>
#include <set>

using namespace tilepack;
using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
namespace fs = std::filesystem;

namespace {

// A folder with a material, a preset and a job that bakes it in no time.
class JobFolder {
public:
  JobFolder() {
    fs::create_directory(scratch.path / "rock");
    image("rock/rock_albedo.png", 3);
    image("rock/rock_height.png", 1);
    image("wet.png", 1);
    write_text_file(path("mine.json"), R"({"purpose": "p", "cost": "c", "layout": "array", "effort": 0})");
  }

  std::string path(const std::string& name) const { return (scratch.path / name).string(); }

  void image(const std::string& name, int channels, int side = 48) const {
    write_image(path(name), quantised(test::noise(side, side, channels, 3), Depth::u8), Depth::u8,
                channels == 3 ? Encoding::srgb : Encoding::linear);
  }

  BakeJob job() const {
    return {.name = "rock",
            .sample = path("rock"),
            .settings = {{"tile-size", "16", field("tile-size")},
                         {"virtual-size", "8", field("virtual-size")},
                         {"effort", "0", field("effort")}},
            .folder = path("out")};
  }

private:
  ScratchFolder scratch;
};

BakeJob with(BakeJob job, const std::string& name, const std::string& value, const std::string& where = "") {
  job.settings.push_back({name, value, where.empty() ? field(name) : where});
  return job;
}

struct Fault {
  ErrorKind kind = ErrorKind::internal;
  std::string option;
  std::string plain;
};

template <typename Work>
Fault fault(Work work) {
  try {
    work();
  } catch (const Error& error) {
    return {error.kind(), error.message(FieldSpelling::option), error.what()};
  }
  return {};
}

} // namespace

TEST_CASE("a job tells what it reads and writes before it runs, and all of it afterwards") {
  const JobFolder at;
  BakeJob job = at.job();
  job.preset = at.path("mine.json");
  job.maps = {{"wet", Role::data, at.path("wet.png")}};
  job.report = at.path("page.html");
  job.depfile = at.path("out.d");
  CHECK(files_read(job) == std::vector{at.path("rock/rock_albedo.png"), at.path("rock/rock_height.png"),
                                       at.path("wet.png"), at.path("mine.json")});
  CHECK(files_written(job) == std::vector{at.path("out/pack.json"), at.path("page.html"), at.path("out.d")});
  CHECK(!fs::exists(at.path("out")));

  const BakedJob baked = run(job);
  std::vector<std::string> there;
  for (const auto& entry : fs::directory_iterator(at.path("out"))) there.push_back(entry.path().string());
  there.insert(there.end(), {at.path("page.html"), at.path("out.d")}); // the page is the caller's to write
  std::vector<std::string> told = files_written(job, baked);
  std::sort(there.begin(), there.end());
  std::sort(told.begin(), told.end());
  CHECK(told == there);
  const std::string rule = read_text_file(at.path("out.d"), "the rule");
  for (const std::string& file : files_read(job)) CHECK_THAT(rule, Contains(file));
}

TEST_CASE("a built-in preset is no file, even where a file has its name") {
  const JobFolder at;
  BakeJob job = at.job();
  job.preset = "wall";
  CHECK(files_read(job).size() == 2);
}

TEST_CASE("the canonical text has a line for every field, sorted, and doesn't depend on where one was set") {
  const JobFolder at;
  const BakeJob job = at.job();
  const std::string text = canonical_options(job);
  std::vector<std::string> keys;
  for (std::size_t start = 0; start < text.size(); start = text.find('\n', start) + 1)
    keys.push_back(text.substr(start, text.find('=', start) - start));
  CHECK(std::is_sorted(keys.begin(), keys.end()));
  CHECK(keys.size() == bake_fields().size() + 4);
  for (const BakeField& field : bake_fields()) CHECK(std::count(keys.begin(), keys.end(), field.name) == 1);
  CHECK_THAT(text, Contains("\nmaps=color:color,height:height\n") && Contains("\ntile-size=16\n") &&
                       Contains("\ngutter=\n") && Contains("\njump-weight="));

  BakeJob preset = job;
  preset.preset = at.path("mine.json");
  CHECK(canonical_options(preset) == canonical_options(with(job, "layout", "array", "manifest.json:3")));
  CHECK(canonical_options(with(job, "seed", "0")) == text); // a default, said
  BakeJob elsewhere = job;
  elsewhere.name = "other";
  elsewhere.folder = at.path("there");
  elsewhere.report = at.path("r.html");
  elsewhere.depfile = at.path("r.d");
  elsewhere.place = "manifest.json:9";
  CHECK(canonical_options(elsewhere) == text);
  std::reverse(elsewhere.settings.begin(), elsewhere.settings.end());
  CHECK(canonical_options(elsewhere) == text);
}

TEST_CASE("the canonical text changes with all that reaches the bytes of a pack") {
  const JobFolder at;
  const BakeJob job = at.job();
  const std::map<std::string, std::string> others{{"tile-size", "24"},
                                                  {"flatten", "50"},
                                                  {"coloring", "edge"},
                                                  {"colors", "3"},
                                                  {"variants", "2"},
                                                  {"straighten", "false"},
                                                  {"set", "sequential"},
                                                  {"interior", "quilt"},
                                                  {"guard", "1"},
                                                  {"effort", "2"},
                                                  {"seed", "5"},
                                                  {"layout", "rotated"},
                                                  {"scheme", "4,0"},
                                                  {"gutter", "3"},
                                                  {"power-of-two", "true"},
                                                  {"turn-filter", "bicubic"},
                                                  {"border", "2"},
                                                  {"corner-pack", "true"},
                                                  {"mips", "box"},
                                                  {"full-mips", "true"},
                                                  {"jump-weight", "7"},
                                                  {"mapping", "index"},
                                                  {"virtual-size", "9"},
                                                  {"image-format", "exr"},
                                                  {"wraps", "no"},
                                                  {"depth", "u16"},
                                                  {"alpha-coverage", "50"},
                                                  {"normal-y", "up"},
                                                  {"height-range", "0,3"},
                                                  {"roughness-from-normals", "false"}};
  std::set<std::string> texts{canonical_options(job)};
  for (const BakeField& field : bake_fields()) {
    INFO(field.name);
    REQUIRE(others.count(field.name) == 1);
    std::string value = others.at(field.name);
    if (field.type == BakeFieldType::flag && field.get(BakeOptions{}) == value)
      value = value == "true" ? "false" : "true";
    CHECK(texts.insert(canonical_options(with(job, field.name, value))).second);
  }
  BakeJob linear = job;
  linear.encoding = Encoding::linear;
  CHECK(texts.insert(canonical_options(linear)).second);
  BakeJob more = job;
  more.maps = {{"wet", Role::data, at.path("wet.png")}};
  CHECK(texts.insert(canonical_options(more)).second);
  more.maps[0].contents = {ChannelContent::roughness};
  CHECK(texts.insert(canonical_options(more)).second);
  more.maps[0] = {"normal", Role::normal, at.path("wet.png")};
  CHECK(texts.insert(canonical_options(more)).second);
  more.maps[0].normal_y = NormalY::down;
  CHECK(texts.insert(canonical_options(more)).second);
  more.maps[0].role = Role::roughness;
  CHECK(texts.insert(canonical_options(more)).second);
}

TEST_CASE("jobs of one canonical text make the same pack, wherever it goes") {
  const JobFolder at;
  BakeJob job = at.job();
  run(job);
  BakeJob other = with(job, "seed", "0", "list.json:4");
  other.folder = at.path("again");
  other.place = "list.json:4";
  run(other);
  REQUIRE(canonical_options(job) == canonical_options(other));
  for (const auto& entry : fs::directory_iterator(at.path("out")))
    CHECK(read_text_file(entry.path().string(), "it") ==
          read_text_file(at.path("again/" + entry.path().filename().string()), "it"));
}

TEST_CASE("errors are blamed on where the field was set, early and late") {
  const JobFolder at;
  const BakeJob job = at.job();
  // Out of range, found when it is parsed.
  CHECK_THAT(fault([&] { run(with(job, "effort", "12")); }).option,
             Contains("--effort: '12' is not allowed"));
  // Contradictions, found by packing.
  const Fault here = fault([&] { run(with(job, "border", "2")); });
  CHECK(here.kind == ErrorKind::usage);
  CHECK(here.option == "--border: is for --layout array");
  const BakeJob edge = with(job, "coloring", "edge");
  CHECK_THAT(fault([&] { run(with(edge, "layout", "de-bruijn", "list.json:7 \"layout\"")); }).plain,
             StartsWith("list.json:7 \"layout\": 'de-bruijn' is for corner coloring"));

  const std::string preset = at.path("late.json");
  write_text_file(
      preset, R"({"purpose": "p", "cost": "c", "coloring": "corner", "layout": "tile-index", "border": 2})");
  BakeJob late = job;
  late.preset = preset;
  const Fault in_file = fault([&] { run(late); });
  CHECK(in_file.kind == ErrorKind::invalid_content);
  CHECK_THAT(in_file.plain, Contains("late.json: \"border\": is for layout array"));
  CHECK_THAT(fault([&] { run(with(late, "border", "0")); }).plain,
             Contains("late.json: \"layout\": 'tile-index' is for edge coloring"));
  // The command line overrides the preset, and then is to blame itself.
  CHECK_THAT(fault([&] { run(with(with(late, "border", "0"), "layout", "tile-index")); }).option,
             Contains("--layout: 'tile-index' is for edge coloring"));
  CHECK(!fs::exists(at.path("out")));
}

TEST_CASE("what a manifest asks for is blamed on its place there") {
  const JobFolder at;
  BakeJob job = at.job();
  job.place = "list.json:12";
  job.report = at.path("page.txt");
  const Fault report = fault([&] { run(job); });
  CHECK(report.kind == ErrorKind::invalid_content);
  CHECK_THAT(report.plain, Contains("list.json:12 \"report\": ") && Contains("it must be .html"));
  job.report.clear();
  job.preset = "waal";
  CHECK_THAT(fault([&] { run(job); }).plain, Contains("list.json:12 \"preset\": there is no preset 'waal'"));
  job.preset.clear();
  // A setting's own place is nearer than the job's; what nobody set is the job's.
  BakeJob edge = with(with(job, "coloring", "edge", "list.json:13 \"coloring\""), "layout", "de-bruijn",
                      "list.json:14 \"layout\"");
  CHECK_THAT(fault([&] { run(edge); }).plain, StartsWith("list.json:14 \"layout\": "));
  BakeJob corner = with(job, "mapping", "permutation");
  corner.settings = {{"colors", "8x8", "list.json:15 \"colors\""},
                     {"mips", "box", "list.json:16 \"mips\""},
                     {"set", "sequential", "list.json:17 \"set\""},
                     {"layout", "array", "list.json:18"},
                     {"mapping", "mix", "list.json:19 \"mapping\""}};
  CHECK_THAT(fault([&] { run(corner); }).plain, StartsWith("list.json:19 \"mapping\": 'mix' needs"));
}

TEST_CASE("outputs that would replace inputs are refused before anything is read") {
  const JobFolder at;
  BakeJob job = at.job();
  job.depfile = at.path("rock/../rock/rock_albedo.png");
  CHECK_THAT(fault([&] { run(job); }).option, Contains("--depfile: ") && Contains("worked from"));
  job.depfile = at.path("a.html");
  job.report = at.path("a.html");
  CHECK_THAT(fault([&] { run(job); }).option, Contains("--report: ") && Contains("--depfile writes too"));
  job = at.job();
  job.preset = at.path("mine.json");
  job.depfile = job.preset;
  CHECK_THAT(fault([&] { run(job); }).option, Contains("--depfile: ") && Contains("worked from"));
}

TEST_CASE("progress tells the job, and cancels it without a trace") {
  const JobFolder at;
  std::set<std::string> jobs, stages;
  std::atomic<int> made = 0;
  JobWatch watch;
  watch.progress = [&](std::string_view job, std::string_view stage, double) {
    jobs.insert(std::string(job));
    stages.insert(std::string(stage));
  };
  watch.made = [&](const BakedJob& baked) {
    made += static_cast<int>(baked.made.pack.maps.size() + baked.description.map_files.size());
  };
  run(at.job(), watch);
  CHECK(jobs == std::set<std::string>{"rock"});
  CHECK(stages.count("reading") == 1);
  CHECK(stages.count("mips") == 1);
  CHECK(made == 4);

  struct Cancelled {};
  BakeJob job = at.job();
  job.folder = at.path("cancelled");
  job.depfile = at.path("cancelled.d");
  watch.progress = [](std::string_view, std::string_view stage, double) {
    if (stage == "mips") throw Cancelled();
  };
  CHECK_THROWS_AS(run(job, watch), Cancelled);
  CHECK(!fs::exists(at.path("cancelled")));
  CHECK(!fs::exists(at.path("cancelled.d")));
}

TEST_CASE("a doubt about the color map reaches the watcher before the bake") {
  const JobFolder at;
  BakeJob job = at.job();
  job.sample = at.path("rock/rock_height.png");
  std::string heard;
  JobWatch watch;
  watch.note = [&](std::string_view line) { heard = spelled(line, FieldSpelling::option); };
  run(job, watch);
  CHECK_THAT(heard, Contains("--map height=") && Contains("--encoding linear takes plain values"));
}

TEST_CASE("the estimate of memory grows with samples, maps and tiles, and needs no texel") {
  const JobFolder at;
  const BakeJob job = at.job();
  const std::int64_t small = peak_memory(job);
  CHECK(peak_memory(with(job, "colors", "4")) > small);
  CHECK(peak_memory(with(job, "tile-size", "32")) > small);
  BakeJob one = job;
  one.sample = at.path("rock/rock_albedo.png");
  CHECK(peak_memory(one) < small);
  at.image("large.png", 3, 256);
  one.sample = at.path("large.png");
  const std::int64_t large = peak_memory(one);
  CHECK(large > small);
  // A file that has its header alone.
  fs::resize_file(at.path("large.png"), 4000);
  CHECK(peak_memory(one) == large);
}
