#include "jobs.h"
#include "verb.h"

#include "tilepack/error/error.h"

#include <memory>
#include <string>

namespace tilepack::cli {
namespace {

struct BakeArguments {
  std::string sample;
  std::string folder;
  int jobs = 0;
};

int run_bake(const BakeArguments& arguments, Console&) {
  const JobLimit limit(arguments.jobs);
  throw Error(ErrorKind::internal, arguments.sample, "baking is not there yet");
}

Action declare_bake(CLI::App& app) {
  auto arguments = std::make_shared<BakeArguments>();
  app.add_option("SAMPLE", arguments->sample, "image to make tiles from")->required();
  app.add_option("-o,--output", arguments->folder, "folder of the pack")->required()->type_name("DIR");
  add_jobs_option(app, arguments->jobs);
  return [arguments](Console& console) { return run_bake(*arguments, console); };
}

} // namespace

Verb bake_verb() {
  return {"bake", "make a tile pack from a texture sample or a set of material maps",
          "  tilepack bake gravel.png -o gravel.pack --tile-size 128 --colors 2\n", declare_bake};
}

} // namespace tilepack::cli
