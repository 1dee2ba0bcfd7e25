#include "support/small_pack.h"

#include "tilepack/error/error.h"
#include "tilepack/sampler/pack_texture.h"
#include "tilepack/sampler/render.h"
#include "tilepack/scanline/view_render.h"

#include <catch2/catch.hpp>
#include <cmath>

using namespace tilepack;

namespace {

const Camera rolled{{0.3, 1.5, 0.2}, {0.5, 0.4, -4}, {0.5, 1, 0}, 60};
const RenderTarget stored{Encoding::srgb, Depth::u8};

Scene ground() {
  Scene scene;
  scene.planes.push_back({});
  return scene;
}

ViewStepping stepping(SpanMethod method, SpanPrecision precision, int reseed = 0) {
  return {{method, reseed}, precision, 0};
}

ViewPixels pixels_of(const Scene& scene, const Camera& camera, Size size, const ViewStepping& s) {
  const ProjectedScene projected(scene, Projection(camera, size));
  return view_pixels(projected.spans(0, size.height), size.width, 0, size.height, s);
}

double in_tiles(TileCoordinate c, double offset) {
  return static_cast<double>(c.tile) + c.fraction + offset;
}

bool finite(const Image& image) {
  return std::all_of(image.data().begin(), image.data().end(), [](float v) { return std::isfinite(v); });
}

} // namespace

TEST_CASE("each pixel of the ground has the coordinates where its view ray meets it") {
  const Size size{160, 90};
  const Projection projection(rolled, size);
  const ViewPixels pixels =
      pixels_of(ground(), rolled, size, stepping(SpanMethod::exact, SpanPrecision::f64));
  int seen = 0;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const Vec3 ray = projection.corner + (x + 0.5) * projection.across + (y + 0.5) * projection.down;
      const std::size_t at = static_cast<std::size_t>(y * size.width + x);
      CAPTURE(x, y);
      REQUIRE((pixels.span[at] >= 0) == (ray.y < 0));
      if (pixels.span[at] < 0) continue;
      ++seen;
      const double t = -rolled.eye.y / ray.y;
      const ViewSpan& view = pixels.spans[static_cast<std::size_t>(pixels.span[at])];
      REQUIRE(in_tiles(view.span.u, pixels.u[at]) == Approx(rolled.eye.x + t * ray.x).epsilon(1e-9));
      REQUIRE(in_tiles(view.span.v, pixels.v[at]) == Approx(rolled.eye.z + t * ray.z).epsilon(1e-9));
    }
  CHECK(seen > 3000);
}

TEST_CASE("footprints are the derivatives of the coordinates") {
  const Size size{200, 120};
  const auto pixels = pixels_of(ground(), rolled, size, stepping(SpanMethod::exact, SpanPrecision::f64));
  const Projection projection(rolled, size);
  const auto place = [&](double x, double y) {
    const Vec3 ray = projection.corner + x * projection.across + y * projection.down;
    return rolled.eye + (-rolled.eye.y / ray.y) * ray;
  };
  const double h = 1e-5;
  for (int y = 20; y < size.height; y += 13)
    for (int x = 0; x < size.width; x += 17) {
      const std::size_t at = static_cast<std::size_t>(y * size.width + x);
      if (pixels.span[at] < 0) continue;
      const ViewSpan& view = pixels.spans[static_cast<std::size_t>(pixels.span[at])];
      const Footprint f = footprint(view, pixels.step[at], pixels.u[at], pixels.v[at]);
      const double px = x + 0.5, py = y + 0.5;
      const Vec3 across = (0.5 / h) * (place(px + h, py) - place(px - h, py));
      const Vec3 down = (0.5 / h) * (place(px, py + h) - place(px, py - h));
      CAPTURE(x, y);
      REQUIRE(f.u_across == Approx(across.x).epsilon(1e-4).margin(1e-8));
      REQUIRE(f.v_across == Approx(across.z).epsilon(1e-4).margin(1e-8));
      REQUIRE(f.u_down == Approx(down.x).epsilon(1e-4).margin(1e-8));
      REQUIRE(f.v_down == Approx(down.z).epsilon(1e-4).margin(1e-8));
    }
}

