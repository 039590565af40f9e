// The functions that IEEE 754 leaves to a library, and the reading of numbers, computed by additions and
// multiplications alone, so that a trace is the same with every compiler, library and processor: C libraries differ in
// the last bit. The error before the last rounding is below 2^-90: a result is the nearest double unless the true value
// is that close to the middle between two, and then it is one of these two, the same everywhere. Where C's Annex F
// gives an exact result (zeros, infinities, no number), this one is given. Square roots, remainders and roundings are
// exact everywhere: take std's.
#pragma once

#include <cstddef>
#include <string_view>

namespace zstep::portable {

double sin(double x);  ///< of radians, as all here
double cos(double x);
double tan(double x);
double asin(double x);
double acos(double x);
double atan(double x);
double atan2(double y, double x);
double exp(double x);
double log(double x);
double log10(double x);
double pow(double base, double exponent);
double sinh(double x);
double cosh(double x);
double tanh(double x);
/// √(x² + y²), for numbers whose squares neither overflow nor vanish.
double length(double x, double y);
float length(float x, float y);

}  // namespace zstep::portable

namespace zstep {

// A number as it is written, read to the nearest double.

/// Reads the decimal number that `text` begins with: "-12", "3.5e-2", ".5". Returns how many characters it has; 0, with
/// `value` as it was, where there is none or it is beyond what a double holds. (Some standard libraries have no
/// std::from_chars for doubles.)
std::size_t read_number(std::string_view text, double& value);

}  // namespace zstep
