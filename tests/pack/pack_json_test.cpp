#include "support/noise_pack.h"

#include "tilepack/error/error.h"
#include "tilepack/mip/far_levels.h"
#include "tilepack/pack/map_meaning.h"
#include "tilepack/pack/pack_json.h"
#include "tilepack/tileset/limits.h"

#include <nlohmann/json.hpp>

#include <catch2/catch.hpp>
#include <functional>

using namespace tilepack;
using nlohmann::json;

namespace {

const MappingKind all_mappings[] = {MappingKind::permutation, MappingKind::mix, MappingKind::even,
                                    MappingKind::index};

bool accepted(const json& changed) {
  try {
    parsed_pack_json(changed.dump(), "pack.json");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::invalid_content);
    return false;
  }
  return true;
}

// Every value of a document, by its JSON pointer.
std::vector<json::json_pointer> places(const json& document) {
  std::vector<json::json_pointer> list;
  const json flat = document.flatten();
  for (const auto& [pointer, value] : flat.items()) {
    json::json_pointer p(pointer);
    for (; !p.empty(); p.pop_back()) list.push_back(p);
  }
  std::sort(list.begin(), list.end(),
            [](const auto& a, const auto& b) { return a.to_string() < b.to_string(); });
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

// Where any text is as good as another.
bool is_free_text(const std::string& place) {
  return place.rfind("/generator/options/", 0) == 0 || place == "/generator/name" ||
         place == "/generator/version";
}

void check_same_map(const PackedMap& read, const PackedMap& written) {
  CHECK(static_cast<const MapFormat&>(read) == written);
  CHECK(read.channels == written.channels);
  CHECK(read.round_trips == written.round_trips);
  CHECK(read.stored() == written.stored());
}

// But for what lies in images. A field that Pack gets is to be compared here too: without it nothing compiles.
void check_same(const Pack& read, const Pack& written) {
  const auto& [generator, tile_size, colors, tiles, layout, maps, mapping, corner_pack, mip_mode, jump_weight,
               guard, tile_levels, full_chain, materials, synthesis] = written;
  CHECK(read.generator.name == generator.name);
  CHECK(read.generator.version == generator.version);
  CHECK(read.generator.options == generator.options);
  CHECK(read.generator.seed == generator.seed);
  CHECK(read.tile_size == tile_size);
  CHECK(read.colors == colors);
  CHECK(read.tiles == tiles);
  CHECK(read.layout == layout);
  REQUIRE(read.maps.size() == maps.size());
  for (std::size_t m = 0; m < maps.size(); ++m) check_same_map(read.maps[m], maps[m]);
  CHECK(read.mapping.kind == mapping.kind);
  CHECK(read.mapping.size == mapping.size);
  CHECK(read.mapping.table == mapping.table);
  CHECK(read.mapping.seed == mapping.seed);
  CHECK(read.mapping.variants == mapping.variants);
  REQUIRE(read.corner_pack.has_value() == corner_pack.has_value());
  if (corner_pack) {
    CHECK(read.corner_pack->columns == corner_pack->columns);
    CHECK(read.corner_pack->rows == corner_pack->rows);
    CHECK(read.corner_pack->width == corner_pack->width);
    REQUIRE(read.corner_pack->maps.size() == corner_pack->maps.size());
    for (std::size_t m = 0; m < corner_pack->maps.size(); ++m)
      check_same_map(read.corner_pack->maps[m], corner_pack->maps[m]);
  }
  CHECK(read.mip_mode == mip_mode);
  CHECK(read.jump_weight == jump_weight);
  CHECK(read.guard == guard);
  CHECK(read.tile_levels == tile_levels);
  CHECK(read.full_chain == full_chain);
  CHECK(read.materials == materials);
  CHECK(read.synthesis == synthesis);
}

void check_comes_back(const Pack& pack) {
  check_same(parsed_pack_json(pack_json(described(pack)), "pack.json").pack, pack);
}

// Whatever may be left out, as far as coloring and layout let it be there.
void fill_optional_fields(Pack& pack) {
  pack.mip_mode = MipMode::least_squares;
  pack.jump_weight = 7;
  pack.guard = 1;
  pack.full_chain = true;
  pack.synthesis = SetFigures{};
  for (const SetFigureField& field : set_figure_fields) (*pack.synthesis).*field.value = 0.5;
  pack.maps[0].role = Role::data;
  pack.maps[0].contents = {ChannelContent::ao, ChannelContent::roughness, ChannelContent::metallic};
  pack.maps[1].range = ValueRange{-2, 3};
  for (PackedMap& map : pack.maps)
    for (const Size size : far_level_sizes(pack.layout, pack.tile_size, pack.tile_levels))
      map.far_levels.emplace_back(size.width, size.height, map.channels);
}

// Of a pack with two colors of edges.
CornerPack corner_pack_for(const Pack& pack) {
  Layout grid;
  grid.columns = grid.rows = 4;
  CornerPack corners{grid.columns, grid.rows, 1.5, pack.maps};
  for (PackedMap& map : corners.maps) {
    map.levels.clear();
    map.far_levels.clear();
    for (int level = 0; level < pack.tile_levels; ++level) {
      const Size size = texture_size(grid, pack.tile_size, level);
      map.levels.emplace_back(size.width, size.height, map.channels);
    }
    for (const Size size : far_level_sizes(grid, pack.tile_size, pack.tile_levels))
      map.far_levels.emplace_back(size.width, size.height, map.channels);
  }
  return corners;
}

} // namespace

