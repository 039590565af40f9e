// Depth sort's list and the pair under test: which of its tests have been made, and how they ended.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

/// The events since the pair was taken up; none when something else has begun since then.
std::optional<std::vector<RecordedEvent>> since_pair(const Session& s);

struct TestLine {
  std::string what, numbers, outcome;
  bool made = false, passed = false, now = false;
  std::optional<answers::Question> question;  ///< what a click on its numbers asks
};

/// The tests as lines of three columns; a small font where they would be too wide.
struct TestTable {
  std::vector<TestLine> lines;
  const ImFont* font = nullptr;
  std::array<float, 3> column{};
  float gap = 0, width = 0, height = 0;
  bool words = true;  ///< what came out is said, and not only marked
};

TestTable lay_out_tests(Ui& ui, const std::vector<RecordedEvent>& made, float room);
void draw_tests(Ui& ui, const PairBegin& pair, const TestTable& table);

}  // namespace zstep::viewer
