// What stands on a strip of the timeline beside its sections: bookmarks, stops, causes, where the reader is, words.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sim/viewer/panes/strip.hpp"
#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

/// What stands on a strip and is gone to by a click: a bookmark, or a stop of the lesson.
struct Sign {
  std::int64_t step = 0;
  int stop = -1;  ///< −1: a bookmark
  std::string help;
};

/// The one under the mouse; of several the nearest, of those a cause, then a bookmark.
std::optional<Sign> sign_under(const Ui& ui, const Strip& strip, bool with_stops);

/// Above the strip, clear of its words: bookmarks, and what playing repeats.
void draw_places(Ui& ui, const Strip& strip);
/// Steps that follow from a cause, or that part from the other run's, and the causes.
void draw_step_marks(Ui& ui, const Strip& strip);
/// Where the reader is: a line and, as its second sign, an arrow head from below.
void draw_place(Ui& ui, const Strip& strip);

/// Words of a strip: over all its shapes, and beside the mark of where the reader is.
class StripWords {
 public:
  StripWords(const Ui& ui, const Strip& strip);
  ~StripWords();
  StripWords(const StripWords&) = delete;
  StripWords& operator=(const StripWords&) = delete;

  /// At x, or else near it between these ends; left out where there is no room.
  void write(float x, float low, float high, ImU32 color, const std::string& text);
  void write_first(ImU32 color, const std::string& text);
  void write_between(float low, float high, ImU32 color, const std::string& text);

 private:
  const Ui& ui_;
  Strip strip_;
  ImDrawList* list_;
};

}  // namespace zstep::viewer
