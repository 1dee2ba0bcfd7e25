#include "tilepack/bake/bake_fields.h"
#include "tilepack/bake/preset.h"
#include "tilepack/error/error.h"

#include <catch2/catch.hpp>
#include <map>
#include <set>

using namespace tilepack;
using Catch::Matchers::Contains;

namespace {

BakeOptions with(const std::string& field, const std::string& value) {
  const BakeSetting setting{field, value, "--" + field, ErrorKind::usage};
  return bake_options({&setting, 1});
}

std::string fault(const std::string& field, const std::string& value) {
  try {
    with(field, value);
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::usage);
    return error.what();
  }
  return "";
}

// Values each field takes, and values it does not.
struct Values {
  std::vector<std::string> good;
  std::vector<std::string> bad;
};

const std::map<std::string, Values> values_of_fields{
    {"tile-size",
     {{"4", "4096", "96x64", "auto"},
      {"3", "4097", "0", "-5", "128x", "x128", "1x2x3", "128 ", "1e3", "", "Auto"}}},
    {"straighten", {{"false"}, {"yes", "", "0"}}},
    {"flatten", {{"1", "100"}, {"-1", "101", "50%", "0.5", ""}}},
    {"coloring", {{"edge", "corner"}, {"", "edges", "Edge"}}},
    {"colors", {{"1", "8", "3x2"}, {"0", "9", "2x9", "-1", "two", "1.5"}}},
    {"set", {{"complete", "sequential"}, {"small", ""}}},
    {"scheme",
     {{"1,0", "2,1", "3,3,2", "64,0"},
      {"", "2", "1,2", "0,0", "2,1,0", "2,1,3", "2,1,1,1", "65,0", "2x1", "2,-1", "2,,1", "2,1,"}}},
    {"gutter", {{"0", "4096"}, {"-1", "4097"}}},
    {"power-of-two", {{"true", "false"}, {"1", ""}}},
    {"turn-filter", {{"bilinear", "bicubic", "lanczos"}, {"Lanczos", "nearest"}}},
    {"border", {{"0", "3", "2048"}, {"-1", "2049", "1x1"}}},
    {"interior", {{"patch", "quilt"}, {"none"}}},
    {"guard", {{"0", "512"}, {"-1", "513", "1x1", "99999999999999999999"}}},
    {"effort", {{"0", "9"}, {"10", "-1", "high"}}},
    {"seed", {{"0", "9007199254740991"}, {"-1", "9007199254740992", "18446744073709551616", "0x10"}}},
    {"layout", {{"tile-index", "de-bruijn", "rotated", "array"}, {"debruijn", ""}}},
    {"corner-pack", {{"true", "false"}, {"yes", "1", ""}}},
    {"full-mips", {{"true"}, {"1", "yes"}}}, // false is not recorded,
    {"mips", {{"none", "box", "edges", "corners", "least-squares"}, {"least_squares", "edge"}}},
    {"jump-weight", {{"0", "1000"}, {"-1", "1001", "0.5"}}},
    {"roughness-from-normals", {{"true", "false"}, {"on", "0"}}},
    {"alpha-coverage", {{"0", "100"}, {"-1", "101", "50%"}}},
    {"variants", {{"2", "8"}, {"0", "9", "2x2"}}},
    {"normal-y", {{"up", "down"}, {"", "left", "Up", "gl"}}},
    {"height-range",
     {{"0,1", "-2.5,18", "auto"},
      {"", "5", "1,1", "2,1", "a,b", "1,2,3", "nan,1", "0,inf", "0, 1", "0,1e31"}}},
    {"mapping", {{"permutation", "mix", "even", "index"}, {"hash"}}},
    {"virtual-size", {{"1", "2147483648", "5x7"}, {"0", "2147483649", "-1x4"}}},
    {"wraps", {{"yes", "no"}, {"true", ""}}}, // auto is not recorded
    {"image-format", {{"png", "exr"}, {"jpg", "PNG"}}},
    {"depth", {{"u8", "u16", "f16", "f32"}, {"8", "u32"}}},
};

} // namespace

TEST_CASE("every field takes its values, gives them back and refuses others", "[pack]") {
  std::set<std::string> names;
  for (const BakeField& field : bake_fields()) {
    INFO(field.name);
    CHECK(names.insert(field.name).second);
    CHECK_FALSE(field.help.empty());
    REQUIRE(values_of_fields.count(field.name) == 1);
    const Values& values = values_of_fields.at(field.name);
    for (const std::string& value : values.good) CHECK(field.get(with(field.name, value)) == value);
    for (const std::string& value : values.bad) {
      INFO("'" << value << "'");
      CHECK_THAT(fault(field.name, value), Contains("--" + field.name) && Contains("'" + value + "'"));
    }
  }
  CHECK(names.size() == values_of_fields.size());
}

TEST_CASE("choices are listed where one is refused", "[pack]") {
  CHECK(fault("coloring", "edges") ==
        "--coloring: 'edges' is not allowed; it must be edge|corner; did you mean 'edge'?");
  CHECK(fault("flatten", "150") ==
        "--flatten: '150' is not allowed; it must be a whole number of 0 to 100, or auto");
  CHECK(fault("effort", "10") == "--effort: '10' is not allowed; it must be a whole number of 0 to 9");
}

