#include "support/scratch_folder.h"

#include "tilepack/bake/text_file.h"
#include "tilepack/batch/build_record.h"
#include "tilepack/batch/cache_head.h"
#include "tilepack/batch/content_hash.h"
#include "tilepack/batch/current_index.h"
#include "tilepack/batch/job_queue.h"
#include "tilepack/batch/output_lock.h"
#include "tilepack/error/error.h"

#include <fmt/format.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <mutex>
#include <set>
#include <thread>

using namespace tilepack;

namespace {

BuildInputs inputs_with(const std::string& options, std::vector<HashedFile> files) {
  return {options, std::move(files)};
}

} // namespace

TEST_CASE("hashes are those of xxHash, however the bytes were cut") {
  CHECK(hex(hash_of("")) == "99aa06d3014798d86001c324468d497f"); // the reference's own value for nothing
  ContentHasher pieces;
  pieces.add("a ");
  pieces.add("");
  pieces.add("text");
  CHECK(pieces.value() == hash_of("a text"));
  CHECK(parsed_hash(hex(hash_of("x"))) == hash_of("x"));
  for (const char* bad : {"", "99aa06d3014798d86001c324468d497", "99AA06D3014798D86001C324468D497F",
                          "-9aa06d3014798d86001c324468d497f"})
    CHECK_FALSE(parsed_hash(bad));
  ContentHasher a, b;
  a.add_field("ab");
  a.add_field("c");
  b.add_field("a");
  b.add_field("bc");
  CHECK(a.value() != b.value());
}

TEST_CASE("a record is read as it was written, and says what differs in words") {
  const BuildRecord record{
      inputs_with("seed=0\nversion=0.1.0\n", {{"sample", hash_of("s")}, {"map normal", hash_of("n")}}),
      {{"pack.json", hash_of("p")}}};
  const std::string text = record_text(record);
  CHECK(parsed_record(text) == record);
  for (std::size_t i = 0; i < text.size(); i += 7) { // damage is noticed, or is none
    std::string damaged = text;
    damaged[i] = static_cast<char>(damaged[i] ^ 4);
    const auto read = parsed_record(damaged);
    if (read) CHECK(read->inputs == record.inputs);
  }
  CHECK(differences(record, record.inputs).empty());
  CHECK(differences(std::nullopt, record.inputs) == std::vector<std::string>{"not built yet"});
  const auto now = inputs_with("colors=3\nseed=3\nversion=0.2.0\n",
                               {{"sample", hash_of("t")}, {"map height", hash_of("h")}});
  CHECK(differences(record, now) == std::vector<std::string>{"option colors: unset → 3", "option seed: 0 → 3",
                                                             "tilepack 0.1.0 → 0.2.0", "sample changed",
                                                             "map height added", "map normal removed"});
}

TEST_CASE("an index holds while files are as they were") {
  const ScratchFolder scratch;
  const std::string file = (scratch / "a").string(), index_file = (scratch / "index").string();
  write_text_file(file, "one");
  {
    CurrentIndex index(index_file);
    index.note("out", hash_of("r"), {file});
    CHECK_FALSE(index.holds("out", hash_of("r"))); // too young to tell a change by
  }
  std::this_thread::sleep_for(std::chrono::milliseconds(150));
  {
    CurrentIndex index(index_file);
    index.note("out", hash_of("r"), {file});
    index.note("gone", hash_of("r"), {file});
    CHECK(index.holds("out", hash_of("r")));
    CHECK_FALSE(index.holds("out", hash_of("other")));
    index.store({"out"});
  }
  const CurrentIndex index(index_file);
  CHECK(index.holds("out", hash_of("r")));
  CHECK_FALSE(index.holds("gone", hash_of("r")));
  write_text_file(file, "two");
  CHECK_FALSE(index.holds("out", hash_of("r")));
}

TEST_CASE("an index holds as a whole while all of it does") {
  const ScratchFolder scratch;
  const std::string folder = (scratch / "samples").string(), index_file = (scratch / "index").string();
  const std::string a = folder + "/a", b = folder + "/b";
  write_text_file(a, "one");
  write_text_file(b, "two");
  std::this_thread::sleep_for(std::chrono::milliseconds(150));
  const ContentHash request = hash_of("m");
  const auto noted = [&](const std::vector<std::string>& outputs, const std::vector<std::string>& kept) {
    std::filesystem::remove(index_file);
    CurrentIndex index(index_file);
    index.note("x", hash_of("r"), {a});
    index.note("y", hash_of("r"), {b});
    index.note_all(request, outputs, {folder});
    index.store(kept);
    return CurrentIndex(index_file).all_hold(request);
  };
  CHECK(noted({"x", "y"}, {"x", "y", ""}) == 2u);
  CHECK_FALSE(noted({"x", "y"}, {"x", ""}));           // a note is lost
  CHECK_FALSE(noted({"x", "y"}, {"x", "y"}));          // not kept, for something is not current
  CHECK_FALSE(noted({"x", "y", "z"}, {"x", "y", ""})); // an output that was never noted
  CHECK(noted({"x", "y"}, {"x", "y", ""}) == 2u);
  CHECK_FALSE(CurrentIndex(index_file).all_hold(hash_of("another manifest")));
  SECTION("a file changes") {
    write_text_file(b, "two");
    CHECK_FALSE(CurrentIndex(index_file).all_hold(request));
  }
  SECTION("a file more lies in the folder") {
    write_text_file(folder + "/c", "three");
    CHECK_FALSE(CurrentIndex(index_file).all_hold(request));
  }
}

