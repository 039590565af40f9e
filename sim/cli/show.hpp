// The viewer's side of view, lesson and zstep alone, and what can be opened from its window.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "sim/cli/traces.hpp"
#include "sim/viewer/viewer.hpp"
#include "traces/file/trace.hpp"

namespace zstep::cli {

// What can be opened from the viewer's window, and how.

/// Lessons, methods and built-in scenes, the scenes with pictures.
std::vector<Offer> all_offers();

/// Opens what is offered, or a file. `now` is what is shown: a method draws its scene, and a scene is drawn by its
/// method where that can draw it, else by the Z-buffer. Throws InputError.
std::unique_ptr<Opened> open_offer(const Trace& now, const Offer& offer);

struct ShowOptions {
  std::string at;  ///< a step, or the name of a bookmark
  std::string screenshot;
  bool describe = false;  ///< text instead of a window
  std::string pane;       ///< of the screenshot; empty: all of the window
  /// Neither a picture nor text is asked for.
  bool opens_window() const { return screenshot.empty() && !describe; }
  std::int32_t width = 1280, height = 720;
  bool dark = false, light = false, presenter = false, notes = false, embed = false;
  std::string pixel, lead;                   ///< to be selected; to lead on the stage
  bool patient = false;                      ///< a link asks for it: what takes too long is cut off
  std::string race, race_by = "operations";  ///< who races, with commas between; empty: no race
  const CLI::App* command = nullptr;         ///< whose words opened the view; lives as long as the action runs
};

/// Adds what names a place and how it is looked at: --at, --pixel, --lead, --dark, --light, --presenter and --embed.
void add_place_options(CLI::App& command, ShowOptions& options);

/// Adds these, --screenshot, --describe, --pane and --size-window.
void add_show_options(CLI::App& command, ShowOptions& options);

/// Adds --notes, for what opens a lesson.
void add_notes_option(CLI::App& command, ShowOptions& options);

/// Adds --race and --race-by.
void add_race_options(CLI::App& command, ShowOptions& options);

/// The words that a parsed command was called by, without those that name a place in what it opens.
std::vector<std::string> words_of(const CLI::App& command);

/// What is shown beside a trace.
struct ShownWith {
  const Lesson* lesson = nullptr;
  const CheckedRun* checked = nullptr;  ///< what check found in it
  const AgainstRun* against = nullptr;  ///< a second run
  bool at_start = false;                ///< with the start page before it
  bool whole = true;                    ///< false: the run was cut off, as it would take too long
  bool finished = false;                ///< opens on the finished picture: who brings a mesh knows no step of it
  std::shared_ptr<const void> kept{};   ///< what the trace and these lie in, where a window may outlive the call
};

/// Opens the viewer, or writes the screenshot and says so. Throws InputError when a window is wanted and there is no
/// display, when the step is not in the trace, and when this zstep was built without the viewer.
int show(const Trace& trace, const ShowOptions& options, const ShownWith& with = {});

/// The pixel that --pixel names; nothing where it is not given. Throws InputError where the raster has no such pixel.
std::optional<Trace::Pixel> pixel_selected(const ShowOptions& options, const Raster& raster);

/// Throws what show() would throw for a place that the trace does not have.
void check_opens(const Trace& trace, const ShowOptions& options);

/// The step of a place, as G in the viewer takes it (sim/places/typed_place.hpp). Throws InputError where the trace has
/// none such.
std::int64_t step_of(const Trace& trace, const std::string& at, const std::string& option = "--at",
                     const Lesson* lesson = nullptr);

/// Before any work: throws what show() would throw for want of a display or a folder.
void check_can_show(const ShowOptions& options);

/// The same for a command that opens the viewer only with --view, and reads these files: without it, throws for options
/// of the viewer.
void check_view(bool view, const ShowOptions& options, const std::vector<std::string>& inputs);
/// A person before a window ends what takes too long.
inline Cost cost_of(bool view, const ShowOptions& options) {
  return view && options.opens_window() ? Cost::free : Cost::limited;
}

/// The commands that need no display, for those who have none.
std::string without_display();

}  // namespace zstep::cli
