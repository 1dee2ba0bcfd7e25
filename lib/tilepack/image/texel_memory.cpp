#include "tilepack/image/texel_memory.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace tilepack {
namespace {

constexpr std::size_t huge_page = std::size_t{2} << 20;

// From here on blocks go back to the system when they are freed. The C library keeps those below 32 MB or so, and of a set
// whose tiles are given up one by one nothing would be gained.
constexpr std::size_t given_back = std::size_t{8} << 20;

} // namespace

void* texel_block(std::size_t bytes) {
  if (bytes < huge_block) return ::operator new(bytes);
  void* const block = ::operator new (bytes, std::align_val_t{huge_page});
#ifdef MADV_HUGEPAGE
  // A wish: refused, all is as before. Whole pages only, so that nothing beyond the block is touched.
  ::madvise(block, bytes / huge_page * huge_page, MADV_HUGEPAGE);
#endif
  return block;
}

void free_texel_block(void* block, std::size_t bytes) noexcept {
  if (bytes < huge_block) {
    ::operator delete(block);
  } else {
#ifdef MADV_DONTNEED
    if (bytes >= given_back) ::madvise(block, bytes / huge_page * huge_page, MADV_DONTNEED);
#endif
    ::operator delete (block, std::align_val_t{huge_page});
  }
}

} // namespace tilepack
