#include "sim/answers/explain_value.hpp"

#include <algorithm>

#include "sim/answers/origin/fields.hpp"
#include "traces/replay/replay.hpp"

namespace zstep::answers {

namespace {

bool matches(const Event& event, const Question& question) {
  if (event.index() != *question.kind) return false;
  return std::all_of(question.where.begin(), question.where.end(), [&](const auto& wanted) { return field_number(event, wanted.first) == static_cast<double>(wanted.second); });
}

/// A depth that a pixel has may be a line's of the other buffer; it is the picture's of the pass at work.
bool light_at_work(const Trace& trace, std::int64_t at) {
  if (!trace.scene().light) return false;
  const auto marks = trace.polygons();
  const std::size_t facets = trace.scene().facets.size();
  const bool passes = std::any_of(trace.header().page.begin(), trace.header().page.end(), [](const StepInfo& s) { return s.kind == kind_of<PassBegin>; });
  if (!passes || facets == 0 || marks.size() <= facets) return passes;
  const auto eye = find_last<PassBegin>(trace, marks[facets].position, [](const PassBegin& e) { return e.pass == Pass::eye; });
  return eye && at < *eye;
}

/// In what order the links are read: a link, then what it asked for.
Chain in_reading_order(Chain chain) {
  std::vector<std::vector<std::size_t>> asked(chain.links.size());
  for (std::size_t i = 1; i < chain.links.size(); ++i)
    if (chain.links[i].parent >= 0) asked[static_cast<std::size_t>(chain.links[i].parent)].push_back(i);
  std::vector<std::size_t> order, stack;
  if (!chain.links.empty()) stack.push_back(0);
  while (!stack.empty()) {
    const std::size_t link = stack.back();
    stack.pop_back();
    order.push_back(link);
    stack.insert(stack.end(), asked[link].rbegin(), asked[link].rend());
  }
  std::vector<std::int32_t> place(chain.links.size(), -1);
  for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = static_cast<std::int32_t>(i);
  Chain sorted;
  sorted.cut = chain.cut;
  for (const std::size_t link : order) {
    sorted.links.push_back(std::move(chain.links[link]));
    ChainLink& moved = sorted.links.back();
    if (moved.parent >= 0) moved.parent = place[static_cast<std::size_t>(moved.parent)];
    for (ChainValue& value : moved.values)
      for (Operand& operand : value.operands)
        if (operand.link >= 0) operand.link = place[static_cast<std::size_t>(operand.link)];
  }
  return sorted;
}

}  // namespace

bool Question::operator==(const Question& other) const {
  const bool same_pixel = pixel.has_value() == other.pixel.has_value() && (!pixel || (pixel->x == other.pixel->x && pixel->y == other.pixel->y));
  return same_pixel && at == other.at && field == other.field && kind == other.kind && where == other.where;
}

std::optional<Place> place_of(const Trace& trace, const Question& question) {
  const std::int64_t at = std::min(question.at, trace.size());
  if (question.pixel) {
    const Step wrote = step_of_depth(trace, at, *question.pixel, light_at_work(trace, at));
    return wrote ? std::optional(Place{*wrote, "z"}) : std::nullopt;
  }
  Step step = at;
  if (question.kind) step = trace.previous(at + 1, [&](const RecordedEvent& recorded) { return matches(recorded.event, question); });
  if (!step || *step < 1) return std::nullopt;
  const Event event = trace.event(*step).event;
  const std::string field = question.field.empty() ? main_field(event) : question.field;
  return field_number(event, field) ? std::optional(Place{*step, field}) : std::nullopt;
}

Chain explain_value(const Trace& trace, const Question& question) {
  const auto place = place_of(trace, question);
  if (!place) return {};
  Replay replay(trace);
  replay.go_to(place->step);
  Work work(trace, replay);
  work.field(place->step, place->field);
  work.run_later();
  return in_reading_order(std::move(work.chain));
}

std::vector<std::string> fields_of_step(const Trace& trace, std::int64_t step) { return fields_in(trace.event(step).event); }

}  // namespace zstep::answers
