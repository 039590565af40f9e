// From a text to something that can be asked of every step: names become fields of the kinds that have them.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/classroom/evaluate.hpp"
#include "sim/places/condition.hpp"
#include "sim/words/explain.hpp"
#include "traces/error.hpp"
#include "traces/events/fields.hpp"
#include "traces/scene.hpp"
#include "traces/text.hpp"

namespace zstep::places {

using classroom::Expression;
using Kind = Expression::Kind;
using Type = classroom::Quantity::Type;

namespace {

constexpr const char* where = "condition";

bool is_step(const StepInfo& step, std::string_view name) {
  return step.name == name || (name.find('.') != std::string_view::npos && step.module + "." + step.name == name);
}
}  // namespace

/// Binds an expression for one step of the pseudo-code.
class Condition::Binder {
 public:
  Binder(Condition& condition, const StepInfo& step)
      : condition_(condition), page_(condition.trace_->header().page), step_(step) {}

  /// The root node; -1 where no event of this step can fulfil the expression.
  std::int32_t bind(const Expression& expression) {
    const Bound root = truth(expression);
    return root.may_be_true ? root.node : -1;
  }

 private:
  struct Bound {
    std::int32_t node = -1;
    Type type = Type::number;
    bool missing = false;
    bool may_be_true = true, may_be_false = true;
  };

  Bound add(Node node, Type type) {
    condition_.nodes_.push_back(std::move(node));
    return {size32(condition_.nodes_) - 1, type};
  }
  Bound constant(double number, Type type) {
    Node node;
    node.op = Op::constant, node.number = number;
    Bound made = add(std::move(node), type);
    made.may_be_true = number != 0, made.may_be_false = number == 0;
    return made;
  }
  Bound missing(Type type) {
    Bound made = add({}, type);
    made.missing = true, made.may_be_true = made.may_be_false = false;
    return made;
  }
  Bound of(Kind kind, const Bound& first, const Bound& second, Type type) {
    if (first.missing || second.missing) return missing(type);
    Node node;
    node.op = Op::computed, node.kind = kind, node.first = first.node, node.second = second.node;
    return add(std::move(node), type);
  }

  [[noreturn]] void fail(const std::string& what, const std::string& mend) const {
    throw InputError(where, what, mend);
  }

  /// A field as panes and people write it, by its own name: z* or z_v, x_L, `line` for y; else the name in small
  /// letters.
  std::string field_meant(std::string text) const {
    const Trace& trace = *condition_.trace_;
    const std::string depth = depth_symbol(trace.scene(), trace.header().conventions);
    if (text.starts_with("z*") && depth != "z*")
      fail(fmt::format("`{}` is not in this trace, whose depths are {}", text, depth), "write z");
    if (text == depth || text.starts_with(depth + "_")) text.replace(0, depth.size(), "z");
    if (text.ends_with("_L")) text.replace(text.size() - 1, 1, "left");
    if (text.ends_with("_R")) text.replace(text.size() - 1, 1, "right");
    text = lower_case(text);
    return text == "line" || text == "scan_line" || text == "scanline" ? "y" : text;
  }
  /// The field that a name means in a step of this kind.
  const FieldOfKind* field_of(std::uint8_t kind, std::string_view text) const {
    if (const FieldOfKind* field = field_of_kind(kind, text)) return field;
    const std::string meant = field_meant(std::string(text));
    const bool known = text == "z_v" ? false : field_named(text);  // `line` is an edge where edges are drawn
    const FieldOfKind* field = known || meant == text ? nullptr : field_of_kind(kind, meant);
    // World coordinates have the letters of depths and scan lines.
    const bool fits = field && (meant != "z" || field->unit == "depth") &&
                      (meant != "y" || field->unit == "px" || field->unit == "row");
    return fits ? field : nullptr;
  }
  bool field_named(std::string_view name) const {
    return std::any_of(page_.begin(), page_.end(),
                       [&](const StepInfo& step) { return field_of_kind(step.kind, name) != nullptr; });
  }
  bool field_somewhere(std::string_view name) const {
    return std::any_of(page_.begin(), page_.end(),
                       [&](const StepInfo& step) { return field_of(step.kind, name) != nullptr; });
  }
  /// The words that a field of this name takes in any step of the method.
  std::vector<std::string_view> words_somewhere(std::string_view name) const {
    std::vector<std::string_view> words;
    for (const StepInfo& step : page_)
      if (const FieldOfKind* field = field_of(step.kind, name))
        for (const std::string_view word : field->words)
          if (std::find(words.begin(), words.end(), word) == words.end()) words.push_back(word);
    return words;
  }

