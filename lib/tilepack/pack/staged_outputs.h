#pragma once

#include "tilepack/error/progress.h"
#include "tilepack/image/staged_file.h"
#include "tilepack/pack/staged_folder.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// All that one command writes, put in place together: every output or none.
///
///   StagedOutputs outputs;
///   StagedFolder& folder = outputs.add_folder("rock.pack");       // or stage_pack(), which does this
///   … write every file of it into folder.path(); outputs.set_files(new_files, old_files); …
///   outputs.add_text("rock.html", page);
///   write_image(outputs.add_file("rock.png"), image, format);
///   outputs.commit(progress);
///
/// Nothing has its name before commit(), which does no more than to change names: those of single files in the
/// order of add_file(), then the folder, in one step where StagedFolder can. If a step fails, or the process is
/// killed between two, those before are undone: at once, or by the next that writes to the folder or reads a
/// pack from it. Without a folder, what is killed between two names stays so until the command is run again.
///
/// A file that lies in the folder itself becomes part of it. Destroyed without commit(), nothing is left.
class StagedOutputs {
public:
  /// At most one, before files that may lie in it; asked for again, the same. Throws as StagedFolder does.
  StagedFolder& add_folder(const std::filesystem::path& target);

  /// What the folder gets, and which of its files go for that, as StagedFolder::commit() takes them.
  void set_files(std::vector<std::string> new_files, std::vector<std::string> old_files);

  /// A file to be written before commit(). Throws as StagedFile does.
  StagedFile& add_file(const std::filesystem::path& target);
  void add_text(const std::filesystem::path& target, std::string_view text);

  /// Throws Error (cannot_write). `last_word` is asked once, before the first step; if it throws, nothing is
  /// written, and after it nothing can call the command off.
  void commit(const Progress& last_word = {});

private:
  std::string name_in_folder(const std::filesystem::path& target) const;

  std::optional<StagedFolder> folder;
  std::filesystem::path folder_target;           // as given
  std::vector<std::string> new_files, old_files; // of the folder
  std::vector<std::string> files_in_folder;
  std::vector<std::unique_ptr<StagedFile>> in_folder, elsewhere; // destroyed before the folder
};

} // namespace tilepack
