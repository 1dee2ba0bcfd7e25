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
  for (const MaterialFile& f : material_files(names, prefix, "folder").files)
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

// "file → label" of what is passed over.
List passed_over(const List& names, const std::string& prefix = "") {
  List list;
  for (const PassedOver& f : material_files(names, prefix, "folder").passed_over)
    list.push_back(f.file + " -> " + f.label);
  return list;
}

} // namespace

TEST_CASE("maps are recognised by their endings, color first", "[pack]") {
  CHECK(recognised({"rock_ao.png", "rock_height.exr", "rock_rough.jpg", "rock_normal.png", "rock_albedo.png",
                    "rock_notes.txt", "rock_preview.png", "readme.md"}) ==
        List{"color:color:rock_albedo.png", "normal:normal:rock_normal.png",
             "roughness:roughness:rock_rough.jpg", "height:height:rock_height.exr", "ao:ao:rock_ao.png"});
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
           "height:height:Rocks011_1K-JPG_Displacement.jpg", "ao:ao:Rocks011_1K-JPG_AmbientOcclusion.jpg"});
  CHECK(recognised({"T-Wall-Base-Color.TIF", "T-Wall-Normal.tif"}) ==
        List{"color:color:T-Wall-Base-Color.TIF", "normal:normal:T-Wall-Normal.tif"});
  CHECK(recognised({"albedo.png", "normal.png"}) ==
        List{"color:color:albedo.png", "normal:normal:normal.png"});
}

TEST_CASE("a file says by its name which map it is", "[pack]") {
  CHECK(map_by_name("maps/rock_Height.png") == MaterialFile{"height", Role::height, "maps/rock_Height.png"});
  CHECK(map_by_name("rock_ao_2k.jpg") == MaterialFile{"ao", Role::ao, "rock_ao_2k.jpg"});
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
        List{"color:color:rock_albedo.png", "ao:ao:rock_ao.png"});
  // Maps without their color map are no second material.
  CHECK(recognised({"bark_albedo.png", "rock_ao.png"}) == List{"color:color:bark_albedo.png"});
}