TEST_CASE("every field of a pack is written and read back, optional ones too", "[pack]") {
  for (const MappingKind mapping : all_mappings)
    for (const int variants : {1, 3}) {
      Pack pack = test::noise_pack(mapping, Depth::u16, 5, variants);
      check_comes_back(pack);
      fill_optional_fields(pack);
      if (coloring_of(pack.tiles) == Coloring::edge)
        pack.corner_pack = corner_pack_for(pack);
      else
        pack.materials = {"pebbles", "sand"};
      check_comes_back(pack);
      pack.maps[0].role = Role::normal;
      pack.maps[0].contents.clear();
      pack.maps[0].normal_y = NormalY::down;
      if (pack.corner_pack) pack.corner_pack = corner_pack_for(pack);
      check_comes_back(pack);
    }
  Pack plain = test::noise_pack();
  for (PackedMap& map : plain.maps) map.levels.resize(1);
  plain.mip_mode = MipMode::none;
  plain.tile_levels = 1;
  check_comes_back(plain);
}

TEST_CASE("text and description are two forms of one thing", "[pack]") {
  for (const MappingKind mapping : all_mappings) {
    const PackDescription first = described(test::noise_pack(mapping));
    const std::string text = pack_json(first);
    const PackDescription second = parsed_pack_json(text, "pack.json");
    CHECK(pack_json(second) == text);
    CHECK(second.all_files() == first.all_files());
    CHECK(second.pack.tiles == first.pack.tiles);
    CHECK(second.pack.layout == first.pack.layout);
    CHECK(second.pack.mapping.table == first.pack.mapping.table);
    CHECK(second.pack.mapping.size == first.pack.mapping.size);
    CHECK(second.pack.mapping.seed == first.pack.mapping.seed);
    CHECK(text.back() == '\n');
  }
}

TEST_CASE("variants are written where there are several, and only complete sets have them", "[pack]") {
  CHECK_FALSE(json::parse(pack_json(described(test::noise_pack()))).contains("variants"));
  for (const MappingKind mapping : all_mappings) {
    const PackDescription first = described(test::noise_pack(mapping, Depth::u8, 1, 3));
    const std::string text = pack_json(first);
    const PackDescription second = parsed_pack_json(text, "pack.json");
    CHECK(pack_json(second) == text);
    CHECK(second.pack.colors.variants == 3);
    CHECK(second.pack.mapping.variants == first.pack.mapping.variants);
    const json good = json::parse(text);
    for (const int variants : {1, 2, 4, 9}) {
      json other = good;
      other["variants"] = variants;
      CHECK_FALSE(accepted(other));
    }
    json swapped = good; // an index map too: ids past the first combinations are variants by their place
    std::swap(swapped["tiles"][20], swapped["tiles"][21]);
    swapped["tiles"][20]["id"] = 20;
    swapped["tiles"][21]["id"] = 21;
    CHECK_FALSE(accepted(swapped));
  }
  json even = json::parse(pack_json(described(test::noise_pack(MappingKind::even, Depth::u8, 1, 3))));
  even["mapping"]["variants"][5] = std::string(64, '3');
  CHECK_FALSE(accepted(even));
  even["mapping"].erase("variants");
  CHECK_FALSE(accepted(even));
  json one = json::parse(pack_json(described(test::noise_pack(MappingKind::even))));
  one["mapping"]["variants"] = one["mapping"]["pattern"];
  CHECK_FALSE(accepted(one));
}