TEST_CASE("every span method shows the ground where the exact one does, within its bound") {
  const Size size{480, 270};
  const auto exact = pixels_of(ground(), rolled, size, stepping(SpanMethod::exact, SpanPrecision::f64));
  const auto shift = [&](SpanMethod method, SpanPrecision precision, int reseed) {
    const auto other = pixels_of(ground(), rolled, size, stepping(method, precision, reseed));
    CHECK(other.span == exact.span);
    return difference(exact, other, {64, 64}).largest_pixels;
  };
  for (SpanPrecision precision : {SpanPrecision::f32, SpanPrecision::f64}) {
    CHECK(shift(SpanMethod::exact, precision, 0) < 1e-3);
    CHECK(shift(SpanMethod::estimate, precision, 0) < 1e-3);
    CHECK(shift(SpanMethod::newton, precision, 0) <= 1);
    CHECK(shift(SpanMethod::newton_general, precision, 0) <= 1);
    CHECK(shift(SpanMethod::euler2, precision, 0) < 2);
    CHECK(shift(SpanMethod::euler1, precision, 0) < std::log(480.0));
    CHECK(shift(SpanMethod::euler2, precision, 8) < 1);
  }
  const auto wanted = pixels_of(ground(), rolled, size, {{SpanMethod::euler2, 0}, SpanPrecision::f32, 0.05});
  CHECK(difference(exact, wanted, {64, 64}).largest_pixels <= 0.05);
}

TEST_CASE("spans may run straight up a picture: a view turned by a quarter is the view, turned") {
  const Camera upright{{0.3, 1.5, 0.2}, {0.5, 0.4, -4}, {0, 1, 0}, 60};
  // What was up points left now: row y of the turned picture is column y of the upright one, from its foot.
  const Vec3 aside = cross(upright.target - upright.eye, upright.up);
  Camera turned = upright;
  turned.up = aside;
  const int side = 96;
  for (SpanMethod method : {SpanMethod::exact, SpanMethod::newton_direct}) {
    const auto a =
        pixels_of(ground(), upright, {side, side}, stepping(SpanMethod::exact, SpanPrecision::f64));
    const auto b = pixels_of(ground(), turned, {side, side}, stepping(method, SpanPrecision::f64));
    int seen = 0;
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        const auto at_a = static_cast<std::size_t>(y * side + x);
        const auto at_b = static_cast<std::size_t>((side - 1 - x) * side + y);
        REQUIRE((a.span[at_a] >= 0) == (b.span[at_b] >= 0));
        if (a.span[at_a] < 0) continue;
        ++seen;
        const ViewSpan& sa = a.spans[static_cast<std::size_t>(a.span[at_a])];
        const ViewSpan& sb = b.spans[static_cast<std::size_t>(b.span[at_b])];
        const double across = footprint(sb, b.step[at_b], b.u[at_b], b.v[at_b]).u_across;
        const double along = footprint(sb, b.step[at_b], b.u[at_b], b.v[at_b]).v_across;
        // A pixel's width at most, along the turned scanline.
        const double limit = method == SpanMethod::exact ? 1e-7 : 1.1 * std::hypot(across, along) + 1e-7;
        REQUIRE(std::abs(in_tiles(sa.span.u, a.u[at_a]) - in_tiles(sb.span.u, b.u[at_b])) < limit);
        REQUIRE(std::abs(in_tiles(sa.span.v, a.v[at_a]) - in_tiles(sb.span.v, b.v[at_b])) < limit);
      }
    CHECK(seen > 3000);
  }
}

