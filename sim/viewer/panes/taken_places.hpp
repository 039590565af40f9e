// Which places of a picture words and marks stand on already, so that none is written over another.
#pragma once

#include <algorithm>
#include <vector>

#include <imgui.h>

namespace zstep::viewer {

class TakenPlaces {
 public:
  void take(ImVec2 at, ImVec2 size) { boxes_.push_back({at.x, at.y, at.x + size.x, at.y + size.y}); }
  bool free(ImVec2 at, ImVec2 size) const {
    return std::none_of(boxes_.begin(), boxes_.end(), [&](const ImVec4& box) {
      return at.x < box.z && box.x < at.x + size.x && at.y < box.w && box.y < at.y + size.y;
    });
  }

 private:
  std::vector<ImVec4> boxes_;  ///< left, top, right, bottom
};

}  // namespace zstep::viewer