TEST_CASE("materials are a name a corner color, and edges have none", "[pack]") {
  Pack pack = test::noise_pack(MappingKind::even);
  CHECK_FALSE(json::parse(pack_json(described(pack))).contains("materials"));
  pack.materials = {"pebbles", "sand"};
  const std::string text = pack_json(described(pack));
  const PackDescription again = parsed_pack_json(text, "pack.json");
  CHECK(again.pack.materials == pack.materials);
  CHECK(pack_json(again) == text);
  const json good = json::parse(text);
  for (const json& names :
       {json{"pebbles"}, json{"pebbles", "sand", "moss"}, json{"sand", "sand"}, json{"sand", ""},
        json{"sand", "a b"}, json{"sand", 1}, json("sand"), json::array()}) {
    json other = good;
    other["materials"] = names;
    CHECK_FALSE(accepted(other));
  }
  json four = good;
  four["colors"]["corner"] = 4;
  four["tiles"] = json::array();
  const TileColors tiles = complete_set({0, 0, 4, 1});
  for (const CornerTile& t : std::get<std::vector<CornerTile>>(tiles))
    four["tiles"].push_back(
        {{"id", four["tiles"].size()}, {"nw", t.nw}, {"ne", t.ne}, {"sw", t.sw}, {"se", t.se}});
  for (const json& names : {json{"a", "a", "a", "b"}, json{"a", "b", "a", "b"}, json{"a", "a", "a", "a"}}) {
    four["materials"] = names; // refused for the names, before the layout is looked at
    try {
      parsed_pack_json(four.dump(), "pack.json");
      FAIL("accepted " + names.dump());
    } catch (const Error& error) {
      CHECK(error.message(FieldSpelling::option).find("materials") != std::string::npos);
    }
  }
  json edges = json::parse(pack_json(described(test::noise_pack())));
  edges["materials"] = json{"pebbles", "sand"};
  CHECK_FALSE(accepted(edges));
}

TEST_CASE("files are named after maps and levels", "[pack]") {
  const PackDescription d = described(test::noise_pack(MappingKind::index, Depth::f16));
  CHECK(d.all_files() == std::vector<std::string>{"color_0.png", "color_1.png", "color_2.png", "height_0.exr",
                                                  "height_1.exr", "height_2.exr", "index.png"});
  CHECK(d.map_files[0][1] == TextureFile{"color_1.png", {{16, 8}}, 1});
}

TEST_CASE("every field is needed, and none may be added", "[pack]") {
  for (const MappingKind mapping : all_mappings) {
    const json good = json::parse(pack_json(described(test::noise_pack(mapping))));
    REQUIRE(accepted(good));
    for (const auto& place : places(good)) {
      const std::string name = place.to_string();
      INFO(name);
      if (name.rfind("/generator/options/", 0) == 0) continue;
      json without = good;
      auto& parent = without[place.parent_pointer()];
      if (parent.is_object())
        parent.erase(place.back());
      else
        parent.erase(static_cast<std::size_t>(std::stoi(place.back())));
      // A shorter table is a table still, and one map fewer a pack.
      const bool is_optional =
          name.rfind("/mapping/table/", 0) == 0 || name == "/maps/0" || name == "/maps/1";
      if (!is_optional) CHECK_FALSE(accepted(without));
      if (good[place].is_object() && name != "/generator/options") {
        json with = good;
        with[place]["extra"] = 1;
        CHECK_FALSE(accepted(with));
      }
    }
    json with = good;
    with["extra"] = 1;
    CHECK_FALSE(accepted(with));
  }
}

TEST_CASE("values of another type or far out of range are refused at every place", "[pack]") {
  const json wrong[] = {
      nullptr,       true,          -1, 1.5, 1e300, 18446744073709551615u, "", "no\\such word", "../up.png",
      json::array(), json::object()};
  for (const MappingKind mapping : all_mappings) {
    const json good = json::parse(pack_json(described(test::noise_pack(mapping))));
    for (const auto& place : places(good)) {
      const std::string name = place.to_string();
      for (const json& value : wrong) {
        INFO(name << " = " << value);
        if (value.is_string() && is_free_text(name)) continue;
        if (value == json::object() && name == "/generator/options") continue;
        json changed = good;
        changed[place] = value;
        CHECK_FALSE(accepted(changed));
      }
    }
  }
}

