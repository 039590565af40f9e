#include "traces/check/precision.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string_view>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "traces/events/fields.hpp"
#include "traces/events/slots.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/math/portable_math.hpp"

namespace zstep {

namespace {

constexpr std::int64_t most_events = 200'000;  // what they do not show, later ones hardly do

/// The digits that a number needs to be read back: all that count, and those behind the point; and the power of ten of
/// the first of them.
struct Digits {
  int all = 0, decimals = 0, exponent = 0;
};
template <class Number>
Digits digits_of(Number value) {
  std::array<char, 64> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific).ptr;
  const std::string_view written(text.data(), static_cast<std::size_t>(end - text.data()));
  const std::size_t e = written.find('e');
  Digits digits;
  for (const char c : written.substr(0, e)) digits.all += c >= '0' && c <= '9';
  const char* from = written.data() + e + 1;
  std::from_chars(*from == '+' ? from + 1 : from, written.data() + written.size(), digits.exponent);
  digits.decimals = std::max(0, digits.all - 1 - digits.exponent);
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
    ++by_digits[std::min(needed.all, most_digits)];
    ++by_decimals[std::min(needed.decimals, most_digits)];
    many_digits = many_digits || needed.all > few;
    many_decimals = many_decimals || needed.decimals > few;
    if (!float32) return;
    // Either the float32 itself, or the shortest text that reads back as one.
    const auto narrow = static_cast<float>(value);
    float32 = narrow == value || digits_of(narrow).all == needed.all;
  }
  /// The most digits that any number needs, if so many of them need as many that they may have been cut there: of
  /// numbers that are rounded to k digits nine in ten need all k.
  static std::optional<int> cut_at(const std::array<std::int64_t, most_digits + 1>& counts, std::int64_t numbers) {
    int most = most_digits;
    while (most > 0 && counts[most] == 0) --most;
    constexpr int fewest = 3;
    const bool many = 2 * counts[most] > numbers;
    return most >= fewest && most <= few && many ? std::optional(most) : std::nullopt;
  }
};

/// Are they cut at so many digits, or decimals? Coordinates of the scene do not show it, nor do numbers that need only
/// few bits; and one or two very short numbers may be so by chance, or by a mistake.
bool are_cut(const Trace& trace, int most, int Digits::*count, bool declared) {
  std::vector<double> given;
  for (const glm::dvec3& point : trace.scene().points) given.insert(given.end(), {point.x, point.y, point.z});
  std::sort(given.begin(), given.end());
  std::int64_t telling = 0, need_all = 0;
  std::set<double> different;
  const auto look = [&](double value) {
    constexpr int few_bits = 10;
    const double bits = std::ldexp(value, few_bits);
    if (!std::isfinite(value) || bits == std::trunc(bits)) return;
    if (std::binary_search(given.begin(), given.end(), value)) return;
    ++telling;
    if (digits_of(value).*count != most) return;
    ++need_all;
    if (different.size() < 3) different.insert(value);
  };
  trace.each(0, std::min(trace.size(), most_events), [&](std::int64_t, const RecordedEvent& recorded) {
    visit_event(
        [&]<class E>(const E& event) {
          for_each_field<E>([&](const auto& field) {
            if constexpr (std::is_same_v<typename std::remove_cvref_t<decltype(field)>::value_type, double>)
              look(event.*field.member);
          });
        },
        recorded.event);
    return true;
  });
  constexpr int long_ones = 5;
  return different.size() >= (most >= long_ones ? 1u : declared ? 3u : 2u) && 2 * need_all > telling;
}

bool is_float32(double value) { return static_cast<float>(value) == value; }

/// How a program may count in fixed point: `steps` units make 1 of what a number is a part of (a range of depths, a
/// pixel).
struct Grid {
  double origin, unit;
  std::int64_t steps;
};

/// Are some numbers whole numbers of units? Those do not tell that short ones are as well, having 64 and more of the
/// steps' factors in common with them (1/2 of 65536 steps, 1/15 of 65535), or that float32 would have: it counts in
/// such units from 2^23 of them on.
struct Multiples {
  std::size_t telling = 0, multiples = 0;
  std::vector<double> told = {};  ///< those multiples, each once where the same come one after another

