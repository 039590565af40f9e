// Numbers as a person reads them: short, true, aligned; or with every bit, as C writes them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace zstep {

/// Every bit of a number as C writes it: "0x1.8p+1". (Of 0 some libraries write the exponent of the smallest number.)
std::string hex_text(double value);

/// How many decimals at most where nobody asks for the exact value.
inline constexpr int usual_decimals = 4;

/// With exactly this many decimals: "−0.50", "∞", "undefined" for a NaN.
std::string number(double value, int decimals);
/// The same, but what is not 0 does not look like 0: "4e−4" for 0.0004 with two decimals.
std::string cell_number(double value, int decimals);
/// As short as it can be without losing one of `at_most` decimals: "4.25", "3", "0.3333". Very large and very small
/// values are written with an exponent ("1.2e−07").
std::string number(double value, int at_most_decimals, bool shorten);
inline std::string number(double value) { return number(value, usual_decimals, true); }
/// The same for what is multiplied by columns and rows: four digits that count, however small it is ("−0.0004551").
std::string factor(double value);

/// The decimals a column needs so that different values look different and short ones stay short; at most `at_most`.
int decimals_needed(std::span<const double> values, int at_most = usual_decimals);

/// Two numbers with as many decimals as tell them apart (all 17 digits if need be); equal numbers look equal.
std::pair<std::string, std::string> tell_apart(double a, double b);

/// Decimal that reads back to the same bits, and the hex float: "0.1 (0x1.999999999999ap-4)".
std::string exact(double value);

/// Where numbers stand in a sentence or a formula, as (first byte, bytes): "−0.5" and "∞", but not the digits of a name
/// as x_0.
std::vector<std::pair<std::size_t, std::size_t>> numbers_in(std::string_view text);
/// Is this what a number looks like there, rounded to the decimals that it is written with?
bool shown_as(double value, std::string_view text);

/// Thousands set apart by a no-break space: "12 041".
std::string grouped(std::int64_t value);

/// Three significant digits, without an exponent.
std::string three_digits(double value);
/// "85.0 µs", "12.4 ms", "1.24 s".
std::string seconds_text(double seconds);

}  // namespace zstep
