#include "support/good_pack.h"

#include "tilepack/check/folder_checks.h"
#include "tilepack/error/error.h"
#include "tilepack/image/image_file.h"
#include "tilepack/pack/pack_write.h"

#include <nlohmann/json.hpp>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <unistd.h>

using namespace tilepack;
using namespace tilepack::test;
namespace fs = std::filesystem;

namespace {

// A good pack on disk, gone when the test ends.
class PackOnDisk {
public:
  explicit PackOnDisk(const Pack& pack = good_pack()) {
    static int number = 0;
    root = fs::temp_directory_path() /
           ("tilepack_check_" + std::to_string(getpid()) + "_" + std::to_string(number++));
    fs::create_directories(root);
    write_pack(pack, folder());
  }
  ~PackOnDisk() {
    std::error_code unused;
    fs::remove_all(root, unused);
  }
  PackOnDisk(const PackOnDisk&) = delete;
  PackOnDisk& operator=(const PackOnDisk&) = delete;

  fs::path folder() const { return root / "pack"; }
  fs::path file(const std::string& name) const { return folder() / name; }
  std::string text(const std::string& name = "pack.json") const {
    std::ifstream stream(file(name), std::ios::binary);
    std::ostringstream all;
    all << stream.rdbuf();
    return all.str();
  }
  void write(const std::string& name, const std::string& content) const {
    std::ofstream(file(name), std::ios::binary) << content;
  }
  void edit(const std::function<void(nlohmann::ordered_json&)>& change) const {
    auto json = nlohmann::ordered_json::parse(text());
    change(json);
    write("pack.json", json.dump());
  }
  Report report() const { return check_folder(folder()); }

private:
  fs::path root;
};

bool caught(const PackOnDisk& pack, Rule rule) {
  const Report report = pack.report();
  UNSCOPED_INFO(listing(report.issues));
  return has(report.issues, rule);
}

} // namespace

TEST_CASE("a good pack on disk has no issues, by its folder and by its pack.json") {
  for (const Depth depth : {Depth::u8, Depth::u16, Depth::f16, Depth::f32}) {
    const PackOnDisk pack(good_pack({.channels = 4, .depth = depth}));
    const Report report = pack.report();
    INFO(listing(report.issues));
    CHECK(report.issues.empty());
    CHECK(report.tiles == 16);
    CHECK(report.levels == 5);
    CHECK(check_folder(pack.file("pack.json")).issues.empty());
  }
}

TEST_CASE("without a pack.json there is nothing to check") {
  CHECK_THROWS_AS(check_folder("/nonexistent"), Error);
  CHECK_THROWS_AS(check_folder(fs::temp_directory_path()), Error);
}

TEST_CASE("faults of pack.json are told apart") {
  const PackOnDisk pack;
  const std::string good = pack.text();
  const auto after = [&](const std::function<void(nlohmann::ordered_json&)>& change, Rule rule) {
    pack.write("pack.json", good);
    pack.edit(change);
    return caught(pack, rule);
  };
  pack.write("pack.json", good.substr(0, good.size() / 2));
  CHECK(caught(pack, Rule::not_json));
  pack.write("pack.json", "");
  CHECK(caught(pack, Rule::not_json));
  CHECK(after([](auto& j) { j.erase("mapping"); }, Rule::field_missing));
  CHECK(after([](auto& j) { j["tile_sizes"] = j["tile_size"]; }, Rule::field_unknown));
  CHECK(after([](auto& j) { j["tile_size"] = "128"; }, Rule::field_type));
  CHECK(after([](auto& j) { j["tile_size"][0] = 0; }, Rule::field_range));
  CHECK(after([](auto& j) { j["tile_size"][0] = 17; }, Rule::fields_disagree));
  CHECK(after([](auto& j) { j["colors"]["vertical"] = 3; }, Rule::fields_disagree));
  CHECK(after([](auto& j) { j["maps"][0]["levels"][2]["file"] = "../../secret.png"; }, Rule::file_outside));
  CHECK(after([](auto& j) { j["maps"][0]["levels"][2]["file"] = "/etc/passwd"; }, Rule::file_outside));
  CHECK(after([](auto& j) { j["maps"][0]["levels"][1]["file"] = "color_0.png"; }, Rule::file_shared));
  CHECK(after([](auto& j) { j["maps"][0]["levels"].erase(4); }, Rule::fields_disagree));
}

