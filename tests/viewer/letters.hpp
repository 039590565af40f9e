// The letters of a frame, read from what Dear ImGui was told to draw, and what makes them hard to read.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <imgui.h>

#include "sim/viewer/app.hpp"

namespace zstep::test {

struct Letter {
  ImVec2 first, last;  ///< corners of its ink, in pixels
  ImVec4 clip;         ///< left, top, right, bottom: what is seen of it
  ImU32 color;
  ImVec2 glyph;  ///< where it stands in the atlas: the same for the same letter of the same type
  float size;    ///< of its type, in pixels
  bool bold;
  std::size_t word;           ///< which of Letters::words it belongs to
  bool half_covered = false;  ///< what lies over it says nothing of its contrast
  bool rim = false;           ///< it is drawn around another one in another colour, which it sets off
};

/// What is drawn of letters in the last frame; those that something drawn later covers are left out.
struct Letters {
  std::vector<Letter> all;
  std::vector<std::string> words;    ///< letters drawn one after the other on a line, for messages
  std::vector<std::string> covered;  ///< words of which a part lies under something drawn later
};
Letters letters_of(const viewer::Fonts& fonts);
/// How often these words alone are written in the frame that is drawn now.
int times_written(viewer::App& app, const std::string& what);
/// Of a canvas that is seen in it, the upper left corner on the screen.
std::optional<ImVec2> corner_of(ImTextureID image);

/// Each of these says of which word, and what: nothing where all is well.
std::vector<std::string> cut_at_the_side(const Letters& drawn);
std::vector<std::string> over_each_other(const Letters& drawn);
std::vector<std::string> smaller_than(const Letters& drawn, float pixels);
/// Less than 4.5 to 1 against what lies behind, or 3 to 1 for large type (24 pixels, or 18.7 bold), by WCAG 2's
/// measure. Draws the frame anew without its letters.
std::vector<std::string> faint(viewer::App& app, const Letters& drawn);

}  // namespace zstep::test