TEST_CASE("the last of several settings wins, and coloring decides what colors mean", "[pack]") {
  const std::vector<BakeSetting> settings{{"colors", "3", "", ErrorKind::usage},
                                          {"coloring", "edge", "", ErrorKind::usage},
                                          {"coloring", "corner", "", ErrorKind::usage}};
  const BakeOptions options = bake_options(settings);
  CHECK(options.synth.colors == ColorCounts{0, 0, 3});
  CHECK(options.layout == LayoutKind::de_bruijn);
  CHECK(with("coloring", "corner").synth.colors == ColorCounts{0, 0, 2});
  CHECK(with("colors", "3x2").synth.colors == ColorCounts{3, 2, 0});
  const std::vector<BakeSetting> with_variants{{"variants", "2", "", ErrorKind::usage},
                                               {"colors", "3", "", ErrorKind::usage}};
  CHECK(bake_options(with_variants).synth.colors == ColorCounts{0, 0, 3, 2});
  const BakeSetting many[] = {settings[2], {"colors", "5", "--colors", ErrorKind::usage}};
  CHECK_THROWS_AS(bake_options(many), Error); // corners have at most 4
}

TEST_CASE("recorded options make the same options again", "[pack]") {
  const std::vector<BakeSetting> settings{{"tile-size", "96x64", "", ErrorKind::usage},
                                          {"colors", "3x2", "", ErrorKind::usage},
                                          {"depth", "u16", "", ErrorKind::usage},
                                          {"seed", "7", "", ErrorKind::usage}};
  const auto recorded = recorded_options(bake_options(settings));
  std::vector<BakeSetting> again;
  for (const auto& [name, value] : recorded) {
    CHECK(name != "seed");         // stands beside the options
    CHECK(name != "image-format"); // was not set
    CHECK(name != "flatten");
    again.push_back({name, value, "", ErrorKind::usage});
  }
  CHECK(recorded_options(bake_options(again)) == recorded);
  CHECK(bake_options(again).synth.tile_size == Size{96, 64});
}

TEST_CASE("built-in presets are sound", "[pack]") {
  std::set<std::string> names;
  for (const Preset& preset : built_in_presets()) {
    names.insert(preset.name);
    CHECK(preset.purpose.size() > 10);
    CHECK(preset.cost.size() > 10);
    CHECK_NOTHROW(bake_options(preset.settings));
  }
  for (const char* name : {"preview", "default", "terrain", "wall", "hero"}) CHECK(names.count(name) == 1);
}

TEST_CASE("presets name the key, the value and the range", "[pack]") {
  const auto preset_fault = [](const std::string& text) -> std::string {
    try {
      parsed_preset(text, "mine", "mine.json");
    } catch (const Error& error) {
      CHECK(error.kind() == ErrorKind::invalid_content);
      return error.what();
    }
    return "";
  };
  const std::string head = R"({"purpose": "p", "cost": "c", )";
  CHECK(preset_fault(head + R"("tile-size": 64, "colors": "2x3", "corner-pack": false, "mips": "box"})") ==
        "");
  CHECK_THAT(preset_fault(head + R"("tile-sise": 64})"), Contains("did you mean \"tile-size\""));
  CHECK(preset_fault(head + R"("effort": 12})") ==
        "mine.json: \"effort\": '12' is not allowed; it must be a whole number of 0 to 9");
  CHECK_THAT(preset_fault(head + R"("effort": "5"})"), Contains("mine.json: effort"));
  CHECK_THAT(preset_fault(head + R"("tile-size": true})"), Contains("mine.json: tile-size"));
  CHECK_THAT(preset_fault(head + R"("corner-pack": "true"})"), Contains("must be true or false"));
  CHECK_THAT(preset_fault(head + R"("mips": 3})"), Contains("must be a text"));
  CHECK(
      preset_fault(R"({"cost": "c", "effort": 3, "format": "exr"})").empty()); // what is not said need not be
  CHECK_THAT(preset_fault("[]"), Contains("must be an object"));
}

TEST_CASE("colors are of corners unless something asks for edges") {
  const auto coloring = [](const std::string& field, const std::string& value) {
    return with(field, value).synth.coloring;
  };
  CHECK(bake_options({}).synth.coloring == Coloring::corner);
  CHECK(bake_options({}).layout == LayoutKind::de_bruijn);
  BakeOptions usual;
  usual.fit_tile_size = true;
  usual.fit_flatten = true;
  CHECK(recorded_options(usual) == recorded_options(bake_options({})));
  for (const auto& [field, value] : {std::pair{"colors", "3"}, {"layout", "array"}, {"corner-pack", "false"}})
    CHECK(coloring(field, value) == Coloring::corner);
  for (const auto& [field, value] : {std::pair{"colors", "2x3"},
                                     {"colors", "5"},
                                     {"layout", "tile-index"},
                                     {"corner-pack", "true"},
                                     {"set", "sequential"},
                                     {"interior", "quilt"},
                                     {"coloring", "edge"}})
    CHECK(coloring(field, value) == Coloring::edge);
}
