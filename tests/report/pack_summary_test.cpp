#include "support/good_pack.h"

#include "tilepack/measure/pack_memory.h"
#include "tilepack/report/pack_summary.h"

#include <nlohmann/json.hpp>

#include <catch2/catch.hpp>

using namespace tilepack;
using namespace tilepack::test;

namespace {

PackSummary summary_of(const Pack& pack) {
  PackSummary summary{"gravel.pack", described(pack), {}, {}};
  std::uint64_t bytes = 100;
  for (const std::string& file : summary.description.all_files()) summary.file_bytes[file] = bytes++;
  return summary;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("memory counts every level of every map at the depth it is stored in") {
  // 16 tiles of 16 x 16 in a texture of 64 x 64, whose levels are quarters of each other down to a texel a tile.
  const std::uint64_t texels = 64 * 64 + 32 * 32 + 16 * 16 + 8 * 8 + 4 * 4;
  for (const auto& [depth, bytes] : {std::pair{Depth::u8, 1}, std::pair{Depth::u16, 2},
                                     std::pair{Depth::f16, 2}, std::pair{Depth::f32, 4}}) {
    const Pack pack = good_pack({.channels = 3, .depth = depth});
    CHECK(bytes_in_memory(pack, described(pack)) == texels * 3 * static_cast<std::uint64_t>(bytes));
  }
}

TEST_CASE("a texture stored whole is as much larger than the pack as it has more tiles") {
  Pack pack = good_pack({});
  pack.mapping.size = {4, 4};
  const auto packed = static_cast<double>(bytes_in_memory(pack, described(pack)));
  CHECK(bytes_stored_whole(pack) == Approx(packed));
  pack.mapping.size = {std::int64_t{1} << 31, std::int64_t{1} << 31};
  CHECK(bytes_stored_whole(pack) == Approx(packed * 0x1p58));
}

TEST_CASE("the summary in text names what a pack holds") {
  const Pack pack = good_pack({});
  const PackSummary summary = summary_of(pack);
  const std::string text = summary_text(summary);
  CHECK(text.rfind("gravel.pack\n", 0) == 0);
  CHECK(has(text, "16 of 16 x 16 texels, 2 horizontal and 2 vertical edge colors"));
  CHECK(has(text, "cells: tile id, colors north east south west"));
  CHECK(has(text, "in " + std::to_string(summary.file_bytes.size()) + " files"));
  CHECK_FALSE(has(text, "borders")); // not measured
  CHECK_FALSE(has(text, "synthesis"));
}

TEST_CASE("the summary in JSON tells the same, and null where a file is missing") {
  const Pack pack = good_pack({});
  PackSummary summary = summary_of(pack);
  summary.seams = seam_figures(pack, 0, 0, 2);
  const std::string gone = summary.description.map_files[0][1].file;
  summary.file_bytes.erase(gone);
  const auto json = nlohmann::json::parse(summary_json(summary));
  CHECK(json["pack"] == "gravel.pack");
  CHECK(json["tiles"].size() == 16);
  CHECK(json["tiles"][3]["id"] == 3);
  CHECK(json["tiles"][3].contains("column"));
  CHECK(json["maps"][0]["levels"][1]["file"] == gone);
  CHECK(json["maps"][0]["levels"][1]["bytes"].is_null());
  CHECK(json["bytes"]["files"] == bytes_on_disk(summary));
  CHECK(json["bytes"]["memory"] == bytes_in_memory(pack, summary.description));
  CHECK(json["seams"]["worst"].size() == 2);
  CHECK_FALSE(json.contains("corner_pack"));
}

TEST_CASE("what bake says in JSON lists its files, pack.json last") {
  const Pack pack = good_pack({});
  const auto json = nlohmann::json::parse(made_json(described(pack), "out/gravel"));
  CHECK(json["pack"] == "out/gravel");
  CHECK(json["files"].size() == described(pack).all_files().size() + 1);
  CHECK(json["files"].back() == "pack.json");
  CHECK_FALSE(json.contains("verdict"));
}
