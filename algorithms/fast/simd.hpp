// Numbers side by side, as one register holds them: the vector types of g++ and clang, for any processor. For the fast
// ways that stand beside methods which are taught.
#pragma once

#if defined(__GNUC__)
#define ZSTEP_HAS_LANES 1

#include <cstdint>
#include <cstring>
#if defined(__x86_64__)
#include <emmintrin.h>
#endif

#define ZSTEP_INLINE [[gnu::always_inline]] inline

// Makes FUNCTION_on_this_processor(TASK&): FUNCTION, or where there is AVX2 the same compiled for it.
#if defined(__x86_64__)
#define ZSTEP_FOR_THIS_PROCESSOR(FUNCTION, TASK)                                    \
  [[gnu::target("avx2")]] void FUNCTION##_with_avx2(TASK& task) { FUNCTION(task); } \
  void FUNCTION##_with_sse2(TASK& task) { FUNCTION(task); }                         \
  void FUNCTION##_on_this_processor(TASK& task) {                                   \
    const bool avx2 = __builtin_cpu_supports("avx2");                               \
    return avx2 ? FUNCTION##_with_avx2(task) : FUNCTION##_with_sse2(task);          \
  }
#else
#define ZSTEP_FOR_THIS_PROCESSOR(FUNCTION, TASK) \
  void FUNCTION##_on_this_processor(TASK& task) { FUNCTION(task); }
#endif

namespace zstep::simd {

using Doubles = double __attribute__((vector_size(32)));
using Mask = std::int64_t __attribute__((vector_size(32)));  ///< what a compare of Doubles gives: all bits or none
using Ints = std::int32_t __attribute__((vector_size(16)));
using Floats = float __attribute__((vector_size(32)));
using FloatMask = std::int32_t __attribute__((vector_size(32)));

inline constexpr int four = 4;
inline constexpr Doubles each_lane{0, 1, 2, 3};

template <class Lanes, class Number>
ZSTEP_INLINE void load(Lanes& to, const Number* from) {
  std::memcpy(&to, from, sizeof to);
}
template <class Lanes, class Number>
ZSTEP_INLINE void store(Number* to, const Lanes& from) {
  std::memcpy(to, &from, sizeof from);
}

/// A bit for each lane that is true.
ZSTEP_INLINE unsigned bits_of(const Mask& mask) {
#if defined(__x86_64__)  // what every such processor has
  __m128d half[2];
  std::memcpy(half, &mask, sizeof mask);
  return static_cast<unsigned>(_mm_movemask_pd(half[0]) | _mm_movemask_pd(half[1]) << 2);
#else
  unsigned bits = 0;
  for (unsigned i = 0; i < 4; ++i) bits |= static_cast<unsigned>(mask[i] < 0) << i;
  return bits;
#endif
}
ZSTEP_INLINE unsigned bits_of(const FloatMask& mask) {
#if defined(__x86_64__)
  __m128 half[2];
  std::memcpy(half, &mask, sizeof mask);
  return static_cast<unsigned>(_mm_movemask_ps(half[0]) | _mm_movemask_ps(half[1]) << 4);
#else
  unsigned bits = 0;
  for (unsigned i = 0; i < 8; ++i) bits |= static_cast<unsigned>(mask[i] < 0) << i;
  return bits;
#endif
}

ZSTEP_INLINE bool any(const Mask& mask) { return bits_of(mask) != 0; }

/// A mask for Ints.
ZSTEP_INLINE Ints narrow(const Mask& mask) {
  using Halves = std::int32_t __attribute__((vector_size(32)));
  Halves halves;
  std::memcpy(&halves, &mask, sizeof halves);
  return __builtin_shufflevector(halves, halves, 0, 2, 4, 6);
}

/// The whole numbers at or above x, for |x| < 2^51: what is added leaves no room for a fraction.
ZSTEP_INLINE void round_up(Doubles& x) {
  constexpr double no_fraction = 0x1.8p52;
  const Doubles whole = (x + no_fraction) - no_fraction;
  x = whole < x ? whole + 1 : whole;
}

}  // namespace zstep::simd

#else
#define ZSTEP_HAS_LANES 0
#endif
