#include "tilepack/bench/lookup_bench.h"
#include "tilepack/check/issues.h"
#include "tilepack/check/tile_border.h"
#include "tilepack/error/error.h"
#include "tilepack/image/resample.h"
#include "tilepack/image/stored_format.h"
#include "tilepack/layout/layout.h"
#include "tilepack/mapping/mapping.h"
#include "tilepack/measure/against_reference.h"
#include "tilepack/mip/mip_mode.h"
#include "tilepack/numeric/enum_names.h"
#include "tilepack/report/bake_verdict.h"
#include "tilepack/sampler/address.h"
#include "tilepack/sampler/filter.h"
#include "tilepack/sampler/pack_texture.h"
#include "tilepack/scanline/span_options.h"
#include "tilepack/scanline/view_shading.h"
#include "tilepack/synth/synth_options.h"
#include "tilepack/tileset/material_map.h"

#include <catch2/catch.hpp>
#include <set>

using namespace tilepack;

namespace {

// Each value and each name once, and each found by the other; enumerators counted from 0.
template <class Enum>
void check_table(Enum last) {
  std::set<std::string> names;
  INFO(alternatives_of<Enum>());
  for (int i = 0; i <= static_cast<int>(last); ++i) {
    const auto value = static_cast<Enum>(i);
    const std::string_view name = name_of(value);
    CHECK_FALSE(name.empty());
    CHECK(names.insert(std::string(name)).second);
    CHECK(enum_named<Enum>(name) == value);
    CHECK(enum_called<Enum>(name, "here", "thing") == value);
  }
  CHECK(names_of<Enum>().size() == names.size());
  CHECK_FALSE(enum_named<Enum>("no such name"));
  CHECK_FALSE(enum_named<Enum>(""));
}

} // namespace

TEST_CASE("every table of names is complete and says each name once") {
  check_table(BenchFilter::elliptical);
  check_table(BenchSampler::reference);
  check_table(BenchWeights::wide);
  check_table(Coloring::corner);
  check_table(Construction::framed);
  check_table(Depth::f32);
  check_table(Encoding::linear);
  check_table(Filter::trilinear);
  check_table(Grade::poor);
  check_table(ImageContainer::exr);
  check_table(LayoutKind::array);
  check_table(MappingKind::index);
  check_table(Matching::not_found);
  check_table(MipMode::least_squares);
  check_table(ResampleFilter::lanczos);
  check_table(Role::opacity);
  check_table(Severity::note);
  check_table(Side::west);
  check_table(SpanMethod::estimate);
  check_table(SpanPrecision::f64);
  check_table(ViewFilter::ewa);
  check_table(WrapMode::mirror);
  check_table(Zone::corner);
}

TEST_CASE("an unknown name is refused with what there is and what is near") {
  try {
    enum_called<Filter>("bilinaer", field("filter"), "filter");
    FAIL("accepted");
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::usage);
    CHECK(error.message(FieldSpelling::option) ==
          "--filter: 'bilinaer' is no filter, did you mean 'bilinear'?; there are nearest, bilinear and "
          "trilinear");
  }
  CHECK_THROWS_WITH(enum_called<WrapMode>("q", "border", "border"),
                    "border: 'q' is no border; there are wrap, clamp and mirror");
  CHECK(alternatives_of<WrapMode>() == "wrap|clamp|mirror");
}
