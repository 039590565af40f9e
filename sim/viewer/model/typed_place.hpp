// What "go to" makes of what is typed, before the trace is asked whether it has such a place.
#pragma once

#include <cstdint>
#include <string>

namespace zstep::viewer {

struct TypedPlace {
  enum class Kind : std::uint8_t { none, step, percent, polygon, scan_line, pixel };
  Kind kind = Kind::none;  ///< none: it is nothing of this; a bookmark may be called so
  std::int64_t number = 0;  ///< of the step, the polygon or the scan line; the pixel's column
  std::int64_t row = 0;     ///< of the pixel
  double percent = 0;       ///< 0 to 100
  bool operator==(const TypedPlace&) const = default;
};

/// "12041", "12 041", "25 %", "p 3", "polygon 3", "line 17", "y 17", "9, 17". Everything has to be understood: of "1e5", "12.5" and
/// "-5" no digits are picked.
TypedPlace read_place(const std::string& text);

/// What may be typed, in one sentence.
extern const char* const what_to_type;

}  // namespace zstep::viewer
