#include "tilepack/bake/text_file.h"

#include "tilepack/error/error.h"
#include "tilepack/image/staged_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <span>
#include <sstream>

namespace tilepack {

std::string read_text_file(const std::string& file, std::string_view what) {
  std::error_code unknown;
  const std::filesystem::file_status status = std::filesystem::status(file, unknown);
  const auto refuse = [&](const std::string& why) { throw Error(ErrorKind::cannot_read, file, why); };
  if (!std::filesystem::exists(status))
    refuse(fmt::format("there is no such file, which would be {}; check the path", what));
  if (std::filesystem::is_directory(status)) refuse(fmt::format("{} is a file, and this a folder", what));
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) refuse(fmt::format("{} can't be read; check its permissions", what));
  return text.str();
}

void write_text_file(const std::string& file, std::string_view text) {
  StagedFile staged(file);
  staged.write(0, std::as_bytes(std::span(text.data(), text.size())));
  staged.commit();
}

} // namespace tilepack