TEST_CASE("sets of ten vendors are taken whole") {
  const std::vector<std::pair<List, List>> sets{
      // freepbr
      {{"rock_albedo.png", "rock_normal-ogl.png", "rock_roughness.png", "rock_ao.png", "rock_height.png",
        "rock_metallic.png", "rock_preview.jpg"},
       {"color", "normal", "roughness", "height", "ao", "metallic"}},
      // Substance Painter
      {{"Wall_DefaultMaterial_BaseColor.png", "Wall_DefaultMaterial_Normal_OpenGL.png",
        "Wall_DefaultMaterial_Roughness.png", "Wall_DefaultMaterial_Height.png",
        "Wall_DefaultMaterial_Mixed_AO.png", "Wall_DefaultMaterial_Metallic.png",
        "Wall_DefaultMaterial_Emissive.png"},
       {"color", "normal", "roughness", "height", "ao", "emissive", "metallic"}},
      // glTF
      {{"r_baseColor.png", "r_normal.png", "r_emissive.png", "r_occlusionRoughnessMetallic.png"},
       {"color", "normal", "emissive", "orm"}},
      // ambientCG
      {{"Rocks011_2K-PNG_Color.png", "Rocks011_2K-PNG_NormalGL.png", "Rocks011_2K-PNG_Roughness.png",
        "Rocks011_2K-PNG_Displacement.png", "Rocks011_2K-PNG_AmbientOcclusion.png",
        "Rocks011_2K-PNG_Metalness.png"},
       {"color", "normal", "roughness", "height", "ao", "metallic"}},
      // Poly Haven
      {{"rock_wall_10_diff_4k.jpg", "rock_wall_10_nor_gl_4k.exr", "rock_wall_10_rough_4k.exr",
        "rock_wall_10_disp_4k.png", "rock_wall_10_ao_4k.jpg", "rock_wall_10_arm_4k.jpg"},
       {"color", "normal", "roughness", "height", "ao", "arm"}},
      // Poliigon
      {{"Bricks01_COL_VAR1_2K.jpg", "Bricks01_NRM_2K.jpg", "Bricks01_GLOSS_2K.jpg", "Bricks01_DISP_2K.jpg",
        "Bricks01_AO_2K.jpg", "Bricks01_REFL_2K.jpg"},
       {"color", "normal", "height", "ao", "gloss", "specular"}},
      // Megascans
      {{"vdcjaeq_2K_Albedo.jpg", "vdcjaeq_2K_Normal_LOD0.jpg", "vdcjaeq_2K_Roughness.jpg",
        "vdcjaeq_2K_Displacement.exr", "vdcjaeq_2K_AO.jpg", "vdcjaeq_2K_Opacity.jpg"},
       {"color", "normal", "roughness", "height", "ao", "opacity"}},
      // Unreal Engine
      {{"T_Rock_BC.TGA", "T_Rock_N.TGA", "T_Rock_ORM.TGA", "T_Rock_E.TGA"},
       {"color", "normal", "emissive", "orm"}},
      // Unity
      {{"Rock_AlbedoTransparency.png", "Rock_Normal.png", "Rock_MetallicSmoothness.png", "Rock_Emission.png",
        "Rock_Occlusion.png"},
       {"color", "normal", "ao", "emissive", "metallic_smoothness"}},
      // CryENGINE
      {{"rock_diff.tif", "rock_ddn.tif", "rock_spec.tif", "rock_displ.tif"},
       {"color", "normal", "height", "specular"}},
      // textures.com, cgbookcase, sharetextures
      {{"TexturesCom_Wall_1K_albedo.tif", "TexturesCom_Wall_1K_normal.tif",
        "TexturesCom_Wall_1K_roughness.tif"},
       {"color", "normal", "roughness"}},
      {{"Rock_01_4K_Base_Color.png", "Rock_01_4K_Normal.png", "Rock_01_4K_AO.png"},
       {"color", "normal", "ao"}},
      {{"wall-12_basecolor-2K.png", "wall-12_normal-2K.png"}, {"color", "normal"}},
      // the color map has the name of the material alone
      {{"rock.png", "rock_normal.png", "rock_rough.png"}, {"color", "normal", "roughness"}},
      // no separators; the kind in front
      {{"rockalbedo.png", "rocknormal.png", "rockroughness.png"}, {"color", "normal", "roughness"}},
      {{"albedo_rock.png", "normal_rock.png"}, {"color", "normal"}},
  };
  for (const auto& [files, maps] : sets) {
    INFO(files.front());
    const FoundMaterial found = material_files(files, "", "folder");
    List names;
    for (const MaterialFile& f : found.files) names.push_back(f.name);
    CHECK(names == maps);
    CHECK(found.passed_over.empty());
  }
}

TEST_CASE("packed maps say what their channels hold") {
  using enum ChannelContent;
  const auto contents = [](const std::string& file) {
    return material_files(List{"r_albedo.png", file}, "", "folder").files.at(1).contents;
  };
  using Contents = std::vector<ChannelContent>;
  CHECK(contents("r_ORM.png") == Contents{ao, roughness, metallic});
  CHECK(contents("r_ARM.png") == Contents{ao, roughness, metallic});
  CHECK(contents("r_RMA.png") == Contents{roughness, metallic, ao});
  CHECK(contents("r_MRAO.png") == Contents{metallic, roughness, ao});
  CHECK(contents("r_metallicRoughness.png") == Contents{other, roughness, metallic});
  CHECK(contents("r_ao.png").empty());
  CHECK(filled_contents({ao, roughness, metallic}, 4) == Contents{ao, roughness, metallic, other});
  CHECK(filled_contents({ao, roughness, metallic}, 1) == Contents{ao});
  CHECK(filled_contents({gloss}, 3) == Contents{gloss, gloss, gloss});
}

TEST_CASE("dot files and what is no image are not seen") {
  CHECK(recognised({"._rock_albedo.png", "._rock_normal.png", "rock_albedo.png", "rock_normal.png",
                    "rock_albedo.png.meta", "Thumbs.db", ".DS_Store", "rock_normal.txt"}) ==
        List{"color:color:rock_albedo.png", "normal:normal:rock_normal.png"});
  CHECK(passed_over({"._rock_cavity.png", "rock_albedo.png", "rock_albedo.png.meta"}).empty());
}

