#include "sample_reading.h"

#include "value_check.h"

#include "tilepack/bake/material_read.h"
#include "tilepack/error/field.h"

namespace tilepack::cli {

void add_reading_options(Options& options, ReadingArguments& arguments) {
  options.option("--encoding", arguments.encoding, "how color is encoded; as the files say unless given")
      .one_of("srgb|linear");
  options
      .option("--channels", arguments.channels, "channels of color by their names in the file, in this order")
      .value("R,G,B");
  options.option("--max-texels", arguments.max_texels, "images of more are refused before memory is taken")
      .check(whole_number(1, std::int64_t{1} << 40))
      .value("N");
}

ImageFile read_noted(const std::string& file, const ReadingArguments& arguments, Role role,
                     Console& console) {
  ReadOptions options;
  if (!arguments.encoding.empty()) options.encoding = enum_named<Encoding>(arguments.encoding);
  options.channels = arguments.channels;
  options.most_texels = arguments.max_texels;
  ImageFile image = read_image(file, reading_of(role, options));
  for (const std::string& note : image.notes)
    console.note(spelled(file + ": " + note, FieldSpelling::option));
  return image;
}

} // namespace tilepack::cli
