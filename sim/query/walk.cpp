#include "sim/query/walk.hpp"

#include <algorithm>

#include "traces/file/visit.hpp"

namespace zstep::query {

Walk::Walk(const Trace& trace, std::uint8_t kind, const Part& part)
    : trace_(trace),
      kind_(kind),
      part_(part),
      names_(step_limit),
      position_(std::max<std::int64_t>(part.first, 1) - 1),
      end_of_turns_(trace.end_of_turns()) {
  for (const StepInfo& step : trace.header().page) {
    names_[step.id] = step.name;
    if (step.kind == kind) steps_.push_back(step.id);
    has_scan_lines_ = has_scan_lines_ || step.kind == kind_of<ScanLineBegin>;
  }
  part_.last = std::min(part_.last, trace.size());
  if (all_tables()[kind].named_by_piece) trace.polygon_of_piece(0);  // asks for events, which read_to() may not
}

// Goes on to the next block that may hold what is wanted; position_ is just before it or in it.
bool Walk::enter_block() {
  const auto marks = trace_.polygons();
  while (position_ < part_.last) {
    if (part_.polygon) {  // on to where work on that polygon begins, unless it is at work
      const auto after = std::upper_bound(marks.begin(), marks.end(), position_ + 1,
                                          [](std::int64_t p, const PolygonMark& mark) { return p < mark.position; });
      const bool at_work = after != marks.begin() && (after - 1)->polygon == *part_.polygon;
      if (!at_work) {
        const auto begins =
            std::find_if(after, marks.end(), [&](const PolygonMark& mark) { return mark.polygon == *part_.polygon; });
        if (begins == marks.end() || begins->position > part_.last) return false;
        position_ = begins->position - 1;
      }
    }
    const std::size_t block = trace_.impl().block_of(position_ + 1);
    const BlockInfo& info = trace_.impl().blocks[block].info;
    const std::int64_t end = std::min(part_.last, info.first_position + info.count);
    const bool pixel_may = !part_.x || !part_.y || trace_.impl().last_touch(block, {*part_.x, *part_.y}) > position_;
    const bool kind_may =
        std::any_of(steps_.begin(), steps_.end(), [&](std::uint8_t step) { return info.steps.has(step); });
    if (pixel_may && kind_may) {
      if (position_ != known_to_) begin_context();
      read_to(end);
      if (!found_.empty()) return true;
    } else {
      position_ = end;
    }
  }
  return false;
}

// All that is wanted up to `end`, which is in the same block.
void Walk::read_to(std::int64_t end) {
  found_.clear();
  next_ = 0;
  trace_.visit(position_, end, [&]<class E>(std::int64_t position, std::uint8_t step, const E& event) {
    position_ = position;
    if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, PieceDraw>) {
      context_.polygon = event.polygon;
      context_.scan_line = -1;
    } else if constexpr (std::is_same_v<E, ScanLineBegin>) {
      context_.scan_line = event.y;
    }
    if (position == end_of_turns_) context_.polygon = no_polygon;
    if (kind_of<E> != kind_) return true;
    context_.step = position;
    context_.name = names_[step];
    found_.push_back({context_, event});
    if constexpr (names_polygon<E> == Names::facet || names_polygon<E> == Names::piece)
      found_.back().context.polygon = trace_.polygon_named(event).value_or(no_polygon);
    return true;
  });
  known_to_ = position_ = end;
}

// What is at work at position_, for who comes there from elsewhere.
void Walk::begin_context() {
  const auto marks = trace_.polygons();
  const auto after = std::upper_bound(marks.begin(), marks.end(), position_,
                                      [](std::int64_t p, const PolygonMark& mark) { return p < mark.position; });
  context_.polygon = trace_.polygon_at_work(position_);
  context_.scan_line = -1;
  if (!has_scan_lines_) return;
  const std::int64_t begins = after == marks.begin() ? 1 : (after - 1)->position;
  const auto line = trace_.previous(
      position_ + 1, [](const RecordedEvent&) { return true; }, Trace::Among({}, kind_of<ScanLineBegin>, begins));
  if (line) context_.scan_line = get<ScanLineBegin>(trace_.event(*line).event).y;
}

bool Walk::next() {
  while (next_ >= found_.size()) {
    found_.clear();
    next_ = 0;
    if (position_ >= part_.last || !enter_block()) return false;
  }
  at_ = &found_[next_++];
  return true;
}

}  // namespace zstep::query
