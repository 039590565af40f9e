#include "sim/answers/explain_value.hpp"

#include <algorithm>

#include "sim/answers/origin/work.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "traces/scene.hpp"

namespace zstep::answers {

namespace {

bool matches(const Event& event, const Question& question) {
  if (std::find(question.kinds.begin(), question.kinds.end(), event.index()) == question.kinds.end()) return false;
  if (question.value && field_number(event, question.field) != question.value) return false;
  return std::all_of(question.where.begin(), question.where.end(), [&](const auto& wanted) {
    return field_number(event, wanted.first) == static_cast<double>(wanted.second);
  });
}

bool asks_for(const Question& question, std::uint8_t kind) {
  return std::find(question.kinds.begin(), question.kinds.end(), kind) != question.kinds.end();
}

/// In what order the links are read: a link, then what it asked for.
Chain in_reading_order(Chain chain) {
  std::vector<std::vector<std::size_t>> asked(chain.links.size());
  for (std::size_t i = 1; i < chain.links.size(); ++i)
    if (chain.links[i].parent >= 0) asked[chain.links[i].parent].push_back(i);
  std::vector<std::size_t> order, stack;
  if (!chain.links.empty()) stack.push_back(0);
  while (!stack.empty()) {
    const std::size_t link = stack.back();
    stack.pop_back();
    order.push_back(link);
    stack.insert(stack.end(), asked[link].rbegin(), asked[link].rend());
  }
  std::vector<std::int32_t> place(chain.links.size(), -1);
  for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = index32(i);
  Chain sorted;
  sorted.cut = chain.cut;
  for (const std::size_t link : order) {
    sorted.links.push_back(std::move(chain.links[link]));
    ChainLink& moved = sorted.links.back();
    if (moved.parent >= 0) moved.parent = place[moved.parent];
    for (ChainValue& value : moved.values)
      for (Operand& operand : value.operands)
        if (operand.link >= 0) operand.link = place[operand.link];
  }
  return sorted;
}

Step step_of_row(const Trace& trace, const MethodState& machine, const Question& question) {
  const std::int64_t at = std::min(question.at, trace.size());
  const auto number = question.where.empty() ? -1 : question.where.front().second;
  if (asks_for(question, kind_of<EdgeStep>)) return step_of_active_edge(trace, machine, at, number);
  if (asks_for(question, kind_of<EdgeTableInsert>)) return step_of_edge(trace, machine, at, number);
  if (asks_for(question, kind_of<PlaneEquation>)) return step_of_plane(machine, number);
  std::int64_t from = at + 1;
  if (asks_for(question, kind_of<Extent>))
    if (const Step plane = step_of_plane(machine, number)) from = std::min(from, *plane + 2);  // it follows its plane
  return trace.previous(from, [&](const RecordedEvent& recorded) { return matches(recorded.event, question); });
}

Step step_of_coordinate(const VertexSteps& steps, const std::string& field) {
  if (field.ends_with("_s")) return steps.on_raster ? steps.on_raster : steps.made;
  if (field.ends_with("_p") || field == "z") return steps.projected;
  return steps.viewed ? steps.viewed : steps.made;
}

/// Leaves the replay at the question's moment, if it looked there.
std::optional<Place> find_place(const Trace& trace, Replay& replay, const Question& question) {
  const std::int64_t at = std::min(question.at, trace.size());
  if (question.pixel) {
    const Step wrote = step_of_depth(trace, at, *question.pixel, question.light || at < begin_of_eye_pass(trace));
    return wrote ? std::optional(Place{*wrote, "z"}) : std::nullopt;
  }
  Step step = at;
  if (question.vertex || !question.kinds.empty()) {
    replay.go_to(at);
    if (question.field.ends_with("_w")) return Place{0, question.field};
    step = question.vertex ? step_of_coordinate(steps_of_vertex(trace, replay.state().machine, at, *question.vertex),
                                                question.field)
                           : step_of_row(trace, replay.state().machine, question);
  }
  if (!step || *step < 1) return std::nullopt;
  const Event event = trace.event(*step).event;
  // What cutting made has its coordinates from there.
  const bool cut = question.vertex && holds<SplitVertex>(event);
  const std::string field = question.field.empty() ? main_field(event)
                            : cut                  ? std::string(1, question.field[0]) + "_cut"
                                                   : question.field;
  return field_number(event, field) ? std::optional(Place{*step, field}) : std::nullopt;
}

}  // namespace

std::optional<Place> place_of(const Trace& trace, const Question& question) {
  Replay replay(trace);
  return find_place(trace, replay, question);
}

Chain explain_value(const Trace& trace, const Question& question) {
  Replay replay(trace);
  return explain_value(trace, replay, question);
}

Chain explain_value(const Trace& trace, Replay& replay, const Question& question) {
  const auto place = find_place(trace, replay, question);
  if (!place) return {};
  if (place->step > 0) replay.go_to(place->step);
  Work work(trace, replay);
  if (place->step > 0) {
    work.field(place->step, place->field);
    if (question.pixel && !question.light)
      if (const Step shade = step_of_shade(trace, std::min(question.at, trace.size()), *question.pixel))
        for (const char* channel : {"r8", "g8", "b8"}) work.also(*shade, channel);
  } else {
    work.world(*question.vertex, axis_of(place->field));
  }
  work.run_later();
  return in_reading_order(std::move(work.chain));
}

std::vector<std::string> fields_of_step(const Trace& trace, std::int64_t step) {
  return fields_in(trace.event(step).event);
}

std::string field_shown_as(const Trace& trace, std::int64_t step, std::string_view number) {
  if (step < 1 || step > trace.size()) return "";
  const Event event = trace.event(step).event;
  for (const std::string& field : fields_in(event))
    if (const auto value = field_number(event, field); value && shown_as(*value, number)) return field;
  return "";
}

std::size_t link_shown_as(const Chain& chain, std::string_view number) {
  if (chain.links.empty()) return 0;
  for (const ChainValue& value : chain.links[0].values)
    for (const Operand& operand : value.operands)
      if (operand.link > 0 && shown_as(operand.value, number)) return operand.link;
  for (std::size_t i = 1; i < chain.links.size(); ++i)
    if (chain.links[i].parent == 0)
      for (const ChainValue& value : chain.links[i].values)
        if (shown_as(value.value, number)) return i;
  return 0;
}

}  // namespace zstep::answers