TEST_CASE("two triangles show what their plane shows, cut by the near plane too") {
  // A quad of the ground, reaching behind the eye.
  Scene quad;
  const std::array<Vec3, 4> c{Vec3{-30, 0, -30}, {30, 0, -30}, {30, 0, 30}, {-30, 0, 30}};
  for (std::size_t k : {1u, 2u}) {
    TexturedTriangle t;
    t.corners = {c[0], c[k], c[k + 1]};
    for (std::size_t i = 0; i < 3; ++i) t.u[i] = t.corners[i].x, t.v[i] = t.corners[i].z;
    quad.triangles.push_back(t);
  }
  const Size size{200, 120};
  const auto exact = stepping(SpanMethod::exact, SpanPrecision::f64);
  const auto plane = pixels_of(ground(), rolled, size, exact);
  const auto mesh = pixels_of(quad, rolled, size, exact);
  int both = 0;
  for (std::size_t at = 0; at < plane.span.size(); ++at) {
    if (mesh.span[at] < 0) continue;
    REQUIRE(plane.span[at] >= 0);
    ++both;
    const ViewSpan& a = plane.spans[static_cast<std::size_t>(plane.span[at])];
    const ViewSpan& b = mesh.spans[static_cast<std::size_t>(mesh.span[at])];
    REQUIRE(in_tiles(a.span.u, plane.u[at]) == Approx(in_tiles(b.span.u, mesh.u[at])).margin(1e-8));
    REQUIRE(in_tiles(a.span.v, plane.v[at]) == Approx(in_tiles(b.span.v, mesh.v[at])).margin(1e-8));
    REQUIRE(std::abs(in_tiles(a.span.u, plane.u[at])) < 32);
  }
  CHECK(both > 5000);
  // The bottom row looks at the ground just before the camera: no pixel may be missing there.
  for (int x = 0; x < size.width; ++x)
    REQUIRE(mesh.span[static_cast<std::size_t>((size.height - 1) * size.width + x)] >= 0);
}

TEST_CASE("the nearer surface hides the farther, in any order") {
  TexturedTriangle near, far;
  near.corners = {Vec3{-9, -9, -2}, {9, -9, -2}, {0, 9, -2}};
  far.corners = {Vec3{-9, -9, -3}, {9, -9, -3}, {0, 9, -3}};
  near.u = far.u = {0, 1, 0};
  near.v = far.v = {0, 0, 1};
  const Camera camera{{0, 0, 0}, {0, 0, -1}};
  for (bool swapped : {false, true}) {
    Scene scene;
    scene.triangles = swapped ? std::vector{far, near} : std::vector{near, far};
    const auto pixels = pixels_of(scene, camera, {32, 32}, stepping(SpanMethod::newton, SpanPrecision::f32));
    for (std::int32_t s : pixels.span) {
      REQUIRE(s >= 0);
      CHECK(pixels.spans[static_cast<std::size_t>(s)].nearness == Approx(0.5));
    }
  }
}

TEST_CASE("probes cover the footprint's ellipse, however the camera is turned") {
  const Size tile{64, 64};
  // A pixel 8 texels long and 1 wide, turned by an angle in the screen and another in the texture.
  for (double turn : {0.0, 0.4, 0.785, 1.3})
    for (double aim : {0.0, 0.6, 1.5707}) {
      const double c = std::cos(turn), s = std::sin(turn), x = std::cos(aim) / 64, y = std::sin(aim) / 64;
      const Footprint f{8 * x * c - -y * s, 8 * y * c - x * s, 8 * x * s + -y * c, 8 * y * s + x * c};
      const Probes one = probes_for(f, tile, ViewFilter::trilinear);
      CAPTURE(turn, aim);
      CHECK(one.count == 1);
      CHECK(one.level == Approx(3));
      const Probes many = probes_for(f, tile, ViewFilter::anisotropic);
      CHECK((many.count == 8 || many.count == 9));
      CHECK(many.level == Approx(0).margin(0.01));
      CHECK(std::abs(many.u_axis) == Approx(std::abs(8 * x)).margin(1e-9));
      CHECK(many.u_axis * y == Approx(many.v_axis * x).margin(1e-9));
    }
  CHECK(probes_for({0.001, 0, 0, 0.001}, tile, ViewFilter::anisotropic).count == 1);
  CHECK(probes_for({}, tile, ViewFilter::anisotropic).level == 0);
  const Probes huge = probes_for({0x1p100, 0x1p100, -0x1p100, 0x1p100}, tile, ViewFilter::anisotropic);
  CHECK(std::isfinite(huge.level));
  CHECK(std::isfinite(huge.u_axis));
}

