#include "support/file_contents.h"
#include "support/killed_process.h"
#include "support/scratch_folder.h"
#include "support/skipped.h"

#include "tilepack/error/error.h"
#include "tilepack/pack/staged_folder.h"

#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <unistd.h>

using namespace tilepack;
using Catch::Matchers::Contains;
namespace fs = std::filesystem;

namespace {

using test::contents;
using test::put;

using Contents = std::map<std::string, std::string>;

const std::vector<std::string> old_files = {"color_0.png", "color_1.png", "pack.json"};
const std::vector<std::string> new_files = {"color_0.png", "height_0.png", "pack.json"};

void write_new(
    const fs::path& folder, const std::function<void()>& before_commit = [] {}) {
  StagedFolder staged(folder);
  for (const std::string& name : new_files) put(staged.path() / name, "new " + name);
  before_commit();
  std::vector<std::string> replaceable = old_files;
  replaceable.insert(replaceable.begin(), "height_0.png"); // if the new files are there already
  staged.commit(new_files, replaceable);
}

enum class Target { beside_a_file, missing, beside_a_folder, current };

/// Kills a writer at every step of its commit and clean-up. `at_once`: the folder holds the old or the new
/// files straight away; otherwise once the next writer came along.
void kill_everywhere(Target target, bool at_once) {
  const ScratchFolder temporary;
  const fs::path folder = temporary / "p";
  Contents before, after;
  for (const std::string& name : new_files) after[name] = "new " + name;
  if (target != Target::missing) {
    for (const std::string& name : old_files) before[name] = "old " + name;
    before["notes.txt"] = after["notes.txt"] = "mine";
    if (target == Target::beside_a_folder) {
      before["drafts"] = after["drafts"] = "folder";
      before["drafts/one.txt"] = after["drafts/one.txt"] = "mine too";
    }
  }
  const auto work = [&] {
    if (target == Target::current) fs::current_path(folder);
    write_new(target == Target::current ? "." : folder, [] { ::raise(SIGSTOP); });
  };
  int kept = 0, replaced = 0;
  bool killed = true;
  for (int n = 1; killed; n += 2) { // on entering; leaving one and entering the next is the same

    fs::remove_all(temporary.path);
    if (!before.empty()) fs::create_directories(folder / "drafts");
    if (target != Target::beside_a_folder) fs::remove(folder / "drafts");
    fs::create_directories(temporary.path);
    for (const auto& [name, text] : before)
      if (text != "folder") put(folder / name, text);
    killed = test::killed_at(n, work);
    CAPTURE(n);
    if (!at_once) {
      const StagedFolder next(folder);
    }
    const Contents found = contents(folder);
    (found == before ? kept : replaced) += 1;
    if (found != before) REQUIRE(found == after);
    write_new(folder);
    REQUIRE(contents(folder) == after);
    for (const auto& entry : fs::directory_iterator(temporary.path)) REQUIRE(entry.path() == folder);
  }
  CHECK(kept > 1);
  CHECK(replaced > 3);
}

} // namespace

TEST_CASE("killed at any system call, a writer leaves the old files or the new ones", "[pack]") {
  if (!test::tracing_is_allowed())
    return test::skipped("killing a writer at each system call; ptrace is forbidden");
  SECTION("in a folder with somebody else's file") {
    kill_everywhere(Target::beside_a_file, true);
  }
  SECTION("in a new folder") {
    kill_everywhere(Target::missing, true);
  }
  // Here it takes the next writer to put things back.
  SECTION("in a folder with a folder in it") {
    kill_everywhere(Target::beside_a_folder, false);
  }
  SECTION("in the current folder") {
    kill_everywhere(Target::current, false);
  }
}

TEST_CASE("the folder that takes a folder's place has its permissions, and links lead to it", "[pack]") {
  const ScratchFolder temporary;
  fs::create_directories(temporary / "real" / "p");
  fs::create_directory_symlink("real/p", temporary / "link");
  fs::permissions(temporary / "real" / "p", fs::perms::owner_all | fs::perms::group_read);
  write_new(temporary / "link");
  CHECK(fs::is_symlink(temporary / "link"));
  CHECK(fs::status(temporary / "real" / "p").permissions() == (fs::perms::owner_all | fs::perms::group_read));
  CHECK(contents(temporary / "link").size() == 3);
  write_new((temporary / "link").string() + "/");
  CHECK(contents(temporary.path).size() == 2 + 3); // real, p and its files; link counts as p
}

TEST_CASE("one writer at a time", "[pack]") {
  const ScratchFolder temporary;
  const fs::path folder = temporary / "p";
  for (const bool exists : {false, true}) {
    if (exists) fs::create_directory(folder);
    StagedFolder first(folder);
    CHECK_THROWS_WITH(StagedFolder(folder), Contains("another process is writing") && Contains("/p: "));
    put(first.path() / "pack.json", "mine");
    first.commit({"pack.json"}, {});
    CHECK(contents(folder).at("pack.json") == "mine");
    fs::remove_all(folder);
  }
  CHECK(contents(temporary.path).empty());
}
