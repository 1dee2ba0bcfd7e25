#include "render_window.h"

#include "tilepack/bake/output_check.h"
#include "tilepack/error/error.h"
#include "tilepack/pack/stored_format_for.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace tilepack::cli {

VirtualRect parsed_rect(const std::string& text) {
  constexpr std::int64_t farthest = std::int64_t{1} << 50;
  std::array<std::int64_t, 4> numbers{};
  const char* at = text.data();
  const char* const end = at + text.size();
  bool good = true;
  for (std::size_t i = 0; i < numbers.size() && good; ++i) {
    const auto [after, fault] = std::from_chars(at, end, numbers[i]);
    good = fault == std::errc() && (i == 3 ? after == end : after != end && *after == ',');
    at = after + 1;
  }
  if (!good)
    throw Error(ErrorKind::usage, "--rect",
                fmt::format("'{}' is no window; give four whole numbers X,Y,WIDTH,HEIGHT in texels", text));
  const auto [x, y, width, height] = numbers;
  if (std::min(x, y) < -farthest || std::max(x, y) > farthest)
    throw Error(ErrorKind::usage, "--rect", fmt::format("{},{}; X and Y may be -2^50..2^50", x, y));
  if (std::min(width, height) < 1 || std::max(width, height) > std::int64_t{1} << 30)
    throw Error(ErrorKind::usage, "--rect",
                fmt::format("{} x {} texels; width and height may be 1..2^30", width, height));
  return {x, y, static_cast<int>(width), static_cast<int>(height)};
}

RenderTarget target_for(const std::string& file, const MapFormat& map, const std::string& encoding) {
  const auto container = container_by_name(file);
  if (!container) throw Error(ErrorKind::usage, "--output", without_ending(file, ".png or .exr"));
  const StoredFormat format =
      stored_format_for(map.role, map.encoding, map.depth, {container, {}}, StoredFor::picture);
  RenderTarget target{format.encoding, format.depth};
  if (encoding == "srgb")
    target.encoding = Encoding::srgb;
  else if (encoding == "linear")
    target.encoding = Encoding::linear;
  else if (!encoding.empty())
    throw Error(ErrorKind::usage, "--encoding", fmt::format("'{}'; it is srgb or linear", encoding));
  return target;
}

} // namespace tilepack::cli
