#include "sim/places/typed_place.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "sim/classroom/evaluate.hpp"
#include "sim/places/condition.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/text.hpp"

namespace zstep::places {
namespace {

using classroom::trim;

void replace_all(std::string& text, std::string_view what, std::string_view by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
}

/// With common spaces and a common minus in place of those that the viewer writes.
std::string plain(std::string text) {
  for (const std::string_view space : {"\u00a0", "\u202f", "\u2009"}) replace_all(text, space, " ");
  replace_all(text, "\u2212", "-");
  return std::string(trim(text));
}

/// Digits and nothing else. A number with more than 18 of them is cut to these: no trace is as long.
std::optional<std::int64_t> digits_of(std::string_view text) {
  if (text.empty() || !std::all_of(text.begin(), text.end(), is_digit)) return std::nullopt;
  text.remove_prefix(std::min(text.find_first_not_of('0'), text.size() - 1));
  std::int64_t value = 0;
  for (const char c : text.substr(0, 18)) value = value * 10 + (c - '0');
  return value;
}

/// Digits, which one and the same sign may part in groups of three: 12041, 12 041, 12,041, 12'041'000.
std::optional<std::int64_t> whole_number(std::string_view text) {
  text = trim(text);
  const auto sign = std::find_if_not(text.begin(), text.end(), is_digit);
  if (sign == text.end()) return digits_of(text);
  if (std::string_view(" ,'_").find(*sign) == std::string_view::npos || sign == text.begin() || sign - text.begin() > 3)
    return std::nullopt;
  std::string digits(text.begin(), sign);
  for (auto at = sign; at != text.end(); at += 4) {
    if (*at != *sign || text.end() - at < 4 || !std::all_of(at + 1, at + 4, is_digit)) return std::nullopt;
    digits.append(at + 1, at + 4);
  }
  return digits_of(digits);
}

/// "37.5 %" as 37.5, from 0 to 100.
std::optional<double> percentage(std::string_view text) {
  if (!text.ends_with('%')) return std::nullopt;
  std::string number(trim(text.substr(0, text.size() - 1)));
  std::replace(number.begin(), number.end(), ',', '.');
  if (number.empty() || !is_digit(number.front())) return std::nullopt;
  double value = 0;
  const bool power = number.find_first_of("eE") != std::string::npos;
  if (power || read_number(number, value) != number.size() || value > 100) return std::nullopt;
  return value;
}

/// "9, 17", "(9, 17)", "9 17".
std::optional<std::pair<std::int64_t, std::int64_t>> two_numbers(std::string_view text) {
  if (text.starts_with('(') && text.ends_with(')')) text = trim(text.substr(1, text.size() - 2));
  const std::size_t end = std::find_if_not(text.begin(), text.end(), is_digit) - text.begin();
  std::string_view rest = trim(text.substr(end));
  if (rest.starts_with(',') || rest.starts_with(';')) rest = trim(rest.substr(1));
  const auto x = digits_of(text.substr(0, end)), y = digits_of(rest);
  if (end == text.size() || !x || !y) return std::nullopt;
  return std::pair{*x, *y};
}

class Reader {
 public:
  Reader(const Here& here, const std::string& text, const std::string& option)
      : here_(here), typed_(plain(text)), where_(option) {}

  Place read() const {
    if (typed_.empty()) nothing();
    if (const auto mark = here_.marks.find(typed_)) return {*mark, Unit::event};
    const std::string small = lower_case(typed_);
    const std::string_view all = small;
    if (all == "end") return {size(), Unit::event};
    if (all == "start" || all == "beginning") return {0, Unit::event};
    if (all.size() > 1 && all.ends_with('%') && !percentage(all))
      fail(fmt::format("'{}' is no part of a trace", typed_), "give 0% to 100%");
    if (const auto percent = percentage(all))
      return {std::llround(*percent / 100 * static_cast<double>(size())), Unit::event};
    if (all.starts_with('+') || all.starts_with('-'))
      if (const auto away = whole_number(all.substr(1)))
        return {all[0] == '+' ? here_.step + *away : std::max<std::int64_t>(0, here_.step - *away), Unit::event};
    const std::size_t after_word =
        std::find_if_not(all.begin(), all.end(), [](char c) { return is_letter(c) || c == ' '; }) - all.begin();
    const std::string_view word = trim(all.substr(0, after_word));
    std::string_view rest = trim(all.substr(after_word));
    if (word.empty()) return number_alone(rest);
    while (rest.starts_with('=')) rest = trim(rest.substr(1));
    const auto number = whole_number(rest);
    if (word == "step" && number) return {*number, Unit::event};
    if ((word == "y" || word == "line" || word == "row" || word == "scan line" || word == "scanline") && number)
      return scan_line(*number);
    if (word == "stop" && number) return stop(*number);
    if (word == "pixel")
      if (const auto pair = two_numbers(rest)) return pixel(pair->first, pair->second);
    return polygon();
  }

 private:
  std::int64_t size() const { return here_.trace.size(); }

  [[noreturn]] void fail(const std::string& what, const std::string& mend) const {
    throw InputError(where_, what, mend);
  }

