#include <hwy/targets.h>

#include <cstdint>

// What the kernels ask of Highway's library as they choose their instruction set, and all that they ask of it. The
// shared library itself (1.0.3) measures the resolution of a clock whenever it is loaded, for benchmarks that are none
// of ours, and that takes longer than all else at the start of a program. So it is not linked, and where a program
// links it all the same, these stand for its own.
namespace hwy {

#if HWY_ARCH_X86

[[gnu::weak]] std::int64_t SupportedTargets() {
  __builtin_cpu_init();
  const auto all = [](auto... features) { return (... && (features != 0)); };
  std::int64_t targets = HWY_STATIC_TARGET;
  if (!all(__builtin_cpu_supports("ssse3"))) return targets;
  targets |= HWY_SSSE3;
  if (!all(__builtin_cpu_supports("sse4.1"), __builtin_cpu_supports("sse4.2"), __builtin_cpu_supports("aes"),
           __builtin_cpu_supports("pclmul")))
    return targets;
  targets |= HWY_SSE4;
  // With these come F16C and LZCNT in every processor that has them.
  if (!all(__builtin_cpu_supports("avx2"), __builtin_cpu_supports("fma"), __builtin_cpu_supports("bmi"),
           __builtin_cpu_supports("bmi2")))
    return targets;
  targets |= HWY_AVX2;
  if (all(__builtin_cpu_supports("avx512f"), __builtin_cpu_supports("avx512vl"),
          __builtin_cpu_supports("avx512dq"), __builtin_cpu_supports("avx512bw"),
          __builtin_cpu_supports("avx512cd")))
    targets |= HWY_AVX3;
  return targets;
}

#else

[[gnu::weak]] std::int64_t SupportedTargets() {
  return HWY_STATIC_TARGET;
}

#endif

[[gnu::weak]] ChosenTarget& GetChosenTarget() {
  static ChosenTarget chosen; // none until a kernel is first called
  return chosen;
}

} // namespace hwy