  Bound number(const Expression& expression) {
    const Bound made = any(expression);
    if (made.type != Type::number && made.type != Type::polygon && !made.missing)
      fail(fmt::format("`{}` is no number", said(expression)), "compare it with ==, or leave it out");
    return made;
  }
  Bound truth(const Expression& expression) {
    const Bound made = any(expression);
    if (made.type != Type::truth && !made.missing)
      fail(fmt::format("`{}` is true of no step and false of none", said(expression)),
           fmt::format("compare it: `{} == 3`", said(expression)));
    return made;
  }
  static std::string said(const Expression& expression) {
    if (!expression.text.empty()) return expression.text;
    return expression.kind == Kind::number ? fmt::format("{}", expression.number) : "a sum";
  }

  static bool is_called(std::string_view text, std::string_view name) {
    return std::equal(text.begin(), text.end(), name.begin(), name.end(),
                      [](char a, char b) { return lower_case(a) == b; });
  }

  Bound name(const Expression& expression) {
    const std::string& text = expression.text;
    if (const FieldOfKind* field = field_of(step_.kind, text)) {
      Node node;
      node.op = Op::field, node.read = field->read, node.none_is_missing = classroom::type_of(*field) == Type::polygon;
      return add(std::move(node), classroom::type_of(*field));
    }
    if (is_called(text, "polygon")) return add_plain(Op::at_work, Type::polygon);
    if (is_called(text, "step")) return add_plain(Op::step, Type::number);
    if (text == "true" || text == "false") return constant(text == "true", Type::truth);
    if (field_somewhere(text)) return missing(Type::number);
    bool known = false;
    for (const StepInfo& step : page_)
      known = known || is_step(step, text) || description_of_kind(step.kind).name == text;
    if (known) return constant(is_step(step_, text) || description_of_kind(step_.kind).name == text, Type::truth);
    std::vector<std::string_view> names{"polygon", "step", "changes(x, y)", "touches(x, y)"};
    for (const StepInfo& step : page_) {
      names.push_back(step.name), names.push_back(description_of_kind(step.kind).name);
      for (const FieldOfKind& field : fields_of_kind(step.kind)) names.push_back(field.name);
    }
    const std::string near = classroom::did_you_mean(text, names);
    fail(fmt::format("`{}` is no field, step or kind of event of this trace{}", text, near),
         "its names, nearest first: " + classroom::nearest_first(text, names));
  }
  Bound add_plain(Op op, Type type) {
    Node node;
    node.op = op, node.none_is_missing = op == Op::at_work;
    return add(std::move(node), type);
  }

  /// Among the alternatives of an equation: `facing == back`, `polygon == B`.
  static bool is_bare(const Expression& side) { return side.kind == Kind::name || side.kind == Kind::quoted; }
  bool takes_words(const Expression& side) const {
    return side.kind == Kind::name && !words_somewhere(side.text).empty();
  }
  bool takes_polygons(const Expression& side) const {
    return side.kind == Kind::name && is_called(side.text, "polygon");
  }