  /// `ends`: numbers that the grid was made from, and that lie on it whatever the others do.
  void add(const std::vector<double>& values, const Grid& grid, std::initializer_list<double> ends = {}) {
    for (const double value : values) {
      constexpr double near = 1e-5;
      constexpr std::int64_t coarse = 64;
      const double units = (value - grid.origin) / grid.unit, whole = std::round(units);
      const bool multiple = std::abs(units - whole) <= near;
      if (multiple && std::abs(whole) < 0x1p62 && std::gcd(static_cast<std::int64_t>(whole), grid.steps) >= coarse)
        continue;
      if (multiple && std::abs(whole) >= 0x1p23 && is_float32(value)) continue;
      // Of numbers with so many units float64 has no parts of one.
      if (std::abs(units) * std::numeric_limits<double>::epsilon() > near) continue;
      if (std::find(ends.begin(), ends.end(), value) != ends.end()) continue;
      ++telling, multiples += multiple;
      if (multiple) told.push_back(value);
    }
  }
  /// Where some do not lie on the grid, one or two may by chance; where all do, one is enough: a number of float64 is
  /// so near to a unit once in 50000 times.
  bool tell() const {
    const std::size_t enough = multiples == telling ? 1 : 3;
    std::vector<double> different = told;
    std::sort(different.begin(), different.end());
    return std::unique(different.begin(), different.end()) - different.begin() >= static_cast<std::ptrdiff_t>(enough);
  }
  bool nearly_all() const { return 10 * multiples >= 9 * telling; }
};

/// The depth of a polygon at a pixel, on its way into the buffer.
struct DepthAt {
  std::int32_t x, y;
  double z;
};
std::optional<DepthAt> depth_at(const Event& event) {
  return visit_event(
      []<class E>(const E& e) -> std::optional<DepthAt> {
        if constexpr (is_of_fragment(at_pixel<E>)) return DepthAt{e.x, e.y, e.z};
        else return std::nullopt;
      },
      event);
}

/// The numbers that a program interpolates: depths and positions, and slopes of both.
struct Interpolated {
  std::vector<double> depths, depth_slopes, positions;

  Interpolated(const Trace& trace, Conventions::Depth depth) {
    constexpr std::size_t enough = 2000;
    const auto add = [](std::vector<double>& to, double value) {
      if (std::isfinite(value) && (to.empty() || to.back() != value)) to.push_back(value);  // again, it says nothing
    };
    // Of `corrected` depths edges and spans have 1/z_v.
    const bool same = depth != Conventions::Depth::corrected;
    trace.each(0, std::min(trace.size(), most_events), [&](std::int64_t, const RecordedEvent& recorded) {
      const auto along = [&](double z) {
        if (same) add(depths, z);
      };
      const auto slope = [&](double dz) {
        if (same) add(depth_slopes, dz);
      };
      if (const auto found = depth_at(recorded.event)) add(depths, found->z);
      else if (const auto* edge = get_if<EdgeTableInsert>(&recorded.event))
        add(positions, edge->x_edge), add(positions, edge->dx_dy), along(edge->z_edge), slope(edge->dz_dy);
      else if (const auto* moved = get_if<EdgeStep>(&recorded.event))
        add(positions, moved->x_edge), along(moved->z_edge);
      else if (const auto* span = get_if<SpanBegin>(&recorded.event)) slope(span->dz_dx);
      else if (const auto* plane = get_if<PlaneSlopes>(&recorded.event)) slope(plane->dz_dx), slope(plane->dz_dy);
      return depths.size() < enough;
    });
  }
  /// Numbers of float32 have 24 bits; not all of them have fewer, as short ones of float64 have.
  bool look_like_float32() const {
    std::size_t narrow = 0, some_long = 0;
    for (const auto* of : {&depths, &depth_slopes, &positions})
      for (const double value : *of) {
        constexpr int some = 20;
        int exponent = 0;
        const double bits = std::ldexp(std::frexp(value, &exponent), some);
        const bool is_long = bits != std::trunc(bits);
        some_long += is_long, narrow += is_long && is_float32(value);
      }
    return some_long > 0 && 10 * narrow >= 9 * some_long;
  }
};