TEST_CASE("fields that contradict each other are refused", "[pack]") {
  const json good = json::parse(pack_json(described(test::noise_pack())));
  const auto changed = [&](const char* place, const json& value) {
    json other = good;
    other[json::json_pointer(place)] = value;
    return accepted(other);
  };
  REQUIRE(changed("/tile_size", good["tile_size"]));
  CHECK_FALSE(changed("/tile_size", {4, 4}));                            // levels have other sizes
  CHECK_FALSE(changed("/coloring", "corner"));                           // tiles have edges
  CHECK_FALSE(changed("/colors", {{"horizontal", 3}, {"vertical", 2}})); // the set is no longer complete
  CHECK_FALSE(changed("/tiles/0/north", 1));                             // two tiles alike
  CHECK_FALSE(changed("/tiles/1/id", 2));                                // ids count up
  CHECK_FALSE(changed("/layout/cells/3/tile", 4));                       // a tile twice
  CHECK_FALSE(changed("/layout/columns", 3));                            // a cell outside
  CHECK_FALSE(changed("/layout/columns", 5));                            // images of another width
  CHECK_FALSE(changed("/maps/0/levels/1/file", "color_0.png"));          // a file twice
  CHECK_FALSE(changed("/maps/0/levels/1/file", "pack.json"));
  CHECK_FALSE(changed("/maps/1/name", "color")); // a name twice
  CHECK_FALSE(changed("/maps/0/levels/0/size", {16, 32}));
  CHECK_FALSE(changed("/mips/tile_levels", 2));
  CHECK_FALSE(changed("/mips/filter", "none"));
  CHECK_FALSE(changed("/mapping/table/0", good["mapping"]["table"].size())); // beyond its own length
  CHECK_FALSE(changed("/format", "tilepac"));
  CHECK_FALSE(changed("/version", 2));
}

TEST_CASE("a full chain is read back, and held to its sizes", "[pack]") {
  Pack pack = test::noise_pack();
  pack.full_chain = true;
  for (PackedMap& map : pack.maps)
    for (const Size size : far_level_sizes(pack.layout, pack.tile_size, pack.tile_levels))
      map.far_levels.emplace_back(size.width, size.height, map.channels);
  const json good = json::parse(pack_json(described(pack)));
  const std::size_t levels = good["maps"][0]["levels"].size();
  CHECK(good["mips"]["full_chain"] == true);
  CHECK(levels == pack.maps[0].levels.size() + pack.maps[0].far_levels.size());
  CHECK(good["maps"][0]["levels"].back()["size"] == json({1, 1}));
  CHECK(parsed_pack_json(good.dump(), "pack.json").pack.full_chain);
  CHECK_FALSE(json::parse(pack_json(described(test::noise_pack())))["mips"].contains("full_chain"));
  const auto changed = [&](const std::string& place, const json& value) {
    json other = good;
    other[json::json_pointer(place)] = value;
    return accepted(other);
  };
  REQUIRE(changed("/tile_size", good["tile_size"]));
  CHECK_FALSE(changed("/mips/full_chain", false)); // too many levels
  CHECK_FALSE(changed("/mips/full_chain", 1));
  CHECK_FALSE(changed("/maps/0/levels/" + std::to_string(levels - 1) + "/size", {2, 1}));
  json short_of_one = good;
  short_of_one["maps"][1]["levels"].erase(levels - 1);
  CHECK_FALSE(accepted(short_of_one));
}

