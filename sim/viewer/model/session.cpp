// Where a reader is: steps, the lesson with its stops, questions and marks, and playing.

#include "sim/viewer/model/session.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "sim/classroom/marking.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"
#include "traces/events/fields.hpp"
#include "traces/file/visit.hpp"
#include "traces/math/whole.hpp"
#include "traces/scene.hpp"

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
  arrived();
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
  proposes_why_ = false;
  message.clear();
  asked_.reset();
  const Stop* stop = stop_here();
  if (stop && (stop->question || stop->marking) && stop->event > position()) asked_ = trace_.event(stop->event);
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

void Session::to_finished_picture() {
  go_to(size());
  proposes_why_ = records<PixelWrite>(header());
  message = proposes_why_ ? "The picture is done. Click a pixel: why is it this colour? Home leads to the first step."
                          : "The picture is done. Home leads to the first step.";
}

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

namespace {

/// Whether what both say of their subject, a pixel, a vertex, an edge, is the same.
bool has_same_subject(const Event& a, const Event& b) {
  bool shares = false;
  for (const FieldOfKind& field : fields_of_kind(a.index())) {
    const FieldOfKind* other = field_of_kind(b.index(), field.name);
    if (!other || !has(field.as, As::subject) || !has(other->as, As::subject)) continue;
    if (field.read(a) != other->read(b)) return false;
    shares = true;
  }
  return shares;
}

}  // namespace

const RecordedEvent* Session::event_told() const {
  return !asked_ || !event() || has_same_subject(event()->event, asked_->event) ? event() : nullptr;
}

std::optional<Cell> Session::cell_looked_at(bool still) const {
  if (const Stop* stop = stop_here(); stop && stop->pixel) return Cell{stop->pixel->x, stop->pixel->y};
  if (still) return std::nullopt;
  if (asked_ && !marking())  // what is to be marked is not shown
    if (const auto pixel = pixel_of(asked_->event)) return Cell{pixel->x, pixel->y};
  if (!event_told()) return std::nullopt;
  if (const auto cell = current_cell()) return cell;
  const RayWork& rays = state().machine.rays;  // what is done along a ray is done for its pixel
  return rays.ray && !rays.tree.empty() ? std::optional(Cell{rays.tree.front().entry.x, rays.tree.front().entry.y})
                                        : std::nullopt;
}

// --- Lesson

