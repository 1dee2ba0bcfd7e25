#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// Which channels of a file become those of the image, in what order.
struct ChannelChoice {
  std::vector<int> from; ///< numbers in the file, in the order of the image
  int alpha = -1;        ///< which of `from` is alpha; -1: none
};

/// Channels of a file that names them freely (EXR), by their names and not by their order:
///
///   one channel                              that one
///   R G B, R G B A, R G, Y, Y A, X Y (Z)     by name, in that order; A is alpha
///   the same behind one prefix               "LeR LeG LeB", "diffuse.R diffuse.G diffuse.B"
///
/// Capitals or not. Anything else (a depth beside R G B, layers, numbers of objects) is no map for sure and is
/// Error (invalid_content): it names the channels and how to choose. `file` is how messages name the file.
ChannelChoice channels_by_name(std::span<const std::string> names, const std::string& file);

/// The channels that a text such as "R,G,B" asks for: 1 to 4 names, each one of the file's. A last channel
/// called A of 2 or 4 is alpha. Error (usage) if a name is no channel of the file.
ChannelChoice channels_asked(std::string_view asked, std::span<const std::string> names,
                             const std::string& file);

} // namespace tilepack
