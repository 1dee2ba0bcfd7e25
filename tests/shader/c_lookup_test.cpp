#include "support/scratch_folder.h"
#include "support/shader_packs.h"

#include "tilepack/lookup/lookup_tables.h"
#include "tilepack/mip/level_size.h"
#include "tilepack/numeric/wrap.h"
#include "tilepack/sampler/reference_sampler.h"
#include "tilepack/sampler/virtual_texture.h"
#include "tilepack/shader/shader_text.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <dlfcn.h>
#include <fstream>
#include <limits>

using namespace tilepack;
using namespace tilepack::test;

namespace {

// As the text of C has them.
struct CImage {
  const float* texels;
  int width, height;
};
struct CTexture {
  const CImage* levels;
  int level_count, channels;
};

// The levels of a map in linear light, as C reads them.
class CLevels {
public:
  CLevels(const PackedMap& map, int layers) {
    for (const Image& level : map.levels) images.push_back(to_linear(level, map.encoding));
    for (const Image& level : map.far_levels) images.push_back(to_linear(level, map.encoding));
    for (const Image& image : images)
      levels.push_back({image.row(0).data(), image.width(), image.height() / layers});
    texture = {levels.data(), static_cast<int>(levels.size()), map.channels};
  }
  CLevels(const CLevels&) = delete;
  CLevels& operator=(const CLevels&) = delete;
  const CTexture* get() const { return &texture; }

private:
  std::vector<Image> images;
  std::vector<CImage> levels;
  CTexture texture{};
};

enum class Mode { nearest, level, exact };

// The text of a pack's lookup in C, compiled and loaded.
class CompiledLookup {
public:
  explicit CompiledLookup(const Pack& pack, WrapMode border = WrapMode::wrap, const std::string& from = {},
                          const std::string& to = {})
      : tiles(pack.maps[0], pack.layout.kind == LayoutKind::array ? pack.layout.rows : 1) {
    if (pack.corner_pack) corners = std::make_unique<CLevels>(pack.corner_pack->maps[0], 1);
    for (const int id : pack.mapping.ids) ids.push_back(static_cast<std::uint16_t>(id));
    ShaderSettings settings;
    settings.language = ShaderLanguage::c;
    settings.border = border;
    std::string text = shader_text(pack, settings, "tilepack shader test --lang c", 0);
    if (!from.empty()) {
      const std::size_t at = text.find(from);
      REQUIRE(at != std::string::npos);
      text.replace(at, from.size(), to);
    }
    std::ofstream(folder / "lookup.h") << text;
    const bool index = !ids.empty(), turned = pack.layout.kind == LayoutKind::rotated;
    const std::string id = index ? "ids, " : "", corner = corners ? "corners, " : "";
    std::ofstream(folder / "lookup.c")
        << "#include \"lookup.h\"\n"
           "void tiles_of(const uint16_t *ids, const int32_t *x, const int32_t *y, int count, uint32_t "
           "*tile,\n"
           "              uint32_t *place);\n"
           "void value_at(int mode, const tilepack_texture *tiles, const tilepack_texture *corners, const "
           "uint16_t *ids,\n"
           "              int32_t x, int32_t y, float fx, float fy, float level, float *out);\n"
           "void tiles_of(const uint16_t *ids, const int32_t *x, const int32_t *y, int count, uint32_t "
           "*tile,\n"
           "              uint32_t *place) {\n"
           "  int i;\n"
           "  (void)ids;\n"
           "  for (i = 0; i < count; ++i) {\n"
           "    tile[i] = tilepack_tile("
        << id << "x[i], y[i]);\n    place[i] = tilepack_place(" << id
        << "x[i], y[i]);\n  }\n}\n"
           "void value_at(int mode, const tilepack_texture *tiles, const tilepack_texture *corners, const "
           "uint16_t *ids,\n"
           "              int32_t x, int32_t y, float fx, float fy, float level, float *out) {\n"
           "  tilepack_value v;\n"
           "  (void)ids, (void)corners;\n"
           "  if (mode == 0) v = tilepack_nearest(tiles, "
        << id << "x, y, fx, fy, (int32_t)level);\n  else if (mode == 1) v = tilepack_level(tiles, " << corner
        << id << "x, y, fx, fy, level);\n  else v = "
        << (turned ? "tilepack_none()" : "tilepack_exact(tiles, " + id + "x, y, fx, fy, level)")
        << ";\n  out[0] = v.c[0], out[1] = v.c[1], out[2] = v.c[2];\n}\n";
    const std::string library = (folder / "lookup.so").string();
    const std::string command = "cc -std=c99 -pedantic -Wall -Wextra -Wconversion -Wno-sign-conversion "
                                "-Werror -O1 -ffp-contract=off -shared -fPIC -o " +
                                library + " " + (folder / "lookup.c").string() + " -lm";
    REQUIRE(std::system(command.c_str()) == 0);
    handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
    REQUIRE(handle != nullptr);
    tiles_of = reinterpret_cast<decltype(tiles_of)>(dlsym(handle, "tiles_of"));
    value_at = reinterpret_cast<decltype(value_at)>(dlsym(handle, "value_at"));
  }
  ~CompiledLookup() {
    if (handle != nullptr) dlclose(handle);
  }
  CompiledLookup(const CompiledLookup&) = delete;
  CompiledLookup& operator=(const CompiledLookup&) = delete;

