// Where a reader is in a trace, and what follows from it. Knows no window; what is shown is a function of this alone.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/classroom/lesson.hpp"
#include "sim/viewer/model/outside.hpp"
#include "traces/replay/replay.hpp"

namespace zstep::viewer {

struct Cell {
  std::int32_t x = 0, y = 0;
  bool operator==(const Cell&) const = default;
};

class Session {
 public:
  Session(const Trace& trace, const Lesson* lesson);

  const Trace& trace() const { return trace_; }
  const Scene& scene() const { return trace_.scene(); }
  const Header& header() const { return trace_.header(); }
  const Lesson* lesson() const { return lesson_; }
  /// Told what share of a long way is done; true ends it where it is. None: nobody waits before a window.
  Replay::OnWay on_way;

  const State& state() const { return replay_.state(); }
  const RecordedEvent* event() const { return replay_.current(); }
  std::int64_t position() const { return replay_.position(); }
  std::int64_t size() const { return trace_.size(); }

  // --- Moving. All clamp to the trace; looking back goes back by the unit of the last move.
  void go_to(std::int64_t position, Unit unit = Unit::event);
  /// Stays, and says so, where no such unit begins that way. After the last scan line, span or pixel it goes to the
  /// end, and says so.
  void move(Unit unit, int direction);
  /// To the next (or previous) event of this step of the pseudo-code. False, and a message, when there is none.
  bool to_step(std::uint8_t step, int direction);
  /// To the next (or previous) event that touches the selected pixel.
  bool to_selected_pixel(int direction);

  /// Lets someone look at other steps through the session's own replay, which then stands where it stood: another one
  /// would take as much memory again.
  template <class Look>
  void look_elsewhere(Look&& look) {
    const std::int64_t here = position();
    try {
      look(replay_);
    } catch (...) {
      replay_.go_to(here);
      throw;
    }
    replay_.go_to(here);
  }

  // --- Before and after
  Unit unit() const { return unit_; }
  std::int64_t before() const;               ///< where the last move's unit began
  const std::vector<Cell>& changed() const;  ///< cells written since before(), for who looks back
  /// Cells that the step itself wrote: how one came to it does not change the picture.
  const std::vector<Cell>& changed_here() const;
  bool looking_back = false;                 ///< show the buffers as they were at before()
  const Picture& picture() const;            ///< the buffers, or those of before()
  std::optional<Cell> current_cell() const;  ///< the pixel of the current event, or that at work
  /// The step before which the lesson's stop asks what it will do; none where it does not.
  const std::optional<RecordedEvent>& event_in_question() const { return asked_; }
  /// The last step, which panes tell of. nullptr where the lesson's stop asks about a step of another subject: what was
  /// done before does not belong to the question.
  const RecordedEvent* event_told() const;
  /// The pixel that the reader looks at: the one that the lesson's stop names, that of the step in question, or else
  /// the current one; in a picture at which nothing is at work any more, only the first.
  std::optional<Cell> cell_looked_at(bool still = false) const;
  /// Pixels that the lesson's stop speaks of, as y times the width + x.
  std::vector<std::int32_t> pixels_spoken_of() const {
    return stop_here() ? stop_here()->pixels.right : std::vector<std::int32_t>();
  }

  // --- Lesson
  int stop() const { return stop_; }  ///< index of the stop that speaks, −1 before the first
  bool speaks() const;                ///< the run stands at that stop, and not beyond it
  void to_stop(int index);
  /// False where it is asked for a stop beyond the last again, after that was said.
  bool next_stop(int direction);
  void answer(int choice);
  void show_answer();  ///< the right one of the current stop's question
  std::optional<int> chosen(int stop) const { return chosen_[stop]; }
  bool question_open() const;  ///< the current stop asks and has no right answer yet
  bool nudged() const;         ///< beyond the question of the current stop, which has no answer yet

