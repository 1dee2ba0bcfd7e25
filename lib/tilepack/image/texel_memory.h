#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace tilepack {

/// Bytes of memory for texels; from `huge_block` on in huge pages where the system has them, which makes the
/// first write to large images several times as fast. Throws std::bad_alloc.
void* texel_block(std::size_t bytes);
void free_texel_block(void* block, std::size_t bytes) noexcept;
constexpr std::size_t huge_block = std::size_t{4} << 20;

/// A standard allocator of such blocks. Values that a container isn't given stay unset, where std::allocator
/// would have them zero: large images are written by all threads, and zeros by one.
template <typename T>
class TexelMemory {
public:
  using value_type = T;

  TexelMemory() = default;
  template <typename U>
  TexelMemory(const TexelMemory<U>&) noexcept {}

  T* allocate(std::size_t count) {
    if (count > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_array_new_length();
    return static_cast<T*>(texel_block(count * sizeof(T)));
  }
  void deallocate(T* block, std::size_t count) noexcept { free_texel_block(block, count * sizeof(T)); }

  template <typename U>
  void construct(U* place) {
    ::new (static_cast<void*>(place)) U;
  }

  bool operator==(const TexelMemory&) const { return true; }
};

using Texels = std::vector<float, TexelMemory<float>>;

} // namespace tilepack
