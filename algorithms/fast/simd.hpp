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

// Makes FUNCTION_on_this_processor(TASK&): FUNCTION, or where there are AVX2 and FMA the same compiled for them.
#if defined(__x86_64__)
#define ZSTEP_FOR_THIS_PROCESSOR(FUNCTION, TASK)                                             \
  [[gnu::target("avx2,fma")]] void FUNCTION##_with_avx2(TASK& task) { FUNCTION(task); }      \
  void FUNCTION##_with_sse2(TASK& task) { FUNCTION(task); }                                  \
  void FUNCTION##_on_this_processor(TASK& task) {                                            \
    return zstep::simd::has_fma() ? FUNCTION##_with_avx2(task) : FUNCTION##_with_sse2(task); \
  }
#else
#define ZSTEP_FOR_THIS_PROCESSOR(FUNCTION, TASK) \
  void FUNCTION##_on_this_processor(TASK& task) { FUNCTION(task); }
#endif

namespace zstep::simd {

/// Is a b + c one operation here, with one rounding, in what is compiled for this processor?
inline bool has_fma() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

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

/// a b + c with one rounding. Slow where has_fma() is false.
ZSTEP_INLINE void fused(const Doubles& a, const Doubles& b, const Doubles& c, Doubles& sum) {
  Doubles all;
  for (int lane = 0; lane < four; ++lane) all[lane] = __builtin_fma(a[lane], b[lane], c[lane]);
  sum = all;
}

/// e / b to the last bit, from y = 1 / b rounded, in five operations (P. W. Markstein, "Computation of elementary
/// functions on the IBM RISC System/6000 processor", IBM J. Res. Dev. 34, 1990): e y is off by less than two units of
/// its last digit; with e - b q, which is at hand but for a last bit, less than one is left; then e - b q is exact, and
/// with it the quotient is rounded once. Nothing on the way may be too small or too large for all its bits; and of e =
/// -0 it makes 0.
ZSTEP_INLINE void quotient(const Doubles& e, const Doubles& b, const Doubles& y, Doubles& q) {
  q = e * y;
  Doubles off;
  fused(-q, b, e, off), fused(off, y, q, q);
  fused(-q, b, e, off), fused(off, y, q, q);
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
