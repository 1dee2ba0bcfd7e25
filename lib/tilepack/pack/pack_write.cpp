#include "tilepack/pack/pack_write.h"

#include "tilepack/error/error.h"
#include "tilepack/image/image_file.h"
#include "tilepack/pack/pack_json.h"
#include "tilepack/pack/pack_read.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <functional>
#include <mutex>

namespace tilepack {

namespace fs = std::filesystem;

namespace {

// The files of the pack that `folder` holds, pack.json last; none if it is empty or missing.
std::vector<std::string> replaceable_files(const fs::path& folder) {
  std::error_code fault;
  const fs::file_status status = fs::status(folder, fault);
  if (!fs::exists(status)) return {};
  if (!fs::is_directory(status))
    throw Error(ErrorKind::cannot_write, folder.string(), "is no folder; name another one");
  if (fs::exists(folder / "pack.json", fault)) {
    try {
      std::vector<std::string> files = read_pack_description(folder).all_files();
      files.emplace_back("pack.json");
      return files;
    } catch (const Error& error) {
      throw Error(
          ErrorKind::cannot_write, folder.string(),
          fmt::format("holds a pack.json that is no readable tile pack ({}); remove it or choose another "
                      "folder",
                      error.what()));
    }
  }
  for (auto entry = fs::directory_iterator(folder, fault); !fault && entry != fs::directory_iterator();
       entry.increment(fault))
    if (entry->path().filename() != ".tilepack-staging")
      throw Error(ErrorKind::cannot_write, folder.string(),
                  fmt::format("holds files but no tile pack ('{}'); choose an empty or a new folder",
                              entry->path().filename().string()));
  if (fault) throw Error(ErrorKind::cannot_write, folder.string(), fault.message());
  return {};
}

struct Task {
  std::size_t texels; // the largest first, since they take the longest
  std::function<void()> write;
};

void plan_writing(std::vector<Task>& tasks, const std::vector<PackedMap>& maps,
                  const std::vector<std::vector<TextureFile>>& files, const fs::path& folder) {
  for (std::size_t m = 0; m < maps.size(); ++m) {
    const StoredFormat format = maps[m].stored();
    std::span<const Image> left(maps[m].levels);
    for (const TextureFile& texture : files[m]) {
      if (left.empty()) left = maps[m].far_levels;
      const auto levels = left.first(texture.levels.size());
      left = left.subspan(levels.size());
      std::size_t values = 0;
      for (const Image& level : levels) values += level.data().size();
      tasks.push_back({values, [levels, format, path = folder / texture.file] {
                         write_texture_file(path, levels, format);
                       }});
    }
  }
}

Image index_image(const Mapping& mapping, Depth depth) {
  Image image(static_cast<int>(mapping.size.width), static_cast<int>(mapping.size.height), 1);
  const float top = depth == Depth::u8 ? 255.0f : 65535.0f;
  std::transform(mapping.ids.begin(), mapping.ids.end(), image.data().begin(),
                 [top](int id) { return static_cast<float>(id) / top; });
  return image;
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream.write(text.data(), static_cast<std::streamsize>(text.size()));
  stream.close();
  if (!stream) throw Error(ErrorKind::cannot_write, file.string(), "can't be written; is the disk full?");
}

// Messages name the file as it would have been called, not its place in the staging folder.
Error named_as_final(const Error& error, const fs::path& staging, const fs::path& folder) {
  std::string what = error.what();
  const std::string inside = staging.string() + "/";
  for (std::size_t at = what.find(inside); at != std::string::npos; at = what.find(inside, at))
    what.replace(at, inside.size(), (folder / "").string());
  return Error(error.kind(), "", what);
}

} // namespace

void check_pack_folder(const fs::path& folder) {
  const StagedFolder made_and_removed(folder); // is there permission, is it locked?
  replaceable_files(folder);
}

fs::path pack_around(const fs::path& folder) {
  std::error_code fault;
  fs::path inner = fs::absolute(folder, fault);
  if (fault) return {}; // the current folder was removed, as writing will find out
  inner = fs::weakly_canonical(inner, fault);
  if (inner.filename().empty()) inner = inner.parent_path(); // "pack/"
  for (fs::path outer = inner.parent_path(); outer != inner; inner = outer, outer = outer.parent_path()) {
    if (!fs::exists(outer / "pack.json", fault)) continue;
    try {
      read_pack_description(outer);
      return outer;
    } catch (const Error&) { // the pack.json of something else
    }
  }
  return {};
}

std::string replacing_note(const fs::path& folder) {
  std::error_code fault;
  if (!fs::exists(folder / "pack.json", fault)) return "";
  const std::string why = moved_one_by_one(folder);
  if (why.empty()) return "";
  return fmt::format(
      "{} {}, so that its files are replaced one by one: who reads it at that moment may find no "
      "pack.json and must try again, and what a failing disk leaves half done is put right by the "
      "next reading or writing",
      folder.string(), why);
}

void stage_pack(StagedOutputs& outputs, const Pack& pack, const fs::path& folder, const Progress& progress) {
  const PackDescription description = described(pack);
  const fs::path staging = outputs.add_folder(folder).path(); // first: it puts back what was left half done
  std::vector<std::string> old_files = replaceable_files(folder);
  std::vector<Task> tasks;
  plan_writing(tasks, pack.maps, description.map_files, staging);
  if (pack.corner_pack) plan_writing(tasks, pack.corner_pack->maps, description.corner_files, staging);
  if (!description.index_file.empty()) {
    const Depth depth = tile_count(pack.tiles) <= 256 ? Depth::u8 : Depth::u16;
    tasks.push_back({pack.mapping.ids.size(), [&pack, depth, file = staging / description.index_file] {
                       write_image(file, index_image(pack.mapping, depth), depth, Encoding::linear);
                     }});
  }
  std::stable_sort(tasks.begin(), tasks.end(),
                   [](const Task& a, const Task& b) { return a.texels > b.texels; });
  std::size_t total = 1;
  for (const Task& task : tasks) total += task.texels;
  std::size_t done = 0;
  std::mutex reporting;
  try {
    report(progress, "writing", 0.0);
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, tasks.size(), 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          for (std::size_t i = range.begin(); i < range.end(); ++i) {
            tasks[i].write();
            const std::lock_guard guard(reporting);
            done += tasks[i].texels;
            report(progress, "writing", static_cast<double>(done) / static_cast<double>(total));
          }
        },
        tbb::simple_partitioner());
    write_text(staging / "pack.json", pack_json(description));
  } catch (const Error& error) {
    throw named_as_final(error, staging, folder);
  }
  // pack.json goes last: whoever finds it finds all it names.
  std::vector<std::string> new_files = description.all_files();
  new_files.emplace_back("pack.json");
  outputs.set_files(std::move(new_files), std::move(old_files));
}

void write_pack(const Pack& pack, const fs::path& folder, const Progress& progress) {
  StagedOutputs outputs;
  stage_pack(outputs, pack, folder, progress);
  outputs.commit(progress);
}

} // namespace tilepack