TEST_CASE("names of one material may differ in case and separators") {
  CHECK(recognised({"Rock_albedo.png", "rock_normal.png", "ROCK-rough.png"}) ==
        List{"color:color:Rock_albedo.png", "normal:normal:rock_normal.png",
             "roughness:roughness:ROCK-rough.png"});
  CHECK(recognised({"RockWall_albedo.png", "rockwall_normal.png", "rock_wall_ao.png"}).size() == 3);
}

TEST_CASE("what looks like a map of the material and is not taken is passed over") {
  CHECK(passed_over({"Wall_BaseColor.png", "Wall_Normal.png", "Wall_Normal_OpenGL.png"}) ==
        List{"Wall_Normal.png -> normal"});
  CHECK(passed_over({"w_albedo.png", "w_Displacement.png", "w_Bump.png"}) == List{"w_Bump.png -> height"});
  CHECK(passed_over({"w_albedo.png", "w_diffuse.png"}) == List{"w_diffuse.png -> color"});
  CHECK(passed_over({"w_albedo.png", "w_cavity.png"}) == List{"w_cavity.png -> cavity:data"});
  CHECK(passed_over({"w_albedo.png", "w_normal.xcf"}) == List{"w_normal.xcf -> "});
  CHECK(passed_over({"w_albedo.png", "w_albedo (1).png", "w_albedo copy.png"}).size() == 2);
  CHECK(passed_over({"w_albedo.exr", "w_albedo.jpg"}) == List{"w_albedo.jpg -> color"});
  CHECK(passed_over({"w_col_1_2k.png", "w_col_2_2k.png", "w_nor_2k.png"}) == List{"w_col_2_2k.png -> color"});
  CHECK(passed_over({"w_albedo_1k.png", "w_albedo_2k.png"}) == List{"w_albedo_1k.png -> color"});
  CHECK(passed_over({"rockwall_albedo.png", "rock_normal.png"}) == List{"rock_normal.png -> normal"});
  CHECK(passed_over({"w_albedo.png", "w_preview.png", "sphere.png"}).empty());
  CHECK(passed_over({"w_albedo.png", "w_normal.png", "other_albedo.png"}, "w").empty());
}

TEST_CASE("images that are no maps of the material are told apart, and without further maps nothing says "
          "which is meant") {
  const List mixed{"w_albedo.png", "w_normal.png", "w_preview.png", "sphere.jpg", "photo.png", "sand.png"};
  const FoundMaterial found = material_files(mixed, "", "art");
  CHECK(found.unlike == List{"photo.png", "sand.png"});
  const std::string note = note_on_unlike(found, "art");
  for (const char* part :
       {"'w' (2 of its images)", "photo.png, sand.png are passed over", "\"samples\": \"art/*.png\""}) {
    CAPTURE(note);
    CHECK(note.find(part) != std::string::npos);
  }
  CHECK(material_files(mixed, "w", "art").unlike.empty());
  const List scans{"w_albedo.tif", "w_normal.tif", "photo.TIF"};
  CHECK(note_on_unlike(material_files(scans, "", "art"), "art").find("art/*.TIF\"") != std::string::npos);
  CHECK(fault({"a.jpg", "b.jpg"}).find("*.jpg\"") != std::string::npos);
  const std::string refused = fault({"w_albedo.png", "photo.png", "sand.png"});
  CHECK(refused.find("w_albedo.png, and photo.png, sand.png; name the one to bake") != std::string::npos);
  CHECK(recognised({"w_albedo.png", "photo.png"}, "w").size() == 1);
}

TEST_CASE("a resolution picks the files that state it") {
  const List names{"w_albedo_1k.png", "w_albedo_2k.png", "w_normal_1k.png", "w_normal_2k.png"};
  CHECK(recognised(names, "w_1k") == List{"color:color:w_albedo_1k.png", "normal:normal:w_normal_1k.png"});
  CHECK(recognised(names, "w") == List{"color:color:w_albedo_2k.png", "normal:normal:w_normal_2k.png"});
}

TEST_CASE("a shorter ending is taken where it leaves the name of the material") {
  CHECK(recognised({"metal_albedo.png", "metal_roughness.png"}) ==
        List{"color:color:metal_albedo.png", "roughness:roughness:metal_roughness.png"});
}

TEST_CASE("a folder without a color map says what was seen and what is known") {
  const std::string message = fault({"a_normal.png", "b.png"});
  CHECK_THAT(message, Contains("a_normal.png, b.png"));
  CHECK_THAT(message, Contains("list-maps"));
}