TEST_CASE("a view straight down at a pixel a texel shows the texture itself") {
  const Pack pack = small_pack();
  // 8 texels a tile, a tile a unit; 48 pixels see 6 units at distance 3 with 90 degrees.
  const Camera camera{{3, 3, 3}, {3, 0, 3}, {0, 0, -1}, 90};
  for (ViewFilter filter : {ViewFilter::trilinear, ViewFilter::anisotropic, ViewFilter::ewa}) {
    const PackTexture packed(pack, 0, filter);
    const ViewRenderer view(packed, ground(), camera, {48, 48}, {}, stored);
    const Renderer flat(pack, 0, {{0, 0, 48, 48}, 0, 1, Filter::bilinear}, stored);
    const Image seen = view.rows(0, 48), texture = flat.rows(0, 48);
    int wrong = 0;
    for (std::size_t i = 0; i < seen.data().size(); ++i)
      wrong += std::abs(seen.data()[i] - texture.data()[i]) > 1.5f / 255;
    CHECK(wrong == 0);
  }
}

TEST_CASE("views come out the same in any bands, and towards the horizon fade to the mean") {
  const Pack pack = small_pack();
  ViewOptions options;
  options.stepping = {{SpanMethod::euler2, 0}, SpanPrecision::f32, 0.1};
  options.background = {0.25f, 0.5f, 0.75f};
  const Size size{120, 100};
  const PackTexture texture(pack, 0, ViewFilter::anisotropic);
  const ViewRenderer view(texture, ground(), {{0, 1, 0}, {0, 0.5, -5}, {0.2, 1, 0}, 70}, size, options,
                          stored);
  const Image whole = view.rows(0, size.height);
  for (int y : {0, 1, 31, 32, 63, 99}) CHECK(view.rows(y, 1) == crop(whole, {0, y, size.width, 1}));
  CHECK(view.rows(20, 50) == crop(whole, {0, 20, size.width, 50}));
  CHECK(finite(whole));
  CHECK(whole.texel(0, 0)[2] == 0.75f);
  // Just below the horizon neighbouring pixels agree.
  for (int x = 5; x < size.width; x += 10) {
    int y = 0;
    while (whole.texel(x, y)[2] == 0.75f) ++y;
    for (int c = 0; c < 3; ++c)
      CHECK(whole.texel(x, y)[static_cast<std::size_t>(c)] ==
            Approx(whole.texel(5,
                               [&] {
                                 int r = 0;
                                 while (whole.texel(5, r)[2] == 0.75f) ++r;
                                 return r;
                               }())[static_cast<std::size_t>(c)])
                .margin(2.0 / 255));
  }
}

TEST_CASE("precision far from the origin of the plane does not fade") {
  const Pack pack = small_pack();
  const PackTexture texture(pack, 0, ViewFilter::trilinear);
  const auto at = [&](double x, double z) {
    const Camera camera{{x, 1, z}, {x, 0.3, z - 2}, {0.3, 1, 0}, 60};
    return ViewRenderer(texture, ground(), camera, {64, 48}, {}, stored).rows(0, 48);
  };
  // The virtual texture repeats after 6 x 5 tiles: the same view 30 million tiles away, exact in double.
  const Image home = at(0.5, 0.25), away = at(0.5 + 30e6, 0.25 - 30e6);
  int wrong = 0;
  for (std::size_t i = 0; i < home.data().size(); ++i)
    wrong += std::abs(home.data()[i] - away.data()[i]) > 0.02f;
  CHECK(wrong < 20);
}

