#pragma once

#include "tilepack/image/encoding.h"

#include <cstddef>
#include <optional>
#include <span>

namespace tilepack {

/// What an ICC profile says of the transfer curve: linear if its curves (of red or grey) are the identity, else
/// srgb, which the curves of all common profiles are near. Unset for what is no profile with curves. [ICC1, 10]
std::optional<Encoding> encoding_of_profile(std::span<const std::byte> profile);

} // namespace tilepack
