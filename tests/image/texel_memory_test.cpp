#include "tilepack/image/texel_memory.h"

#include <catch2/catch.hpp>
#include <cstdint>
#include <new>

using namespace tilepack;

TEST_CASE("texels keep their values, in blocks of any size") {
  for (const std::size_t bytes : {std::size_t{4}, huge_block - 4, huge_block, huge_block + 4}) {
    const std::size_t count = bytes / sizeof(float);
    Texels texels(count);
    for (std::size_t i = 0; i < count; ++i) texels[i] = static_cast<float>(i % 1000);
    const Texels copy = texels;
    texels.resize(count + 1);
    texels.pop_back();
    CHECK(texels == copy);
    CHECK(copy.back() == static_cast<float>((count - 1) % 1000));
    CHECK(Texels(count, 2.5f)[count - 1] == 2.5f);
    CHECK(Texels(count, 0.0f)[count / 2] == 0.0f);
  }
}

TEST_CASE("more texels than there can be are refused") {
  TexelMemory<float> memory;
  CHECK_THROWS_AS(memory.allocate(SIZE_MAX / 2), std::bad_alloc);
}
