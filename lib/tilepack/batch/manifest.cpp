#include "tilepack/batch/manifest.h"

#include "tilepack/bake/text_file.h"
#include "tilepack/batch/manifest_entry.h"
#include "tilepack/batch/path_pattern.h"
#include "tilepack/error/nearest_name.h"
#include "tilepack/json/json_cursor.h"
#include "tilepack/json/json_line.h"
#include "tilepack/numeric/enum_names.h"
#include "tilepack/scene/scene_file_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

namespace tilepack {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_jobs = 1'000'000;

// Adds the line to errors of JsonCursor: "FILE: PLACE" becomes "FILE:LINE: PLACE".
Error with_line(const Error& error, const std::string& text, const std::string& file) {
  const std::string prefix = file + ": ";
  if (!error.where().starts_with(prefix)) return error;
  const std::string place = error.where().substr(prefix.size());
  return Error(error.kind(), fmt::format("{}:{}: {}", file, json_line(text, place), place),
               error.what_happened());
}

class ManifestReader {
public:
  ManifestReader(std::string text, const std::string& file) {
    manifest.file = file;
    manifest.text = std::move(text);
    manifest.lines = std::make_shared<JsonLines>(manifest.text);
    folder = fs::path(file).parent_path().string();
  }

  Manifest read() {
    const JsonCursor root = JsonCursor::parse(manifest.text, manifest.file);
    root.only({"format", "version", "defaults", "jobs"});
    root.member("format").one_of({"tilepack-manifest"});
    root.member("version").integer(1, 1);
    if (const auto given = root.find("defaults")) defaults = entry_defaults(*given);
    const JsonCursor jobs = root.member("jobs");
    const std::size_t count = jobs.array(0, most_jobs);
    std::vector<std::vector<BatchEntry>> made(count);
    std::vector<std::size_t> later; // patterns of packs match what the others make
    for (std::size_t j = 0; j < count; ++j) {
      const EntryText entry = entry_text(jobs.item(j), fmt::format("jobs[{}]", j), defaults);
      if (!entry.pattern.empty() && entry.is_pack_pattern)
        later.push_back(j);
      else
        made[j] = expanded(entry, entry.pattern.empty() ? std::vector<std::string>{} : on_disk(entry));
      for (const BatchEntry& one : made[j])
        if (one.verb->output == BatchOutput::pack) packs.push_back(one.output);
    }
    for (const std::size_t j : later) {
      const EntryText entry = entry_text(jobs.item(j), fmt::format("jobs[{}]", j), defaults);
      std::vector<std::string> paths = made_here(entry);
      made[j] = expanded(entry, paths.empty() ? on_disk(entry) : paths);
    }
    for (std::vector<BatchEntry>& some : made)
      for (BatchEntry& one : some) manifest.entries.push_back(std::move(one));
    check_names();
    find_order();
    return std::move(manifest);
  }

private:
  std::string resolved(const std::string& path) const {
    // Most have nothing to be normalized, which takes the longest of all.
    const bool is_plain = path.front() != '/' && path.front() != '.' && path.find("/.") == path.npos &&
                          path.find("//") == path.npos && folder.find('.') == folder.npos &&
                          folder.find("//") == folder.npos;
    if (is_plain) return folder.empty() ? path : fmt::format("{}/{}", folder, path);
    return (fs::path(folder) / path).lexically_normal().string();
  }

  [[noreturn]] void fail(const std::string& at, const std::string& what,
                         ErrorKind kind = ErrorKind::invalid_content) const {
    throw Error(kind, fmt::format("{}: {}", manifest.file, at), what);
  }

  std::vector<std::string> on_disk(const EntryText& entry) {
    PatternMatches found;
    for (const std::string& pattern : entry.pattern) {
      const PatternMatches some = paths_matching(resolved(pattern));
      found.paths.insert(found.paths.end(), some.paths.begin(), some.paths.end());
      manifest.folders.insert(manifest.folders.end(), some.folders.begin(), some.folders.end());
      if (some.paths.empty())
        fail(entry.pattern_at,
             fmt::format("'{}' matches nothing; check the path, which is meant from the folder of "
                         "the manifest",
                         pattern),
             ErrorKind::cannot_read);
    }
    std::sort(found.paths.begin(), found.paths.end());
    found.paths.erase(std::unique(found.paths.begin(), found.paths.end()), found.paths.end());
    return found.paths;
  }

  std::vector<std::string> made_here(const EntryText& entry) const {
    std::vector<std::string> found;
    for (const std::string& path : packs)
      if (std::any_of(entry.pattern.begin(), entry.pattern.end(),
                      [&](const std::string& pattern) { return matches(resolved(pattern), path); }))
        found.push_back(path);
    return found;
  }

  std::vector<BatchEntry> expanded(const EntryText& entry, const std::vector<std::string>& paths) {
    std::vector<BatchEntry> entries;
    if (entry.pattern.empty()) {
      entries.push_back(filled(entry, entry.sources.empty() ? "" : resolved(entry.sources.front()), false));
      return entries;
    }
    for (const std::string& path : paths) entries.push_back(filled(entry, path, true));
    return entries;
  }

