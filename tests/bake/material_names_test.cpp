#include "tilepack/bake/material_names.h"

#include <catch2/catch.hpp>

using namespace tilepack;

namespace {

// "material kind" of the first reading; empty if there is none.
std::string read(const std::string& name) {
  const auto readings = readings_of(name);
  return readings.empty() ? "" : readings[0].key + " " + std::string(readings[0].kind.kind->name);
}

} // namespace

TEST_CASE("endings are known in every spelling") {
  for (const char* name : {"rock_albedo.png",
                           "Rock_Albedo.PNG",
                           "ROCK_ALBEDO.TGA",
                           "rock albedo.png",
                           "rock-albedo.jpg",
                           "rock.albedo.tif",
                           "rockAlbedo.png",
                           "RockAlbedo.exr",
                           "rock_base_color.png",
                           "rock_BaseColor.png",
                           "Rock Base Color.png",
                           "rock_Color_2K.png",
                           "rock-basecolor-2K-PNG.png",
                           "rock_diff_4k.jpg",
                           "rock_COL_2048x2048.png",
                           "rock_D.png",
                           "rock_Colour.png",
                           "rock_basecolour.png",
                           "rock_AlbedoTransparency.png",
                           "rock_2K_Albedo.jpg",
                           "rock_albedo_16bit.tif",
                           "rock_albedo_sRGB.png",
                           "rock_BaseColor_sRGB.png",
                           "Rock [2K] Base Color.png",
                           "Rock_2K-JPG_Color.jpg",
                           "rock_basecolor_seamless.png",
                           "(rock) albedo.png"}) {
    INFO(name);
    CHECK(read(name) == "rock color");
  }
}

TEST_CASE("every kind of map is known by what vendors call it") {
  const std::pair<const char*, const char*> names[] = {{"rock_normal-ogl.png", "normal"},
                                                       {"rock_Normal_OpenGL.png", "normal"},
                                                       {"rock_Normal_DirectX.png", "normal"},
                                                       {"rock_NormalGL.png", "normal"},
                                                       {"rock_NormalDX.png", "normal"},
                                                       {"rock_nor_dx_4k.exr", "normal"},
                                                       {"rock_ddn.tif", "normal"},
                                                       {"rock_nrm.png", "normal"},
                                                       {"rock_NRM16.tif", "normal"},
                                                       {"rock_2K_Normal_LOD0.jpg", "normal"},
                                                       {"rock_N.png", "normal"},
                                                       {"rock_Mixed_AO.png", "ao"},
                                                       {"rock_OCC.png", "ao"},
                                                       {"rock_ambientOcclusion.png", "ao"},
                                                       {"rock_ambient_occlusion.png", "ao"},
                                                       {"rock_occlusionRoughnessMetallic.png", "orm"},
                                                       {"T_Rock_ORM.png", "orm"},
                                                       {"rock_arm_4k.jpg", "arm"},
                                                       {"rock_RMA.png", "rma"},
                                                       {"rock_MRAO.png", "mrao"},
                                                       {"rock_metallicRoughness.png", "metallic_roughness"},
                                                       {"rock_MetallicSmoothness.png", "metallic_smoothness"},
                                                       {"rock_MaskMap.png", "mask_map"},
                                                       {"rock_emissive.png", "emissive"},
                                                       {"rock_Emission.png", "emissive"},
                                                       {"rock_opacity.png", "opacity"},
                                                       {"rock_Bump.png", "height"},
                                                       {"rock_Displacement.exr", "height"},
                                                       {"rock_DISP16.tif", "height"},
                                                       {"rock_Metalness.png", "metallic"},
                                                       {"rock_GLOSS.jpg", "gloss"},
                                                       {"rock_rough.png", "roughness"}};
  for (const auto& [name, kind] : names) {
    INFO(name);
    REQUIRE_FALSE(readings_of(name).empty());
    CHECK(readings_of(name)[0].kind.kind->name == kind);
    CHECK_FALSE(readings_of(name)[0].weak);
  }
}

TEST_CASE("names of normals say which way green points") {
  const auto y = [](const char* name) { return readings_of(name).at(0).kind.normal_y; };
  for (const char* name : {"a_normal-ogl.png", "a_NormalGL.png", "a_Normal_OpenGL.png", "a_nor_gl_1k.png"})
    CHECK(y(name) == NormalY::up);
  for (const char* name : {"a_normal_dx.png", "a_NormalDX.png", "a_Normal_DirectX.png", "a_nor_dx.png"})
    CHECK(y(name) == NormalY::down);
  CHECK_FALSE(y("a_normal.png"));
  CHECK_FALSE(kind_called("roughgl"));
}

TEST_CASE("what is no ending is read as none") {
  for (const char* name : {"rock.png", "photo 12.jpg", "._rock_albedo.png", ".png", "", "abnormality.png",
                           "warm.png", "rock_cavity.png", "n.png", "2048.png", "___.png", "rockn.png"}) {
    INFO(name);
    for (const NameReading& reading : readings_of(name)) CHECK(reading.weak);
  }
}

TEST_CASE("an ending without a separator and one in front are weak") {
  CHECK(readings_of("rockalbedo.png").at(0).weak);
  CHECK(readings_of("rockalbedo.png").at(0).key == "rock");
  CHECK(readings_of("normal_rock.png").at(0).weak);
  CHECK(readings_of("normal_rock.png").at(0).key == "rock");
}

TEST_CASE("both readings of metal_roughness are there") {
  const auto readings = readings_of("metal_roughness.png");
  REQUIRE(readings.size() == 2);
  CHECK(readings[0].kind.kind->name == "metallic_roughness");
  CHECK(readings[1].kind.kind->name == "roughness");
  CHECK(readings[1].key == "metal");
}

TEST_CASE("keys of one material are equal however it is spelled") {
  for (const char* name :
       {"Rock_01", "rock-01", "ROCK 01", "Rock01_2K", "rock01-1K-PNG", "Rock_01_2048x1024"})
    CHECK(material_key(name) == "rock01");
  CHECK(readings_of("rock_albedo_01.png").at(0).key == "rock01");
  CHECK(resolution_in("Rock_01_2K-PNG") == "2k");
  CHECK(resolution_in("Rock_01").empty());
}
