#include "build_rules.h"

#include "tilepack/batch/content_hash.h"
#include "tilepack/batch/entry_choice.h"
#include "tilepack/batch/entry_state.h"
#include "tilepack/error/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace tilepack::cli {
namespace {

namespace fs = std::filesystem;

// A path in a build statement of Ninja.
std::string ninja_path(const std::string& path) {
  std::string text;
  for (const char c : path) {
    if (c == '\n') throw Error(ErrorKind::invalid_content, path, "no rule can hold a name with a line break");
    if (c == '$' || c == ' ' || c == ':' || c == '|') text += '$';
    text += c;
  }
  return text;
}

// The value of a variable of Ninja.
std::string ninja_value(const std::string& value) {
  std::string text;
  for (const char c : value) {
    if (c == '$') text += '$';
    text += c == '\n' ? ' ' : c;
  }
  return text;
}

// A target or prerequisite of make.
std::string make_path(const std::string& path) {
  std::string text;
  for (const char c : path) {
    if (c == '\n' || c == ';' || c == '=')
      throw Error(ErrorKind::invalid_content, path,
                  fmt::format("make takes no name with '{}'; use ninja, or another name",
                              c == '\n' ? std::string("\\n") : std::string(1, c)));
    if (c == '$') text += '$';
    if (c == ' ' || c == '#' || c == ':' || c == '|' || c == '%') text += '\\';
    text += c;
  }
  return text;
}

std::string make_recipe(const std::string& words) {
  std::string text;
  for (const char c : words) text += c == '$' ? std::string("$$") : std::string(1, c);
  return text;
}

// What an entry is made from as far as that is known now; of what other entries make, what stands for it.
std::vector<std::string> sources_of(const Manifest& manifest, std::size_t i) {
  const BatchEntry& entry = manifest.entries[i];
  std::set<std::string> sources;
  for (const std::size_t other : entry.after) sources.insert(target_of(manifest.entries[other]));
  std::vector<std::string> outputs;
  for (const std::size_t other : entry.after)
    outputs.push_back(fmt::format("{}/", manifest.entries[other].output));
  try {
    for (const std::string& file : looked_at(entry, inputs_of(manifest, entry))) {
      const bool is_made = std::any_of(outputs.begin(), outputs.end(), [&](const std::string& output) {
        return fmt::format("{}/", file).starts_with(output);
      });
      if (!is_made) sources.insert(file);
    }
  } catch (const Error&) { // the entry fails when it is made, and says why
    for (const std::string& source : entry.sources)
      if (entry.after.empty()) sources.insert(source);
  }
  return {sources.begin(), sources.end()};
}

// Another one for other options, so that rules with it are run again.
std::string key_of_options(const Manifest& manifest, const BatchEntry& entry) {
  std::string text;
  try {
    text = canonical_options_of(manifest, entry);
  } catch (const Error& error) {
    text = error.what();
  }
  return hex(hash_of(text + entry.name)).substr(0, 16);
}

// What changes the list of entries: the manifest, presets, and the folders of patterns but the one that the rules
// are written to, which changes by that.
std::vector<std::string> sources_of_rules(const Manifest& manifest, const RuleSettings& settings) {
  std::set<std::string> sources{manifest.file};
  const auto place = [](const fs::path& path) { return fs::weakly_canonical(fs::absolute(path)); };
  for (const std::string& folder : manifest.folders)
    if (place(folder) != place(settings.file).parent_path() &&
        place(folder) != place(manifest.file).parent_path())
      sources.insert(folder);
  for (const BatchEntry& entry : manifest.entries) {
    std::error_code fault;
    if (!entry.preset.empty() && fs::is_regular_file(entry.preset, fault)) sources.insert(entry.preset);
  }
  return {sources.begin(), sources.end()};
}

std::string call(const Manifest& manifest, const RuleSettings& settings) {
  return fmt::format("{} batch {}{}{}", shell_word(settings.program), shell_word(manifest.file),
                     settings.arguments.empty() ? "" : " ", settings.arguments);
}

} // namespace

