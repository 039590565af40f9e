// A line of JSON Lines as programs mostly write it: one object, the step first, each field of its event once, nothing
// else. Such lines are read by simdjson, ten times as fast as by a parser that can say what is wrong with one.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "traces/file/trace.hpp"
#include "traces/record/step.hpp"

namespace zstep {

class QuickLine {
 public:
  explicit QuickLine(const Page& page);
  ~QuickLine();

  /// False where the line is anything else: then it has to be looked at more closely. May lengthen the text's storage,
  /// not the text.
  bool read(std::string& line, RecordedEvent& event);

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
  std::map<std::string, const StepInfo*, std::less<>> steps_;  ///< by name, and by module and name
};

}  // namespace zstep