TEST_CASE("faults of files are told apart") {
  const PackOnDisk pack;
  const std::string good = pack.text("color_1.png");
  fs::remove(pack.file("color_1.png"));
  CHECK(caught(pack, Rule::file_missing));
  for (const std::string& content :
       {std::string(), std::string("no image"), good.substr(0, good.size() - 20)}) {
    pack.write("color_1.png", content);
    CHECK(caught(pack, Rule::file_unreadable));
  }
  fs::remove(pack.file("color_1.png"));
  write_image(pack.file("color_1.png"), Image(32, 31, 3), Depth::u8, Encoding::srgb);
  CHECK(caught(pack, Rule::file_size));
  write_image(pack.file("color_1.png"), Image(32, 32, 1), Depth::u8, Encoding::srgb);
  CHECK(caught(pack, Rule::file_channels));
  write_image(pack.file("color_1.png"), Image(32, 32, 3), Depth::u16, Encoding::srgb);
  CHECK(caught(pack, Rule::file_depth));
  fs::remove(pack.file("color_1.png"));
  fs::create_symlink("/etc/hostname", pack.file("color_1.png"));
  CHECK(caught(pack, Rule::file_outside));
  fs::remove(pack.file("color_1.png"));
  fs::create_directory(pack.file("color_1.png"));
  CHECK_FALSE(passed(pack.report()));
}

TEST_CASE("an edited texel is found on disk as in memory") {
  const PackOnDisk pack;
  const ImageFile level = read_image(pack.file("color_0.png"));
  Image image = level.image;
  for (float& v : image.texel(5, 0)) v = v > 0.5f ? 0 : 1;
  write_image(pack.file("color_0.png"), image, Depth::u8, Encoding::srgb);
  CHECK(caught(pack, Rule::edge_texels));
}

TEST_CASE("NaN and infinity in an EXR level are found") {
  for (const float value :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    const PackOnDisk pack(good_pack({.depth = Depth::f32}));
    Image image = read_image(pack.file("color_2.exr")).image;
    image.texel(7, 7)[1] = value;
    write_image(pack.file("color_2.exr"), image, Depth::f32, Encoding::linear);
    CHECK(caught(pack, Rule::not_finite));
  }
}

TEST_CASE("stray files are a note") {
  const PackOnDisk pack;
  pack.write("color_0 (copy).png", "x");
  fs::create_directory(pack.file("old"));
  const Report report = pack.report();
  CHECK(passed(report));
  CHECK(count(report.issues).notes == 2);
}

TEST_CASE("many faults are listed in one go") {
  const PackOnDisk pack;
  fs::remove(pack.file("color_1.png"));
  fs::remove(pack.file("color_3.png"));
  pack.write("color_2.png", "");
  pack.write("stray.txt", "");
  pack.edit([](auto& j) {
    j["mapping"]["table"][0] = j["mapping"]["table"][1];
    j["layout"]["cells"][3]["column"] = 0;
  });
  const Report report = pack.report();
  INFO(listing(report.issues));
  for (const Rule rule :
       {Rule::file_missing, Rule::file_unreadable, Rule::file_stray, Rule::table_not_permutation,
        Rule::cell_taken_twice, Rule::cell_empty, Rule::cell_formula})
    CHECK(has(report.issues, rule));
  CHECK(count(report.issues).errors >= 7);
}

TEST_CASE("missing files are found even beside a broken field") {
  const PackOnDisk pack;
  fs::remove(pack.file("color_1.png"));
  pack.edit([](auto& j) {
    j["tiles"][3]["north"] = "two";
    j["generator"]["seeds"] = 1;
  });
  const Report report = pack.report();
  CHECK(has(report.issues, Rule::file_missing));
  CHECK(has(report.issues, Rule::field_type));
  CHECK(has(report.issues, Rule::field_unknown));
}

TEST_CASE("an index map is checked cell by cell") {
  Pack pack = good_pack();
  pack.mapping = {MappingKind::index, {3, 2}, {}, 0, {0, 0, 0, 0, 0, 0}};
  const PackOnDisk folder(pack);
  CHECK(folder.report().issues.empty());
  const auto write_ids = [&](const std::vector<int>& ids) {
    Image image(3, 2, 1);
    for (std::size_t i = 0; i < ids.size(); ++i) image.data()[i] = static_cast<float>(ids[i]) / 255.0f;
    write_image(folder.file("index.png"), image, Depth::u8, Encoding::linear);
  };
  write_ids({0, 0, 99, 0, 0, 0});
  CHECK(caught(folder, Rule::index_id));
  write_ids({0, 1, 0, 0, 0, 0});
  CHECK(caught(folder, Rule::index_colors));
  fs::remove(folder.file("index.png"));
  CHECK(caught(folder, Rule::file_missing));
  CHECK_FALSE(has(folder.report().issues, Rule::index_size));
}
