#include "support/scratch_folder.h"

#include "tilepack/bake/text_file.h"
#include "tilepack/batch/entry_choice.h"
#include "tilepack/batch/manifest.h"
#include "tilepack/batch/manifest_schema.h"
#include "tilepack/batch/path_pattern.h"
#include "tilepack/json/json_line.h"
#include "tilepack/json/json_schema.h"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <set>

using namespace tilepack;
using Catch::Matchers::Contains;

namespace {

Manifest manifest_of(const std::string& jobs, const std::string& defaults = "{}") {
  return parsed_manifest(R"({"format": "tilepack-manifest", "version": 1, "defaults": )" + defaults +
                             R"(, "jobs": [)" + jobs + "]}",
                         "art/m.json");
}

std::string refused(const std::string& jobs) {
  try {
    manifest_of(jobs);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

} // namespace

TEST_CASE("an entry's paths stand behind the manifest's folder, and defaults give way to its own options") {
  const Manifest manifest = manifest_of(
      R"({"sample": "a.png", "output": "../out/a", "options": {"seed": 7}},
         {"verb": "render", "pack": "../out/a", "output": "view.png", "options": {"mesh": "wall.obj"}},
         {"sample": "b.png", "output": "b", "preset": "wall", "name": "second"})",
      R"({"preset": "mine.json", "options": {"seed": 1, "colors": "3"}, "verbs": {"render": {"scale": 0.5}}})");
  REQUIRE(manifest.entries.size() == 3);
  const BatchEntry& bake = manifest.entries[0];
  CHECK(bake.name == "../out/a");
  CHECK(bake.output == "out/a");
  CHECK(bake.preset == "art/mine.json");
  REQUIRE(bake.options.size() == 2);
  CHECK(bake.options[0].name == "colors");
  CHECK(bake.options[1].values == std::vector<std::string>{"7"});
  CHECK(bake.sources == std::vector<std::string>{"art/a.png"});
  const BatchEntry& render = manifest.entries[1];
  CHECK(render.after == std::vector<std::size_t>{0});
  REQUIRE(render.options.size() == 2);
  CHECK(render.options[0].values == std::vector<std::string>{"art/wall.obj"}); // a path like any other
  CHECK(render.options[1].values == std::vector<std::string>{"0.5"});
  CHECK(manifest.entries[2].preset == "wall");
  CHECK(manifest.entries[2].name == "second");
  CHECK(target_of(bake) == "out/a/pack.json");
}

TEST_CASE("what can't be a manifest is refused with its place") {
  CHECK_THAT(refused(R"({"sample": "a", "samples": "*.png", "output": "o"})"), Contains("jobs[0]"));
  CHECK_THAT(refused(R"({"sample": "a", "output": ""})"), Contains("jobs[0].output"));
  CHECK_THAT(refused(R"({"sample": "p/q", "output": "p"})"), Contains("reads what it writes"));
  CHECK_THAT(refused(R"({"verb": "compare", "a": "y.txt", "b": "b", "output": "x.txt"},
                        {"verb": "compare", "a": "x.txt", "b": "b", "output": "y.txt"})"),
             Contains("made from what is made from it"));
  CHECK_THAT(refused(R"({"sample": "a", "output": "o", "options": {"--seed": 1}})"),
             Contains("without dashes"));
  CHECK_THAT(refused(R"({"sample": "a", "output": "o", "options": {"seed": null}})"),
             Contains("options.seed"));
  CHECK_THAT(refused(R"({"sample": "a\u0000b", "output": "o"})"), Contains("zero character"));
}

TEST_CASE("patterns match name by name") {
  CHECK(matches("in/*.png", "in/a.png"));
  CHECK_FALSE(matches("in/*.png", "in/deep/a.png"));
  CHECK(matches("in/**/*.png", "in/a.png"));
  CHECK(matches("in/**/*.png", "in/deep/er/a.png"));
  CHECK_FALSE(matches("*.png", ".hidden.png"));
  CHECK_FALSE(matches("/in/*", "in/a"));
  CHECK(matches("packs/[ab]", "packs/a"));

  const ScratchFolder scratch;
  for (const char* name : {"x/b.png", "x/a.png", "x/y/c.png", ".git/d.png"}) {
    std::filesystem::create_directories((scratch.path / name).parent_path());
    write_text_file((scratch.path / name).string(), "");
  }
  const std::string root = scratch.path.string();
  CHECK(paths_matching(root + "/x/*.png").paths == std::vector{root + "/x/a.png", root + "/x/b.png"});
  CHECK(paths_matching(root + "/**/*.png").paths ==
        std::vector{root + "/x/a.png", root + "/x/b.png", root + "/x/y/c.png"});
  CHECK(paths_matching(root + "/x/*.png").folders == std::vector{root + "/x"});
  CHECK(paths_matching(root + "/*").paths == std::vector{root + "/x"});
  CHECK(paths_matching(root + "/*/none.png").folders == std::vector{root, root + "/x"}); // where one may come to be
}

TEST_CASE("parts of a manifest are a partition that stays as it is when entries are added") {
  std::string jobs;
  const auto part = [&](const Manifest& manifest, int number) {
    std::set<std::string> names;
    for (const std::size_t i : chosen_entries(manifest, {}, fmt::format("{}/4", number)))
      names.insert(manifest.entries[i].name);
    return names;
  };
  for (int i = 0; i < 200; ++i)
    jobs += fmt::format(
        R"({0}{{"sample": "a.png", "output": "p{1}"}},{{"verb": "render", "pack": "p{1}", "output": "v{1}.png"}})",
        i > 0 ? "," : "", i);
  const Manifest before = manifest_of(jobs);
  const Manifest after = manifest_of(R"({"sample": "a.png", "output": "new"},)" + jobs);
  std::size_t total = 0;
  for (int number = 1; number <= 4; ++number) {
    const auto names = part(before, number);
    CHECK(names.size() > 2 * 30); // of 2 * 50: none is starved
    total += names.size();
    auto more = part(after, number);
    more.erase("new");
    CHECK(more == names);
    for (const std::string& name : names) // a view lies where its pack is
      if (name[0] == 'v') CHECK(names.contains(fmt::format("p{}", name.substr(1, name.size() - 5))));
  }
  CHECK(total == 400);
}

TEST_CASE("the schema takes what the reader takes") {
  const std::string good =
      R"({"format": "tilepack-manifest", "version": 1, "jobs": [{"samples": "a/*.png", "output": "p/{stem}"}]})";
  CHECK(schema_problems(good, manifest_schema()).empty());
  CHECK(schema_problems(
            R"({"format": "tilepack-manifest", "version": 1, "jobs": [{"sample": 3, "output": "p"}]})",
            manifest_schema())
            .size() == 1);
}

TEST_CASE("places in a document have lines") {
  const std::string text = "{\n \"a\": [1,\n  {\"b.c\": \"]}\\\"\",\n   \"d\": 2}],\n \"e\": true}";
  CHECK(json_line(text, "") == 1);
  CHECK(json_line(text, "a") == 2);
  CHECK(json_line(text, "a[1]") == 3);
  CHECK(json_line(text, "a[1].b.c") == 3);
  CHECK(json_line(text, "a[1].d") == 4);
  CHECK(json_line(text, "e") == 5);
  CHECK(json_line(text, "a[1].none") == 3);
  for (std::size_t cut = 0; cut < text.size(); ++cut) json_line(text.substr(0, cut), "a[1].d"); // ends
  const JsonLines lines(text);
  for (const char* place :
       {"", "a", "a[0]", "a[1]", "a[1].b.c", "a[1].d", "a[2]", "a[x]", "a[", "e", "f", "a[1].none"}) {
    CAPTURE(place);
    CHECK(lines.line(place) == json_line(text, place));
  }
  for (std::size_t cut = 0; cut < text.size(); ++cut) JsonLines(text.substr(0, cut)).line("a[1].d");
}