int Session::stop_at(std::int64_t position) const {
  if (!lesson_) return -1;
  const auto& stops = lesson_->stops;
  // Several stops may have one position: arriving there shows the first of them, later positions show the last.
  int found = -1;
  for (int i = 0; i < size32(stops); ++i) {
    const std::int64_t at = stops[i].position;
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
    const std::size_t at = edge.value_or(-1);
    if (!edge || at >= table.size()) return ScenePart{};
    const EdgeEnds ends = std::minmax(table[at].vertex_0, table[at].vertex_1);
    const auto points = size32(scene().points);
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

void Session::to_stop(int index) {
  if (!lesson_ || lesson_->stops.empty()) return;
  index = std::clamp(index, 0, size32(lesson_->stops) - 1);
  unit_ = Unit::event;
  replay_.go_to(lesson_->stops[index].position);
  stop_ = index;
  selected_edge.reset();
  arrived();
}

bool Session::next_stop(int direction) {
  if (!lesson_ || lesson_->stops.empty()) {
    message = "There is no lesson here; Ctrl+O opens one.";
    return true;
  }
  const int count = size32(lesson_->stops);
  int target = stop_ + direction;
  // Going back from between two stops returns to the one that is still shown.
  if (direction < 0 && stop_ >= 0 && position() > lesson_->stops[stop_].position) target = stop_;
  if (target < 0 || target >= count) {
    message = direction > 0 ? "This was the last stop of the lesson." : "This is the first stop of the lesson.";
    const bool again = direction > 0 && told_end_;
    told_end_ = direction > 0;
    return !again;
  }
  told_end_ = false;
  to_stop(target);
  return true;
}

bool Session::speaks() const { return stop_ >= 0 && lesson_->stops[stop_].position == position(); }

bool Session::question_open() const {
  if (stop_ < 0) return false;
  const auto& question = lesson_->stops[stop_].question;
  if (!question) return false;
  const auto given = chosen(stop_);
  return !given || !question->answers[*given].right;
}

bool Session::nudged() const {
  return question_open() && !chosen(stop_) && (told_to_answer_ || position() > lesson_->stops[stop_].position);
}

void Session::answer(int choice) {
  if (stop_ < 0) return;
  if (const Marking* asked = marking(); asked && asked->kind == Marking::Kind::order) {
    const std::vector<std::int32_t> choices = choices_of(*asked);
    if (choice >= 0 && choice < size32(choices)) mark(choices[choice]);
    return;
  }
  const auto& question = lesson_->stops[stop_].question;
  if (!question || choice < 0 || choice >= size32(question->answers)) return;
  chosen_[stop_] = choice;
}

void Session::show_answer() {
  if (!question_open()) return;
  const std::vector<Answer>& answers = lesson_->stops[stop_].question->answers;
  const auto right = std::find_if(answers.begin(), answers.end(), [](const Answer& one) { return one.right; });
  if (right != answers.end()) answer(static_cast<int>(right - answers.begin()));
}

// --- Playing

// Playing: so many steps a second, or a unit a frame, with halts where the lesson speaks and asks.

const std::vector<Session::Speed>& Session::speeds() {
  static const std::vector<Speed> all{{"1 step/s", 1, {}},
                                      {"2 steps/s", 2, {}},
                                      {"5 steps/s", 5, {}},
                                      {"10 steps/s", 10, {}},
                                      {"30 steps/s", 30, {}},
                                      {"100 steps/s", 100, {}},
                                      {"500 steps/s", 500, {}},
                                      {"a span a frame", 0, Unit::span},
                                      {"a line a frame", 0, Unit::scan_line},
                                      {"a polygon a frame", 0, Unit::polygon}};
  return all;
}

bool Session::asks_here() const {
  if (stop_ < 0) return false;
  const Stop& stop = lesson_->stops[stop_];
  return stop.question && !chosen(stop_) && stop.position == position();
}

void Session::say_that_it_asks() {
  told_to_answer_ = true;
  const std::size_t answers = lesson_->stops[stop_].question->answers.size();
  message =
      fmt::format("Here the lesson asks. Answer first (a key from 1 to {}, or a click), then Space plays on.", answers);
}

void Session::toggle_play() {
  if (playing && waits_ > 0) {
    reading_until_ = -1;  // the reader has read
    return;
  }
  if (!playing && position() == size() && !loops()) {
    message = "This is the end of the trace; Home goes back to its beginning.";
    return;
  }
  if (!playing && asks_here()) return say_that_it_asks();
  playing = !playing;
}

double Session::play(double now) {
  constexpr double frame = 1.0 / 60, words_a_second = 3.5;
  if (played_until_ < 0 || now - played_until_ > 1) played_until_ = now;
  const double passed = now - played_until_;
  played_until_ = now;
  if (!playing) {
    owed_ = 0, waits_ = 0;
    reading_until_ = played_until_ = -1;
    return 3600;
  }
  if (asks_here()) {
    playing = false;
    say_that_it_asks();
    return 3600;
  }
  if (const double left = reading_until_ - now; left > 0) {
    const int whole = ceil_int(left);
    if (whole != std::exchange(waits_, whole)) {
      message =
          fmt::format("Time to read this stop: playing goes on in {} s. Space goes on at once, Esc pauses.", whole);
    }
    return std::max(frame, left - (whole - 1));
  }
  if (std::exchange(waits_, 0) > 0) message.clear();
  const Speed& s = speeds()[speed];
  std::int64_t to = position();
  if (s.unit_a_frame) {
    to = next_unit(trace_, position(), *s.unit_a_frame);
  } else {
    owed_ = std::min(owed_ + passed * s.steps_a_second, s.steps_a_second);
    to = position() + static_cast<std::int64_t>(owed_);
    owed_ -= static_cast<double>(static_cast<std::int64_t>(owed_));
  }
  if (loops()) to = position() >= loop_last || position() < loop_first ? loop_first : std::min(to, loop_last);
  // The lesson has the word: halt where it speaks, for as long as reading takes, or until its question is answered.
  if (lesson_ && to > position())
    for (std::size_t i = 0; i < lesson_->stops.size(); ++i) {
      const Stop& stop = lesson_->stops[i];
      const bool next_here = stop.position == position() && index32(i) > stop_;  // several may speak at one step
      if (stop.position > to || (stop.position <= position() && !next_here)) continue;
      to_stop(index32(i));
      owed_ = 0;
      if (!asks_here())
        reading_until_ =
            now + 2 + static_cast<double>(std::count(stop.text.begin(), stop.text.end(), ' ')) / words_a_second;
      return 0;
    }
  if (to != position()) go_to(to, s.unit_a_frame.value_or(Unit::event));
  if (position() == size() && !loops()) {
    playing = false;
    message = "Played to the end of the trace; Home goes back to its beginning.";
  }
  if (s.unit_a_frame) return frame;
  return std::max(frame, (1 - owed_) / s.steps_a_second);
}

// What a reader marks by hand, before the run does it.

const Marking* Session::marking() const {
  if (!lesson_ || stop_ < 0) return nullptr;
  const auto& marking = lesson_->stops[stop_].marking;
  return marking ? &*marking : nullptr;
}

bool Session::marks_cells() const { return marking() && marking()->kind != Marking::Kind::order; }

void Session::mark(std::int32_t what) {
  if (!marking()) return;
  Marks& marks = marks_[stop_];
  marks.checked = false;
  if (const auto there = std::find(marks.made.begin(), marks.made.end(), what); there != marks.made.end()) {
    marks.made.erase(there);
  } else {
    if (marking()->kind == Marking::Kind::scan_line) marks.made.clear();
    marks.made.push_back(what);
  }
}

void Session::mark(Cell cell) {
  if (marks_cells())
    mark(marking()->kind == Marking::Kind::scan_line ? cell.y : cell.y * scene().raster.width + cell.x);
}

void Session::check_marks() {
  if (!marking()) return void(message = "Nothing is asked to be marked here.");
  Marks& marks = marks_[stop_];
  if (marks.made.empty()) message = "Nothing is marked yet.";
  else marks.checked = true;
}

void Session::help_with_marks() {
  if (!marking()) return void(message = "Nothing is asked to be marked here.");
  Marks& marks = marks_[stop_];
  if (marks.hints < marking()->hints.size()) ++marks.hints;
  else marks.shown = true;
}

}  // namespace zstep::viewer
