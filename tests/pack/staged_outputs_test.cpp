#include "support/file_contents.h"
#include "support/killed_process.h"
#include "support/noise_pack.h"
#include "support/scratch_folder.h"
#include "support/skipped.h"

#include "tilepack/error/error.h"
#include "tilepack/image/image_file.h"
#include "tilepack/pack/pack_folder.h"
#include "tilepack/pack/pack_read.h"
#include "tilepack/pack/pack_write.h"
#include "tilepack/pack/staged_outputs.h"

#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <set>

using namespace tilepack;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

using test::contents;
using test::put;

using Contents = std::map<std::string, std::string>;

/// One command's outputs: two files beside the folder, one in it, and the folder.
void write_all(
    const fs::path& below, const std::string& text, const std::function<void()>& before_commit = [] {}) {
  StagedOutputs outputs;
  const fs::path staging = outputs.add_folder(below / "p").path();
  put(staging / "color_0.png", text + " color");
  put(staging / "pack.json", text + " pack");
  outputs.set_files({"color_0.png", "pack.json"}, {"color_0.png", "pack.json"});
  outputs.add_text(below / "report.html", text + " report");
  outputs.add_text(below / "p.d", text + " depfile");
  outputs.add_text(below / "p" / "inside.html", text + " inside");
  before_commit();
  outputs.commit();
}

Contents all_of(const std::string& text) {
  return {{"p", "folder"},
          {"p/color_0.png", text + " color"},
          {"p/pack.json", text + " pack"},
          {"p/inside.html", text + " inside"},
          {"report.html", text + " report"},
          {"p.d", text + " depfile"}};
}

/// Kills the writer at every system call of its last step; whoever comes next finds the old outputs or the new.
void kill_everywhere(bool exists, bool one_by_one) {
  const ScratchFolder temporary;
  int kept = 0, replaced = 0;
  bool killed = true;
  for (int n = 1; killed; n += 2) {
    fs::remove_all(temporary.path);
    fs::create_directories(temporary.path);
    Contents before, after = all_of("new");
    if (exists) {
      write_all(temporary.path, "old");
      before = all_of("old");
    }
    if (one_by_one) {
      fs::create_directories(temporary / "p" / "drafts");
      before["p"] = before["p/drafts"] = after["p/drafts"] = "folder";
    }
    killed = test::killed_at(n, [&] { write_all(temporary.path, "new", [] { ::raise(SIGSTOP); }); });
    CAPTURE(n);
    { const StagedFolder next(temporary / "p"); }
    const StagedFile of_report(temporary / "report.html"), of_depfile(temporary / "p.d");
    Contents found = contents(temporary.path);
    // Those two.
    REQUIRE(found.erase(".report.html.0.part") + found.erase(".p.d.0.part") == 2);
    (found == before ? kept : replaced) += 1;
    if (found != before) REQUIRE(found == after);
  }
  CHECK(kept > 3);
  CHECK(replaced > 3);
}

} // namespace

TEST_CASE("outputs of one command are all old or all new, wherever it is killed", "[pack]") {
  if (!test::tracing_is_allowed())
    return test::skipped("killing a writer at each system call; ptrace is forbidden");
  SECTION("with older ones there") {
    kill_everywhere(true, false);
  }
  SECTION("with nothing there") {
    kill_everywhere(false, false);
  }
  SECTION("in a folder that can't be swapped") {
    kill_everywhere(true, true);
  }
}

TEST_CASE("a step that fails takes those before it back", "[pack]") {
  const ScratchFolder temporary;
  SECTION("the folder, at the end") {
    write_all(temporary.path, "old");
    const auto block = [&] { put(temporary / "p" / "height_0.png", "mine"); };
    StagedOutputs outputs;
    put(outputs.add_folder(temporary / "p").path() / "height_0.png", "new");
    outputs.set_files({"height_0.png"}, {"color_0.png", "pack.json"});
    outputs.add_text(temporary / "report.html", "new report");
    block();
    CHECK_THROWS_WITH(outputs.commit(), Contains("height_0.png") && Contains("in the way"));
  }
  SECTION("the second of two files") {
    write_all(temporary.path, "old");
    StagedOutputs outputs;
    outputs.add_text(temporary / "report.html", "new report");
    outputs.add_text(temporary / "p.d", "new depfile");
    fs::remove(temporary / "p.d");
    fs::create_directory(temporary / "p.d");
    put(temporary / "p.d" / "in the way", "");
    CHECK_THROWS_WITH(outputs.commit(), Contains("p.d") && Contains("has become a folder"));
    fs::remove_all(temporary / "p.d");
    put(temporary / "p.d", "old depfile");
  }
  SECTION("the last word") {
    write_all(temporary.path, "old");
    StagedOutputs outputs;
    outputs.add_text(temporary / "report.html", "new report");
    CHECK_THROWS_AS(outputs.commit([](std::string_view, double) { throw 1; }), int);
  }
  Contents found = contents(temporary.path);
  for (auto entry = found.begin(); entry != found.end();)
    entry = entry->first.ends_with(".part") || entry->first == "p/height_0.png" ||
                    entry->first.find("tilepack-staging") != std::string::npos
                ? found.erase(entry)
                : std::next(entry);
  CHECK(found == all_of("old"));
}

