#include "tilepack/bake/text_file.h"

#include "tilepack/error/error.h"
#include "tilepack/image/staged_file.h"

#include <fmt/format.h>

#include <fstream>
#include <span>
#include <sstream>

namespace tilepack {

std::string read_text_file(const std::string& file, std::string_view what) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) throw Error(ErrorKind::cannot_read, file, fmt::format("{} can't be read", what));
  return text.str();
}

void write_text_file(const std::string& file, std::string_view text) {
  StagedFile staged(file);
  staged.write(0, std::as_bytes(std::span(text.data(), text.size())));
  staged.commit();
}

} // namespace tilepack
