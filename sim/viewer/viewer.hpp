// The replay viewer. Draws from a trace alone.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "algorithms/catalog/changes.hpp"
#include "sim/classroom/lesson.hpp"
#include "sim/cost/growth.hpp"
#include "traces/image/png.hpp"
#include "sim/words/judged.hpp"
#include "traces/file/trace.hpp"

namespace zstep {

/// What can be opened from the window.
struct Offer {
  enum class What : std::uint8_t { lesson, method, scene };
  What what = What::lesson;
  std::string id;  ///< a lesson's or a method's, a built-in scene's name, or the path of a file
  std::string title, summary;
  int stops = 0;        ///< of a lesson
  int number = 0;       ///< of a lesson, in teaching order from 1
  Image picture{};      ///< of a scene
  std::string theme{};  ///< of a lesson; neighbours with the same stand together
  double minutes = 0;   ///< that a lesson takes
};

/// A run that was opened from the window.
struct Opened {
  Trace trace;
  std::optional<Lesson> lesson{};        ///< resolved against it
  std::vector<std::string> opened_by{};  ///< as in ViewerOptions
  std::string note{};                    ///< what a reader should know of it, in a sentence; mostly empty
  std::string impossible{};              ///< why the step that would come next cannot be; mostly empty
  bool finished = false;                 ///< as in ViewerOptions
};

/// A run of another method on the scene of a trace.
struct OtherRun {
  Trace trace;
  bool whole = true;  ///< false: it was cut off, as it would take too long
};

/// Told how many steps a run has so far; false ends it there.
using RunWatch = std::function<bool(std::int64_t steps)>;

/// A second run beside the trace, and how the two were matched. The trace is run A of the report.
struct AgainstRun {
  const Trace* trace = nullptr;
  const diff::DiffReport* report = nullptr;
  bool at_first_cause = false;  ///< opens where the runs first part
};

/// Methods side by side on the scene of the trace.
struct RaceAsked {
  std::vector<std::string> entrants;  ///< as "z-buffer", "bsp:root=random"; none: the method of the trace and the next
  compare::Measure clock = compare::Measure::operations;
  double at = 0;        ///< of the clock
  bool of_all = false;  ///< `at` is a share of the whole race, not a number of steps or operations
};

struct WindowSize {
  std::int32_t width = 1280, height = 720;
  bool operator==(const WindowSize&) const = default;
};

struct ViewerOptions {
  std::int64_t at = -1;       ///< position to open at; -1: where it was left, or the lesson's first stop
  std::optional<int> stop{};  ///< of the lesson, to open at: several may speak at one position
  std::optional<std::filesystem::path> screenshot;  ///< write one frame as PNG and leave; needs no display
  std::string pane;                                 ///< of the screenshot; empty: all of the window
  std::optional<WindowSize> size;       ///< of the window or the screenshot; unset: of a window as it was left
  std::optional<bool> dark;             ///< for this run; unset: as it was left, light at first
  bool presenter = false;               ///< for this run
  bool embed = false;                   ///< inside a page of others: what leads, and the transport
  bool notes = false;                   ///< the speaker's: opens them too, or is the picture of them
  const Lesson* lesson = nullptr;       ///< narration beside the trace, already resolved
  const CheckedRun* checked = nullptr;  ///< what check found in the trace: it is marked
  const AgainstRun* against = nullptr;
  /// Runs the next (1) or previous (-1) method that can draw this trace's scene; nullopt when there is none. Empty
  /// where no method can be run. May throw InputError.
  std::function<std::optional<OtherRun>(const Trace&, int direction)> other_method;
  /// What can be opened from the window, asked for when a reader wants to choose; empty where nothing can be.
  std::function<std::vector<Offer>()> offers;
  /// Opens it: a method draws the scene of this trace, a scene is drawn by its method. Throws InputError.
  std::function<std::unique_ptr<Opened>(const Trace&, const Offer&)> open;
  /// Runs a method on the scene of a trace with these changes made, one after the other. Throws InputError. Empty where
  /// nothing can be changed.
  std::function<OtherRun(const Trace& opened, const std::string& method, const std::vector<Change>& changes)>
      run_changed;
  /// The same for a long run, watched: on another thread, and not cut off before a trace fills the memory that a window
  /// may have. Empty: there is none.
  std::function<OtherRun(const Trace& opened, const std::string& method, const std::vector<Change>& changes,
                         const RunWatch& watch)>
      run_watched;
  std::optional<RaceAsked> race{};  ///< opens with it
  bool at_start = false;            ///< opens with the choice of what to open
  std::vector<std::string>
      opened_by;  ///< words of the command line that opens this view again, without the place in it
  std::optional<Trace::Pixel> pixel{};  ///< to be selected
  std::string lead{};                   ///< the pane that leads on the stage; empty: what the method has
  std::string note{};                   ///< what a reader should know of what is opened, in a sentence
  bool finished = false;                ///< opens on the finished picture, where it was not left elsewhere
  /// What the trace and all that is pointed to lie in, where the window may outlive the call, as it does in a browser.
  std::shared_ptr<const void> kept{};
};

/// Opens the window and runs until it is closed; with `screenshot` draws one frame headless. Returns the exit code.
int run_viewer(const Trace& trace, const ViewerOptions& options);

/// What is shown at the place that `options` opens at, as text for a screen reader: the sentence and the formulas in
/// words, the lesson and its question, and the tables. Needs no display.
std::string described(const Trace& trace, const ViewerOptions& options);

/// The lesson that was open last, by its id; empty where none is known.
std::string last_lesson();

/// Whether a window can be opened here.
bool display_available();

}  // namespace zstep