  Bound equation(const Expression& expression) {
    const Expression *left = &expression.parts[0], *right = &expression.parts[1];
    if (is_bare(*left) && !takes_words(*left) && !takes_polygons(*left)) std::swap(left, right);
    if (takes_words(*left) && is_bare(*right)) return word(*left, *right);
    if (takes_polygons(*left) && is_bare(*right) && (right->kind == Kind::quoted || !field_somewhere(right->text)))
      return called(*left, *right);
    if (takes_polygons(*right) && !takes_polygons(*left)) std::swap(left, right);
    auto index = numbered(*left, *right);
    if (!index && (index = numbered(*right, *left))) std::swap(left, right);
    const Bound first = any(*left), second = index ? constant(*index, Type::number) : any(*right);
    if (takes_polygons(*left) && right->kind == Kind::negate) condition_.nodes_[first.node].none_is_missing = false;
    const auto sort = [](Type type) { return type == Type::polygon ? Type::number : type; };
    if (!first.missing && !second.missing && sort(first.type) != sort(second.type))
      fail(fmt::format("`{}` and `{}` are not of one kind", said(*left), said(*right)),
           "compare numbers with numbers and truths with truths");
    return of(Kind::equal, first, second, Type::truth);
  }
  /// "e3" beside `edge`, "v2" beside `vertex_0`: the number, as panes write it.
  std::optional<double> numbered(const Expression& field, const Expression& name) const {
    const std::string& text = name.text;
    if (field.kind != Kind::name || name.kind != Kind::name || text.size() < 2 || text.size() > 10 ||
        field_somewhere(text))
      return std::nullopt;
    if (lower_case(text[0]) != lower_case(field.text[0])) return std::nullopt;
    if (!std::all_of(text.begin() + 1, text.end(), is_digit)) return std::nullopt;
    return static_cast<double>(std::stoll(text.substr(1)));
  }
  Bound word(const Expression& left, const Expression& right) {
    const auto all = words_somewhere(left.text);
    if (std::find(all.begin(), all.end(), right.text) == all.end())
      fail(fmt::format("`{}` is never `{}`", left.text, right.text),
           fmt::format("it is one of {}", fmt::join(all, ", ")));
    const FieldOfKind* field = field_of(step_.kind, left.text);
    if (!field || field->type != FieldOfKind::Type::word) return missing(Type::truth);
    const auto& words = field->words;
    const auto place = std::find(words.begin(), words.end(), right.text) - words.begin();
    return of(Kind::equal, name(left), constant(static_cast<double>(place), Type::word), Type::truth);
  }
  Bound called(const Expression& left, const Expression& right) {
    Node node;
    node.op = Op::among;
    node.set = polygons_called(condition_.trace_->scene(), right.text);
    if (node.set.empty()) {
      std::vector<std::string_view> names;
      for (const Polygon& polygon : condition_.trace_->scene().polygons)
        if (!polygon.name->empty()) names.push_back(*polygon.name);
      fail(fmt::format("no polygon of the scene is called `{}`", right.text),
           names.empty() ? "polygons have numbers here: polygon == 0 is the first"
                         : "its polygons, nearest first: " + classroom::nearest_first(right.text, names));
    }
    node.first = name(left).node;
    return add(std::move(node), Type::truth);
  }

  Bound call(const Expression& expression) {
    if (expression.text != "changes" && expression.text != "touches")
      fail(fmt::format("there is no `{}(`", expression.text), "changes(x, y) and touches(x, y) speak of a pixel");
    const auto& parts = expression.parts;
    const Raster& raster = condition_.trace_->scene().raster;
    const auto inside = [](const Expression& part, std::int32_t end) {
      return part.kind == Kind::number && part.number < end && part.number == std::floor(part.number);
    };
    if (parts.size() != 2 || !inside(parts[0], raster.width) || !inside(parts[1], raster.height))
      fail(fmt::format("`{}(` needs a pixel's column and row", expression.text),
           fmt::format("the picture has {} by {}; write {}(0, 0)", raster.width, raster.height, expression.text));
    Node node;
    node.op = expression.text == "changes" ? Op::changes : Op::touches;
    node.number = parts[0].number, node.row = parts[1].number;
    Bound made = add(std::move(node), Type::truth);
    made.may_be_true = field_of_kind(step_.kind, "x") && field_of_kind(step_.kind, "y");
    if (condition_.nodes_.back().op == Op::changes) {
      const std::uint8_t k = step_.kind;
      made.may_be_true = k == kind_of<DepthWrite> || k == kind_of<PixelWrite> || k == kind_of<PixelPaint> ||
                         k == kind_of<ColorWrite> || k == kind_of<ColorBlend>;
    }
    return made;
  }