TEST_CASE("heads of the cache are read as they were written and damage is noticed") {
  const std::vector<CachedOutput::File> files{{"color_0.png", 12, hash_of("x")},
                                              {"pack.json", 3, hash_of("y")}};
  const std::string text = cache_head_text(files);
  const auto head = parsed_cache_head(text + "data");
  REQUIRE(head);
  CHECK(head->head_size == text.size());
  REQUIRE(head->files.size() == 2);
  CHECK(head->files[1].name == "pack.json");
  CHECK(head->files[1].size == 3);
  for (std::size_t i = 0; i < text.size(); ++i) {
    std::string damaged = text;
    damaged[i] = static_cast<char>(damaged[i] ^ 1);
    CHECK_FALSE(parsed_cache_head(damaged));
    CHECK_FALSE(parsed_cache_head(text.substr(0, i)));
  }
  CHECK_FALSE(parsed_cache_head(cache_head_text({{"../pack.json", 3, hash_of("y")}})));
  CHECK_FALSE(parsed_cache_head(cache_head_text({})));
  // A number has one spelling: a list with its own hash, but a leading zero in what says its size or that of its file.
  const auto head_of = [](const char* zero_of_list, const char* zero_of_file) {
    const std::string list = fmt::format("1\npack.json\n{}3\n{}\n", zero_of_file, hex(hash_of("y")));
    return fmt::format("tilepack-cache-1\n{}\n{}{}\n{}", hex(hash_of(list)), zero_of_list, list.size(), list);
  };
  CHECK(parsed_cache_head(head_of("", "")));
  CHECK_FALSE(parsed_cache_head(head_of("0", "")));
  CHECK_FALSE(parsed_cache_head(head_of("", "0")));
}

TEST_CASE("jobs share threads and memory, and a failure keeps only what hangs on it") {
  std::mutex mutex;
  std::int64_t used = 0, most = 0;
  std::atomic<int> ran = 0;
  std::vector<QueuedJob> jobs(12);
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const std::int64_t bytes = i % 3 == 0 ? 70 : 30;
    jobs[i].memory = [bytes] { return bytes; };
    jobs[i].run = [&, bytes, i](int threads) {
      CHECK(threads >= 1);
      {
        const std::scoped_lock lock(mutex);
        most = std::max(most, used += bytes);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
      const std::scoped_lock lock(mutex);
      used -= bytes;
      ++ran;
      if (i == 4) throw Error(ErrorKind::cannot_read, "", "gone");
    };
  }
  jobs[0].after = {11};
  jobs[5].after = {4};
  jobs[6].after = {5};
  std::set<std::size_t> failed, skipped;
  const auto ends = run_all(
      jobs, {8, 100},
      [&](std::size_t job, const std::exception_ptr&) {
        const std::scoped_lock lock(mutex);
        failed.insert(job);
      },
      [&](std::size_t job) {
        const std::scoped_lock lock(mutex);
        skipped.insert(job);
      });
  CHECK(most <= 100);
  CHECK(most > 70);
  CHECK(ran == 10);
  CHECK(failed == std::set<std::size_t>{4});
  CHECK(skipped == std::set<std::size_t>{5, 6});
  CHECK(ends[6] == JobEnd::skipped);
  CHECK(ends[0] == JobEnd::done);
  CHECK_THROWS_AS(
      run_all(
          jobs, {1, 0}, [](std::size_t, const std::exception_ptr&) { throw 7; }, [](std::size_t) {}),
      int);
  CHECK(run_all({}, {}, {}, {}).empty());
}

TEST_CASE("a lock on an output is had by one at a time") {
  const ScratchFolder scratch;
  const std::string output = (scratch / "pack").string();
  bool has_waited = false;
  std::thread other;
  {
    const OutputLock lock(output, WhenBusy::refuse);
    CHECK_FALSE(lock.has_waited());
    CHECK_THROWS_AS(OutputLock(output + "/", WhenBusy::refuse), Error);
    CHECK_THROWS_AS(OutputLock(output, WhenBusy::wait, [](const std::string&) { throw 7; }), int);
    const OutputLock another((scratch / "other").string(), WhenBusy::refuse);
    other = std::thread([&] { has_waited = OutputLock(output, WhenBusy::wait).has_waited(); });
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
  }
  other.join();
  CHECK(has_waited);
}