  std::array<float, 3> at(Mode mode, int x, int y, float fx, float fy, float level) const {
    std::array<float, 3> value{};
    value_at(static_cast<int>(mode), tiles.get(), corners ? corners->get() : nullptr, ids.data(), x, y, fx,
             fy, level, value.data());
    return value;
  }

  void cells(const std::vector<std::int32_t>& x, const std::vector<std::int32_t>& y,
             std::vector<std::uint32_t>& tile, std::vector<std::uint32_t>& place) const {
    tiles_of(ids.data(), x.data(), y.data(), static_cast<int>(x.size()), tile.data(), place.data());
  }

private:
  ScratchFolder folder;
  CLevels tiles;
  std::unique_ptr<CLevels> corners;
  std::vector<std::uint16_t> ids;
  void* handle = nullptr;
  void (*tiles_of)(const std::uint16_t*, const std::int32_t*, const std::int32_t*, int, std::uint32_t*,
                   std::uint32_t*) = nullptr;
  void (*value_at)(int, const CTexture*, const CTexture*, const std::uint16_t*, std::int32_t, std::int32_t,
                   float, float, float, float*) = nullptr;
};

// Cells near 0, the ends of 32 bits and multiples of 64, and strewn over all.
void draw_cells(int count, std::vector<std::int32_t>& xs, std::vector<std::int32_t>& ys) {
  const auto coordinate = [](std::uint32_t bits, std::uint32_t kind) {
    constexpr std::array<std::int64_t, 4> near{0, std::int64_t{1} << 31, -(std::int64_t{1} << 31),
                                               std::int64_t{1} << 30};
    if (kind == 0) return static_cast<std::int32_t>(bits);
    const std::int64_t at = near[kind % 4] + static_cast<std::int32_t>(bits % 400) - 200;
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(at));
  };
  xs.resize(static_cast<std::size_t>(count));
  ys.resize(xs.size());
  for (std::size_t i = 0; i < xs.size(); ++i) {
    const std::uint64_t bits = mixed(i), kind = mixed(i + (std::uint64_t{1} << 40));
    xs[i] = coordinate(static_cast<std::uint32_t>(bits), static_cast<std::uint32_t>(kind % 5));
    ys[i] = coordinate(static_cast<std::uint32_t>(bits >> 32), static_cast<std::uint32_t>(kind / 5 % 5));
  }
}