  Bound negation(const Expression& inner) {
    const Bound made = truth(inner);
    Bound turned = of(Kind::not_, made, made, Type::truth);
    turned.may_be_true = made.may_be_false, turned.may_be_false = made.may_be_true;
    return turned;
  }
  /// Where a side is missing the other may still settle it.
  Bound logic(const Expression& expression) {
    const Bound first = truth(expression.parts[0]), second = truth(expression.parts[1]);
    Node node;
    node.op = Op::both_or_either, node.kind = expression.kind, node.first = first.node, node.second = second.node;
    Bound made = add(std::move(node), Type::truth);
    const bool both = expression.kind == Kind::and_;
    made.may_be_true = both ? first.may_be_true && second.may_be_true : first.may_be_true || second.may_be_true;
    made.may_be_false = both ? first.may_be_false || second.may_be_false : first.may_be_false && second.may_be_false;
    return made;
  }

  Bound any(const Expression& expression) {
    const auto& parts = expression.parts;
    switch (expression.kind) {
      case Kind::number:
        return constant(expression.number, Type::number);
      case Kind::quoted:
        fail(fmt::format("\"{}\" stands alone", expression.text), "write `polygon == \"…\"`");
      case Kind::name:
        return name(expression);
      case Kind::call:
        return call(expression);
      case Kind::count:
        fail("`count(` counts a whole run", "zstep query counts: select count(*) from …");
      case Kind::not_:
        return negation(parts[0]);
      case Kind::equal:
        return equation(expression);
      case Kind::unequal: {
        const Bound made = equation(expression);
        return of(Kind::not_, made, made, Type::truth);
      }
      case Kind::and_:
      case Kind::or_:
        return logic(expression);
      default:
        break;
    }
    const Bound first = number(parts[0]), second = parts.size() > 1 ? number(parts[1]) : first;
    return of(expression.kind, first, second, expression.is_truth() ? Type::truth : Type::number);
  }

  Condition& condition_;
  const Page& page_;
  const StepInfo& step_;
};

Condition::Condition(const Trace& trace, const std::string& text)
    : trace_(&trace), text_(classroom::trim(text)), root_of_step_(step_limit, -1) {
  constexpr std::size_t longest = 2000;
  if (text_.empty()) throw InputError(where, "is empty", "write for example `not nearer` or `z < 4.2 && x == 9`");
  if (text_.size() > longest)
    throw InputError(where, fmt::format("has more than {} letters", longest), "write a shorter one");
  const Page& page = trace.header().page;

  // "compare", "z_buffer.compare where not nearer": a step or a kind of event, and what must hold besides.
  std::string_view rest = text_;
  std::string only;
  const std::string_view first = classroom::leading_step_name(rest);
  const std::string_view after = classroom::trim(rest.substr(first.size()));
  const auto is_where = [](std::string_view word) { return word == "where" || word == "WHERE"; };
  const bool further = is_where(after.substr(0, 5)) &&
                       (after.size() == 5 || !(is_letter(after[5]) || is_digit(after[5]) || after[5] == '_'));
  if (!first.empty() && (after.empty() || further)) {
    const bool known = std::any_of(page.begin(), page.end(), [&](const StepInfo& step) {
      return is_step(step, first) || description_of_kind(step.kind).name == first;
    });
    if (further && !known)
      throw InputError(where, fmt::format("`{}` is no step or kind of event of this trace", first),
                       "zstep info FILE names them");
    if (known) only = first, rest = further ? after.substr(5) : std::string_view("true");
  }
  const Expression expression = classroom::parse_typed(rest, where);
  for (const StepInfo& step : page) {
    const std::int32_t root = Binder(*this, step).bind(expression);
    if (!only.empty() && !is_step(step, only) && description_of_kind(step.kind).name != only) continue;
    root_of_step_[step.id] = root;
    if (root >= 0) bounds_.kinds.set(step.kind);
  }
  if (bounds_.kinds.none())
    throw InputError(where, fmt::format("no step of this trace can fulfil `{}`", text_),
                     "name fields that one event has together; zstep query FILE lists them");
  if (std::any_of(nodes_.begin(), nodes_.end(), [](const Node& node) { return node.op == Op::at_work; })) {
    trace.end_of_turns();  // asks for events, and holds() may not
    if (trace.has(kind_of<PieceMake>)) trace.polygon_of_piece(0);
  }
  find_bounds(expression);
}

}  // namespace zstep::places
