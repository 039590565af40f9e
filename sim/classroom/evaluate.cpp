// Expressions against a run: every name is checked before it, so that a slip is told with the names that would do;
// values are found at a moment of it.

#include "sim/classroom/evaluate.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/core.h>

#include "sim/classroom/expression.hpp"
#include "traces/error.hpp"
#include "traces/text.hpp"

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

namespace {

using Kind = Expression::Kind;
using Type = Quantity::Type;

struct Checker {
  std::uint8_t kind;
  const Page& page;
  std::string_view where;

  /// The words a name on one side of a comparison may take, if it is a field of words.
  std::span<const std::string_view> words(const Expression& expression) const {
    if (expression.kind != Kind::name) return {};
    if (kind != no_kind) {
      if (const auto field = field_of_kind(kind, expression.text)) return field->words;
    }
    if (expression.text == "facing") return {words_of<Facing>.data(), words_of<Facing>.size()};
    return {};
  }

  [[noreturn]] void unknown_name(std::string_view name) const {
    std::vector<std::string_view> candidates;
    for (const KnownName& known : known_names()) candidates.push_back(known.name);
    std::string fields;
    if (kind != no_kind)
      for (const FieldOfKind& field : fields_of_kind(kind)) {
        candidates.push_back(field.name);
        fields += (fields.empty() ? "" : ", ") + std::string(field.name);
      }
    throw InputError(where, fmt::format("nothing is called `{}`{}", name, did_you_mean(name, candidates)),
                     kind == no_kind
                         ? "see the list of names in docs/writing-a-lesson.md"
                         : fmt::format("this step has {}; see docs/writing-a-lesson.md for the rest", fields));
  }

  Type of_name(const Expression& expression) const {
    if (kind != no_kind) {
      if (const auto field = field_of_kind(kind, expression.text)) return type_of(*field);
    }
    if (expression.text == "true" || expression.text == "false") return Type::truth;
    if (const KnownName* known = find_known_name(expression.text)) return known->type;
    unknown_name(expression.text);
  }

  Type of_call(const Expression& expression) const {
    const KnownFunction* known = find_known_function(expression.text);
    if (!known) {
      std::vector<std::string_view> candidates;
      for (const KnownFunction& function : known_functions()) candidates.push_back(function.name);
      throw InputError(
          where, fmt::format("nothing is called `{}(…)`{}", expression.text, did_you_mean(expression.text, candidates)),
          "see the list of names in docs/writing-a-lesson.md");
    }
    if (known->arguments != expression.parts.size()) {
      throw InputError(where, fmt::format("`{}` is given {} arguments", known->name, expression.parts.size()),
                       fmt::format("write {}", known->meaning.substr(0, known->meaning.find(':'))));
    }
    for (const Expression& part : expression.parts) number(part);
    return known->type;
  }

  void number(const Expression& expression) const {
    const Type type = of(expression);
    if (type == Type::truth || type == Type::word) {
      throw InputError(where, "a number is needed where a truth or a word stands",
                       "compare it first: `facing == back`");
    }
  }
  void truth(const Expression& expression) const {
    if (of(expression) != Type::truth) {
      throw InputError(where, "`and`, `or`, `not` and `where` need a truth",
                       "compare the number with something: `x == 3`");
    }
  }

  void equality(const Expression& expression) const {
    const auto known = words(expression.parts[0]);
    if (!known.empty()) {
      const Expression& other = expression.parts[1];
      if (other.kind == Kind::name && std::find(known.begin(), known.end(), other.text) != known.end()) return;
      std::string list;
      for (const std::string_view word : known) list += (list.empty() ? "" : ", ") + std::string(word);
      throw InputError(where,
                       fmt::format("`{}` is never `{}`", expression.parts[0].text,
                                   other.kind == Kind::name ? other.text : std::string("that")),
                       "it is one of " + list);
    }
    const Type first = of(expression.parts[0]), second = of(expression.parts[1]);
    const auto comparable = [](Type type) { return type == Type::number || type == Type::polygon; };
    if (first != second && !(comparable(first) && comparable(second))) {
      throw InputError(where, "a comparison of unlike things", "compare numbers with numbers, truths with truths");
    }
  }

  Type of(const Expression& expression) const {
    switch (expression.kind) {
      case Kind::number:
        return Type::number;
      case Kind::quoted:
        return Type::polygon;
      case Kind::name:
        return of_name(expression);
      case Kind::call:
        return of_call(expression);
      case Kind::count: {
        const StepInfo& step = require_step(page, expression.text, where);
        if (!expression.parts.empty()) Checker{step.kind, page, where}.truth(expression.parts[0]);
        return Type::number;
      }
      case Kind::equal:
      case Kind::unequal:
        equality(expression);
        return Type::truth;
      case Kind::not_:
      case Kind::and_:
      case Kind::or_:
        for (const Expression& part : expression.parts) truth(part);
        return Type::truth;
      default:
        for (const Expression& part : expression.parts) number(part);
        return expression.kind >= Kind::less && expression.kind <= Kind::greater_equal ? Type::truth : Type::number;
    }
  }
};

}  // namespace

std::string did_you_mean(std::string_view written, const std::vector<std::string_view>& candidates) {
  const std::string_view best = near_word(written, candidates);
  return best.empty() ? "" : fmt::format(" (did you mean `{}`?)", best);
}

std::string nearest_first(std::string_view written, std::vector<std::string_view> candidates) {
  constexpr std::size_t most = 12;
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
  std::vector<std::pair<std::size_t, std::string_view>> by_distance;
  for (const std::string_view candidate : candidates) {
    const bool part = !written.empty() && (candidate.starts_with(written) || written.starts_with(candidate));
    by_distance.emplace_back(part ? 1 : 1 + word_distance(written, candidate), candidate);
  }
  std::stable_sort(by_distance.begin(), by_distance.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::string list;
  for (std::size_t i = 0; i < std::min(most, by_distance.size()); ++i)
    list += (i ? ", " : "") + std::string(by_distance[i].second);
  if (candidates.size() > most) list += fmt::format(", … ({} in all)", candidates.size());
  return list;
}

const StepInfo& require_step(const Page& page, std::string_view name, std::string_view where) {
  if (const StepInfo* step = find_step(page, name)) return *step;
  std::vector<std::string_view> names;
  std::string list;
  for (const StepInfo& step : page) {
    names.push_back(step.name);
    list += (list.empty() ? "" : ", ") + step.name;
  }
  const std::size_t dot = name.rfind('.');
  throw InputError(where,
                   fmt::format("the method has no step named `{}`{}", name,
                               did_you_mean(dot == std::string_view::npos ? name : name.substr(dot + 1), names)),
                   "its steps are " + list);
}

Type check(const Expression& expression, std::uint8_t kind, const Page& page, std::string_view where) {
  return Checker{kind, page, where}.of(expression);
}

}  // namespace zstep::classroom
