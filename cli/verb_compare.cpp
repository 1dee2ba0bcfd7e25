#include "sample_reading.h"
#include "value_check.h"
#include "verb.h"

#include "tilepack/bake/output_check.h"
#include "tilepack/image/image_file.h"
#include "tilepack/measure/comparison.h"
#include "tilepack/pack/pack_read.h"
#include "tilepack/pack/staged_outputs.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tilepack::cli {
namespace {

struct CompareArguments {
  std::string a;
  std::string b;
  std::string format = "text";
  std::string picture;
  double gain = 8;
  CompareLimits limits;
  ReadingArguments reading;
};

bool names_pack(const std::string& name) {
  std::error_code unused;
  return std::filesystem::is_directory(name, unused) || std::filesystem::path(name).extension() == ".json";
}

void add_picture(StagedOutputs& outputs, const CompareArguments& arguments, const ImageFile& a,
                 const ImageFile& b) {
  if (a.image.size() != b.image.size() || a.image.channels() != b.image.channels())
    throw Error(ErrorKind::invalid_content, "--picture",
                "the images differ in size or channels; none is written");
  write_image(outputs.add_file(arguments.picture), difference_picture(a.image, b.image, arguments.gain),
              usual_format(Depth::u8, Encoding::srgb));
}

int run_compare(const CompareArguments& arguments, Console& console) {
  const bool packs = names_pack(arguments.a);
  if (packs != names_pack(arguments.b))
    throw Error(ErrorKind::usage, "",
                fmt::format("{} is {} and {} is {}; two images or two packs can be compared", arguments.a,
                            packs ? "a pack" : "an image", arguments.b, packs ? "an image" : "a pack"));
  if (packs && !arguments.picture.empty())
    throw Error(ErrorKind::usage, "--picture", "is for two images; name two of the packs' files instead");
  check_outputs(std::vector<OutputFile>{{"--picture", arguments.picture}},
                std::vector{arguments.a, arguments.b});
  const Progress progress = console.progress();
  report(progress, "reading", 0.0);
  Comparison comparison;
  if (packs) {
    comparison = compared(read_pack(arguments.a), read_pack(arguments.b));
  } else {
    const ImageFile a = read_noted(arguments.a, arguments.reading, Role::color, console);
    report(progress, "reading", 0.5);
    const ImageFile b = read_noted(arguments.b, arguments.reading, Role::color, console);
    report(progress, "comparing", 0.0);
    comparison = compared(a, b);
    StagedOutputs outputs;
    if (!arguments.picture.empty()) add_picture(outputs, arguments, a, b);
    outputs.commit(progress);
  }
  comparison.a = arguments.a;
  comparison.b = arguments.b;
  console.print(arguments.format == "json" ? comparison_json(comparison, arguments.limits)
                                           : comparison_text(comparison, arguments.limits));
  if (!within(comparison, arguments.limits))
    throw Error(ErrorKind::check_failed, "", fmt::format("{} and {} differ", arguments.a, arguments.b));
  return 0;
}

Action declare_compare(Options& options) {
  auto arguments = std::make_shared<CompareArguments>();
  options.option("A", arguments->a, "image, or pack (folder or pack.json)").required();
  options.option("B", arguments->b, "of the same kind").required();
  options.option("--format", arguments->format, "of the report on stdout (default text)").one_of("text|json");
  options
      .option("--max-difference", arguments->limits.max_difference,
              "alike if no value differs by more: 1/255 for integer images, plain for float")
      .check(number(0, 1e38))
      .value("N");
  options.option("--min-psnr", arguments->limits.min_psnr, "alike from this PSNR on, in dB, -1000 to 1000")
      .check(number(-1000, 1000, " dB"))
      .value("DB");
  options.option("--min-ssim", arguments->limits.min_ssim, "alike from this SSIM on, -1 to 1")
      .check(number(-1, 1))
      .value("S");
  options.option("--picture", arguments->picture, "write the difference, magnified, as a PNG")
      .value("FILE.png");
  options
      .option("--gain", arguments->gain,
              "how much the picture magnifies differences, 0.001 to 1000 (default 8)")
      .check(number(0.001, 1000))
      .value("N");
  add_reading_options(options, arguments->reading);
  return [arguments](Console& console) { return run_compare(*arguments, console); };
}

} // namespace

Verb compare_verb() {
  return {"compare", "measure how far two images or two packs are apart",
          "  tilepack compare before.png after.png --picture difference.png\n"
          "  tilepack compare old.pack new.pack --max-difference 1\n"
          "Exit code 0 if equal, or within all limits given; 5 if not.\n",
          declare_compare};
}

} // namespace tilepack::cli
