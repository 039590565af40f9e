#include "sim/query/walk.hpp"

#include <algorithm>

#include "traces/file/trace_impl.hpp"

namespace zstep::query {

Walk::Walk(const Trace& trace, std::uint8_t kind, const Part& part)
    : trace_(trace), kind_(kind), part_(part), names_(step_limit), position_(std::max<std::int64_t>(part.first, 1) - 1) {
  for (const StepInfo& step : trace.header().page) {
    names_[step.id] = step.name;
    has_scan_lines_ = has_scan_lines_ || step.kind == kind_of<ScanLineBegin>;
  }
  part_.last = std::min(part_.last, trace.size());
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
        const auto begins = std::find_if(after, marks.end(), [&](const PolygonMark& mark) { return mark.polygon == *part_.polygon; });
        if (begins == marks.end() || begins->position > part_.last) return false;
        position_ = begins->position - 1;
      }
    }
    const std::size_t index = trace_.impl().block_of(position_ + 1);
    const BlockInfo& info = trace_.impl().blocks[index].info;
    const bool x_may = !part_.x || (info.x_min <= *part_.x && *part_.x <= info.x_max);
    const bool y_may = !part_.y || (info.y_min <= *part_.y && *part_.y <= info.y_max);
    const bool consecutive = events_ && position_ == block_end_;
    block_first_ = info.first_position;
    block_end_ = info.first_position + info.count;
    if (x_may && y_may) {
      if (!consecutive) begin_context();
      events_ = trace_.impl().events(index);
      return true;
    }
    position_ = block_end_;
    events_.reset();
  }
  return false;
}

// What is at work at position_, for who comes there from elsewhere.
void Walk::begin_context() {
  const auto marks = trace_.polygons();
  const auto after = std::upper_bound(marks.begin(), marks.end(), position_,
                                      [](std::int64_t p, const PolygonMark& mark) { return p < mark.position; });
  mark_ = static_cast<std::size_t>(after - marks.begin());
  context_.polygon = mark_ == 0 ? no_polygon : marks[mark_ - 1].polygon;
  context_.scan_line = -1;
  if (!has_scan_lines_) return;
  const std::int64_t begins = mark_ == 0 ? 0 : marks[mark_ - 1].position;
  for (std::int64_t p = position_; p > begins; --p) {
    const auto* line = std::get_if<ScanLineBegin>(&trace_.event(p).event);
    if (!line) continue;
    context_.scan_line = line->y;
    return;
  }
}

void Walk::follow(const Event& event) {
  const auto marks = trace_.polygons();
  if (mark_ < marks.size() && marks[mark_].position == position_) {
    context_.polygon = marks[mark_++].polygon;
    context_.scan_line = -1;
  } else if (const auto* line = std::get_if<ScanLineBegin>(&event)) {
    context_.scan_line = line->y;
  }
}

bool Walk::next() {
  while (true) {
    while (events_ && position_ < std::min(block_end_, part_.last)) {
      const RecordedEvent& recorded = (*events_)[static_cast<std::size_t>(position_ - block_first_)];
      ++position_;
      follow(recorded.event);
      if (recorded.event.index() != kind_) continue;
      context_.step = position_;
      context_.name = names_[recorded.step];
      event_ = &recorded.event;
      return true;
    }
    if (position_ >= part_.last || !enter_block()) return false;
  }
}

}  // namespace zstep::query
