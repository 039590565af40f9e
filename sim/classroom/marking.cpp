#include "sim/classroom/marking.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "sim/classroom/anchor.hpp"
#include "sim/classroom/evaluate.hpp"
#include "sim/classroom/fill.hpp"
#include "traces/error.hpp"

namespace zstep {

using namespace classroom;

namespace {

Anchor steps_of(const Marking& marking, const std::string& where) {
  return parse_anchor("at: " + marking.steps, where);
}

/// What a step says is right, and where it stands there.
std::int32_t value_at(const Marking& marking, const Expression& value, const Moment& moment) {
  const auto number = [&](const Expression& expression) {
    return static_cast<std::int32_t>(evaluate(expression, moment).number);
  };
  if (marking.kind != Marking::Kind::pixels) return number(value);
  const std::string where(moment.where);
  return number(parse_expression("y", where)) * moment.trace().scene().raster.width +
         number(parse_expression("x", where));
}

}  // namespace

namespace classroom {

void check_marking(const Marking& marking, const Page& page, const std::string& file) {
  const std::string where = Place{file, marking.steps_line}.str();
  const Anchor steps = steps_of(marking, where);
  if (steps.kind != Anchor::Kind::step || steps.which != Anchor::Which::next)
    throw InputError(where, fmt::format("`{}` does not name steps", marking.steps),
                     "write a step, or a step and a condition: `compare where polygon == \"A\"`");
  check_anchor(steps, page, where);
  const std::uint8_t kind = require_step(page, steps.step, where).kind;
  if (marking.kind == Marking::Kind::pixels) {
    for (const char* name : {"x", "y"})
      if (!field_of_kind(kind, name))
        throw InputError(where, fmt::format("`{}` is no step of a pixel", steps.step),
                         "name one that has x and y, as compare or write_pixel");
    return;
  }
  const bool order = marking.kind == Marking::Kind::order;
  if (check(parse_expression(marking.value, where), kind, page, where) !=
      (order ? Quantity::Type::polygon : Quantity::Type::number))
    throw InputError(where, fmt::format("`{}` is no {}", marking.value, order ? "polygon" : "number"),
                     order ? "take a polygon of each step, as `polygon of draw`"
                           : "take a number of the step, as `first_row(edge) of insert_edge`");
}

void resolve_marking(Marking& marking, Replay& replay, std::int64_t after, const std::string& file) {
  const std::string where = Place{file, marking.steps_line}.str();
  const Anchor steps = steps_of(marking, where);
  const Trace& trace = replay.trace();
  const std::uint8_t step = require_step(trace.header().page, steps.step, where).id;
  const Expression value = marking.value.empty() ? Expression{} : parse_expression(marking.value, where);
  marking.right.clear();
  for (std::int64_t position = after + 1; position <= trace.size(); ++position) {
    const RecordedEvent event = trace.event(position);
    if (event.step != step) continue;
    const Moment moment(replay, &event, position, where);
    if (steps.condition && !holds(*steps.condition, moment)) continue;
    const std::int32_t right = value_at(marking, value, moment);
    if (std::find(marking.right.begin(), marking.right.end(), right) == marking.right.end())
      marking.right.push_back(right);
  }
  const std::size_t found = marking.right.size();
  const auto wrong = [&](const std::string& what, const char* mend) { throw InputError(where, what, mend); };
  if (found == 0)
    wrong(fmt::format("no step `{}` after this stop is as described", steps.step),
          "loosen the condition, or move the stop up");
  if (marking.kind == Marking::Kind::pixels) return std::sort(marking.right.begin(), marking.right.end());
  if (marking.kind == Marking::Kind::scan_line && found > 1)
    wrong(fmt::format("{} scan lines are right", found), "add a condition of which one step is left");
  if (marking.kind == Marking::Kind::order && (found < 2 || found > 4))
    wrong(fmt::format("an order of {} is asked for", found), "an order has two to four polygons; add a condition");
}

}  // namespace classroom

std::vector<std::int32_t> choices_of(const Marking& marking) {
  std::vector<std::int32_t> choices = marking.right;
  std::sort(choices.begin(), choices.end());
  return choices;
}

MarksJudged judge_marks(const Marking& marking, std::span<const std::int32_t> marks) {
  MarksJudged judged;
  const auto has = [](std::span<const std::int32_t> all, std::int32_t one) {
    return std::find(all.begin(), all.end(), one) != all.end();
  };
  for (std::size_t k = 0; k < marks.size(); ++k) {
    const bool right = marking.kind == Marking::Kind::order ? k < marking.right.size() && marking.right[k] == marks[k]
                                                            : has(marking.right, marks[k]);
    if (!right) judged.wrong.push_back(marks[k]);
  }
  for (const std::int32_t right : marking.right)
    if (!has(marks, right)) judged.missing.push_back(right);
  return judged;
}

}  // namespace zstep
