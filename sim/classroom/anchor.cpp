#include "sim/classroom/anchor.hpp"

#include <algorithm>

#include <fmt/core.h>

#include "sim/classroom/evaluate.hpp"
#include "traces/error.hpp"

namespace zstep::classroom {
namespace {

constexpr std::string_view form_of_anchors =
    "write {at: step}, {at: step where condition} or {before: step where condition, first}";

void parse_which(Anchor& anchor, std::string_view text, std::string_view where) {
  const auto unknown = [&] {
    return InputError(where, fmt::format("`{}` does not say which one", text),
                      "write `first`, `next`, `last` or `nth 3`");
  };
  if (text == "next") anchor.which = Anchor::Which::next;
  else if (text == "first") anchor.which = Anchor::Which::first;
  else if (text == "last") anchor.which = Anchor::Which::last;
  else if (text.substr(0, 4) == "nth ") {
    anchor.which = Anchor::Which::nth;
    for (const char c : trim(text.substr(4))) {
      if (c < '0' || c > '9' || anchor.n > 100'000'000) throw unknown();
      anchor.n = anchor.n * 10 + (c - '0');
    }
    if (anchor.n == 0) throw unknown();
  } else throw unknown();
}

/// Positions whose step and condition fit, in order, until `visit` returns false.
template <class Visit>
void for_each_fit(const Anchor& anchor, std::uint8_t step, std::int64_t from, Replay& replay, std::string_view where,
                  Visit&& visit) {
  const Trace& trace = replay.trace();
  for (std::int64_t position = from; position <= trace.size(); ++position) {
    const RecordedEvent& event = trace.event(position);
    if (event.step != step) continue;
    if (anchor.condition && !holds(*anchor.condition, Moment(replay, &event, position, where))) continue;
    if (!visit(position)) return;
  }
}

[[noreturn]] void never_happens(const Anchor& anchor, std::uint8_t step, std::int64_t fits, Replay& replay,
                                std::string_view where) {
  if (fits > 0) {
    throw InputError(
        where,
        fmt::format("`{}` happens as described {} times, but not {}", anchor.step, fits,
                    anchor.which == Anchor::Which::nth ? fmt::format("{} times", anchor.n)
                                                       : std::string("after the stop before this one")),
        anchor.which == Anchor::Which::nth ? "ask for an earlier one" : "move the stop up, or loosen its condition");
  }
  std::int64_t happens = 0;
  Anchor any = anchor;
  any.condition.reset();
  for_each_fit(any, step, 1, replay, where, [&](std::int64_t) { return ++happens, true; });
  if (happens == 0) {
    throw InputError(where, fmt::format("`{}` never happens in this run", anchor.step),
                     "choose another step, or a scene in which it does");
  }
  throw InputError(where, fmt::format("`{}` happens {} times, but its condition never holds", anchor.step, happens),
                   "loosen the condition, or choose a scene in which it holds");
}

}  // namespace

Anchor parse_anchor(std::string_view text, std::string_view where) {
  Anchor anchor;
  text = trim(text);
  if (text.substr(0, 3) == "at:") text.remove_prefix(3);
  else if (text.substr(0, 7) == "before:") {
    text.remove_prefix(7);
    anchor.before = true;
  } else throw InputError(where, fmt::format("`{{{}}}` is no anchor", text), form_of_anchors);
  text = trim(text);
  anchor.step = leading_step_name(text);
  if (anchor.step.empty()) throw InputError(where, "the anchor names no step", form_of_anchors);
  text = trim(text.substr(anchor.step.size()));

  if (anchor.step == "start" || anchor.step == "end" || anchor.step == "here") {
    if (!text.empty() || anchor.before)
      throw InputError(where, fmt::format("`{}` stands alone", anchor.step),
                       fmt::format("write {{at: {}}}", anchor.step));
    anchor.kind = anchor.step == "start" ? Anchor::Kind::start
                  : anchor.step == "end" ? Anchor::Kind::end
                                         : Anchor::Kind::here;
    return anchor;
  }
  if (text.substr(0, 6) == "where ") anchor.condition = parse_expression(text.substr(6), text, where);
  if (text.empty()) return anchor;
  if (text.front() != ',')
    throw InputError(where, fmt::format("`{}` is left over in the anchor", text.substr(0, 24)), form_of_anchors);
  parse_which(anchor, trim(text.substr(1)), where);
  return anchor;
}

void check_anchor(const Anchor& anchor, const Page& page, std::string_view where) {
  if (anchor.kind != Anchor::Kind::step) return;
  const StepInfo& step = require_step(page, anchor.step, where);
  if (anchor.condition && check(*anchor.condition, step.kind, page, where) != Quantity::Type::truth) {
    throw InputError(where, "the condition is no truth", "compare the number with something: `x == 3`");
  }
}

Spot resolve_anchor(const Anchor& anchor, const Spot& previous, Replay& replay, std::string_view where) {
  switch (anchor.kind) {
    case Anchor::Kind::here:
      return previous;
    case Anchor::Kind::end:
      return {replay.trace().size(), 0};
    case Anchor::Kind::start:
      if (previous.position > 0) throw InputError(where, "`start` comes after another stop", "make it the first stop");
      return {};
    case Anchor::Kind::step:
      break;
  }
  const std::uint8_t step = require_step(replay.trace().header().page, anchor.step, where).id;
  const bool next = anchor.which == Anchor::Which::next;
  // Two stops in a row before the same kind of step mean two steps; `before` and then `at` mean the same one.
  const std::int64_t from = !next           ? 1
                            : anchor.before ? std::max(previous.position, previous.event) + 1
                                            : previous.position + 1;
  std::int64_t fits = 0, found = 0;
  for_each_fit(anchor, step, from, replay, where, [&](std::int64_t position) {
    ++fits;
    if (anchor.which == Anchor::Which::nth && fits < anchor.n) return true;
    found = position;
    return anchor.which == Anchor::Which::last;
  });
  if (found == 0) {
    if (next) for_each_fit(anchor, step, 1, replay, where, [&](std::int64_t) { return ++fits, true; });
    never_happens(anchor, step, fits, replay, where);
  }
  const Spot spot{anchor.before ? found - 1 : found, found};
  if (spot.position < previous.position) {
    throw InputError(where,
                     fmt::format("this stop's step comes before that of the stop before it (step {}, after {})", found,
                                 previous.position),
                     "move the stop up, or ask for the `next` one");
  }
  return spot;
}

}  // namespace zstep::classroom
