// What the window is asked to do.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "algorithms/catalog/changes.hpp"
#include "sim/viewer/viewer.hpp"

namespace zstep::viewer {

/// Whoever owns the window takes the requests and clears them.
struct WindowRequests {
  bool quit = false, toggle_full_screen = false;
  bool leave_page = false;                  ///< that it is embedded in: to a window with everything
  bool toggle_notes = false;                ///< the speaker's, in a window of their own
  bool choose_file = false;                 ///< by the desktop's own dialogue
  bool save_progress = false;               ///< and settings and bookmarks, as one file
  bool check = false;                       ///< whether each step follows from its own operands
  std::optional<std::string> compare_with;  ///< the run of a file, or of what can be opened; empty: zstep's own
  bool marks_kept = false;                  ///< other bookmarks are in their file than before
  std::optional<std::string> clipboard;
  std::optional<std::string> save_picture;  ///< path
  int switch_method = 0;                    ///< 1 or -1: to another method on the same scene
  std::optional<Offer> open;
  bool for_class = false;       ///< and that in presenter mode, a lesson from its first stop on
  std::vector<Change> changes;  ///< of the run, one after the other
  bool change_goes_on = false;  ///< it takes the place of the one before, which a hand has not let go
  bool end_run = false;         ///< the one that is made while the window goes on
  int back_to_lesson = 0;       ///< from a run in its place: to its next stop (1), or the previous one (-1)
  int undo_change = 0;          ///< 1, or -1: make what was undone again

  /// Whether what was asked for may show something else: the next key is meant for that, and waits for it.
  bool may_show_other() const {
    return check || compare_with || switch_method != 0 || open || !changes.empty() || end_run || undo_change != 0 ||
           back_to_lesson != 0;
  }
};

}  // namespace zstep::viewer
