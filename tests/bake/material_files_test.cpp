#include "tilepack/bake/material_files.h"
#include "tilepack/error/error.h"

#include <algorithm>
#include <catch2/catch.hpp>

using namespace tilepack;
using Catch::Matchers::Contains;

namespace {

// "name:role:file" of what was recognised.
std::vector<std::string> recognised(const std::vector<std::string>& names, const std::string& prefix = "") {
  std::vector<std::string> list;
  for (const MaterialFile& f : material_files(names, prefix, "folder"))
    list.push_back(f.name + ":" + std::string(name_of(f.role)) + ":" + f.file);
  return list;
}

std::string fault(const std::vector<std::string>& names, const std::string& prefix = "") {
  try {
    material_files(names, prefix, "folder");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::invalid_content);
    return error.what();
  }
  return "";
}

using List = std::vector<std::string>;

} // namespace

TEST_CASE("maps are recognised by their endings, color first", "[pack]") {
  CHECK(recognised({"rock_ao.png", "rock_height.exr", "rock_rough.jpg", "rock_normal.png", "rock_albedo.png",
                    "rock_notes.txt", "rock_preview.png", "readme.md"}) ==
        List{"color:color:rock_albedo.png", "normal:normal:rock_normal.png",
             "roughness:roughness:rock_rough.jpg", "height:height:rock_height.exr", "ao:data:rock_ao.png"});
}

TEST_CASE("the order in which files are listed does not matter", "[pack]") {
  List names{"a_col.png", "a_orm.png", "a_metallic.tif", "a_nor.png", "a_disp.png"};
  const List expected = recognised(names);
  std::sort(names.begin(), names.end());
  do CHECK(recognised(names) == expected);
  while (std::next_permutation(names.begin(), names.end()));
}

TEST_CASE("the habits of different libraries are known", "[pack]") {
  CHECK(recognised({"rocky_trail_diff_4k.jpg", "rocky_trail_nor_gl_4k.exr", "rocky_trail_nor_dx_4k.exr",
                    "rocky_trail_arm_4k.jpg"}) == List{"color:color:rocky_trail_diff_4k.jpg",
                                                       "normal:normal:rocky_trail_nor_gl_4k.exr",
                                                       "arm:data:rocky_trail_arm_4k.jpg"});
  CHECK(
      recognised({"Rocks011_1K-JPG_Color.jpg", "Rocks011_1K-JPG_NormalDX.jpg", "Rocks011_1K-JPG_NormalGL.jpg",
                  "Rocks011_1K-JPG_AmbientOcclusion.jpg", "Rocks011_1K-JPG_Displacement.jpg"}) ==
      List{"color:color:Rocks011_1K-JPG_Color.jpg", "normal:normal:Rocks011_1K-JPG_NormalGL.jpg",
           "height:height:Rocks011_1K-JPG_Displacement.jpg", "ao:data:Rocks011_1K-JPG_AmbientOcclusion.jpg"});
  CHECK(recognised({"T-Wall-Base-Color.TIF", "T-Wall-Normal.tif"}) ==
        List{"color:color:T-Wall-Base-Color.TIF", "normal:normal:T-Wall-Normal.tif"});
  CHECK(recognised({"albedo.png", "normal.png"}) ==
        List{"color:color:albedo.png", "normal:normal:normal.png"});
}

TEST_CASE("a file says by its name which map it is", "[pack]") {
  CHECK(map_by_name("maps/rock_Height.png") == MaterialFile{"height", Role::height, "maps/rock_Height.png"});
  CHECK(map_by_name("rock_ao_2k.jpg") == MaterialFile{"ao", Role::data, "rock_ao_2k.jpg"});
  CHECK(map_by_name("rock_albedo.png")->role == Role::color);
  CHECK_FALSE(map_by_name("rock.png"));
  CHECK_FALSE(map_by_name("rock_height/photo.png"));
}

TEST_CASE("what is not clear is an error", "[pack]") {
  CHECK_THAT(fault({"rock_normal.png", "photo.png"}), Contains("no color map"));
  CHECK_THAT(fault({}), Contains("no color map"));
  CHECK_THAT(fault({"a_color.png", "a_albedo.png"}), Contains("both the color map"));
  CHECK_THAT(fault({"bark_albedo.png", "rock_albedo.png"}), Contains("bark, rock"));
  CHECK_THAT(fault({"bark_albedo.png"}, "rock"), Contains("no color map"));
  CHECK(recognised({"bark_albedo.png", "rock_albedo.png", "rock_ao.png"}, "rock") ==
        List{"color:color:rock_albedo.png", "ao:data:rock_ao.png"});
  // Maps without their color map are no second material.
  CHECK(recognised({"bark_albedo.png", "rock_ao.png"}) == List{"color:color:bark_albedo.png"});
}
