// What a person types to name a place in a trace: G in the viewer and --at on the command line read it alike.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sim/classroom/lesson.hpp"
#include "sim/places/bookmarks.hpp"
#include "traces/replay/replay.hpp"

namespace zstep::places {

/// Where that is.
struct Place {
  std::int64_t step = 0;                ///< as typed: it may be beyond the end
  Unit unit = Unit::event;              ///< what one goes to the beginning of
  std::optional<Trace::Pixel> pixel{};  ///< to be selected; the step is then where one is
  std::optional<int> stop{};            ///< of the lesson, where it was named
  std::string note{};                   ///< what a reader should know besides, or nothing
};

/// Where one is when one types.
struct Here {
  const Trace& trace;
  const Bookmarks& marks;
  const Lesson* lesson = nullptr;  ///< resolved; nullptr where there is none
  std::int64_t step = 0;
};

/// "12041", "12 041", "1,000", "+5", "25 %", "p 3", "polygon B", "B", "line 17", "stop 3", "9, 17", "pixel 9 17", a
/// bookmark's name, "end". Everything has to be understood: of "1e5" and "12.5" no digits are picked. Throws
/// InputError, which names what is written most like it.
Place find_place(const Here& here, const std::string& text, const std::string& option);

/// What may be typed, in one sentence.
extern const char* const what_to_type;

}  // namespace zstep::places
