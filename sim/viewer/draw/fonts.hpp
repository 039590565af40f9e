// Typefaces: a system font found at run time, Dear ImGui's built-in one only as the last resort.
#pragma once

#include <string>
#include <vector>

#include <imgui.h>

namespace zstep::viewer {

struct Fonts {
  ImFont* text = nullptr;  ///< body
  ImFont* bold = nullptr;
  ImFont* heading = nullptr;   ///< of a lesson's stop
  ImFont* variable = nullptr;  ///< the letters of a formula
  ImFont* mono = nullptr;      ///< code and numbers: all digits as wide
  ImFont* small = nullptr;     ///< monospaced, for cells and legends
  std::string lacking;         ///< one sentence when something was not found, else empty

  /// Builds ImGui's atlas with body text of this many pixels. Looks for fonts in $ZSTEP_FONTS only, when that is set.
  void load(float pixels);

  /// The text as it can be drawn: characters the fonts lack are replaced by ASCII ("−" by "-", "∞" by "inf").
  std::string drawable(const std::string& text) const;

 private:
  std::vector<std::pair<std::string, std::string>> replace_;
};

}  // namespace zstep::viewer