  /// 12041, or 9 17. What could be both is the step where it is written as zstep writes steps, if there is such a step.
  Place number_alone(std::string_view text) const {
    const auto number = whole_number(text);
    const auto pair = two_numbers(text);
    if (!number && !pair) nothing();
    if (!pair) return {*number, Unit::event};
    const Raster& raster = here_.trace.scene().raster;
    const bool inside = pair->first < raster.width && pair->second < raster.height;
    if (!number) return pixel(pair->first, pair->second);
    const char sign = text[text.find_first_not_of("0123456789")];
    const bool led_by_zero = text[text.find_first_not_of("0123456789") + 1] == '0';
    if (!inside || led_by_zero || (sign != ',' && *number <= size())) return {*number, Unit::event};
    if (*number > size()) return pixel(pair->first, pair->second);
    fail(fmt::format("{} may be a step or a pixel", text),
         fmt::format("type step {} or pixel {} {}", *number, pair->first, pair->second));
  }

  Place pixel(std::int64_t x, std::int64_t y) const {
    const Raster& raster = here_.trace.scene().raster;
    if (x >= raster.width || y >= raster.height)
      fail(fmt::format("there is no pixel ({}, {})", x, y),
           fmt::format("the picture has {} by {} pixels, counted from (0, 0)", raster.width, raster.height));
    return {here_.step, Unit::event, Trace::Pixel{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)}};
  }

  /// The next place where work on this scan line begins, or the last one before the reader where there is no next.
  Place scan_line(std::int64_t line) const {
    const Trace& trace = here_.trace;
    const auto begins = [line](const ScanLineBegin& event) { return event.y == line; };
    if (!trace.has(kind_of<ScanLineBegin>)) fail("no scan line begins in this trace", what_to_type);
    if (const auto next = trace.next<ScanLineBegin>(here_.step, begins)) return {*next, Unit::scan_line};
    const auto last = trace.previous<ScanLineBegin>(here_.step + 1, begins);
    if (!last)
      fail(fmt::format("no work on scan line {} begins in this trace", line),
           fmt::format("the picture has the scan lines 0 to {}", trace.scene().raster.height - 1));
    Place place{*last, Unit::scan_line};
    place.note = fmt::format("No later work on scan line {} begins; this is the last that did.", line);
    return place;
  }

  Place stop(std::int64_t number) const {
    if (!here_.lesson) fail("there is no lesson here, so it has no stops", what_to_type);
    const auto& stops = here_.lesson->stops;
    if (number < 1 || number > std::ssize(stops))
      fail(fmt::format("there is no stop {}", number), fmt::format("the lesson has the stops 1 to {}", stops.size()));
    Place place{stops[number - 1].position};
    place.stop = static_cast<int>(number - 1);
    return place;
  }

  /// "B", "polygon B", "p 3", "P3": where work on it begins next, or began last.
  Place polygon() const {
    const auto polygons = named_polygons();
    if (polygons.empty()) nothing();
    const auto is_meant = [&](const PolygonMark& mark) {
      return std::find(polygons.begin(), polygons.end(), mark.polygon) != polygons.end();
    };
    std::optional<std::int64_t> found;
    for (const PolygonMark& mark : here_.trace.polygons()) {
      if (!is_meant(mark)) continue;
      if (mark.position > here_.step) return {mark.position, Unit::polygon};
      found = mark.position;
    }
    if (found) return {*found, Unit::polygon};
    fail(fmt::format("no work on polygon {} begins in this trace",
                     polygon_label(here_.trace.scene(), static_cast<std::int32_t>(polygons.front()))),
         "it may have been dropped before; Y and zstep why-not say why");
  }
  std::vector<double> named_polygons() const {
    const Scene& scene = here_.trace.scene();
    if (const auto all = polygons_called(scene, typed_); !all.empty()) return all;
    const std::string small = lower_case(typed_);
    for (const std::string_view word : {"polygon", "p"}) {
      if (!small.starts_with(word) || small.size() == word.size()) continue;
      const std::string name(trim(std::string_view(typed_).substr(word.size())));
      if (word == "p" && name.size() + 1 == typed_.size() && !is_digit(name.front()))
        continue;  // a word that begins so
      if (const auto all = polygons_called(scene, name); !all.empty()) return all;
      if (const auto number = whole_number(name); number && *number < std::ssize(scene.polygons))
        return {static_cast<double>(*number)};
      if (const auto number = whole_number(name))
        fail(fmt::format("there is no polygon {}", *number),
             fmt::format("the scene has the polygons 0 to {}", std::ssize(scene.polygons) - 1));
    }
    return {};
  }

  [[noreturn]] void nothing() const {
    if (typed_.empty()) fail("nothing was typed", what_to_type);
    std::string asked = typed_;
    if (const std::string small = lower_case(typed_); small.starts_with("polygon "))
      asked = trim(std::string_view(typed_).substr(8));
    std::vector<std::string_view> names;
    for (const Bookmark& mark : here_.marks.all()) names.push_back(mark.name);
    for (const Polygon& polygon : here_.trace.scene().polygons)
      if (!polygon.name->empty()) names.push_back(*polygon.name);
    const bool digits = !is_letter(asked.front()) || names.empty();
    const std::string near =
        digits ? "" : " Bookmarks and polygons, nearest first: " + classroom::nearest_first(asked, names);
    fail(fmt::format("'{}' is no step, and no bookmark or polygon is called so", typed_),
         fmt::format("{}.{}", what_to_type, near));
  }

  const Here& here_;
  std::string typed_, where_;
};

}  // namespace

Place find_place(const Here& here, const std::string& text, const std::string& option) {
  return Reader(here, text, option).read();
}

const char* const what_to_type =
    "type a step (12041, +5), a part (25 %), a polygon (B, p 3), a scan line (line 17), a stop (stop 3), a pixel (9, "
    "17) or a bookmark's name";

}  // namespace zstep::places
