#include "sim/classroom/evaluate.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "sim/classroom/computed.hpp"
#include "traces/error.hpp"

namespace zstep::classroom {
namespace {

using Kind = Expression::Kind;

/// A polygon by the name the scene gives it.
double polygon_named(const Moment& moment, std::string_view name) {
  const auto& polygons = moment.trace().scene().polygons;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    if (*polygons[i].name == name) return static_cast<double>(i);
  }
  std::string names;
  for (const Polygon& polygon : polygons) {
    if (!polygon.name->empty() && names.size() < 80) names += (names.empty() ? "" : ", ") + *polygon.name;
  }
  throw InputError(moment.where, fmt::format("the scene has no polygon named \"{}\"", name),
                   names.empty() ? "its polygons have no names; use their numbers" : "its polygons are " + names);
}

Quantity name_value(const Expression& expression, const Moment& moment) {
  if (moment.event) {
    if (auto value = field_value(moment.event->event, expression.text)) return *value;
  }
  if (expression.text == "true") return Quantity::of_truth(true);
  if (expression.text == "false") return Quantity::of_truth(false);
  if (const KnownName* known = find_known_name(expression.text)) return known->value(moment);
  return Quantity::of_word(expression.text);  // check() has let no other name through
}

/// In `facing == back` the word is a word even where `back` could be a name: `plane == near`.
Quantity comparand(const Expression& side, const Quantity& other, const Moment& moment) {
  if (other.type == Quantity::Type::word && side.kind == Kind::name) return Quantity::of_word(side.text);
  return evaluate(side, moment);
}

bool equal(const Expression& expression, const Moment& moment) {
  const Quantity first = evaluate(expression.parts[0], moment);
  const Quantity second = comparand(expression.parts[1], first, moment);
  if (first.type == Quantity::Type::word) return first.word == second.word;
  return same_number(first.number, second.number);
}

double counted(const Expression& expression, const Moment& moment) {
  const Trace& trace = moment.trace();
  const std::uint8_t step = require_step(trace.header().page, expression.text, moment.where).id;
  double total = 0;
  for (std::int64_t position = 1; position <= trace.size(); ++position) {
    const RecordedEvent& event = trace.event(position);
    if (event.step != step) continue;
    if (expression.parts.empty() ||
        holds(expression.parts[0], Moment(moment.replay(), &event, position, moment.where))) {
      ++total;
    }
  }
  return total;
}

}  // namespace

bool same_number(double a, double b) {
  if (a == b || !std::isfinite(a) || !std::isfinite(b)) return a == b;
  return std::abs(a - b) <= 1e-9 * std::max({1.0, std::abs(a), std::abs(b)});
}

bool holds(const Expression& condition, const Moment& moment) { return evaluate(condition, moment).number != 0; }

Quantity evaluate(const Expression& expression, const Moment& moment) {
  const auto number = [&](std::size_t part) { return evaluate(expression.parts[part], moment).number; };
  switch (expression.kind) {
    case Kind::number:
      return Quantity::of(expression.number);
    case Kind::quoted:
      return {Quantity::Type::polygon, polygon_named(moment, expression.text), {}};
    case Kind::name:
      return name_value(expression, moment);
    case Kind::call: {
      std::vector<double> arguments;
      for (const Expression& part : expression.parts) arguments.push_back(evaluate(part, moment).number);
      return find_known_function(expression.text)->value(moment, arguments);
    }
    case Kind::count:
      return Quantity::of(counted(expression, moment));
    case Kind::equal:
      return Quantity::of_truth(equal(expression, moment));
    case Kind::unequal:
      return Quantity::of_truth(!equal(expression, moment));
    case Kind::and_:
      return Quantity::of_truth(number(0) != 0 && number(1) != 0);
    case Kind::or_:
      return Quantity::of_truth(number(0) != 0 || number(1) != 0);
    default:
      break;
  }
  const double first = number(0), second = expression.parts.size() > 1 ? number(1) : first;
  const double value = computed<Doubles>(expression.kind, first, second);
  return expression.is_truth() ? Quantity::of_truth(value != 0) : Quantity::of(value);
}

}  // namespace zstep::classroom
