#include "tilepack/bake/material_read.h"

#include "tilepack/bake/material_names.h"
#include "tilepack/error/error.h"
#include "tilepack/error/nearest_name.h"
#include "tilepack/image/image_file.h"
#include "tilepack/pack/file_name.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string_view>

namespace tilepack {

namespace fs = std::filesystem;

namespace {

// "Base-Color" is "basecolor".
std::optional<KindNamed> known_kind(std::string_view word) {
  std::string plain;
  for (const char c : word)
    if (c != '_' && c != '-' && c != '.' && c != ' ')
      plain += c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return kind_called(plain);
}

// As a shell takes it for one word.
std::string in_quotes(const std::string& file) {
  return file.find_first_of(" ()&;'") == std::string::npos ? file : fmt::format("\"{}\"", file);
}

// What a packed map says of its channels, as many as the file has.
std::vector<ChannelContent> contents_in(const MaterialFile& file, int channels,
                                        std::vector<std::string>& notes) {
  if (file.contents.size() > 1 && static_cast<std::size_t>(channels) < file.contents.size())
    notes.push_back(fmt::format("has {} channel{}, and a packed map like {} has {}", channels,
                                channels == 1 ? "" : "s", file.name, file.contents.size()));
  return filled_contents(file.contents, channels);
}

MaterialFile map_of_kind(const KindNamed& named, const std::string& file) {
  return {std::string(named.kind->name), named.kind->role, file, named.kind->contents, named.normal_y};
}

// "brick" of "packs/brick.pack/".
std::string pack_stem(const std::string& pack) {
  fs::path path(pack);
  if (path.filename().empty()) path = path.parent_path();
  const std::string stem = path.stem().string();
  return stem.empty() || stem.front() == '.' ? "pack" : stem;
}

// " The roles are …", with a hint before it if `word` is nearly one of them: what follows "'word' is no role".
std::string roles_instead_of(const std::string& word) {
  std::vector<std::string> known{"data"};
  for (const MapKind& k : map_kinds()) known.emplace_back(k.name);
  const std::string nearest = nearest_name(word, known);
  return fmt::format("{} The roles are {} and data",
                     nearest.empty() ? "." : fmt::format("; did you mean '{}'?", nearest), listed_kinds());
}

// A pack holds images too, whose names would be taken for those of maps.
void refuse_pack(const fs::path& sample, bool is_folder) {
  const fs::path json = is_folder ? sample / "pack.json" : sample;
  std::error_code fault;
  if (json.filename() != "pack.json" || !fs::is_regular_file(json, fault)) return;
  const std::string pack = is_folder ? sample.string() : sample.parent_path().string();
  throw Error(
      ErrorKind::invalid_content, sample.string(),
      fmt::format("is a pack already, made from a sample: bake that sample again, or draw what the pack "
                  "shows with `tilepack render {0} -o {1}.png`, or several packs in a scene with "
                  "`tilepack compose`",
                  pack.empty() ? "." : pack, pack_stem(pack)));
}

} // namespace

FoundMaterial sample_files(const std::string& sample) {
  const FoundMaterial image{{{"color", Role::color, sample}}, {}};
  const fs::path path(sample);
  const bool is_folder = fs::is_directory(path);
  refuse_pack(path, is_folder);
  // What is no folder and not there may be the common beginning of several names; if it is not, reading it
  // as an image says that it is missing.
  if (!is_folder && (fs::exists(fs::symlink_status(path)) || has_readable_ending(sample))) return image;
  const fs::path folder = is_folder ? path : path.parent_path();
  std::vector<std::string> names, folders;
  std::error_code fault;
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, fault), end; !fault && entry != end;
       entry.increment(fault)) {
    std::error_code unknown;
    std::string name = entry->path().filename().string();
    if (name.front() == '.') continue;
    (entry->is_directory(unknown) ? folders : names).push_back(std::move(name));
  }
  if (!is_folder) {
    const std::string key = material_key(path.filename().string());
    const bool any = !fault && std::any_of(names.begin(), names.end(), [&](const std::string& name) {
      const auto readings = readings_of(name);
      return std::any_of(readings.begin(), readings.end(),
                         [&](const NameReading& r) { return r.key == key; });
    });
    if (!any) return image;
  }
  if (fault) throw Error(ErrorKind::cannot_read, folder.string(), fault.message());
  if (std::none_of(names.begin(), names.end(), has_readable_ending) && !folders.empty()) {
    std::sort(folders.begin(), folders.end());
    throw Error(
        ErrorKind::invalid_content, sample,
        fmt::format("holds no image, but folders: {}; name the one with the maps",
                    fmt::join(std::span(folders).first(std::min<std::size_t>(8, folders.size())), ", ")));
  }
  FoundMaterial found = material_files(names, is_folder ? "" : path.filename().string(), sample);
  for (MaterialFile& f : found.files) f.file = (folder / f.file).string();
  for (PassedOver& f : found.passed_over) f.file = (folder / f.file).string();
  return found;
}