  // `first` is the path that {stem} and {folder} are taken from, and of a pattern the source itself.
  BatchEntry filled(const EntryText& text, const std::string& first, bool matched) {
    std::string stem, around; // the disk is looked at for those who ask
    const auto name_parts = [&] {
      if (!stem.empty()) return;
      const fs::path path = fs::path(first).has_filename() ? fs::path(first) : fs::path(first).parent_path();
      std::error_code fault;
      const bool is_folder = text.is_pack_pattern || fs::is_directory(path, fault);
      stem = is_folder && !path.filename().string().ends_with(".pack") ? path.filename().string()
                                                                       : path.stem().string();
      around = is_folder && text.verb->name == "bake" ? path.filename().string()
                                                      : path.parent_path().filename().string();
    };
    const auto fill = [&](const std::string& words, const std::string& at) {
      if (words.find('{') == words.npos) return words;
      std::string result;
      for (std::size_t i = 0; i < words.size();) {
        const std::size_t end = words[i] == '{' ? words.find('}', i) : std::string::npos;
        if (end == std::string::npos) {
          result += words[i++];
          continue;
        }
        const std::string word = words.substr(i + 1, end - i - 1);
        if (word != "stem" && word != "folder")
          fail(at, fmt::format("'{{{}}}' is not known; {{stem}} and {{folder}} are put in", word));
        name_parts();
        result += word == "stem" ? stem : around;
        i = end + 1;
      }
      return result;
    };
    BatchEntry entry;
    entry.verb = text.verb;
    entry.at = text.at;
    entry.is_transition = text.is_transition;
    const std::string output = fill(text.output, text.at + ".output");
    entry.output = resolved(output);
    while (entry.output.size() > 1 && entry.output.ends_with('/')) entry.output.pop_back();
    entry.name = text.name.empty() ? output : fill(text.name, text.at + ".name");
    if (matched)
      entry.sources = {first};
    else
      for (const std::string& source : text.sources) add_source(entry, text, source);
    for (const MaterialFile& map : text.maps)
      entry.maps.push_back({map.name, map.role, resolved(fill(map.file, text.at + ".maps"))});
    entry.preset = text.preset;
    // A preset is a built-in one by its name or a file by its path.
    if (fs::path(entry.preset).has_parent_path() || fs::path(entry.preset).has_extension())
      entry.preset = resolved(entry.preset);
    for (BatchOption option : text.options) {
      for (std::string& value : option.values) {
        value = fill(value, option.at);
        if (is_file_option(*entry.verb, option.name)) value = resolved(value);
      }
      entry.options.push_back(std::move(option));
    }
    return entry;
  }

  void add_source(BatchEntry& entry, const EntryText& text, const std::string& source) {
    if (!text.verb->sources.front().is_list || !is_pattern(source)) {
      entry.sources.push_back(resolved(source));
      return;
    }
    const PatternMatches found = paths_matching(resolved(source));
    manifest.folders.insert(manifest.folders.end(), found.folders.begin(), found.folders.end());
    if (found.paths.empty())
      fail(text.at + "." + std::string(text.verb->sources.front().key),
           fmt::format("'{}' matches nothing", source), ErrorKind::cannot_read);
    entry.sources.insert(entry.sources.end(), found.paths.begin(), found.paths.end());
  }

  void check_names() {
    std::map<std::string, const BatchEntry*> names;
    for (std::size_t i = 0; i < manifest.entries.size(); ++i) {
      const BatchEntry& entry = manifest.entries[i];
      if (const auto [other, is_new] = outputs.emplace(entry.output, i); !is_new)
        fail(entry.at + ".output", fmt::format("'{}' is what the entry on line {} makes too", entry.output,
                                               json_line(manifest.text, manifest.entries[other->second].at)));
      if (const auto [other, is_new] = names.emplace(entry.name, &entry); !is_new)
        fail(entry.at + ".name", fmt::format("'{}' is the name of the entry on line {} too", entry.name,
                                             json_line(manifest.text, other->second->at)));
    }
    for (const BatchEntry& entry : manifest.entries)
      if (const auto outer = made_around(fs::path(entry.output).parent_path().string()))
        if (manifest.entries[*outer].verb->output == BatchOutput::pack)
          fail(entry.at + ".output", fmt::format("'{}' lies in the pack '{}'; choose a path outside of it",
                                                 entry.output, manifest.entries[*outer].output));
  }

  // The entry that makes `path` or a folder around it.
  std::optional<std::size_t> made_around(const std::string& path) const {
    for (std::string_view at = path; !at.empty();) {
      if (const auto found = outputs.find(at); found != outputs.end()) return found->second;
      std::size_t end = at.rfind('/');
      if (end == at.npos || at == "/") break;
      while (end > 0 && at[end - 1] == '/') --end;
      at = at.substr(0, std::max<std::size_t>(end, 1));
    }
    return std::nullopt;
  }

