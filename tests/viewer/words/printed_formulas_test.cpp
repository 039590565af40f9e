// The law of formulas: what is printed is evaluated as it stands on the line, and must give the number behind it; and
// that number must be the event's own. Every printed number stands for all that would be written so.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "tests/golden/golden.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

struct Interval {
  double low, high;
};
constexpr double infinite = std::numeric_limits<double>::infinity();

Interval hull(std::initializer_list<double> ends) { return {std::min(ends), std::max(ends)}; }
Interval operator+(Interval a, Interval b) { return {a.low + b.low, a.high + b.high}; }
Interval operator-(Interval a, Interval b) { return {a.low - b.high, a.high - b.low}; }
Interval operator*(Interval a, Interval b) {
  return hull({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
}
Interval operator/(Interval a, Interval b) {
  if (b.low <= 0 && b.high >= 0) return {-infinite, infinite};  // too few digits to say
  return hull({a.low / b.low, a.low / b.high, a.high / b.low, a.high / b.high});
}

/// What a printed number may stand for: at least four decimals are written where a number has them.
Interval meant_by(std::string_view text) {
  std::string plain(text);
  for (std::size_t at = plain.find("\u2212"); at != std::string::npos; at = plain.find("\u2212", at))
    plain.replace(at, 3, "-");
  const double value = std::strtod(plain.c_str(), nullptr);
  const std::size_t power = std::min(plain.find('e'), plain.size()), point = std::min(plain.find('.'), power);
  const int written = point == power ? 0 : static_cast<int>(power - point) - 1;
  const int exponent = power < plain.size() ? std::atoi(plain.c_str() + power + 1) : 0;
  const int decimals = power < plain.size() ? written : std::max(written, usual_decimals);
  const double half = 0.500001 * std::pow(10.0, exponent - decimals);
  return {value - half, value + half};
}

/// A printed expression of numbers alone; throws std::invalid_argument for anything else.
class Reading {
 public:
  explicit Reading(std::string_view text) : text_(text), numbers_(numbers_in(text)) {}
  Interval all() {
    const Interval value = sum();
    if (at_ != text_.size()) fail();
    return value;
  }
  bool computes() const { return computes_; }  ///< it is more than a number

 private:
  [[noreturn]] static void fail() { throw std::invalid_argument("not an expression of numbers"); }
  bool take(std::string_view sign) {
    if (!text_.substr(at_).starts_with(sign)) return false;
    at_ += sign.size();
    return true;
  }
  Interval sum() {
    Interval value = product();
    while (true) {
      if (take(" + ")) value = value + product(), computes_ = true;
      else if (take(" \u2212 ")) value = value - product(), computes_ = true;
      else return value;
    }
  }
  Interval product() {
    Interval value = single();
    while (true) {
      if (take("\u00b7")) value = value * single(), computes_ = true;
      else if (take("/")) value = value / single(), computes_ = true;
      else if (text_.substr(at_).starts_with("(")) value = value * single(), computes_ = true;
      else return value;
    }
  }
  Interval single() {
    if (take("(")) return closed(sum(), ")");
    if (take("\u2308")) return rounded(closed(sum(), "\u2309"), [](double x) { return std::ceil(x); });
    if (take("\u230a")) return rounded(closed(sum(), "\u230b"), [](double x) { return std::floor(x); });
    const auto here =
        std::find_if(numbers_.begin(), numbers_.end(), [&](const auto& number) { return number.first == at_; });
    if (here != numbers_.end() && text_.substr(at_, here->second).find("\u221e") == std::string_view::npos) {
      at_ += here->second;
      return meant_by(text_.substr(here->first, here->second));
    }
    if (take("\u2212")) return Interval{0, 0} - single();
    fail();
  }
  Interval closed(Interval value, std::string_view sign) {
    if (!take(sign)) fail();
    return value;
  }
  template <class Round>
  Interval rounded(Interval value, Round&& round) {
    computes_ = true;
    return {round(value.low), round(value.high)};
  }

  std::string_view text_;
  std::vector<std::pair<std::size_t, std::size_t>> numbers_;
  std::size_t at_ = 0;
  bool computes_ = false;
};

std::vector<std::string> parts(const std::string& line, const std::string& sign) {
  std::vector<std::string> all;
  std::size_t from = 0;
  for (std::size_t at = line.find(sign); at != std::string::npos; from = at + sign.size(), at = line.find(sign, from))
    all.push_back(line.substr(from, at - from));
  all.push_back(line.substr(from));
  return all;
}

struct Read {
  Interval value;
  bool computes;
};
std::optional<Read> read(const std::string& text) {
  try {
    Reading reading(text);
    const Interval value = reading.all();
    return Read{value, reading.computes()};
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

/// The event's fields by name.
std::map<std::string, double> fields_by_name(const Event& event) {
  std::map<std::string, double> fields;
  visit_event(
      [&](const auto& known) {
        for_each_field<std::decay_t<decltype(known)>>(
            [&](const auto& field) { fields[std::string(field.name)] = static_cast<double>(known.*(field.member)); });
      },
      event);
  return fields;
}

/// Is the number behind this name one of the event's fields that the name may stand for? A name that none of them has
/// is an operand's.
bool is_field(const std::map<std::string, double>& fields, std::string name, const std::string& number) {
  static const std::map<std::string, std::string> others = {{"1/m", "dx_dy"},
                                                            {"dz/dy", "dz_dy"},
                                                            {"dz/dx", "dz_dx"},
                                                            {"the value", "value"},
                                                            {"first scan line", "first_row"},
                                                            {"leaves at y", "end_row"},
                                                            {"z*", "z"},
                                                            {"z_v", "z"}};
  if (const std::size_t after = name.rfind(": "); after != std::string::npos) name = name.substr(after + 2);
  if (const std::size_t of = name.find(" of "); of != std::string::npos) name = name.substr(0, of);
  const auto known = others.find(name);
  const std::string wanted = known == others.end() || fields.contains(name) ? name : known->second;
  const auto named = [&](const auto& field) { return field.first == wanted || field.first.starts_with(wanted + "_"); };
  return std::none_of(fields.begin(), fields.end(), named) ||
         std::any_of(fields.begin(), fields.end(),
                     [&](const auto& field) { return named(field) && shown_as(field.second, number); });
}

}  // namespace

TEST_CASE(
    "law: what is printed as a formula gives, when it is evaluated, the number behind it, and that is the event's") {
  std::map<std::string, int> evaluated;  // of each kind
  test::for_each_golden([&](const std::string& name, const Trace& trace) {
    CAPTURE(name);
    Replay replay(trace);
    while (replay.position() < trace.size()) {
      replay.step_forward();
      const Event event = replay.current()->event;
      const Explanation told = explain(trace, replay.state(), *replay.current());
      const auto step = replay.position();
      const std::string kind(
          visit_event([](const auto& known) { return kind_text<std::decay_t<decltype(known)>>.name; }, event));
      CAPTURE(step);
      for (const std::string& line : told.formulas) {
        CAPTURE(line);
        const std::vector<std::string> sides = parts(line, " = ");
        for (std::size_t k = 1; k + 1 < sides.size(); ++k) {
          const auto formula = read(sides[k]), result = read(sides[k + 1]);
          if (!formula || !formula->computes || !result) continue;
          const bool meets = formula->value.low <= result->value.high && result->value.low <= formula->value.high;
          REQUIRE(meets);
          if (std::isinf(formula->value.high)) continue;
          ++evaluated[kind];
          REQUIRE(is_field(fields_by_name(event), sides[0], sides[k + 1]));
        }
        // "z < zbuffer[x,y]:  5 < 7  is true"
        const std::size_t colon = line.find(":  "), is = line.find("  is ");
        if (colon == std::string::npos || is == std::string::npos) continue;
        const std::string test = line.substr(colon + 3, is - colon - 3);
        for (const std::string sign : {" < ", " \u2264 ", " \u2265 "}) {
          const std::vector<std::string> both = parts(test, sign);
          if (both.size() != 2) continue;
          const auto value = [](const std::string& text) {
            return text == "\u221e"         ? infinite
                   : text == "\u2212\u221e" ? -infinite
                                            : (meant_by(text).low + meant_by(text).high) / 2;
          };
          const double left = value(both[0]), right = value(both[1]);
          const bool so = sign == " < " ? left < right : sign == " \u2264 " ? left <= right : left >= right;
          REQUIRE(so == (line.substr(is + 5) == "true"));
          ++evaluated[kind];
        }
      }
    }
  });
  for (const char* kind : {"view_transform", "projection",   "viewport_transform", "clip_cross",    "edge_table_insert",
                           "edge_step",      "span_begin",   "depth_interpolate",  "depth_compare", "pixel_paint",
                           "plane_depth",    "implied_edge", "vertex_side",        "eye_side",      "split_vertex",
                           "ray_plane",      "ray_hit",      "horizon_test",       "horizon_cross", "line_cross"}) {
    CAPTURE(kind);
    CHECK(evaluated[kind] > 0);
  }
}