std::int64_t wrong_cells(const Pack& pack, const CompiledLookup& compiled, int count, WrapMode border) {
  const LookupTables tables(pack);
  const VirtualSize size = pack.mapping.size;
  std::vector<std::int32_t> xs, ys;
  draw_cells(count, xs, ys);
  std::vector<std::uint32_t> tile(xs.size()), place(xs.size());
  compiled.cells(xs, ys, tile, place);
  std::int64_t wrong = 0;
  for (std::size_t i = 0; i < xs.size(); ++i) {
    const LatticeCell cell{static_cast<std::uint32_t>(within(xs[i], size.width, border)),
                           static_cast<std::uint32_t>(within(ys[i], size.height, border))};
    const std::uint32_t id = tile_of_cell(tables.words(), cell);
    wrong += tile[i] != id || place[i] != tables.words().places[id] ? 1 : 0;
  }
  return wrong;
}

struct Differences {
  double nearest = 0, level = 0, exact = 0;
};

// The stored virtual texture filtered at a whole level.
double filtered(const Image& texture, double x, double y, std::size_t channel, WrapMode border) {
  const double i = std::floor(x - 0.5), j = std::floor(y - 0.5);
  double sum = 0;
  for (int dy = 0; dy < 2; ++dy)
    for (int dx = 0; dx < 2; ++dx) {
      const auto texel = texture.texel(
          static_cast<int>(within(static_cast<std::int64_t>(i) + dx, texture.width(), border)),
          static_cast<int>(within(static_cast<std::int64_t>(j) + dy, texture.height(), border)));
      sum += (dx == 0 ? 1 - (x - 0.5 - i) : x - 0.5 - i) * (dy == 0 ? 1 - (y - 0.5 - j) : y - 0.5 - j) *
             static_cast<double>(texel[channel]);
    }
  return sum;
}

Differences differences(const Pack& pack, WrapMode border, int count) {
  const CompiledLookup compiled(pack, border);
  const ReferenceSampler reference(pack, 0, default_corner_width, border);
  const bool turned = pack.layout.kind == LayoutKind::rotated;
  const VirtualSize size = pack.mapping.size;
  const bool small = size.width <= 128 && size.height <= 128;
  std::vector<Image> truths;
  for (int level = 0; small && !turned && level < pack.tile_levels; ++level) {
    const Size tile = level_size(pack.tile_size, level);
    truths.push_back(to_linear(virtual_texture(pack, 0, level,
                                               {0, 0, static_cast<int>(size.width) * tile.width,
                                                static_cast<int>(size.height) * tile.height}),
                               Encoding::srgb));
  }
  Differences largest;
  for (int i = 0; i < count; ++i) {
    const auto drawn = [&](std::string_view purpose) {
      return random_bits(3, purpose, static_cast<std::uint64_t>(i));
    };
    const int x = static_cast<int>(drawn("x") % 20) - 8, y = static_cast<int>(drawn("y") % 20) - 8;
    // Steps of 1/1024, every other one within a tile's first or last 32nd.
    const auto fraction = [](std::uint64_t bits) {
      const int step = static_cast<int>(bits % 1024), border_step = step % 32;
      if (bits >> 40 & 1) return static_cast<float>(step) / 1024;
      return static_cast<float>(bits >> 41 & 1 ? border_step : 1023 - border_step) / 1024;
    };
    const float fx = fraction(drawn("fx")), fy = fraction(drawn("fy"));
    // A mirrored place exactly on a border is taken for the tile before.
    if (border == WrapMode::mirror && (fx == 0 || fy == 0)) continue;
    const std::size_t levels = pack.maps[0].levels.size() + pack.maps[0].far_levels.size();
    const int whole = static_cast<int>(drawn("level") % levels);
    std::array<double, 3> expected{};
    const auto worst = [&](const std::array<float, 3>& found) {
      double difference = 0;
      for (std::size_t c = 0; c < 3; ++c)
        difference = std::max(difference, std::fabs(static_cast<double>(found[c]) - expected[c]));
      return difference;
    };
    const TileCoordinate at_x{x, static_cast<double>(fx)}, at_y{y, static_cast<double>(fy)};
    if (!turned ||
        std::fabs(fx * 8 - std::round(fx * 8)) > 0.01f) { // a turned texel's border is met by no float
      reference.sample(at_x, at_y, whole, Filter::nearest, expected);
      if (!pack.corner_pack)
        largest.nearest = std::max(
            largest.nearest, worst(compiled.at(Mode::nearest, x, y, fx, fy, static_cast<float>(whole))));
    }
    // Between levels, borders and corners are those of neither.
    const float level = pack.corner_pack || border != WrapMode::wrap ? static_cast<float>(whole)
                                                                     : static_cast<float>(whole) + 0.25f;
    reference.sample(at_x, at_y, level, Filter::trilinear, expected);
    largest.level = std::max(largest.level, worst(compiled.at(Mode::level, x, y, fx, fy, level)));
    if (truths.empty()) continue;
    if (whole >= pack.tile_levels) { // far levels are the texture's own
      if (!pack.corner_pack)
        largest.exact = std::max(largest.exact, worst(compiled.at(Mode::exact, x, y, fx, fy, level)));
      continue;
    }
    const Size tile = level_size(pack.tile_size, whole);
    for (std::size_t c = 0; c < 3; ++c)
      expected[c] =
          filtered(truths[static_cast<std::size_t>(whole)], (x + static_cast<double>(fx)) * tile.width,
                   (y + static_cast<double>(fy)) * tile.height, c, border);
    largest.exact =
        std::max(largest.exact, worst(compiled.at(Mode::exact, x, y, fx, fy, static_cast<float>(whole))));
  }
  return largest;
}

} // namespace

