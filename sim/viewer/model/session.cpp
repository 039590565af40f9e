#include "sim/viewer/model/session.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "sim/classroom/marking.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"
#include "traces/file/visit.hpp"
#include "traces/events/fields.hpp"

namespace zstep::viewer {
namespace {

/// What a unit is called in this trace: methods without scan lines have areas or edges in their stead, some work on
/// curves in turn. Empty where none begins in it, which is found without reading its events.
std::string_view word_in(const Trace& trace, Unit unit) {
  for (std::size_t kind = 0; kind < kind_count; ++kind)
    if (const Begins& begins = description_of_kind(kind).begins;
        begins.unit == unit && trace.has(static_cast<std::uint8_t>(kind)))
      return begins.word;
  const bool assumed = unit == Unit::pixel || (unit == Unit::polygon && !trace.polygons().empty());
  return assumed ? unit_word(unit) : "";
}

/// May the last event begin a unit? A pixel always may; any other unit only where a recording was cut off.
bool may_begin(const Event& event, Unit unit) {
  return description_of_kind(event.index()).begins.unit == unit || (unit == Unit::pixel && pixel_of(event));
}

}  // namespace

const char* unit_word(Unit unit) {
  switch (unit) {
    case Unit::event:
      return "step";
    case Unit::pixel:
      return "pixel";
    case Unit::span:
      return "span";
    case Unit::scan_line:
      return "scan line";
    case Unit::polygon:
      return "polygon";
  }
  return "step";
}

Session::Session(const Trace& trace, const Lesson* lesson)
    : trace_(trace),
      lesson_(lesson),
      replay_(trace),
      chosen_(lesson ? lesson->stops.size() : 0),
      marks_(chosen_.size()) {
  stop_ = stop_at(0);
}

void Session::go_to(std::int64_t position, Unit unit) {
  const std::int64_t from = this->position(), to = std::clamp<std::int64_t>(position, 0, size());
  if (to == from && unit == unit_ && message.empty()) return;
  unit_ = unit;
  std::string refused;
  if (to != from) {
    try {
      replay_.go_to(to, on_way);
    } catch (const InputError& error) {
      refused = error.what();  // a step that cannot be: this is the state before it
    }
    selected_edge.reset();
    stop_ = stop_at(this->position());
  }
  arrived();
  if (!refused.empty()) message = refused;
  else if (this->position() != to) message = fmt::format("The way to step {} was ended here.", grouped(to));
}

void Session::arrived() {
  before_.reset();
  changed_.reset();
  changed_here_.reset();
  told_to_answer_ = false;
  message.clear();
}

void Session::move(Unit unit, int direction) {
  const std::int64_t at = position();
  if ((direction > 0 && at == size()) || (direction < 0 && at == 0)) {
    message = direction > 0 ? "This is the end of the trace." : "This is the beginning of the trace.";
    return;
  }
  if (unit == Unit::event) return go_to(at + direction, unit);
  const auto say = [this](std::string sentence) { message = std::move(sentence); };
  const std::string_view word = word_in(trace_, unit);
  if (word.empty()) return say(fmt::format("No {} begins in this trace.", unit_word(unit)));
  const std::int64_t to = direction > 0 ? next_unit(trace_, at, unit) : previous_unit(trace_, at, unit);
  if (direction < 0 && to == 0)
    return say(fmt::format("No earlier {} begins; Home goes to the beginning of the trace.", word));
  const bool last = direction > 0 && to == size() && !may_begin(trace_.event(to).event, unit);
  // After the last polygon many methods have most of their work before them.
  if (last && unit == Unit::polygon)
    return say(fmt::format("No later {} begins; End goes to the end of the trace.", word));
  go_to(to, unit);
  if (last) say(fmt::format("No later {} begins; this is the end of the trace.", word));
}

bool Session::to_step(std::uint8_t step, int direction) {
  const auto same = [step](const RecordedEvent& e) { return e.step == step; };
  const auto found = direction > 0 ? trace_.next(position(), same) : trace_.previous(position(), same);
  if (found) {
    go_to(*found);
    return true;
  }
  message = direction > 0 ? "This line does not run again." : "This line did not run before.";
  return false;
}

bool Session::to_selected_pixel(int direction) {
  if (!selected) {
    message = "Click a pixel first; then F runs to the next step that touches it.";
    return false;
  }
  const Cell cell = *selected;
  const auto touches = [cell](const RecordedEvent& e) {
    const auto pixel = pixel_of(e.event);
    return pixel && pixel->x == cell.x && pixel->y == cell.y;
  };
  const Trace::Pixel pixel{cell.x, cell.y};
  const auto found =
      direction > 0 ? trace_.next(position(), touches, pixel) : trace_.previous(position(), touches, pixel);
  if (found) {
    go_to(*found);
    return true;
  }
  message = direction > 0 ? "No later step touches this pixel." : "No earlier step touches this pixel.";
  return false;
}

void Session::select(std::optional<Cell> cell) { selected = cell; }

// --- Before and after

std::int64_t Session::before() const {
  if (!before_) {
    if (position() == 0) before_ = 0;
    else before_ = unit_ == Unit::event ? position() - 1 : previous_unit(trace_, position(), unit_);
  }
  return *before_;
}

namespace {

/// The cells that events of steps beyond `before` up to `position` wrote.
std::vector<Cell> cells_written(const Trace& trace, std::int64_t before, std::int64_t position) {
  std::vector<Cell> cells;
  constexpr std::int64_t readable = 500'000;  // beyond, marks would cover the picture and cost more than a frame
  if (position - before > readable) return cells;
  const auto look = [&](const auto& event) {
    using E = std::decay_t<decltype(event)>;
    if constexpr (std::is_same_v<E, DepthWrite> || std::is_same_v<E, PixelWrite>)
      if (const Cell cell{event.x, event.y}; cells.empty() || cells.back() != cell) cells.push_back(cell);
  };
  if (position - before == 1) {
    visit_event(look, trace.event(position).event);
  } else {
    trace.visit(before, position, [&](std::int64_t, std::uint8_t, const auto& event) {
      look(event);
      return true;
    });
  }
  return cells;
}

}  // namespace

const std::vector<Cell>& Session::changed() const {
  if (!changed_) changed_ = cells_written(trace_, before(), position());
  return *changed_;
}

const std::vector<Cell>& Session::changed_here() const {
  if (!changed_here_) changed_here_ = cells_written(trace_, std::max<std::int64_t>(0, position() - 1), position());
  return *changed_here_;
}

const Picture& Session::picture() const {
  if (!looking_back) return state().picture_of_pass();
  if (!replay_before_) replay_before_.emplace(trace_);
  replay_before_->go_to(before());
  return replay_before_->state().picture_of_pass();
}

std::optional<Cell> Session::current_cell() const {
  if (!event()) return std::nullopt;
  if (const auto pixel = pixel_of(event()->event)) return Cell{pixel->x, pixel->y};
  return std::nullopt;
}

// --- Lesson

int Session::stop_at(std::int64_t position) const {
  if (!lesson_) return -1;
  const auto& stops = lesson_->stops;
  // Several stops may have one position: arriving there shows the first of them, later positions show the last.
  int found = -1;
  for (int i = 0; i < static_cast<int>(stops.size()); ++i) {
    const std::int64_t at = stops[static_cast<std::size_t>(i)].position;
    if (at == position) return i;
    if (at < position) found = i;
  }
  return found;
}

std::optional<std::int32_t> Session::entry_of(const ScenePart& part) const {
  if (part.edge)
    for (const EdgeTableInsert& entry : state().machine.edge_table)
      if (EdgeEnds(std::minmax(entry.vertex_0, entry.vertex_1)) == *part.edge) return entry.edge;
  return std::nullopt;
}

std::optional<std::int32_t> Session::lit_edge() const {
  if (hovered_edge) return hovered_edge;
  if (const auto entry = entry_of(hovered_part)) return entry;
  return selected_edge ? selected_edge : entry_of(picked_part);
}

ScenePart Session::lit_part() const {
  const auto in_scene = [&](const std::optional<std::int32_t>& edge) {
    const auto& table = state().machine.edge_table;
    const auto at = static_cast<std::size_t>(edge.value_or(-1));
    if (!edge || at >= table.size()) return ScenePart{};
    const EdgeEnds ends = std::minmax(table[at].vertex_0, table[at].vertex_1);
    const auto points = static_cast<std::int32_t>(scene().points.size());
    return ends.first >= 0 && ends.second < points ? ScenePart{{}, ends} : ScenePart{};
  };
  if (hovered_part.any()) return hovered_part;
  if (hovered_edge) return in_scene(hovered_edge);
  return picked_part.any() ? picked_part : in_scene(selected_edge);
}

void Session::pick(const ScenePart& part) {
  picked_part = part;
  selected_edge.reset();
  message = part.any() ? told_of(scene(), part) : "";
}

}  // namespace zstep::viewer
