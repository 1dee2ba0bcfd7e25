#pragma once

#include <filesystem>
#include <stdexcept>
#include <stdlib.h>
#include <string>

/// A new folder of its own for a test, removed with all it holds.
struct ScratchFolder {
  std::filesystem::path path;

  ScratchFolder() {
    // mkdtemp puts a name of its own in place of six X.
    std::string name =
        (std::filesystem::temp_directory_path() / "tilepack_test_").string() + std::string(6, 'X');
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path / name; }
};