/// What a program interpolates in, where other numbers of its trace are computed in float64, as those of vertices are.
/// Fixed-point numbers are whole numbers of a unit: the largest one of which nearly all are that tell. Some programs
/// count 2ᴺ − 1 units from the least depth to the greatest, others 2ᴺ from 0 for the same length.
std::optional<NumberFormat> format_of_depths(const Trace& trace, const HeldTo& held, Conventions::Depth depth) {
  const Interpolated numbers(trace, depth);
  Multiples positions;
  positions.add(numbers.positions,
                {0, 1 / fixed_positions_a_pixel, static_cast<std::int64_t>(fixed_positions_a_pixel)});
  const double least = formulas::least_depth(trace.scene(), depth), range = depth_range(trace.scene(), depth);
  const auto counted_by = [&](const Grid& grid) {
    Multiples depths;
    depths.add(numbers.depths, grid, {least, least + range});
    depths.add(numbers.depth_slopes, {0, grid.unit, grid.steps});
    return (depths.tell() || positions.tell()) && depths.nearly_all() && positions.nearly_all();
  };
  const auto in_units = [&](NumberFormat format) {
    const auto most = static_cast<std::int64_t>(formulas::greatest_number(format));
    return counted_by({least, range / static_cast<double>(most), most}) ||
           counted_by({0, range / static_cast<double>(most + 1), most + 1});
  };
  using enum NumberFormat;
  for (const NumberFormat format : {fixed16, fixed18, fixed20, fixed24, fixed32})
    if (held.takes(format) && in_units(format)) return format;
  return numbers.look_like_float32() ? std::optional(float32) : std::nullopt;
}

/// Of whole numbers no digits tell what they were computed in, or whether they were cut.
bool whole_depths(const Trace& trace) {
  const Interpolated numbers(trace, trace.header().conventions.depth);
  return !numbers.depths.empty() &&
         std::all_of(numbers.depths.begin(), numbers.depths.end(), [](double z) { return z == std::trunc(z); });
}

/// Are they rounded to such? Then most depths between the ends of a span would not be whole without it, and nearly all
/// of these are less than one off.
bool rounds_to_whole(const Trace& trace) {
  std::optional<SpanBegin> span;
  std::int64_t between = 0, near = 0;
  const auto look = [&](std::int32_t x, std::int32_t y, double z) {
    if (!span || y != span->y || x < span->first || x > span->last || span->x_left == span->x_right) return;
    const double exact =
        formulas::on_line(span->z_left, span->z_right, static_cast<double>(x), span->x_left, span->x_right);
    constexpr double whole = 1e-6;
    if (!(std::abs(exact - std::round(exact)) > whole)) return;
    ++between, near += std::abs(z - exact) < 1;
  };
  trace.each(0, std::min(trace.size(), most_events), [&](std::int64_t, const RecordedEvent& recorded) {
    if (const auto* begin = get_if<SpanBegin>(&recorded.event)) span = *begin;
    else if (const auto depth = depth_at(recorded.event)) look(depth->x, depth->y, depth->z);
    return true;
  });
  constexpr std::int64_t enough = 3;
  return between >= enough && 10 * near >= 9 * between;
}

Precision precision_of_fixed(const Trace& trace, NumberFormat format, Conventions::Depth depth, const char* why) {
  Conventions conventions = trace.header().conventions;
  conventions.number_format = format, conventions.depth = depth;
  const double unit = depth_unit(trace.scene(), conventions);
  double coarser = unit;
  if (depth == Conventions::Depth::corrected) {  // edges and spans have 1/z_v, in units of its own
    conventions.depth = Conventions::Depth::reciprocal;
    coarser = std::max(unit, depth_unit(trace.scene(), conventions));
  }
  Precision found{
      formulas::rounding_of_float64, 2 * coarser, true, fmt::format("{}, {}", word_of(format), why), format, unit};
  found.positions = 2 / fixed_positions_a_pixel;
  return found;
}