TEST_CASE("whatever reads the pack puts outputs right that a killed writer left half done", "[pack]") {
  if (!test::tracing_is_allowed())
    return test::skipped("killing a writer at each system call; ptrace is forbidden");
  const ScratchFolder temporary;
  const ScratchFolder made; // packs to copy: threads don't outlive a fork
  for (const std::uint64_t seed : {1, 2})
    write_pack(test::noise_pack(MappingKind::mix, Depth::u16, seed), made / std::to_string(seed));
  const auto files = [&](const std::string& text) {
    std::vector<std::string> names = read_pack_description(made / text).all_files();
    names.emplace_back("pack.json");
    return names;
  };
  const auto names = std::map<std::string, std::vector<std::string>>{{"1", files("1")}, {"2", files("2")}};
  const auto write = [&](const std::string& text, const std::function<void()>& before_commit) {
    StagedOutputs outputs;
    const fs::path staging = outputs.add_folder(temporary / "p").path();
    for (const std::string& name : names.at(text)) fs::copy_file(made.path / text / name, staging / name);
    outputs.set_files(names.at(text), names.at("1"));
    outputs.add_text(temporary / "report.html", text);
    before_commit();
    outputs.commit();
  };
  const auto noop = [] {};
  for (const bool one_by_one : {false, true}) {
    std::set<std::string> reports;
    bool killed = true;
    for (int n = 1; killed; n += 2) {
      fs::remove_all(temporary.path);
      fs::create_directories(temporary.path);
      write("1", noop);
      if (one_by_one) fs::create_directory(temporary / "p" / "drafts");
      killed = test::killed_at(n, [&] { write("2", [] { ::raise(SIGSTOP); }); });
      CAPTURE(n, one_by_one);
      const Pack found = read_pack(temporary / "p");
      std::ifstream stream(temporary / "report.html");
      const std::string report{std::istreambuf_iterator<char>(stream), {}};
      REQUIRE(report == std::to_string(found.generator.seed));
      REQUIRE(found.maps[0].levels ==
              test::noise_pack(MappingKind::mix, Depth::u16, found.generator.seed).maps[0].levels);
      reports.insert(report);
    }
    CHECK(reports == std::set<std::string>{"1", "2"});
  }
}

TEST_CASE("a journal in a pack from elsewhere leads to nobody's files", "[pack]") {
  const ScratchFolder temporary;
  write_pack(test::noise_pack(), temporary / "p");
  put(temporary / "precious.txt", "mine");
  put(temporary / "other.txt", "mine too");
  const FileId id = *file_id(temporary / "precious.txt");
  fs::create_directory(temporary / "p" / ".tilepack-staging");
  const std::string target = (temporary / "precious.txt").string(), part = (temporary / "other.txt").string();
  std::string journal;
  for (const std::string& entry :
       {"s" + target, part, std::to_string(id.device) + ":" + std::to_string(id.number),
        std::string("replaces"), std::string("n../precious.txt"), std::string("o/etc/x")})
    journal += entry + '\0';
  put(temporary / "p" / ".tilepack-staging" / "moves", journal);
  read_pack(temporary / "p");
  CHECK(contents(temporary.path).at("precious.txt") == "mine");
  CHECK(contents(temporary.path).at("other.txt") == "mine too");
  CHECK_FALSE(fs::exists(temporary / "p" / ".tilepack-staging" / "moves"));
}

TEST_CASE("temporary files of killed writers go with the next that writes the same file", "[pack]") {
  const ScratchFolder temporary;
  const fs::path file = temporary / "x.png", name = temporary / (std::string(250, 'n') + ".png");
  for (const char* left : {".x.png.0.part", ".x.png.3.part"}) put(temporary / left, "left over");
  put(temporary / ".y.png.0.part", "of another file");
  {
    const StagedFile mine(file);
    const StagedFile also_mine(file); // not taken for dead
    CHECK(contents(temporary.path).size() == 3);
  }
  CHECK(contents(temporary.path).size() == 1);
  StagedFile long_name(name); // as long as names get
  long_name.write("whole");
  long_name.commit();
  CHECK(contents(temporary.path).at(name.filename().string()) == "whole");
}
