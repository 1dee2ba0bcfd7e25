#pragma once

#include "tilepack/batch/content_hash.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// What stands at the head of a file of the cache: the files of an output, which follow in this order.
struct CachedOutput {
  struct File {
    std::string name; ///< relative to the folder of the output
    std::uint64_t size = 0;
    ContentHash hash;
  };
  std::vector<File> files;
  std::size_t head_size = 0; ///< bytes before the first of them
};

/// The head of `bytes`; none if it is damaged, cut short, or names what can't be a file of an output.
std::optional<CachedOutput> parsed_cache_head(std::string_view bytes);

std::string cache_head_text(const std::vector<CachedOutput::File>& files);

} // namespace tilepack
