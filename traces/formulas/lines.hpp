// What is linear between two ends: x and z along an edge, z along a span (000, "Double interpolation").
//
// Each formula stands here once, for any type of number: the engine and the codec evaluate it with double, in this
// order, so that they agree to the bit; the words evaluate it with a number that remembers how it was made, and print
// that.
#pragma once

namespace zstep::formulas {

/// p at q on the line from (q_0, p_0) to (q_1, p_1).
template <class T>
T on_line(const T& p_0, const T& p_1, const T& q, const T& q_0, const T& q_1) {
  return p_0 + (p_1 - p_0) * (q - q_0) / (q_1 - q_0);
}

/// What p gains there where q gains 1.
template <class T>
T slope(const T& p_0, const T& p_1, const T& q_0, const T& q_1) {
  return (p_1 - p_0) / (q_1 - q_0);
}

/// How far along from 0 to 1 a value that is d_0 at 0 and d_1 at 1 becomes 0.
template <class T>
T where_zero(const T& d_0, const T& d_1) {
  return d_0 / (d_0 - d_1);
}

/// p at t, of the way from p_0 (t = 0) to p_1 (t = 1).
template <class T>
T part_of_way(const T& p_0, const T& p_1, const T& t) {
  return p_0 + t * (p_1 - p_0);
}

}  // namespace zstep::formulas
