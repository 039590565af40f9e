#include "sim/classroom/fill.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "sim/classroom/evaluate.hpp"
#include "sim/classroom/markdown.hpp"
#include "traces/error.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/text.hpp"

namespace zstep::classroom {
namespace {

using Kind = Expression::Kind;

constexpr std::string_view form_of_slots =
    "write {z}, {z:2}, {z = 4.25}, {z ~ 0.333} or {\"a word\"}; a brace itself is {{ or }}";

struct Slot {
  Expression expression;
  char mark = 0;  // ':', '=', '~', '"' for a word, or none
  std::string written;
};

/// Whether an expression is what an author may write for a number: 4.25, −1/3, √3/2.
bool is_written_number(const Expression& expression) {
  if (expression.kind == Kind::number) return true;
  if (expression.kind < Kind::negate || expression.kind > Kind::divide || expression.kind == Kind::not_) return false;
  for (const Expression& part : expression.parts) {
    if (!is_written_number(part)) return false;
  }
  return true;
}

/// A number that stands where no run can check it.
[[noreturn]] void unchecked(std::string_view shown, std::string_view what, std::string_view digits,
                            std::string_view word, std::string_view where) {
  throw InputError(
      where, fmt::format("`{}` {}", shown, what),
      fmt::format("write {{… = {}}} with what it is a number of, or {{\"{}\"}} for a word or a name", digits, word));
}

Slot parse_slot(std::string_view text, std::string_view where) {
  Slot slot;
  std::string_view rest = trim(text);
  if (rest.size() > 2 && rest.front() == '"' && rest.find('"', 1) == rest.size() - 1) {
    slot.mark = '"';
    slot.written = rest.substr(1, rest.size() - 2);
    return slot;
  }
  slot.expression = parse_expression(text, rest, where);
  if ((rest.empty() || rest.front() == ':') && is_written_number(slot.expression)) {
    const std::string_view number = trim(text.substr(0, text.size() - rest.size()));
    unchecked(fmt::format("{{{}}}", text), "is a number that nothing checks", number, number, where);
  }
  if (rest.empty()) return slot;
  if (rest.substr(0, 3) == "≈") {
    slot.mark = '~';
    rest.remove_prefix(3);
  } else {
    slot.mark = rest.front();
    rest.remove_prefix(1);
  }
  slot.written = trim(rest);
  const bool known = slot.mark == ':' || slot.mark == '=' || slot.mark == '~';
  if (!known || slot.written.empty())
    throw InputError(where, fmt::format("`{{{}}}` cannot be read", text), form_of_slots);
  if (slot.mark == ':' && (slot.written.size() != 1 || slot.written[0] < '0' || slot.written[0] > '9')) {
    throw InputError(where, fmt::format("`:{}` is no number of decimals", slot.written), "write a digit, {z:2}");
  }
  return slot;
}

/// Calls text(piece) and slot(inside, line) for what is outside and inside of braces.
template <class Text, class Inside>
void split(std::string_view all, const Place& place, Text&& text, Inside&& inside) {
  std::int32_t line = 0;
  for (std::size_t at = 0; at < all.size();) {
    const char c = all[at];
    if (c == '\n') ++line;
    if (c != '{' && c != '}') {
      text(all.substr(at, 1));
      ++at;
      continue;
    }
    if (at + 1 < all.size() && all[at + 1] == c) {
      text(all.substr(at, 1));
      at += 2;
      continue;
    }
    if (c == '}') throw InputError(place.str(line), "a `}` without its `{`", "a brace itself is }}");
    const std::size_t end = all.find_first_of("{}\n", at + 1);
    if (end == std::string_view::npos || all[end] != '}')
      throw InputError(place.str(line), "a `{` is not closed on its line", form_of_slots);
    inside(all.substr(at + 1, end - at - 1), line);
    at = end + 1;
  }
}

constexpr std::string_view ascii_digits = "0123456789";
constexpr std::string_view ascii_letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_";

/// Whether what stands before a digit makes it a part of a name, as in V01, T_1 and θ2: a letter, Latin or Greek, or _.
bool ends_name(std::string_view before) {
  if (before.empty()) return false;
  const auto byte = [&](std::size_t from_end) { return byte_of(before[before.size() - from_end]); };
  if (before.size() > 1 && continues_character(before.back()))  // À … Ͽ but × and ÷
    return byte(2) >= 0xC3 && byte(2) <= 0xCF && !(byte(2) == 0xC3 && (byte(1) == 0x97 || byte(1) == 0xB7));
  return ascii_letters.find(before.back()) != ascii_letters.npos;
}

/// Refuses a digit outside braces and code that is no part of a name.
void check_no_literal(std::string_view all, const Place& place) {
  std::string outside(all.size(), '$');  // what stands in braces has been checked already
  split(
      all, place,
      [&](std::string_view piece) {
        std::copy(piece.begin(), piece.end(), outside.begin() + (piece.data() - all.data()));
      },
      [](std::string_view, std::int32_t) {});
  for (const std::string_view prose : prose_of(outside)) {
    const std::size_t start = prose.data() - outside.data();
    for (std::size_t at = prose.find_first_of(ascii_digits); at != prose.npos;
         at = prose.find_first_of(ascii_digits, at)) {
      const std::size_t begin = at;
      at = std::min(prose.find_first_not_of(ascii_digits, at), prose.size());
      if (ends_name(all.substr(0, start + begin))) continue;
      const auto of = [&](std::string_view more) {  // the number, or the word that begins with it: 1.5, 3-4-5
        const std::size_t end = prose.find_first_not_of(std::string(ascii_digits) + std::string(more), begin);
        const std::string_view found = prose.substr(begin, end - begin);
        return found.substr(0, found.find_last_not_of("-.") + 1);
      };
      const std::string_view word = of(std::string(ascii_letters) + "-.");
      unchecked(word, "stands outside braces, where nothing checks it", of("."), word,
                place.str(static_cast<std::int32_t>(std::ranges::count(all.substr(0, start + begin), '\n'))));
    }
  }
}

std::string with_signs(std::string text) {  // as the lectures print them
  if (text == "infinity") return "∞";
  for (std::size_t at; (at = text.find('-')) != std::string::npos;) text.replace(at, 1, "−");
  return text;
}

[[noreturn]] void differs(std::string_view slot, const std::string& truth, std::string_view where) {
  throw InputError(where, fmt::format("`{{{}}}` does not hold: it is {} here", slot, truth),
                   "write what the run gives, or attach the stop elsewhere");
}

/// Whether the decimal that is written is the number, rounded to as many places.
bool rounds_to(double number, const std::string& written, std::string_view where) {
  const double value = [&] {
    const Expression literal = parse_expression(written, where);
    const Expression& digits = literal.kind == Expression::Kind::negate ? literal.parts[0] : literal;
    if (digits.kind != Expression::Kind::number)
      throw InputError(where, fmt::format("`~ {}` is no decimal", written), "write {z ~ 0.333}");
    return &digits == &literal ? digits.number : -digits.number;
  }();
  const std::size_t point = written.find('.');
  const auto places = point == std::string::npos ? 0 : static_cast<int>(written.size() - point - 1);
  return std::abs(number - value) <= 0.5 * portable::pow(10.0, -places) * (1 + 1e-9);
}

void verify(const Slot& slot, std::string_view text, const Quantity& value, const Moment& moment) {
  const Scene& scene = moment.trace().scene();
  bool good = false;
  switch (value.type) {
    case Quantity::Type::truth:
    case Quantity::Type::word:
    case Quantity::Type::polygon:
      good = slot.mark == '=' && slot.written == show(value, scene);
      break;
    case Quantity::Type::number:
      good = slot.mark == '~'
                 ? rounds_to(value.number, slot.written, moment.where)
                 : same_number(value.number, evaluate(parse_expression(slot.written, moment.where), moment).number);
      break;
  }
  if (!good) differs(text, show(value, scene, slot.mark == '~' ? 9 : -1), moment.where);
}

}  // namespace

std::string show(const Quantity& value, const Scene& scene, int decimals) {
  switch (value.type) {
    case Quantity::Type::truth:
      return value.number != 0 ? "true" : "false";
    case Quantity::Type::word:
      return value.word;
    case Quantity::Type::polygon: {
      const auto index = static_cast<std::int64_t>(value.number);
      if (index < 0 || index >= static_cast<std::int64_t>(scene.polygons.size())) return "background";
      const std::string& name = *scene.polygons[index].name;
      return name.empty() ? std::to_string(index) : name;
    }
    case Quantity::Type::number:
      break;
  }
  const double number = value.number;
  if (std::isinf(number)) return number > 0 ? "∞" : "−∞";
  if (std::isnan(number)) return "undefined";
  std::string text = fmt::format("{:.{}f}", number, decimals < 0 ? 4 : decimals);
  if (decimals < 0 && text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  if (text.find_first_not_of("-0.") == std::string::npos && text.front() == '-') text.erase(0, 1);
  return with_signs(text);
}

std::string fill(std::string_view text, const Place& place, Replay& replay, const RecordedEvent* event,
                 std::int64_t position) {
  std::string filled;
  split(
      text, place, [&](std::string_view piece) { filled += piece; },
      [&](std::string_view inside, std::int32_t line) {
        const std::string where = place.str(line);
        const Moment moment(replay, event, position, where);
        const Slot slot = parse_slot(inside, where);
        if (slot.mark == '"') {
          filled += slot.written;
          return;
        }
        const Quantity value = evaluate(slot.expression, moment);
        const bool checked = slot.mark == '=' || slot.mark == '~';
        if (checked) verify(slot, inside, value, moment);
        const bool number = value.type == Quantity::Type::number;
        filled += checked ? (number ? with_signs(slot.written) : slot.written)
                          : show(value, moment.trace().scene(), slot.mark == ':' ? slot.written[0] - '0' : -1);
      });
  return filled;
}

namespace {

void add_steps_counted(const Expression& expression, std::vector<std::string>& names) {
  if (expression.kind == Kind::count) names.push_back(expression.text);
  for (const Expression& part : expression.parts) add_steps_counted(part, names);
}

}  // namespace

std::vector<std::string> names_in(std::string_view text, const Place& place) {
  std::vector<std::string> names;
  split(
      text, place, [](std::string_view) {},
      [&](std::string_view inside, std::int32_t line) {
        const Slot slot = parse_slot(inside, place.str(line));
        if (slot.mark == '"') return;
        const Expression& whole = slot.expression;
        if (whole.kind == Kind::name || whole.kind == Kind::call) names.push_back(whole.text);
        add_steps_counted(whole, names);
      });
  return names;
}

void check_fill(std::string_view text, const Place& place, std::uint8_t kind, const Page& page) {
  split(
      text, place, [](std::string_view) {},
      [&](std::string_view inside, std::int32_t line) {
        const std::string where = place.str(line);
        const Slot slot = parse_slot(inside, where);
        if (slot.mark == '"') return;
        const Quantity::Type type = check(slot.expression, kind, page, where);
        if (type == Quantity::Type::number && (slot.mark == '=' || slot.mark == '~')) {
          if (!is_written_number(parse_expression(slot.written, where))) {
            throw InputError(where, fmt::format("`{}` is no number that a reader can be shown", slot.written),
                             "write 4.25, −1/3 or √3/2");
          }
        }
      });
  check_no_literal(text, place);
}

}  // namespace zstep::classroom
