// Where words are seen in the window, read out of what it was told to draw.
#pragma once

#include <string>
#include <vector>

#include <imgui.h>

#include "sim/viewer/app.hpp"

namespace zstep::test {

struct SeenWords {
  float x, y;   ///< of the middle of what was looked for
  float end_x;  ///< of the middle of its last letter
};

/// Each place where a text is seen, from the first drawn to the last; where some stand for themselves, only those.
std::vector<SeenWords> find_words(viewer::App& app, const std::string& text);

}  // namespace zstep::test
