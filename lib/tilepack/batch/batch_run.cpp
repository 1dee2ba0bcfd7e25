#include "tilepack/batch/batch_run.h"

#include "tilepack/bake/preset.h"
#include "tilepack/bake/stage_clock.h"
#include "tilepack/bake/text_file.h"
#include "tilepack/batch/job_queue.h"
#include "tilepack/batch/output_cache.h"
#include "tilepack/batch/written_files.h"
#include "tilepack/error/error.h"
#include "tilepack/image/file_swap.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <new>
#include <set>
#include <sys/resource.h>
#include <thread>

namespace tilepack {
namespace {

namespace fs = std::filesystem;

// What a batch asks for an entry by: if it is the same and no file that was looked at changed, so is the key.
ContentHash request_of(const BatchEntry& entry) {
  ContentHasher hasher;
  hasher.add_field(TILEPACK_VERSION);
  hasher.add_field(entry.verb->name);
  hasher.add_field(entry.preset);
  hasher.add_field(entry.output);
  hasher.add_number(entry.sources.size());
  for (const std::string& source : entry.sources) hasher.add_field(source);
  for (const MaterialFile& map : entry.maps) {
    hasher.add_field(map.name);
    hasher.add_number(static_cast<std::uint64_t>(map.role));
    hasher.add_field(map.file);
  }
  for (const BatchOption& option : entry.options) {
    if (is_beside_the_output(option.name)) continue;
    hasher.add_field(option.name);
    for (const std::string& value : option.values) hasher.add_field(value);
  }
  return hasher.value();
}

// The same for all of a manifest.
ContentHash request_of(const std::string& file, const std::string& text) {
  ContentHasher hasher;
  hasher.add_field(TILEPACK_VERSION);
  hasher.add_field(file);
  hasher.add_field(text);
  return hasher.value();
}

std::int64_t peak_of_process() {
  rusage usage{};
  return ::getrusage(RUSAGE_SELF, &usage) == 0 ? std::int64_t{usage.ru_maxrss} * 1024 : 0;
}

// Of verbs that have no estimate of their own: what their files are when they are unpacked, twice.
std::int64_t guessed_memory(const std::vector<EntryInput>& inputs) {
  constexpr std::int64_t program = 32 << 20;
  constexpr std::int64_t unpacked = 16;
  std::int64_t bytes = program;
  std::error_code fault;
  for (const EntryInput& input : inputs)
    if (const auto size = fs::file_size(input.file, fault); !fault)
      bytes += unpacked * static_cast<std::int64_t>(size);
  return bytes;
}

std::string as_text(std::int64_t bytes) {
  return fmt::format("{} MB", (bytes + (1 << 20) - 1) >> 20);
}

// All that `chosen` are made from, and they themselves.
std::vector<std::size_t> with_sources(const Manifest& manifest, const std::vector<std::size_t>& chosen) {
  std::set<std::size_t> all;
  std::vector<std::size_t> left = chosen;
  while (!left.empty()) {
    const std::size_t entry = left.back();
    left.pop_back();
    if (!all.insert(entry).second) continue;
    const auto& after = manifest.entries[entry].after;
    left.insert(left.end(), after.begin(), after.end());
  }
  return {all.begin(), all.end()};
}

class BatchRun {
public:
  BatchRun(const Manifest& of, const std::vector<std::size_t>& chosen, const BatchSettings& given)
      : manifest(of), settings(given), entries(with_sources(of, chosen)), index(index_file_of(of.file)),
        cache(given.cache), results(entries.size()) {
    for (std::size_t i = 0; i < entries.size(); ++i) {
      results[i].entry = entries[i];
      number[entries[i]] = i;
    }
    find_current();
    std::vector<std::size_t> made;
    for (std::size_t i = 0; i < entries.size(); ++i)
      if (!current[i]) made.push_back(entries[i]);
    check_written_files(manifest, made);
  }

  std::vector<EntryResult> run(const BatchWatch& told) {
    watch = &told;
    std::vector<std::size_t> queued; // places in `entries`
    std::map<std::size_t, std::size_t> place_in_queue;
    for (std::size_t i = 0; i < entries.size(); ++i)
      if (!current[i]) {
        place_in_queue[i] = queued.size();
        queued.push_back(i);
      }
    std::vector<QueuedJob> jobs;
    for (const std::size_t i : queued) {
      QueuedJob job;
      for (const std::size_t other : entry_at(i).after)
        if (!current[number[other]]) job.after.push_back(place_in_queue[number[other]]);
      job.memory = [this, i] { return memory_of(i); };
      job.run = [this, i](int) { make_current(i); };
      jobs.push_back(std::move(job));
    }
    for (std::size_t i = 0; i < entries.size(); ++i)
      if (current[i]) tell(i);
    run_all(
        jobs, {settings.jobs, settings.memory},
        [&](std::size_t job, const std::exception_ptr& fault) { fail(queued[job], fault); },
        [&](std::size_t job) {
          results[queued[job]].end = EntryEnd::skipped;
          tell(queued[job]);
        });
    finish();
    return std::move(results);
  }

