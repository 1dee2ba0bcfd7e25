#include "tilepack/pack/staged_outputs.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace tilepack {

namespace fs = std::filesystem;

StagedFolder& StagedOutputs::add_folder(const fs::path& target) {
  if (folder && folder_target != target) throw std::logic_error("outputs have one folder");
  if (folder) return *folder;
  folder_target = target;
  return folder.emplace(target);
}

void StagedOutputs::set_files(std::vector<std::string> put_in, std::vector<std::string> taken_out) {
  new_files = std::move(put_in);
  old_files = std::move(taken_out);
}

// The name that `target` has in the folder itself; empty if it lies elsewhere.
std::string StagedOutputs::name_in_folder(const fs::path& target) const {
  if (!folder) return "";
  std::error_code fault;
  const fs::path whole = fs::absolute(target, fault);
  const fs::path parent = fault ? fs::path() : fs::weakly_canonical(whole.parent_path(), fault);
  return !fault && parent == folder->final_path() ? whole.filename().string() : "";
}

StagedFile& StagedOutputs::add_file(const fs::path& target) {
  const std::string name = name_in_folder(target);
  if (name.empty()) return *elsewhere.emplace_back(std::make_unique<StagedFile>(target));
  files_in_folder.push_back(name);
  return *in_folder.emplace_back(std::make_unique<StagedFile>(folder->path() / name, target.string()));
}

void StagedOutputs::add_text(const fs::path& target, std::string_view text) {
  StagedFile& file = add_file(target);
  file.write(text);
  file.check();
}

void StagedOutputs::commit(const Progress& last_word) {
  for (const auto& file : in_folder) file->commit(); // within the staging folder: not yet in place
  std::vector<FileSwap> swaps;
  for (const auto& file : elsewhere) swaps.push_back(file->finished());
  report(last_word, "writing", 1.0);
  StepOnDisk step;
  if (folder) {
    // pack.json, the last one, stays that.
    new_files.insert(new_files.end() - std::min<std::ptrdiff_t>(1, std::ssize(new_files)),
                     files_in_folder.begin(), files_in_folder.end());
    old_files.insert(old_files.begin(), files_in_folder.begin(), files_in_folder.end());
    folder->commit(new_files, old_files, swaps);
    return;
  }
  if (swaps.size() == 1) return elsewhere.front()->commit(); // an older file goes in the same step
  std::size_t done = 0;
  try {
    for (; done < swaps.size(); ++done) put_in_place(swaps[done], elsewhere[done]->name());
  } catch (...) {
    while (done-- > 0) take_back(swaps[done]);
    throw;
  }
  if (!swaps.empty()) step.puts_in_place();
}

} // namespace tilepack
