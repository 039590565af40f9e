// What stands on a strip of the timeline beside its sections: bookmarks, stops, causes, where the reader is, words.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <imgui.h>
#include <optional>
#include <string>

#include "sim/viewer/panes/ui.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {

// A part of the trace laid out from left to right: the place of each step on it, and the step at each place.

struct Strip {
  ImVec2 at;
  float width, height;
  std::int64_t first, last;  ///< positions at its ends
  bool holds(std::int64_t position) const { return position >= first && position <= last; }
  float x(std::int64_t position) const {
    if (last <= first) return at.x;
    return at.x + width * static_cast<float>(ratio(position - first, last - first));
  }
  std::int64_t position(float mouse) const {
    const double share = std::clamp((mouse - at.x) / width, 0.0f, 1.0f);
    return first + std::llround(share * static_cast<double>(last - first));
  }
};

/// What stands on a strip and is gone to by a click: a bookmark, or a stop of the lesson.
struct Sign {
  std::int64_t step = 0;
  int stop = -1;  ///< −1: a bookmark
  std::string help;
};

/// The one under the mouse; of several the nearest, of those a cause, then a bookmark.
std::optional<Sign> sign_under(const Ui& ui, const Strip& strip, bool with_stops);

/// Of a stop's mark, half as high as it is; a lecture hall's strips are hardly higher than their letters.
inline float arm_of_stop(const Ui& ui) { return std::round(ui.presenter ? 0.16f * ui.em : 4 * ui.thin); }

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
