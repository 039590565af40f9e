// What a condition says of all steps that fulfil it, so that a search can pass over the rest.

#include "sim/places/condition.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "sim/classroom/evaluate.hpp"
#include "sim/classroom/expression.hpp"
#include "traces/text.hpp"

namespace zstep::places {

using Kind = classroom::Expression::Kind;

namespace {

/// Does the event write a colour or a depth to a pixel?
bool writes(const Event& event) {
  return holds<DepthWrite>(event) || holds<PixelWrite>(event) || holds<PixelPaint>(event) || holds<ColorWrite>(event) ||
         holds<ColorBlend>(event);
}

bool names_pixel(const Event& event, double x, double y) {
  const auto pixel = pixel_of(event);
  return pixel && pixel->x == x && pixel->y == y;
}

}  // namespace

/// `and` and `or`: one side alone may settle it; else a side that is missing leaves nothing to say.
Condition::Value Condition::both_or_either(const Node& node, const Event& event, std::int64_t step) const {
  const bool settles = node.kind == Kind::or_;
  const Value first = evaluate(node.first, event, step);
  if (first.is == Value::Is::known && (first.number != 0) == settles) return first;
  const Value second = evaluate(node.second, event, step);
  if (second.is == Value::Is::known && (second.number != 0) == settles) return second;
  return {std::min(first.is, second.is), settles ? 0.0 : 1.0};
}

Condition::Value Condition::evaluate(std::int32_t at, const Event& event, std::int64_t step) const {
  const Node& node = nodes_[at];
  const auto truth = [](bool holds) { return Value{Value::Is::known, holds ? 1.0 : 0.0}; };
  const auto read = [&](double number) {
    return Value{node.none_is_missing && number < 0 ? Value::Is::missing : Value::Is::known, number};
  };
  switch (node.op) {
    case Op::constant:
      return {Value::Is::known, node.number};
    case Op::missing:
      return {Value::Is::missing, 0};
    case Op::field:
      return read(node.read(event));
    case Op::step:
      return {Value::Is::known, static_cast<double>(step)};
    case Op::at_work:
      if (const auto named = trace_->polygon_named(event)) return read(static_cast<double>(*named));
      return read(static_cast<double>(trace_->polygon_at_work(step)));
    case Op::changes:
      return truth(writes(event) && names_pixel(event, node.number, node.row));
    case Op::touches:
      return truth(names_pixel(event, node.number, node.row));
    case Op::both_or_either:
      return both_or_either(node, event, step);
    default:
      break;
  }
  const Value first = evaluate(node.first, event, step);
  const Value second = node.second < 0 ? first : evaluate(node.second, event, step);
  if (first.is != Value::Is::known || second.is != Value::Is::known) return {std::min(first.is, second.is), 0};
  const double a = first.number, b = second.number;
  if (node.op == Op::among) return truth(std::binary_search(node.set.begin(), node.set.end(), a));
  if (node.kind == Kind::equal) return truth(classroom::same_number(a, b));
  return {Value::Is::known, classroom::computed<classroom::Doubles>(node.kind, a, b)};
}

bool Condition::holds(std::int64_t step, const RecordedEvent& event) const {
  const std::int32_t root = root_of_step_[event.step];
  if (root < 0) return false;
  const Value value = evaluate(root, event.event, step);
  return value.is == Value::Is::known && value.number != 0;
}

std::vector<double> polygons_called(const Scene& scene, const std::string& name) {
  std::vector<double> found;
  const auto same_letter = [](char a, char b) { return lower_case(a) == lower_case(b); };
  const auto find = [&](auto&& same) {
    for (std::size_t i = 0; i < scene.polygons.size(); ++i)
      if (same(*scene.polygons[i].name)) found.push_back(static_cast<double>(i));
  };
  find([&](const std::string& other) { return other == name; });
  if (found.empty() && !name.empty())
    find([&](const std::string& other) {
      return std::equal(other.begin(), other.end(), name.begin(), name.end(), same_letter);
    });
  if (!found.empty() || name.size() < 2 || name.size() > 10 || (name[0] != 'P' && name[0] != 'p')) return found;
  if (!std::all_of(name.begin() + 1, name.end(), [](char c) { return c >= '0' && c <= '9'; })) return found;
  const auto number = std::stoll(name.substr(1));
  if (number < std::ssize(scene.polygons)) found.push_back(static_cast<double>(number));
  return found;
}

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