TEST_CASE("what values stand for is kept, and is for maps of one role", "[pack]") {
  using enum ChannelContent;
  Pack pack = test::noise_pack();
  REQUIRE(pack.maps.size() == 2); // color and height
  pack.maps[1].range = ValueRange{-0.1, 1234.5};
  CHECK(parsed_pack_json(pack_json(described(pack)), "pack.json").pack.maps[1].range ==
        ValueRange{-0.1, 1234.5});
  pack.maps[0].role = Role::normal;
  pack.maps[0].normal_y = NormalY::down;
  CHECK(parsed_pack_json(pack_json(described(pack)), "pack.json").pack.maps[0].normal_y == NormalY::down);
  pack.maps[0].normal_y.reset();
  pack.maps[0].role = Role::data;
  pack.maps[0].contents = {ao, roughness, metallic};
  const std::string text = pack_json(described(pack));
  const PackDescription again = parsed_pack_json(text, "pack.json");
  CHECK(again.pack.maps[0].contents == pack.maps[0].contents);
  CHECK(pack_json(again) == text);
  CHECK(meaning_text(again.pack.maps[0]) == "R ao, G roughness, B metallic");
  CHECK(meaning_text(again.pack.maps[1]) == "0 to 1 stand for -0.1 to 1234.5");
  CHECK(meaning_text({"normal", Role::normal, Encoding::linear, Depth::u8, {}, NormalY::down}) ==
        "green down");

  const json good = json::parse(text);
  const auto changed = [&](const char* place, const json& value) {
    json other = good;
    other[json::json_pointer(place)] = value;
    return accepted(other);
  };
  REQUIRE(changed("/maps/1/range", {0, 1}));
  CHECK_FALSE(changed("/maps/1/range", {1, 1}));
  CHECK_FALSE(changed("/maps/1/range", {2, 1}));
  CHECK_FALSE(changed("/maps/1/range", {0}));
  CHECK_FALSE(changed("/maps/1/range", {0, 1e31}));
  CHECK_FALSE(changed("/maps/0/range", {0, 1})); // of no height
  CHECK_FALSE(changed("/maps/0/contents", {"ao", "roughness"}));
  CHECK_FALSE(changed("/maps/0/contents", {"ao", "roughness", "dirt"}));
  CHECK_FALSE(changed("/maps/1/contents", {"height"}));
  CHECK_FALSE(changed("/maps/0/normal_y", "up"));
  CHECK_FALSE(changed("/maps/0/role", "occlusion"));
}

TEST_CASE("figures of the synthesis are optional, and all or none", "[pack]") {
  Pack pack = test::noise_pack();
  CHECK(pack_json(described(pack)).find("synthesis") == std::string::npos);
  SetFigures figures;
  double next = 0.0625;
  for (const SetFigureField& field : set_figure_fields) figures.*field.value = next += 0.03125;
  pack.synthesis = figures;
  const std::string text = pack_json(described(pack));
  const PackDescription again = parsed_pack_json(text, "pack.json");
  REQUIRE(again.pack.synthesis);
  CHECK(*again.pack.synthesis == figures);
  CHECK(pack_json(again) == text);

  const json good = json::parse(text);
  REQUIRE(good["synthesis"].size() == set_figure_fields.size());
  for (const auto& [name, value] : good["synthesis"].items()) {
    INFO(name);
    for (const json& wrong : {json(nullptr), json(true), json("1"), json(-0.5), json(1e300), json::array()}) {
      json changed = good;
      changed["synthesis"][name] = wrong;
      CHECK_FALSE(accepted(changed));
    }
    json without = good;
    without["synthesis"].erase(name);
    CHECK_FALSE(accepted(without));
  }
  json extra = good;
  extra["synthesis"]["extra"] = 1;
  CHECK_FALSE(accepted(extra));
}

TEST_CASE("sizes that multiply past the limits are refused before any memory is taken", "[pack]") {
  json huge = json::parse(pack_json(described(test::noise_pack())));
  huge["tile_size"] = {limits::largest_tile_side, limits::largest_tile_side};
  huge["layout"]["columns"] = 5; // 4 would just be allowed
  huge["mips"]["tile_levels"] = 1;
  for (auto& map : huge["maps"]) map["levels"] = {{{"file", map["name"]}, {"size", {20480, 16384}}}};
  CHECK_FALSE(accepted(huge));
  huge["layout"]["columns"] = huge["layout"]["rows"] = 4096;
  for (auto& map : huge["maps"]) map["levels"][0]["size"] = {16777216, 16777216};
  CHECK_FALSE(accepted(huge));
  json cells = json::parse(pack_json(described(test::noise_pack(MappingKind::index))));
  cells["mapping"]["virtual_size"] = {65536, 65536};
  CHECK_FALSE(accepted(cells));
}
