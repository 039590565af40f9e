// What a condition says of all steps that fulfil it, so that a search can pass over the rest.
#include <algorithm>
#include <cmath>

#include "sim/places/condition.hpp"

namespace zstep::places {

using classroom::Expression;
using Kind = Expression::Kind;

namespace {

bool is_name(const Expression& side, std::string_view name) { return side.kind == Kind::name && side.text == name; }

/// A number as it stands there, with its sign.
std::optional<double> literal(const Expression& side) {
  if (side.kind == Kind::number) return side.number;
  if (side.kind == Kind::negate && side.parts[0].kind == Kind::number) return -side.parts[0].number;
  return std::nullopt;
}

Kind turned(Kind kind) {
  switch (kind) {
    case Kind::less:
      return Kind::greater;
    case Kind::less_equal:
      return Kind::greater_equal;
    case Kind::greater:
      return Kind::less;
    case Kind::greater_equal:
      return Kind::less_equal;
    default:
      return kind;
  }
}

bool whole(double value) { return value == std::floor(value) && std::abs(value) < 1e9; }

/// In zstep's own recordings of these methods a polygon is drawn from its polygon_begin to the next one, and every
/// `polygon` of an event is the one at work.
bool polygons_in_turn(const Header& header) {
  return header.writer.starts_with("zstep ") && (header.algorithm == "z-buffer" || header.algorithm == "shadow-buffer");
}

}  // namespace

void Condition::bound_by(const Expression& comparison, std::optional<double>& x, std::optional<double>& y) {
  if (comparison.kind == Kind::call) {
    x = comparison.parts[0].number, y = comparison.parts[1].number;
    return;
  }
  if (comparison.parts.size() != 2) return;
  const Expression *left = &comparison.parts[0], *right = &comparison.parts[1];
  Kind sign = comparison.kind;
  if (left->kind != Kind::name || (right->kind == Kind::name && is_name(*right, "polygon")))
    std::swap(left, right), sign = turned(sign);
  if (left->kind != Kind::name) return;
  if (sign == Kind::equal && left->text == "polygon" && polygons_in_turn(trace_->header())) {
    std::vector<double> called;
    const auto& page = trace_->header().page;
    const bool field = right->kind == Kind::name && std::any_of(page.begin(), page.end(), [&](const StepInfo& s) {
                         return field_of_kind(s.kind, right->text) != nullptr;
                       });
    if (field) return;
    if (right->kind == Kind::name || right->kind == Kind::quoted)
      called = polygons_called(trace_->scene(), right->text);
    else if (const auto number = literal(*right)) called.push_back(*number);
    if (called.size() == 1 && whole(called[0])) bounds_.polygon = static_cast<std::int32_t>(called[0]);
    return;
  }
  const auto value = literal(*right);
  if (!value || !std::isfinite(*value)) return;
  if (sign == Kind::equal && left->text == "x") x = value;
  if (sign == Kind::equal && left->text == "y") y = value;
  if (left->text != "step" || std::abs(*value) > 1e15) return;
  const auto below = static_cast<std::int64_t>(std::ceil(*value)) - 1,
             above = static_cast<std::int64_t>(std::floor(*value)) + 1;
  const auto at_most = static_cast<std::int64_t>(std::floor(*value)),
             at_least = static_cast<std::int64_t>(std::ceil(*value));
  if (sign == Kind::less) bounds_.last = std::min(bounds_.last, below);
  if (sign == Kind::less_equal) bounds_.last = std::min(bounds_.last, at_most);
  if (sign == Kind::greater) bounds_.first = std::max(bounds_.first, above);
  if (sign == Kind::greater_equal) bounds_.first = std::max(bounds_.first, at_least);
  // Equality is to nine digits: of very large steps the neighbours are equal, too.
  if (sign == Kind::equal && *value < 1e8)
    bounds_.first = std::max(bounds_.first, at_least), bounds_.last = std::min(bounds_.last, at_most);
}

void Condition::find_bounds(const Expression& expression) {
  std::vector<const Expression*> all{&expression};
  std::optional<double> x, y;
  while (!all.empty()) {
    const Expression& part = *all.back();
    all.pop_back();
    if (part.kind == Kind::and_) all.push_back(&part.parts[0]), all.push_back(&part.parts[1]);
    else bound_by(part, x, y);
  }
  if (x && y && whole(*x) && whole(*y))
    bounds_.pixel = Trace::Pixel{static_cast<std::int32_t>(*x), static_cast<std::int32_t>(*y)};
}

}  // namespace zstep::places