  std::vector<EntryResult> plan() {
    for (const std::size_t i : in_order()) {
      if (current[i]) continue;
      EntryResult& result = results[i];
      result.end = EntryEnd::built;
      for (const std::size_t other : entry_at(i).after)
        if (const EntryResult& source = results[number[other]]; source.end != EntryEnd::current)
          result.reasons.push_back(
              fmt::format("{} {}", manifest.entries[other].name,
                          source.end == EntryEnd::failed ? "can't be made" : "is made again"));
      if (!result.reasons.empty()) continue;
      try {
        const EntryState state = state_of(manifest, entry_at(i));
        result.reasons = state.reasons;
        if (settings.all) result.reasons.emplace_back("asked for");
        if (result.reasons.empty()) {
          result.end = EntryEnd::current;
          remember(i, state);
        }
      } catch (const Error& error) {
        result.end = EntryEnd::failed;
        result.message =
            error.where().empty() ? error.what_happened() : error.where() + ": " + error.what_happened();
        result.kind = error.kind();
      }
    }
    store_index();
    return std::move(results);
  }

private:
  const BatchEntry& entry_at(std::size_t i) const { return manifest.entries[entries[i]]; }

  // Sources before what is made from them.
  std::vector<std::size_t> in_order() const {
    std::vector<std::size_t> order;
    std::vector<bool> there(entries.size());
    const std::function<void(std::size_t)> add = [&](std::size_t i) {
      if (there[i]) return;
      there[i] = true;
      for (const std::size_t other : entry_at(i).after) add(number.at(other));
      order.push_back(i);
    };
    for (std::size_t i = 0; i < entries.size(); ++i) add(i);
    return order;
  }

  void find_current() {
    std::vector<char> holds(entries.size());
    // Two threads are what a disk's cache in memory serves; a pool that has to be woken takes longer than this.
    const auto look = [&](std::size_t first) {
      for (std::size_t i = first; i < entries.size(); i += 2)
        holds[i] = index.holds(entry_at(i).output, request_of(entry_at(i))) ? 1 : 0;
    };
    if (!settings.all) {
      const std::jthread odd([&] { look(1); });
      look(0);
    }
    current.assign(entries.size(), false);
    for (const std::size_t i : in_order()) {
      const auto& after = entry_at(i).after;
      current[i] = holds[i] != 0 && std::all_of(after.begin(), after.end(),
                                                [&](std::size_t other) { return current[number[other]]; });
    }
  }

  std::int64_t memory_of(std::size_t i) const {
    const BatchEntry& entry = entry_at(i);
    const std::int64_t bytes = entry.verb->name == "bake" ? peak_memory(bake_job_of(manifest, entry))
                                                          : guessed_memory(inputs_of(manifest, entry));
    if (bytes > settings.memory)
      throw Error(
          ErrorKind::usage, place_in(manifest, entry.at),
          fmt::format(
              "needs about {}, more than the {} of memory given to the batch; give more, or ask for less",
              as_text(bytes), as_text(settings.memory)));
    return bytes;
  }

  void progress(std::size_t i, std::string_view stage, double done) const {
    if (watch->progress) watch->progress(entries[i], stage, done);
  }

  void make_current(std::size_t i) {
    Stopwatch watch_of_entry;
    EntryResult& result = results[i];
    const BatchEntry& entry = entry_at(i);
    progress(i, "looking", 0);
    const OutputLock lock(entry.output, settings.when_busy,
                          [&](const std::string& who) { progress(i, "waiting for " + who, 0); });
    remove_left_overs(entry);
    EntryState state = state_of(manifest, entry);
    if (settings.all && !lock.has_waited()) state.reasons.emplace_back("asked for");
    result.reasons = state.reasons;
    if (state.reasons.empty()) {
      remember(i, state);
    } else {
      if (watch->started) watch->started(entries[i], state.reasons);
      const ContentHash key = key_of(state.inputs);
      clear_broken_pack(entry);
      if (restored(i, key, state)) {
        result.end = EntryEnd::restored;
      } else {
        result.story = watch->make(manifest, entry,
                                   [&](std::string_view stage, double done) { progress(i, stage, done); });
        const bool stayed = inputs_stayed(state);
        const auto files = made_files(entry);
        write_record(entry, {state.inputs, files});
        result.end = EntryEnd::built;
        if (stayed) keep(i, key, files);
      }
    }
    result.seconds = watch_of_entry.lap();
    tell(i);
  }

