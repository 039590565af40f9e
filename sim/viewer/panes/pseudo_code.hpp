// Pseudo-code with the line at work, and a block of code or a small table in a pane narrower than its lines.
#pragma once

#include <string>
#include <vector>

namespace zstep::viewer {

struct CodeLine {
  std::string text;
  int indent = 0;          ///< columns
  bool continues = false;  ///< the line before, in the middle of a formula: a sign in front of it says so
  bool operator==(const CodeLine&) const = default;
};

/// In so many columns. A table keeps its columns: each of its rows breaks where all do, and goes on below, indented.
/// Other lines break at spaces, before a sign where they can.
std::vector<CodeLine> code_lines(const std::string& code, int columns);

}  // namespace zstep::viewer
