// The window with what it shows, turn by turn: events in, a frame out when something changed.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "sim/viewer/notes.hpp"
#include "sim/viewer/settings.hpp"
#include "sim/viewer/stage.hpp"
#include "sim/viewer/system.hpp"
#include "sim/viewer/viewer.hpp"
#include "sim/viewer/window.hpp"

namespace zstep::viewer {

class Loop {
 public:
  /// Opens the window. The trace and what the options point to must live as long; `options.kept` is kept. Throws
  /// InputError where no window can be opened, or the trace has no such place.
  Loop(const Trace& trace, ViewerOptions options);
  /// Saves what stays from run to run.
  ~Loop();
  Loop(const Loop&) = delete;
  Loop& operator=(const Loop&) = delete;

  /// Whether a turn waits for the next event or the next thing to move.
  enum class May { wait, go_on };
  /// Takes events and draws, if something changed. False once the window is to be closed.
  bool turn(May may);
  /// Seconds until there is something to do, if no event comes; as of the last turn.
  double rests_for() const { return frames_due_ > 0 ? 0 : rests_for_; }

  /// Goes to the place that a link names in what is shown. False where the link opens something else, or its place
  /// cannot be gone to.
  bool go_to_link(const std::string& link);
  void save_now() { save(true); }
  /// Does what the command of this id does; nothing where there is none.
  void run(std::string_view command);

 private:
  void serve();
  void save(bool at_end);
  void save_progress();
  void tell_place();
  void say_place();
  void tell_typing();

  const ViewerOptions options_;
  const Settings stored_;  ///< what was saved,
  const Settings begun_;   ///< and what options make of it for this run
  Settings saved_;
  Window window_;
  Stage stage_;
  NotesWindow notes_{window_};
  std::string told_;  ///< where the reader is, as a link or else a command line, as last said
  std::int64_t told_stop_ = -1;
  std::uint64_t told_seen_ = 0;
  bool told_by_link_ = false;      ///< there, but nothing was said of it
  std::vector<TableSeen> tables_;  ///< of the last frame, where somebody listens
  std::optional<system::TypedLine> told_line_;
  double rests_for_ = 0;
  int frames_due_ = App::frames_to_settle;  ///< after a change, until nothing moves any more
  std::uint64_t moment_ = 0;                ///< App::moment, as last looked at
  std::uint64_t seen_ = 0;                  ///< the fingerprint of the picture
  const App* drawn_app_ = nullptr;
  bool on_way_ = false;  ///< the title says so
};

}  // namespace zstep::viewer