std::string shell_word(const std::string& text) {
  const bool is_plain = !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("._-/+,@:").find(c) != std::string_view::npos;
  });
  if (is_plain) return text;
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

std::string ninja_rules(const Manifest& manifest, const std::vector<std::size_t>& chosen,
                        const RuleSettings& settings) {
  std::string text = fmt::format("# Made by: tilepack batch {} --emit ninja\n"
                                 "ninja_required_version = 1.5\n\n"
                                 "rule tilepack\n"
                                 "  command = {} --quiet --only $entry # $key\n"
                                 "  description = tilepack $entry\n"
                                 "  restat = 1\n",
                                 shell_word(manifest.file), ninja_value(call(manifest, settings)));
  for (const std::size_t i : chosen) {
    const BatchEntry& entry = manifest.entries[i];
    text += fmt::format("\nbuild {}: tilepack", ninja_path(target_of(entry)));
    for (const std::string& source : sources_of(manifest, i)) text += fmt::format(" {}", ninja_path(source));
    text += fmt::format("\n  entry = {}\n  key = {}\n", ninja_value(shell_word(entry.name)),
                        key_of_options(manifest, entry));
  }
  if (settings.file.empty()) return text;
  text += fmt::format("\nrule tilepack_rules\n  command = {} --quiet --emit ninja --output $out\n"
                      "  description = rules of {}\n  generator = 1\n\nbuild {}: tilepack_rules",
                      ninja_value(call(manifest, settings)), ninja_value(manifest.file),
                      ninja_path(settings.file));
  for (const std::string& source : sources_of_rules(manifest, settings))
    text += fmt::format(" {}", ninja_path(source));
  text += "\n\nbuild all: phony";
  for (const std::size_t i : chosen) text += fmt::format(" {}", ninja_path(target_of(manifest.entries[i])));
  return text + "\ndefault all\n";
}

std::string make_rules(const Manifest& manifest, const std::vector<std::size_t>& chosen,
                       const RuleSettings& settings) {
  const std::string stamps = ".tilepack-options";
  std::string text = fmt::format("# Made by: tilepack batch {} --emit make\n"
                                 "TILEPACK_BATCH := {}\n\n"
                                 ".PHONY: all\nall:",
                                 shell_word(manifest.file), make_recipe(call(manifest, settings)));
  for (const std::size_t i : chosen)
    text += fmt::format(" \\\n  {}", make_path(target_of(manifest.entries[i])));
  // A file whose name is the hash of options: other options ask for another file.
  text += fmt::format("\n\n{0}/%:\n\t@mkdir -p {0} && touch $@\n.PRECIOUS: {0}/%\n", stamps);
  for (const std::size_t i : chosen) {
    const BatchEntry& entry = manifest.entries[i];
    const std::string target = target_of(entry);
    text += fmt::format("\n{}: {}/{}", make_path(target), stamps, key_of_options(manifest, entry));
    for (const std::string& source : sources_of(manifest, i))
      text += fmt::format(" \\\n  {}", make_path(source));
    // Touched, since an output that is current by content stays as it is, and make goes by time.
    text += fmt::format("\n\t$(TILEPACK_BATCH) --quiet --only {} && touch -c {}\n",
                        make_recipe(shell_word(entry.name)), make_recipe(shell_word(target)));
  }
  if (settings.file.empty()) return text;
  text += fmt::format("\n{}:", make_path(settings.file));
  for (const std::string& source : sources_of_rules(manifest, settings))
    text += fmt::format(" {}", make_path(source));
  return text + fmt::format("\n\t$(TILEPACK_BATCH) --quiet --emit make --output {0} && touch -c {0}\n",
                            make_recipe(shell_word(settings.file)));
}

} // namespace tilepack::cli
