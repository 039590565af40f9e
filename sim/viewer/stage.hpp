// What the window shows: a trace in an App, and in its place, on a key, another method's trace of the same scene.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>
#include <optional>

#include "sim/viewer/app.hpp"
#include "sim/viewer/model/run_behind.hpp"
#include "sim/viewer/viewer.hpp"

namespace zstep::viewer {

/// Where a reader is, by what that means to every method.
struct Whereabouts {
  std::optional<Cell> selected, cell;  ///< cell: at work
  std::int32_t polygon = no_polygon;   ///< at work
  std::optional<std::int32_t> line{};  ///< the scan line at work
  std::string step{};                  ///< of the page, by its name
  double share = 0;                    ///< of the run
};
Whereabouts moment_of(const Session& session);

/// Where a reader who was here before goes on. Nowhere before a class, and in a lesson that was read to its end: they
/// begin with the first stop.
std::optional<std::int64_t> place_to_go_on(const Settings& settings, const Trace& trace, const Lesson* lesson);

/// Where another method's run of the same scene is at such a moment, and what that is, in words.
struct MomentThere {
  std::int64_t step = 0;
  std::string what;
};
MomentThere moment_in(const Trace& trace, const Whereabouts& moment);

class Stage {
 public:
  /// `trace` and what the options point to must live as long.
  Stage(const Trace& trace, const ViewerOptions& options, const Settings& settings, int width, int height,
        float dpi_scale = 1);

  App& app() { return other_app_ ? *other_app_ : *first_app_; }
  const Trace& trace() const { return other_ ? other_->trace : *first_; }
  /// The trace that was opened, with its lesson, as the reader left it.
  App& first_app() { return *first_app_; }
  const Trace& first() const { return *first_; }

  /// Does what the App asks for that may show something else. True where that may be of another name.
  bool serve();

  /// Opens something else in place of all that is shown, at the place where it was left. What cannot be opened is said
  /// on the start page, and all stays as it is. Another method of a run that was changed is as after switch_method: the
  /// changes can be taken back there.
  /// `for_class`: in presenter mode, and a lesson from its first stop on.
  void open(const Offer& offer, bool for_class = false);

  /// Shows the next (or previous) method's run on this scene at the same moment. The trace that was opened has its
  /// place among them and keeps the reader's place, the lesson's answers and all else meanwhile. What cannot be done is
  /// said in the window.
  void switch_method(int direction);

  /// Judges the run that is shown, marks what is wrong in it and goes to the first cause.
  void check();
  /// Shows the run of a file, or of whatever else can be opened, beside the one that is shown, where the two first
  /// part; of nothing, the run that zstep itself makes of this scene. What cannot be is said in the drawer, and all
  /// stays.
  void compare_with(const std::string& path);

  /// Runs the method shown anew with one thing changed; `goes_on`: in place of the last change, if that was of the same
  /// thing. The window stays at the same moment. What cannot be is said, and all stays as it is.
  void change(const Change& change, bool goes_on);
  /// Takes the last change back (1), or makes again what was taken back (-1).
  void undo(int direction);
  const std::vector<Change>& changes() const { return changes_; }

  /// From a run that is shown in place of the lesson's back to it, and to its next stop (1) or the previous one (-1).
  /// What was changed can be made again there.
  void go_back_to_lesson(int direction);

  /// Of a large run the next one is made while the window goes on: each turn this looks whether it is done, and shows
  /// it then; until then it says how far it is.
  void look_for_run();
  /// Ends the run that is being made; what is shown stays.
  void end_run();

 private:
  void begin(const Settings& settings, int width, int height);
  void take_progress_of(const std::string& file);
  /// What a reader has changed and taken back, once the run that is asked for is made.
  struct Asked {
    std::vector<Change> changes, undone;
    bool goes_on = false;
    bool typed = false;  ///< the field is emptied then
  };
  Asked asked() const;
  void ask(Asked asked);
  /// Makes the run, at once or while the window goes on, and shows it.
  void show_made(OtherRun made, Asked asked);
  /// What making a run threw, said in the window; false where it threw nothing.
  template <class Make>
  std::optional<OtherRun> made_by(Make&& make);
  void switch_to(const std::string& method);
  void show_other(OtherRun other, Changed changed);
  /// What was shown: the App goes before the run that it looks at.
  struct Before {
    std::shared_ptr<OtherRun> run;
    std::unique_ptr<App> app;
  };
  /// Shows another run in the same window, or without one the first again. What a lecturer wrote stays, as does the
  /// clock.
  Before show_in_place(std::optional<OtherRun> next);
  Changed told_of(const std::vector<Change>& changes, const Trace& before);

  /// A run beside the one that is shown, and how the two were matched.
  struct Second {
    Trace trace;
    diff::DiffReport report{};
    AgainstRun with{};
  };
  Second second_run(const std::string& path);
  bool check_run();  ///< false: it was ended
  bool on_way(double share);

  std::deque<CheckedRun> checked_;  ///< and these, what an App marks: the last of both is shown now
  std::deque<Second> seconds_;
  std::unique_ptr<Opened> opened_;  ///< from the window, once something was
  const Trace* first_;
  const Lesson* lesson_;
  const ViewerOptions& options_;
  float dpi_scale_;
  std::unique_ptr<App> first_app_;
  std::shared_ptr<OtherRun> other_;  ///< none while the first is shown
  std::unique_ptr<App> other_app_;
  std::vector<Change> changes_, undone_;
  std::shared_ptr<OtherRun> before_change_;  ///< none: the first
  struct Pending {
    Asked asked;
    std::int64_t told = 0;  ///< steps, as last said
    RunBehind run;
  };
  std::unique_ptr<Pending> pending_;
  Whereabouts moment_;         ///< where the reader went last, by hand
  std::int64_t arrived_ = -1;  ///< where switching led; the reader has not moved while that is the position
};

/// What a trace is called in the settings: its name, its length and its scene, so that another run is another place.
std::string place_key(const Trace& trace);

/// The last event of the trace that gave this pixel a colour; its size if none did.
std::int64_t last_write(const Trace& trace, Cell cell);

}  // namespace zstep::viewer