Precision precision_of_numbers(const Trace& trace, const HeldTo& held) {
  const int digits = held.digits;
  const Header& header = trace.header();
  const bool declared = header.declares(Convention::number_format);
  if (declared && header.conventions.number_format == NumberFormat::float32)
    return {formulas::rounding_of_float32, 0, true, "float32, as the header declares", NumberFormat::float32};
  if (declared && bits_of(header.conventions.number_format) > 0)
    return precision_of_fixed(trace, header.conventions.number_format, header.conventions.depth,
                              "as the header declares");
  // Which depths they are may not be declared either, and then the units tell both.
  std::vector<Conventions::Depth> depths{header.conventions.depth};
  if (!header.declares(Convention::depth))
    depths.insert(depths.end(), values_of<Conventions::Depth>.begin(), values_of<Conventions::Depth>.end());
  bool as_float32 = false;
  for (const Conventions::Depth depth : depths) {
    const auto seen_format = declared ? std::nullopt : format_of_depths(trace, held, depth);
    if (seen_format && bits_of(*seen_format) > 0)
      return precision_of_fixed(trace, *seen_format, depth, "as the numbers look");
    as_float32 = as_float32 || (seen_format && depth == header.conventions.depth);
  }
  if (as_float32)
    return {formulas::rounding_of_float32, 0, true, "float32, as the numbers look", NumberFormat::float32};
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
  const auto written = [&](int count, const char* what) {
    return fmt::format("written with {} {}{}", count, what, count < digits ? fmt::format(", held to {}", digits) : "");
  };
  if (const auto decimals = Seen::cut_at(seen.by_decimals, seen.numbers);
      decimals && are_cut(trace, *decimals, &Digits::decimals, declared)) {
    const double unit = portable::pow(10.0, -std::max(*decimals, digits));
    return {formulas::rounding_of_float64,
            unit,
            false,
            written(*decimals, "decimals"),
            NumberFormat::float64,
            unit,
            *decimals < digits};
  }
  if (const auto all = Seen::cut_at(seen.by_digits, seen.numbers);
      all && are_cut(trace, *all, &Digits::all, declared)) {
    const int held_to = std::max(*all, digits);
    Precision cut{2 * portable::pow(10.0, 1 - held_to), 0, false, written(*all, "digits")};
    cut.held = *all < digits, cut.digits = held_to;
    return cut;
  }
  // A header that does not say in what depths are kept is held to no more digits than they have.
  const bool corrected = header.conventions.depth == Conventions::Depth::corrected;
  if (!declared && digits == 0 && !corrected && whole_depths(trace) && rounds_to_whole(trace)) {
    Precision rounded{formulas::rounding_of_float64, 1, false, "whole depths, as the numbers look"};
    rounded.unit = 1, rounded.whole = true;
    return rounded;
  }
  constexpr int digits_of_float32 = 6;
  const bool many_digits = std::any_of(seen.by_digits.begin() + digits_of_float32 + 1, seen.by_digits.end(),
                                       [](std::int64_t count) { return count > 0; });
  if (!declared && seen.float32 && many_digits)
    return {formulas::rounding_of_float32, 0, true, "float32, as the numbers look", NumberFormat::float32};
  return {formulas::rounding_of_float64, 0, true,
          declared              ? "float64, as the header declares"
          : whole_depths(trace) ? "float64, as nothing shows otherwise: all depths are whole numbers"
                                : "float64, as the numbers look"};
}

/// The unit of a field, where all kinds that have one of this name give it the same.
std::string_view unit_of(std::string_view field) {
  static const std::map<std::string_view, std::string_view> units = [] {
    std::map<std::string_view, std::string_view> all;
    for (std::size_t kind = 0; kind < kind_count; ++kind)
      for (const FieldOfKind& one : fields_of_kind(kind))
        if (const auto [known, is_new] = all.try_emplace(one.name, one.unit); !is_new && known->second != one.unit)
          known->second = "";
    return all;
  }();
  const auto found = units.find(field);
  return found == units.end() ? std::string_view() : found->second;
}

}  // namespace

void hold(formulas::Situation& at, const Precision& precision) {
  at.roundoff = precision.format == NumberFormat::float32 ? 0x1p-24 : 0x1p-53;
  at.is_fixed = bits_of(precision.format) > 0;
  if (!precision.every_digit) at.written = precision.relative, at.written_off = precision.largest_amount();
}

double last_written_digit(double value, int digits) {
  return portable::pow(10.0, digits_of(value).exponent + 1 - digits);
}

double Precision::amount(const formulas::Place& place) const {
  return positions == 0 && !whole ? absolute : amount(unit_of(place.field));
}

Precision precision_of(const Trace& trace, const HeldTo& held) {
  Precision precision = precision_of_numbers(trace, held);
  precision.depths = held.depths;
  return precision;
}

}  // namespace zstep