  // --- Marked by hand, where a stop asks for it; kept by stop
  struct Marks {
    std::vector<std::int32_t> made;  ///< as Marking::right has them; in an order, as they were made
    bool checked = false;            ///< as they are now
    std::size_t hints = 0;           ///< that were given
    bool shown = false;              ///< what is right
  };
  const Marking* marking() const;                       ///< of the stop that speaks, or nullptr
  bool marks_cells() const;                             ///< pixels or a scan line are asked for
  const Marks& marks() const { return marks_[stop_]; }  ///< where marking() is one
  void mark(std::int32_t what);                         ///< or takes the mark away
  void mark(Cell cell);                                 ///< or its scan line, where that is asked for
  void check_marks();
  void help_with_marks();  ///< the next hint, and after the last what is right

  // --- Selected and pointed at, the same in every pane
  std::optional<Cell> selected;
  std::optional<std::int32_t> selected_edge, hovered_edge;  ///< of the edge table
  ScenePart picked_part, hovered_part;                      ///< of the scene
  /// Or takes it away, if there is none.
  void pick(const ScenePart& part);
  /// The edge of the edge table, and the vertex or edge of the scene, that every pane shows as selected or pointed at.
  std::optional<std::int32_t> lit_edge() const;
  ScenePart lit_part() const;
  void select(std::optional<Cell> cell);
  /// Goes to the end, where a first question is proposed: why a pixel has its colour. Until the next move a click on
  /// one asks that.
  void to_finished_picture();
  bool proposes_why() const { return proposes_why_; }
  /// The picture is done and looked at as a whole: nothing is at work any more.
  bool at_rest() const {
    return position() == size() && (proposes_why_ || (speaks() && lesson_->stops[stop_].event == 0));
  }

  // --- Playing
  bool playing = false;
  /// Play or pause, by key and by button. Says why where nothing is played: the end, or a question that waits for its
  /// answer.
  void toggle_play();
  /// Whole seconds that playing still leaves a reader at this stop; 0 where it does not wait.
  int seconds_to_read() const { return playing ? waits_ : 0; }
  int speed = 2;  ///< index into speeds()
  struct Speed {
    const char* name;
    double steps_a_second;
    std::optional<Unit> unit_a_frame;
  };
  static const std::vector<Speed>& speeds();
  /// Plays on; `now` in seconds of any clock. Returns in how many seconds the next picture is due, 0 for at once.
  double play(double now);

  /// Playing repeats what lies between these; 0 and 0 where it does not.
  std::int64_t loop_first = 0, loop_last = 0;
  bool loops() const { return loop_first < loop_last; }

  std::string message;  ///< one sentence for the reader, until the next move

 private:
  std::optional<std::int32_t> entry_of(const ScenePart& part) const;
  const Stop* stop_here() const { return speaks() ? &lesson_->stops[static_cast<std::size_t>(stop_)] : nullptr; }
  void arrived();
  int stop_at(std::int64_t position) const;
  bool asks_here() const;
  void say_that_it_asks();

  const Trace& trace_;
  const Lesson* lesson_;
  Replay replay_;
  mutable std::optional<Replay> replay_before_;
  Unit unit_ = Unit::event;
  mutable std::optional<std::int64_t> before_;
  mutable std::optional<std::vector<Cell>> changed_, changed_here_;
  bool told_end_ = false;  ///< of the lesson
  bool proposes_why_ = false;
  std::optional<RecordedEvent> asked_;
  bool told_to_answer_ = false;  ///< the reader wanted to play on from an open question
  int stop_ = -1;
  std::vector<std::optional<int>> chosen_;
  std::vector<Marks> marks_;
  double played_until_ = -1, owed_ = 0, reading_until_ = -1;
  int waits_ = 0;  ///< seconds, as last said
};

/// "event", "pixel", …: the word for one and where it is said.
const char* unit_word(Unit unit);

}  // namespace zstep::viewer
