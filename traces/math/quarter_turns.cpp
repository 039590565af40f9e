#include "traces/math/quarter_turns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "traces/math/kernels.hpp"

namespace zstep::portable {

namespace {

// The digits of 2 / pi behind the point, 32 bits each.
constexpr std::uint32_t two_over_pi[] = {
    0xa2f9836e, 0x4e441529, 0xfc2757d1, 0xf534ddc0, 0xdb629599, 0x3c439041, 0xfe5163ab, 0xdebbc561,
    0xb7246e3a, 0x424dd2e0, 0x06492eea, 0x09d1921c, 0xfe1deb1c, 0xb129a73e, 0xe88235f5, 0x2ebb4484,
    0xe99c7026, 0xb45f7e41, 0x3991d639, 0x835339f4, 0x9c845f8b, 0xbdf9283b, 0x1ff897ff, 0xde05980f,
    0xef2f118b, 0x5a0a6d1f, 0x6d367ecf, 0x27cb09b7, 0x4f463f66, 0x9e5fea2d, 0x7527bac7, 0xebe5f17b,
    0x3d0739f7, 0x8a5292ea, 0x6bfb5fb1, 0x1f8d5d08, 0x56033046, 0xfc7b6bab, 0xf0cfbc20, 0x9af4361d};

constexpr std::size_t used = 8, digits = used + 2;
using Digits = std::array<std::uint32_t, digits>;  // the greatest last

}  // namespace

// M. H. Payne and R. N. Hanek, "Radian reduction for trigonometric functions", 1983: digits of 2 / pi that make whole
// turns are left out, and eight of the others leave 108 right bits of any rest.
QuarterTurns quarter_turns(double x) {
  if (std::abs(x) <= half_pi.high / 2) return {0, x};
  int exponent = 0;
  const auto whole = static_cast<std::uint64_t>(std::ldexp(std::frexp(std::abs(x), &exponent), 53));
  exponent -= 53;
  const int first = std::max(0, (exponent - 2) / 32);

  Digits product{};
  for (std::size_t word = 0; word < 2; ++word) {
    const std::uint64_t factor = word == 0 ? whole & 0xffffffff : whole >> 32;
    std::uint64_t carry = 0;
    for (std::size_t i = 0; i < used; ++i) {
      carry += product[i + word] + factor * two_over_pi[static_cast<std::size_t>(first) + used - 1 - i];
      product[i + word] = static_cast<std::uint32_t>(carry);
      carry >>= 32;
    }
    product[used + word] = static_cast<std::uint32_t>(carry);
  }

  // Moved so that the two bits of the count are the uppermost ones; what is above them is whole turns.
  const int behind_point = 32 * (static_cast<int>(used) + first) - exponent;
  const int move = 32 * static_cast<int>(digits) - 2 - behind_point;
  Digits moved{};
  for (std::size_t i = static_cast<std::size_t>(move / 32); i < digits; ++i) {
    const std::size_t from = i - static_cast<std::size_t>(move / 32);
    const std::uint64_t two = std::uint64_t{product[from]} << 32 | (from > 0 ? product[from - 1] : 0);
    moved[i] = static_cast<std::uint32_t>(two << (move % 32) >> 32);
  }
  std::uint32_t& top = moved[digits - 1];
  int count = static_cast<int>(top >> 30);
  top &= 0x3fffffff;
  const bool beyond_half = (top >> 29) != 0;  // nearer to the next quarter turn
  if (beyond_half) {
    ++count;
    std::uint64_t borrow = 1;
    for (std::uint32_t& digit : moved) {
      borrow += static_cast<std::uint32_t>(~digit);
      digit = static_cast<std::uint32_t>(borrow);
      borrow >>= 32;
    }
    top &= 0x3fffffff;
  }
  DoubleDouble rest;
  std::size_t last = digits;
  while (last > 0 && moved[last - 1] == 0) --last;
  for (std::size_t i = last; i-- > 0 && i + 5 > last;)
    rest = rest + std::ldexp(static_cast<double>(moved[i]), 2 - 32 * static_cast<int>(digits - i));
  if (beyond_half != (x < 0)) rest = -rest;
  if (x < 0) count = -count;
  return {count & 3, rest * half_pi};
}

}  // namespace zstep::portable
