#include "traces/check/precision.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "traces/events/slots.hpp"
#include "traces/formulas/rounding.hpp"

namespace zstep {

namespace {

constexpr std::int64_t most_events = 200'000;  // what they do not show, later ones hardly do

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

/// How many of some numbers are whole multiples of a unit, and of these how many of no larger one.
struct Multiples {
  std::size_t numbers = 0, multiples = 0, odd = 0;

  Multiples(const std::vector<double>& values, double unit) {
    for (const double value : values) {
      if (unit < 1 && value == std::trunc(value)) continue;  // what is whole says nothing
      ++numbers;
      constexpr double near = 1e-5;
      const double units = value / unit, whole = std::round(units);
      if (std::abs(units - whole) > near) continue;
      ++multiples;
      odd += std::fmod(whole, 2) != 0;
    }
  }
  bool nearly_all() const { return 10 * multiples >= 9 * numbers; }
  bool some_odd() const { return 10 * odd >= numbers; }
};

/// What a program interpolates in, where other numbers of its trace are computed in float64, as those of vertices are.
/// Fixed-point depths are whole multiples of a unit: the largest one of which nearly all are, if some are of no larger
/// one, or if positions are fixed-point numbers, too.
std::optional<NumberFormat> format_of_depths(const Trace& trace) {
  constexpr std::size_t enough = 2000, fewest = 4;
  constexpr double few = 0.1;
  std::vector<double> depths, positions;
  const auto add = [](std::vector<double>& to, double value) {
    if (std::isfinite(value) && (to.empty() || to.back() != value)) to.push_back(value);  // again, it says nothing
  };
  const bool edges_too = trace.header().conventions.depth != Conventions::Depth::corrected;  // else they have 1/z_v
  trace.each(0, std::min(trace.size(), most_events), [&](std::int64_t, const RecordedEvent& recorded) {
    const auto add_edge = [&](double x, double z) {
      add(positions, x);
      if (edges_too) add(depths, z);
    };
    if (const auto* found = get_if<DepthInterpolate>(&recorded.event)) add(depths, found->z);
    else if (const auto* compared = get_if<DepthCompare>(&recorded.event)) add(depths, compared->z);
    else if (const auto* edge = get_if<EdgeTableInsert>(&recorded.event)) add_edge(edge->x_edge, edge->z_edge);
    else if (const auto* moved = get_if<EdgeStep>(&recorded.event)) add_edge(moved->x_edge, moved->z_edge);
    return depths.size() < enough;
  });
  if (depths.size() + positions.size() < fewest) return std::nullopt;
  const auto is_narrow = [](double value) { return static_cast<double>(static_cast<float>(value)) == value; };
  const auto is_long = [](double value) {
    constexpr int some = 20;
    int exponent = 0;
    const double bits = std::ldexp(std::frexp(value, &exponent), some);
    return bits != std::trunc(bits);
  };
  const auto share = [](const std::vector<double>& of, auto&& is) {
    return static_cast<double>(std::count_if(of.begin(), of.end(), is)) / static_cast<double>(of.size());
  };
  const Multiples of_position(positions, 1 / fixed_positions_a_pixel);
  const bool fixed_positions = of_position.odd > 0 && of_position.nearly_all() && of_position.some_odd();
  for (std::size_t k = 0; k < words_of<NumberFormat>.size(); ++k) {
    Conventions conventions = trace.header().conventions;
    conventions.number_format = static_cast<NumberFormat>(k);
    const double unit = depth_unit(trace.scene(), conventions);
    if (unit == 0) continue;
    int exponent = 0;
    const bool is_power_of_two = std::frexp(unit, &exponent) == 0.5;  // then short numbers are multiples anyway
    const Multiples of_unit(depths, unit);
    const bool tells = of_unit.numbers >= fewest &&
                       (of_unit.some_odd() || (!is_power_of_two && share(depths, is_long) >= few));
    if (of_unit.nearly_all() && (tells || fixed_positions)) return conventions.number_format;
  }
  depths.insert(depths.end(), positions.begin(), positions.end());
  // Numbers of float32 have 24 bits; not all of them have fewer, as short ones of float64 have.
  if (share(depths, is_narrow) >= 1 - few && share(depths, is_long) >= few) return NumberFormat::float32;
  return std::nullopt;
}

Precision precision_of_fixed(const Trace& trace, NumberFormat format, const char* why) {
  Conventions conventions = trace.header().conventions;
  conventions.number_format = format;
  const double unit = std::max(depth_unit(trace.scene(), conventions), 1 / fixed_positions_a_pixel);
  return {formulas::rounding_of_float64, 2 * unit, true, fmt::format("{}, {}", word_of(format), why), format, unit};
}

}  // namespace

Precision precision_of(const Trace& trace) {
  const Header& header = trace.header();
  const bool declared = header.declares(Convention::number_format);
  if (declared && header.conventions.number_format == NumberFormat::float32)
    return {formulas::rounding_of_float32, 0, true, "float32, as the header declares", NumberFormat::float32};
  if (declared && bits_of(header.conventions.number_format) > 0)
    return precision_of_fixed(trace, header.conventions.number_format, "as the header declares");
  const auto seen_format = declared ? std::nullopt : format_of_depths(trace);
  if (seen_format && bits_of(*seen_format) > 0) return precision_of_fixed(trace, *seen_format, "as the numbers look");
  if (seen_format) return {formulas::rounding_of_float32, 0, true, "float32, as the numbers look", *seen_format};
  Seen seen;
  trace.each(0, std::min(trace.size(), most_events), [&](std::int64_t, const RecordedEvent& recorded) {
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
