#include "tilepack/image/texel_memory.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace tilepack {
namespace {

constexpr std::size_t huge_page = std::size_t{2} << 20;

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
  if (bytes < huge_block)
    ::operator delete(block);
  else
    ::operator delete (block, std::align_val_t{huge_page});
}

} // namespace tilepack
