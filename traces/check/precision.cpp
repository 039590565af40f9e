#include "traces/check/precision.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <variant>

#include <fmt/format.h>

#include "traces/events/slots.hpp"
#include "traces/formulas/rounding.hpp"

namespace zstep {

namespace {

/// The digits that a number needs to be read back: all that count, and those behind the point.
struct Digits {
  int all = 0, decimals = 0;
};
template <class Number>
Digits digits_of(Number value) {
  std::array<char, 64> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific).ptr;
  const std::string_view written(text.data(), static_cast<std::size_t>(end - text.data()));
  const std::size_t e = written.find('e');
  Digits digits;
  for (const char c : written.substr(0, e)) digits.all += c >= '0' && c <= '9';
  int exponent = 0;
  const char* from = written.data() + e + 1;
  std::from_chars(*from == '+' ? from + 1 : from, written.data() + written.size(), exponent);
  digits.decimals = std::max(0, digits.all - 1 - exponent);
  return digits;
}

/// How many digits the numbers of a trace need, and how many numbers need the most.
struct Seen {
  static constexpr int most_digits = 20, few = 10;
  std::array<std::int64_t, most_digits + 1> by_digits{}, by_decimals{};
  bool float32 = true;
  bool many_digits = false, many_decimals = false;  ///< more than where numbers are said to be cut
  std::int64_t numbers = 0;

  void add(double value) {
    if (!std::isfinite(value) || value == std::trunc(value)) return;
    ++numbers;
    const Digits needed = digits_of(value);
    ++by_digits[static_cast<std::size_t>(std::min(needed.all, most_digits))];
    ++by_decimals[static_cast<std::size_t>(std::min(needed.decimals, most_digits))];
    many_digits = many_digits || needed.all > few;
    many_decimals = many_decimals || needed.decimals > few;
    if (!float32) return;
    // Either the float32 itself, or the shortest text that reads back as one.
    const auto narrow = static_cast<float>(value);
    float32 = static_cast<double>(narrow) == value || digits_of(narrow).all == needed.all;
  }
  /// The most digits that any number needs, if so many of them need as many that they must have been cut there: of
  /// numbers that are rounded to k digits nine in ten need all k.
  static std::optional<int> cut_at(const std::array<std::int64_t, most_digits + 1>& counts, std::int64_t numbers) {
    int most = most_digits;
    while (most > 0 && counts[static_cast<std::size_t>(most)] == 0) --most;
    constexpr int fewest = 3;
    const bool many = 2 * counts[static_cast<std::size_t>(most)] > numbers;
    return most >= fewest && most <= few && many ? std::optional(most) : std::nullopt;
  }
};

}  // namespace

Precision precision_of(const Trace& trace) {
  const Header& header = trace.header();
  const bool declared = header.declares(Convention::number_format);
  if (declared && header.conventions.number_format == NumberFormat::float32)
    return {formulas::rounding_of_float32, 0, true, "float32, as the header declares", NumberFormat::float32};
  if (declared && bits_of(header.conventions.number_format) > 0) {
    const double unit = std::max(depth_unit(trace.scene(), header.conventions), 1 / fixed_positions_a_pixel);
    return {formulas::rounding_of_float64, 2 * unit, true,
            fmt::format("{}, as the header declares", word_of(header.conventions.number_format)),
            header.conventions.number_format, unit};
  }
  Seen seen;
  constexpr std::int64_t enough = 200'000;  // events: what they do not show, later ones hardly do
  trace.each(0, std::min(trace.size(), enough), [&](std::int64_t, const RecordedEvent& recorded) {
    visit_event(
        [&]<class E>(const E& event) {
          for_each_field<E>([&](const auto& field) {
            if constexpr (std::is_same_v<typename std::remove_cvref_t<decltype(field)>::value_type, double>)
              seen.add(event.*field.member);
          });
        },
        recorded.event);
    // Numbers with all their digits are not cut, whatever comes later.
    return !(seen.many_digits && seen.many_decimals && (declared || !seen.float32));
  });
  if (const auto decimals = Seen::cut_at(seen.by_decimals, seen.numbers))
    return {formulas::rounding_of_float64, std::pow(10.0, -*decimals), false,
            fmt::format("written with {} decimals", *decimals), NumberFormat::float64, std::pow(10.0, -*decimals)};
  if (const auto digits = Seen::cut_at(seen.by_digits, seen.numbers))
    return {2 * std::pow(10.0, 1 - *digits), 0, false, fmt::format("written with {} digits", *digits)};
  constexpr int digits_of_float32 = 6;
  const bool many_digits = std::any_of(seen.by_digits.begin() + digits_of_float32 + 1, seen.by_digits.end(),
                                       [](std::int64_t count) { return count > 0; });
  if (!declared && seen.float32 && many_digits)
    return {formulas::rounding_of_float32, 0, true, "float32, as the numbers look", NumberFormat::float32};
  return {formulas::rounding_of_float64, 0, true,
          declared ? "float64, as the header declares" : "float64, as the numbers look"};
}

}  // namespace zstep