TEST_CASE("C finds the tiles of the lookup in ten million cells, the ends of 32 bits among them") {
  for (const NamedPack& named : shader_packs()) {
    INFO(named.name);
    const CompiledLookup compiled(named.pack);
    CHECK(wrong_cells(named.pack, compiled, 800000, WrapMode::wrap) == 0);
  }
}

TEST_CASE("C finds tiles beyond the border") {
  for (NamedPack& named : shader_packs())
    for (const WrapMode border : {WrapMode::clamp, WrapMode::mirror}) {
      if (!named.pack.mapping.ids.empty()) continue;
      INFO(named.name << ", " << name_of(border));
      CHECK(wrong_cells(named.pack, CompiledLookup(named.pack, border), 50000, border) == 0);
    }
}

TEST_CASE("a constant that is wrong in its last bit shows in C") {
  for (const NamedPack& named : shader_packs()) {
    INFO(named.name);
    if (named.pack.mapping.kind == MappingKind::index) continue;
    if (named.pack.mapping.size.height < 64 && named.pack.mapping.kind == MappingKind::even)
      continue; // shows little of its pattern
    // The first constant in hexadecimal is a word of a table or a key.
    ShaderSettings settings;
    settings.language = ShaderLanguage::c;
    const std::string text = shader_text(named.pack, settings, "", 0);
    const std::size_t start = text.find("0x"), end = text.find('u', start);
    REQUIRE(end != std::string::npos);
    const std::string constant = text.substr(start, end - start);
    const std::string changed = std::to_string(std::stoul(constant, nullptr, 16) ^ 1);
    CHECK(wrong_cells(named.pack, CompiledLookup(named.pack, WrapMode::wrap, constant, changed), 50000,
                      WrapMode::wrap) > 0);
  }
}

TEST_CASE(
    "C reads the texels of the reference sampler, and with exact lookups those of the virtual texture") {
  for (const NamedPack& named : shader_packs())
    for (const WrapMode border : {WrapMode::wrap, WrapMode::clamp, WrapMode::mirror}) {
      INFO(named.name << ", " << name_of(border));
      const Differences found = differences(named.pack, border, 4000);
      CHECK(found.nearest == 0);
      CHECK(found.level < 2e-5);
      CHECK(found.exact < 2e-5);
    }
}