MaterialFile parsed_map(const std::string& text) {
  const auto refuse = [](const std::string& what) { throw Error(ErrorKind::usage, field("map"), what); };
  const std::size_t equals = text.find('=');
  const std::string label = text.substr(0, equals);
  const std::string file = equals == std::string::npos ? "" : text.substr(equals + 1);
  if (equals == std::string::npos) {
    if (known_kind(label))
      refuse(fmt::format("'{}' has no '='; write {}", text, field("map", label + "=FILE")));
    refuse(fmt::format("'{}' has no '='; write ROLE=FILE or NAME:ROLE=FILE", text));
  }
  if (file.empty() || label.empty())
    refuse(fmt::format("'{}' is not allowed; write ROLE=FILE or NAME:ROLE=FILE", text));
  const std::size_t colon = label.find(':');
  const std::string word = colon == std::string::npos ? label : label.substr(colon + 1);
  if (colon == 0)
    refuse(fmt::format("the name before ':' is empty in '{}'; write NAME:ROLE=FILE or {}", text,
                       field("map", word + "=" + file)));
  const std::optional<KindNamed> kind = known_kind(word);
  if (!kind && has_readable_ending(word) && known_kind(file))
    refuse(fmt::format("'{}' has file and role swapped; write {}", text, field("map", file + "=" + word)));
  if (!kind && word != name_of(Role::data)) {
    const std::string name = colon == std::string::npos ? word : label.substr(0, colon);
    refuse(fmt::format("'{}' is no role{}: any other map is {}:data=FILE", word, roles_instead_of(word),
                       is_map_name(name) ? name : "NAME"));
  }
  MaterialFile map = kind ? map_of_kind(*kind, file) : MaterialFile{label, Role::data, file};
  if (colon != std::string::npos) map.name = label.substr(0, colon);
  return map;
}

std::string note_on(const PassedOver& file) {
  return fmt::format("{} is passed over: {}{}", file.file, file.why,
                     file.label.empty() ? ""
                                        : fmt::format("; to take it: {}",
                                                      field("map", file.label + "=" + in_quotes(file.file))));
}

MaterialFile meant_map(const std::string& word, std::string_view field_to_blame) {
  if (const auto kind = known_kind(word)) return map_of_kind(*kind, "");
  if (word == name_of(Role::data)) return {word, Role::data, ""};
  throw Error(ErrorKind::usage, field(field_to_blame),
              fmt::format("'{}' is no role{}", word, roles_instead_of(word)));
}

ReadOptions reading_of(Role role, const ReadOptions& options) {
  if (is_light(role)) return options;
  ReadOptions plain;
  plain.encoding = Encoding::linear;
  plain.alpha = AlphaReading::as_stored;
  plain.most_texels = options.most_texels;
  return plain;
}

ReadSamples read_samples(std::span<const MaterialFile> files, const ReadOptions& options) {
  ReadSamples read;
  read.maps.resize(files.size());
  std::vector<std::vector<std::string>> notes(files.size());
  tbb::parallel_for(std::size_t{0}, files.size(), [&](std::size_t i) {
    const MaterialFile& f = files[i];
    ImageFile file = read_image(f.file, reading_of(f.role, options));
    notes[i] = std::move(file.notes);
    MapFormat format{
        f.name,    f.role, file.encoding, file.depth, contents_in(f, file.image.channels(), notes[i]),
        f.normal_y};
    read.maps[i] = {std::move(format), std::move(file.image), f.file};
  });
  for (std::size_t i = 0; i < files.size(); ++i)
    for (const std::string& note : notes[i]) read.notes.push_back(files[i].file + ": " + note);
  return read;
}

std::string doubt_about_color(const SampleMap& map, std::optional<Encoding> asked) {
  const std::optional<MaterialFile> named = map_by_name(map.file);
  if (map.role != Role::color || !named || is_light(named->role) || asked) return "";
  const bool srgb = map.encoding == Encoding::srgb;
  return fmt::format("{} is taken as {} color, though its name says {}: beside its color map it goes as {}{}",
                     map.file, srgb ? "an sRGB" : "a linear", named->name,
                     field("map", named->name + "=" + in_quotes(map.file)),
                     srgb ? "; alone, " + field("encoding", "linear") + " takes plain values" : "");
}

} // namespace tilepack