  // A record of inputs that changed while they were read would call an output current that is not.
  static bool inputs_stayed(EntryState& state) {
    bool stayed = true;
    for (std::size_t f = 0; f < state.input_files.size(); ++f)
      if (hash_if_there(state.input_files[f].file) != state.inputs.files[f].hash) {
        state.inputs.files[f].hash = {};
        stayed = false;
      }
    return stayed;
  }

  bool restored(std::size_t i, const ContentHash& key, const EntryState& state) {
    if (settings.cache.empty() || settings.all) return false;
    return cache.restore(key, entry_at(i), state.inputs);
  }

  void keep(std::size_t i, const ContentHash& key, const std::vector<HashedFile>& files) {
    if (settings.cache.empty()) return;
    try {
      cache.keep(key, entry_at(i), files);
    } catch (const Error& error) { // the output is there all the same
      if (watch->warned) watch->warned(entries[i], fmt::format("not kept in the cache: {}", error.what()));
    }
  }

  void remember(std::size_t i, const EntryState& state) {
    const BatchEntry& entry = entry_at(i);
    std::vector<std::string> files = looked_at(entry, state.input_files);
    files.push_back(side_file_of(entry.output, entry.verb->output == BatchOutput::pack));
    for (const HashedFile& made : state.record->outputs)
      files.push_back((fs::path(folder_of_output(entry)) / made.name).string());
    index.note(entry.output, request_of(entry), files);
  }

  void fail(std::size_t i, const std::exception_ptr& fault) {
    EntryResult& result = results[i];
    result.end = EntryEnd::failed;
    try {
      std::rethrow_exception(fault);
    } catch (const Error& error) {
      result.message =
          error.where().empty() ? error.what_happened() : error.where() + ": " + error.what_happened();
      result.kind = error.kind();
    } catch (const std::bad_alloc&) {
      result.message = "out of memory; fewer entries at a time need less";
    } catch (const std::exception& error) {
      result.message = std::string("internal fault: ") + error.what();
    } // a watch that ends the batch is thrown on
    tell(i);
  }

  void tell(std::size_t i) {
    if (results[i].end != EntryEnd::current || !current[i]) results[i].peak_memory = peak_of_process();
    if (watch->ended) watch->ended(results[i]);
  }

  void store_index() {
    std::vector<std::string> outputs;
    for (const BatchEntry& entry : manifest.entries) outputs.push_back(entry.output);
    const bool all = std::all_of(results.begin(), results.end(),
                                 [](const EntryResult& result) { return result.end == EntryEnd::current; });
    // A folder that the index is written to is never as it was.
    const auto place = file_id(fs::absolute(manifest.file).parent_path());
    const bool is_here = std::any_of(manifest.folders.begin(), manifest.folders.end(),
                                     [&](const std::string& folder) { return file_id(folder) == place; });
    if (all && results.size() == outputs.size() && !is_here) {
      index.note_all(request_of(manifest.file, manifest.text), outputs, manifest.folders);
      outputs.emplace_back();
    }
    index.store(outputs);
  }

  void finish() {
    store_index();
    const bool wrote = std::any_of(results.begin(), results.end(),
                                   [](const EntryResult& result) { return result.end == EntryEnd::built; });
    if (!settings.cache.empty() && (wrote || settings.cache_size > 0))
      cache.shrink_to(settings.cache_size > 0 ? settings.cache_size : INT64_MAX);
  }

  const Manifest& manifest;
  const BatchSettings& settings;
  std::vector<std::size_t> entries; // that are looked at, in the order of the manifest
  std::map<std::size_t, std::size_t> number;
  CurrentIndex index;
  OutputCache cache;
  std::vector<EntryResult> results;
  std::vector<bool> current;
  const BatchWatch* watch = nullptr;
};

} // namespace

std::optional<std::size_t> entries_if_all_current(const std::string& manifest) {
  const std::string text = read_text_file(manifest, "the manifest");
  return CurrentIndex(index_file_of(manifest)).all_hold(request_of(manifest, text));
}

std::vector<EntryResult> run_batch(const Manifest& manifest, const std::vector<std::size_t>& chosen,
                                   const BatchSettings& settings, const BatchWatch& watch) {
  return BatchRun(manifest, chosen, settings).run(watch);
}

std::vector<EntryResult> planned_batch(const Manifest& manifest, const std::vector<std::size_t>& chosen,
                                       const BatchSettings& settings) {
  return BatchRun(manifest, chosen, settings).plan();
}

std::vector<std::string> files_read(const Manifest& manifest, const std::vector<std::size_t>& chosen) {
  std::set<std::string> files(manifest.folders.begin(), manifest.folders.end());
  files.insert(manifest.file);
  for (const std::size_t i : with_sources(manifest, chosen)) {
    try {
      for (const std::string& file : looked_at(manifest.entries[i], inputs_of(manifest, manifest.entries[i])))
        files.insert(file);
    } catch (const Error&) { // it fails when it is made, and says why
    }
  }
  return {files.begin(), files.end()};
}

} // namespace tilepack