TEST_CASE("scenes that show nothing give an empty picture, hostile ones a finite one") {
  const Pack pack = small_pack();
  const Camera camera{{0, 1, 0}, {0, 1, -5}};
  const PackTexture texture(pack, 0, ViewFilter::trilinear);
  const PackTexture sharp(pack, 0, ViewFilter::anisotropic);
  const auto picture = [&](const Scene& scene) {
    return ViewRenderer(texture, scene, camera, {32, 24}, {}, stored).rows(0, 24);
  };
  const Image nothing(32, 24, 3);
  CHECK(picture({}) == nothing);
  constexpr double inf = std::numeric_limits<double>::infinity(),
                   nan = std::numeric_limits<double>::quiet_NaN();
  const auto plane = [](Vec3 origin, Vec3 u, Vec3 v) {
    Scene scene;
    scene.planes.push_back({origin, u, v});
    return scene;
  };
  CHECK(picture(plane({0, 1, 0}, {1, 0, 0}, {0, 0, 1})) == nothing); // edge-on
  CHECK(picture(plane({0, 0, 5}, {1, 0, 0}, {0, 1, 0})) == nothing); // behind the eye
  CHECK(picture(plane({0, 0, 0}, {1, 0, 0}, {2, 0, 0})) == nothing); // axes parallel
  CHECK(picture(plane({0, 0, 0}, {0, 0, 0}, {0, 0, 1})) == nothing);
  CHECK(picture(plane({0, nan, 0}, {1, 0, 0}, {0, 0, 1})) == nothing);
  CHECK(picture(plane({0, 0, 0}, {inf, 0, 0}, {0, 0, 1})) == nothing);
  CHECK(finite(picture(plane({0, 0, 0}, {1e-150, 0, 0}, {0, 0, 1e150}))));
  CHECK(finite(picture(plane({0, std::nextafter(1.0, 0.0), 0}, {1, 0, 0}, {0, 0, 1}))));

  const double numbers[] = {0, 1, -1, 1e-30, -3, 1e9, -1e9, 0.5, 1e-9};
  Scene triangles;
  for (std::uint64_t i = 0; i < 400; ++i) {
    TexturedTriangle t;
    std::uint64_t k = 9 * i;
    const auto number = [&] { return numbers[random_below(2, "corner", k++, 9)]; };
    for (std::size_t j = 0; j < 3; ++j) {
      t.corners[j] = {number(), number(), number()};
      t.u[j] = number();
      t.v[j] = number();
    }
    triangles.triangles.push_back(t);
  }
  triangles.triangles[7].corners[1].x = nan;
  triangles.triangles[8].u[1] = inf;
  for (SpanMethod method : {SpanMethod::exact, SpanMethod::euler1, SpanMethod::newton,
                            SpanMethod::newton_general, SpanMethod::affine})
    for (SpanPrecision precision : {SpanPrecision::f32, SpanPrecision::f64}) {
      ViewOptions options;
      options.stepping = stepping(method, precision);
      const Image image = ViewRenderer(sharp, triangles, camera, {64, 48}, options, stored).rows(0, 48);
      CHECK(finite(image));
      CHECK_FALSE(image == Image(64, 48, 3));
    }
}

namespace {

// A texture that no pack makes: the place itself, and how far it moves across and down.
class Coordinates final : public Texture {
public:
  int channels() const override { return 4; }
  void sample(TileCoordinate u, TileCoordinate v, const Footprint& footprint,
              std::span<double> out) const override {
    out[0] = in_tiles(u, 0);
    out[1] = in_tiles(v, 0);
    out[2] = footprint.u_across;
    out[3] = footprint.v_down;
  }
};

} // namespace

TEST_CASE("a view shows any texture") {
  const Camera down{{3, 3, 3}, {3, 0, 3}, {0, 0, -1}, 90}; // 48 pixels see 6 units
  const Coordinates coordinates;
  const Image image =
      ViewRenderer(coordinates, ground(), down, {48, 48}, {}, {Encoding::linear, Depth::f32}).rows(0, 48);
  for (const int y : {0, 7, 47})
    for (const int x : {0, 20, 47}) {
      const auto texel = image.texel(x, y);
      CHECK(texel[0] == Approx((x + 0.5) / 8));
      CHECK(texel[1] == Approx((y + 0.5) / 8));
      CHECK(texel[2] == Approx(1.0 / 8));
      CHECK(texel[3] == Approx(1.0 / 8));
    }
}

TEST_CASE("wrong view options are refused") {
  const Pack pack = small_pack();
  const Camera camera{{0, 1, 0}, {0, 0, -5}};
  const auto make = [&](const ViewOptions& options, int map = 0) {
    const PackTexture texture(pack, map, ViewFilter::trilinear);
    ViewRenderer(texture, ground(), camera, {8, 8}, options, stored);
  };
  ViewOptions options;
  options.background = {0.5f};
  CHECK_THROWS_WITH(make(options), Catch::Contains("3 channels"));
  options.background = {0.5f, std::numeric_limits<float>::infinity(), 0};
  CHECK_THROWS_WITH(make(options), Catch::Contains("not all finite"));
  options.background = {};
  options.stepping.options.reseed = -1;
  CHECK_THROWS_AS(make(options), Error);
  CHECK_THROWS_AS(make({}, 1), Error);
  CHECK_THROWS_WITH(view_filter_of("bilinear"), Catch::Contains("anisotropic"));
}
