#include "tilepack/image/made_folders.h"

#include <system_error>
#include <unistd.h>

namespace tilepack {

namespace fs = std::filesystem;

MadeFolders::MadeFolders(const fs::path& folder) {
  std::vector<fs::path> missing; // innermost first
  std::error_code fault;
  for (fs::path at = folder; !at.empty() && fs::symlink_status(at, fault).type() == fs::file_type::not_found;
       at = at.parent_path())
    missing.push_back(at);
  for (auto at = missing.rbegin(); at != missing.rend(); ++at)
    if (fs::create_directory(*at, fault)) made.push_back(*at);
}

MadeFolders::~MadeFolders() {
  for (auto at = made.rbegin(); at != made.rend(); ++at) ::rmdir(at->c_str()); // of empty ones alone
}

} // namespace tilepack
