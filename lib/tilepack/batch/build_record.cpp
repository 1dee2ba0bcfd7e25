#include "tilepack/batch/build_record.h"

#include "tilepack/error/error.h"
#include "tilepack/json/json_cursor.h"
#include "tilepack/json/json_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

namespace tilepack {
namespace {

constexpr std::size_t longest_text = 1 << 20;
constexpr std::size_t most_files = 1 << 20;
constexpr std::uintmax_t largest_record = 64 << 20;

std::map<std::string, std::string> lines_of(const std::string& options) {
  std::map<std::string, std::string> lines;
  std::istringstream text(options);
  for (std::string line; std::getline(text, line);) {
    const std::size_t equals = line.find('=');
    lines[line.substr(0, equals)] = equals == std::string::npos ? "" : line.substr(equals + 1);
  }
  return lines;
}

std::string shown(const std::string& value) {
  return value.empty() ? "unset" : value;
}

void compare_options(const BuildInputs& then, const BuildInputs& now, std::vector<std::string>& reasons) {
  if (then.options == now.options) return;
  auto old = lines_of(then.options), made = lines_of(now.options);
  for (const auto& [key, unused] : made) old.try_emplace(key);
  for (const auto& [key, value] : old) {
    const std::string& other = made[key];
    if (value == other) continue;
    if (key == "version")
      reasons.push_back(fmt::format("tilepack {} → {}", shown(value), shown(other)));
    else
      reasons.push_back(fmt::format("option {}: {} → {}", key, shown(value), shown(other)));
  }
}

void compare_files(const BuildInputs& then, const BuildInputs& now, std::vector<std::string>& reasons) {
  std::map<std::string, ContentHash> old;
  for (const HashedFile& file : then.files) old.emplace(file.name, file.hash);
  for (const HashedFile& file : now.files) {
    const auto found = old.find(file.name);
    if (found == old.end())
      reasons.push_back(file.name + " added");
    else if (found->second != file.hash)
      reasons.push_back(file.name + " changed");
    if (found != old.end()) old.erase(found);
  }
  for (const auto& [name, unused] : old) reasons.push_back(name + " removed");
}

JsonValue files_value(const std::vector<HashedFile>& files) {
  JsonValue list = JsonValue::array();
  for (const HashedFile& file : files) list.push_back({{"name", file.name}, {"hash", hex(file.hash)}});
  return list;
}

std::vector<HashedFile> files_in(const JsonCursor& list) {
  std::vector<HashedFile> files;
  for (std::size_t i = 0; i < list.array(0, most_files); ++i) {
    const JsonCursor item = list.item(i);
    item.only({"name", "hash"});
    const auto hash = parsed_hash(item.member("hash").text());
    if (!hash) item.fail("no hash");
    files.push_back({item.member("name").text(longest_text), *hash});
  }
  return files;
}

} // namespace

ContentHash key_of(const BuildInputs& inputs) {
  ContentHasher hasher;
  hasher.add_field(inputs.options);
  for (const HashedFile& file : inputs.files) {
    hasher.add_field(file.name);
    hasher.add_number(file.hash.high);
    hasher.add_number(file.hash.low);
  }
  return hasher.value();
}

std::string side_file_of(const std::string& output, bool is_pack) {
  const std::filesystem::path file =
      is_pack ? std::filesystem::path(output) / "pack.json" : std::filesystem::path(output);
  return (file.parent_path() / fmt::format(".{}.build", file.filename().string())).string();
}

std::string record_text(const BuildRecord& record) {
  JsonValue value{{"format", "tilepack-build"}, {"version", 1}, {"key", hex(key_of(record.inputs))}};
  JsonValue options = JsonValue::object();
  for (const auto& [key, setting] : lines_of(record.inputs.options)) options[key] = setting;
  value["options"] = std::move(options);
  value["inputs"] = files_value(record.inputs.files);
  value["outputs"] = files_value(record.outputs);
  return filled_json_text(value);
}

std::optional<BuildRecord> parsed_record(std::string_view text) {
  try {
    const JsonCursor root = JsonCursor::parse(text, "");
    root.only({"format", "version", "key", "options", "inputs", "outputs"});
    root.member("format").one_of({"tilepack-build"});
    root.member("version").integer(1, 1);
    BuildRecord record;
    const JsonCursor options = root.member("options");
    for (const std::string& key : options.names()) {
      const std::string value = options.member(key).text(longest_text);
      if (key.find_first_of("=\n") != key.npos || value.find('\n') != value.npos) return std::nullopt;
      record.inputs.options += fmt::format("{}={}\n", key, value);
    }
    record.inputs.files = files_in(root.member("inputs"));
    record.outputs = files_in(root.member("outputs"));
    if (root.member("key").text() != hex(key_of(record.inputs))) return std::nullopt;
    return record;
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::optional<BuildRecord> read_record(const std::string& side_file) {
  std::error_code fault;
  if (const auto size = std::filesystem::file_size(side_file, fault); fault || size > largest_record)
    return std::nullopt;
  std::ifstream stream(side_file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) return std::nullopt;
  return parsed_record(text.str());
}

void shorten(std::vector<std::string>& reasons) {
  constexpr std::size_t most_named = 3;
  if (reasons.size() <= most_named + 1) return;
  const std::size_t more = reasons.size() - most_named;
  reasons.resize(most_named);
  reasons.push_back(fmt::format("and {} more", more));
}

std::vector<std::string> differences(const std::optional<BuildRecord>& record, const BuildInputs& now) {
  if (!record) return {"not built yet"};
  std::vector<std::string> reasons, of_files;
  compare_options(record->inputs, now, reasons);
  compare_files(record->inputs, now, of_files);
  shorten(of_files);
  reasons.insert(reasons.end(), of_files.begin(), of_files.end());
  if (reasons.empty() && !(record->inputs == now)) reasons.emplace_back("inputs in another order");
  return reasons;
}

} // namespace tilepack