  void find_order() {
    for (std::size_t i = 0; i < manifest.entries.size(); ++i) {
      BatchEntry& entry = manifest.entries[i];
      std::set<std::size_t> after;
      const auto reads = [&](const std::string& path) {
        if (const auto maker = made_around(path)) after.insert(*maker);
      };
      for (const std::string& source : entry.sources) reads(source);
      for (const MaterialFile& map : entry.maps) reads(map.file);
      if (shows_scene(entry))
        for (const SceneFileName& name : scene_file_names(entry.sources.front())) reads(name.path);
      for (const BatchOption& option : entry.options)
        if (is_read_option(*entry.verb, option.name))
          for (const std::string& value : option.values) reads(value);
      if (after.contains(i)) fail(entry.at, "reads what it writes; choose another output");
      entry.after.assign(after.begin(), after.end());
    }
    // Whoever is left when all whose sources are there have been taken away waits for himself.
    std::vector<std::size_t> waits(manifest.entries.size());
    std::vector<std::vector<std::size_t>> before(manifest.entries.size());
    std::vector<std::size_t> ready;
    for (std::size_t i = 0; i < waits.size(); ++i) {
      waits[i] = manifest.entries[i].after.size();
      for (const std::size_t other : manifest.entries[i].after) before[other].push_back(i);
      if (waits[i] == 0) ready.push_back(i);
    }
    for (std::size_t done = 0; done < ready.size(); ++done)
      for (const std::size_t next : before[ready[done]])
        if (--waits[next] == 0) ready.push_back(next);
    for (std::size_t i = 0; i < waits.size(); ++i)
      if (waits[i] != 0)
        fail(manifest.entries[i].at,
             fmt::format("'{}' is made from what is made from it", manifest.entries[i].name));
  }

  Manifest manifest;
  std::string folder;
  EntryDefaults defaults;
  std::vector<std::string> packs;
  std::map<std::string, std::size_t, std::less<>> outputs;
};

bool is_bake_word(const std::string& name) {
  return name == "encoding" || name == "channels" || name == "max-texels" || name == "report" ||
         name == "jobs";
}

} // namespace

Manifest parsed_manifest(std::string text, const std::string& file) {
  const std::string copy = text;
  try {
    return ManifestReader(std::move(text), file).read();
  } catch (const Error& error) {
    throw with_line(error, copy, file);
  }
}

Manifest read_manifest(const std::string& file) {
  return parsed_manifest(read_text_file(file, "the manifest"), file);
}

std::string place_in(const Manifest& manifest, std::string_view at) {
  return fmt::format("{}:{}", manifest.file, manifest.lines->line(at));
}

BakeJob bake_job_of(const Manifest& manifest, const BatchEntry& entry) {
  BakeJob job;
  job.name = entry.name;
  if (entry.is_transition)
    job.transition = entry.sources;
  else
    job.sample = entry.sources.front();
  job.maps = entry.maps;
  job.preset = entry.preset;
  job.folder = entry.output;
  job.place = place_in(manifest, entry.at);
  for (const BatchOption& option : entry.options) {
    const std::string where = fmt::format("{}: \"{}\"", place_in(manifest, option.at), option.name);
    const std::string& value = option.values.front();
    const auto refuse = [&](const std::string& allowed) {
      throw Error(ErrorKind::invalid_content, where,
                  fmt::format("'{}' is not allowed; it must be {}", value, allowed));
    };
    if (option.values.size() > 1)
      throw Error(ErrorKind::invalid_content, where, "has several values, and bake takes one");
    std::vector<std::string> known = bake_field_names();
    if (std::find(known.begin(), known.end(), option.name) != known.end()) {
      job.settings.push_back({option.name, value, where, ErrorKind::invalid_content});
    } else if (option.name == "encoding") {
      job.encoding = enum_named<Encoding>(value);
      if (!job.encoding) refuse(alternatives_of<Encoding>());
    } else if (option.name == "channels") {
      job.channels = value;
    } else if (option.name == "report") {
      job.report = value;
    } else if (option.name == "max-texels") {
      if (!parse_whole(value, 1, std::int64_t{1} << 40, job.max_texels))
        refuse(fmt::format("a whole number of 1 to {}", std::int64_t{1} << 40));
    } else if (option.name == "require") {
      if (value != "good" && value != "fair") refuse("good or fair");
      job.require = value;
    } else if (option.name == "apply-advice") {
      if (!option.is_flag) refuse("true or false");
      job.apply_advice = value == "true";
    } else if (!is_bake_word(option.name)) {
      known.insert(known.end(),
                   {"encoding", "channels", "max-texels", "report", "jobs", "require", "apply-advice"});
      const std::string nearest = nearest_name(option.name, known);
      throw Error(ErrorKind::invalid_content, where,
                  nearest.empty() ? "is no option of bake"
                                  : fmt::format("is no option of bake; did you mean \"{}\"?", nearest));
    }
  }
  check_advice(job);
  return job;
}

} // namespace tilepack
