#include "tilepack/batch/manifest_entry.h"

#include "tilepack/bake/material_read.h"
#include "tilepack/error/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace tilepack {
namespace {

constexpr std::size_t longest_path = 4096;
constexpr std::size_t most_sources = 65536;

std::string path_text(const JsonCursor& value) {
  std::string text = value.text(longest_path);
  if (text.empty()) value.fail("is empty; it must be a path");
  if (text.find('\0') != std::string::npos) value.fail("holds a zero character, which no path can");
  return text;
}

std::string value_text(const JsonCursor& value, bool& is_flag) {
  is_flag = value.is_boolean();
  if (is_flag) return value.boolean() ? "true" : "false";
  if (value.is_text()) return value.text(longest_path);
  if (value.is_integer()) return fmt::format("{}", value.integer(INT64_MIN, INT64_MAX));
  if (value.is_object() || value.is_array() || value.is_null())
    value.fail(fmt::format("must be a text, a number, true or false, and is {}", value.shown()));
  value.number(-1e308, 1e308);
  return value.shown();
}

std::vector<BatchOption> options_in(const JsonCursor& options, const std::string& at) {
  std::vector<BatchOption> list;
  for (const std::string& name : options.names()) {
    const JsonCursor value = options.member(name);
    BatchOption option{name, {}, false, at + "." + name};
    // What an entry says in places of their own, and what would make no output.
    for (const auto& [word, instead] :
         {std::pair("output", "\"output\""), std::pair("preset", "\"preset\""), std::pair("map", "\"maps\""),
          std::pair("transition", "\"transition\": [\"A\", \"B\"]"),
          std::pair("depfile", "the depfile of the batch"), std::pair("help", "no help"),
          std::pair("list-presets", "no list"), std::pair("list-rules", "no list")})
      if (name == word)
        value.fail(fmt::format("is no option of an entry; {} beside \"options\" is what it has", instead));
    if (name.empty() || name.front() == '-' || name.find_first_of("= ") != std::string::npos)
      value.fail("options are named without dashes: \"seed\"");
    if (value.is_array()) {
      for (std::size_t i = 0; i < value.array(1, most_sources); ++i) {
        bool flag = false;
        option.values.push_back(value_text(value.item(i), flag));
      }
    } else {
      option.values.push_back(value_text(value, option.is_flag));
    }
    list.push_back(std::move(option));
  }
  return list;
}

void take_over(std::vector<BatchOption>& options, std::vector<BatchOption> own) {
  for (BatchOption& option : own) {
    std::erase_if(options, [&](const BatchOption& other) { return other.name == option.name; });
    options.push_back(std::move(option));
  }
  std::sort(options.begin(), options.end(),
            [](const BatchOption& a, const BatchOption& b) { return a.name < b.name; });
}

const BatchVerb& verb_in(const JsonCursor& name) {
  const std::vector<std::string> known = batch_verb_names();
  return batch_verbs()[name.one_of(known)];
}

std::vector<std::string> texts_in(const JsonCursor& value) {
  if (value.is_text()) return {path_text(value)};
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < value.array(1, most_sources); ++i) texts.push_back(path_text(value.item(i)));
  return texts;
}

// The materials of a transition, which stand in place of a sample; false if the entry is none.
bool read_materials(const JsonCursor& job, EntryText& entry) {
  const auto materials = job.find("transition");
  if (!materials) return false;
  for (const char* const other : {"sample", "samples", "maps"})
    if (job.find(other))
      job.fail(
          fmt::format("has both \"transition\" and \"{}\"; a transition is made from its materials alone, "
                      "each an image or a folder of maps",
                      other));
  entry.is_transition = true;
  constexpr std::size_t fewest = 2, most = 4;
  for (std::size_t i = 0; i < materials->array(fewest, most); ++i)
    entry.sources.push_back(path_text(materials->item(i)));
  return true;
}

// One path for each source of the verb, or the pattern that stands for its first.
void read_sources(const JsonCursor& job, EntryText& entry) {
  for (const BatchSource& source : entry.verb->sources) {
    if (const auto pattern = source.pattern.empty() ? std::nullopt : job.find(source.pattern)) {
      if (job.find(source.key))
        job.fail(fmt::format("has both \"{}\" and \"{}\"; keep one", source.key, source.pattern));
      entry.pattern = texts_in(*pattern);
      entry.pattern_at = fmt::format("{}.{}", entry.at, source.pattern);
      entry.is_pack_pattern = source.is_pack;
      continue;
    }
    if (!source.pattern.empty() && !job.find(source.key))
      job.fail(fmt::format("\"{}\" is missing, or \"{}\" with a pattern", source.key, source.pattern));
    const JsonCursor value = job.member(source.key);
    if (source.is_list) {
      const auto paths = texts_in(value);
      entry.sources.insert(entry.sources.end(), paths.begin(), paths.end());
    } else {
      entry.sources.push_back(path_text(value));
    }
  }
}

} // namespace

bool is_read_option(const BatchVerb& verb, std::string_view option) {
  return std::find(verb.files_read.begin(), verb.files_read.end(), option) != verb.files_read.end();
}

bool is_file_option(const BatchVerb& verb, std::string_view option) {
  return is_read_option(verb, option) ||
         std::find(verb.files_written.begin(), verb.files_written.end(), option) != verb.files_written.end();
}

EntryDefaults entry_defaults(const JsonCursor& given) {
  given.only({"preset", "options", "verbs"});
  EntryDefaults defaults;
  if (const auto preset = given.find("preset")) defaults.preset = path_text(*preset);
  if (const auto options = given.find("options"))
    defaults.options["bake"] = options_in(*options, "defaults.options");
  if (const auto verbs = given.find("verbs")) {
    verbs->only(batch_verb_names());
    for (const std::string& verb : verbs->names())
      take_over(defaults.options[verb], options_in(verbs->member(verb), "defaults.verbs." + verb));
  }
  return defaults;
}

EntryText entry_text(const JsonCursor& job, const std::string& at, const EntryDefaults& defaults) {
  EntryText entry;
  entry.at = at;
  const auto verb = job.find("verb");
  entry.verb = verb ? &verb_in(*verb) : batch_verb_called("bake");
  const bool is_bake = entry.verb->name == "bake";
  std::vector<std::string> known{"name", "verb", "output", "options"};
  if (is_bake) known.insert(known.end(), {"transition", "maps", "preset"});
  for (const BatchSource& source : entry.verb->sources) {
    known.emplace_back(source.key);
    if (!source.pattern.empty()) known.emplace_back(source.pattern);
  }
  job.only(known);
  if (!is_bake || !read_materials(job, entry)) read_sources(job, entry);
  entry.output = path_text(job.member("output"));
  if (const auto name = job.find("name")) entry.name = name->text(longest_path);
  if (const auto options = defaults.options.find(std::string(entry.verb->name));
      options != defaults.options.end())
    entry.options = options->second;
  if (const auto own = job.find("options")) take_over(entry.options, options_in(*own, at + ".options"));
  if (!is_bake) return entry;
  entry.preset = defaults.preset;
  if (const auto preset = job.find("preset"))
    entry.preset = preset->is_text() && preset->text().empty() ? "" : path_text(*preset);
  if (const auto maps = job.find("maps"))
    for (const std::string& label : maps->names()) {
      try {
        entry.maps.push_back(parsed_map(label + "=" + path_text(maps->member(label))));
      } catch (const Error& error) {
        if (error.field().empty()) throw;
        maps->member(label).fail(error.what_happened());
      }
    }
  return entry;
}

} // namespace tilepack
