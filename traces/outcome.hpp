// More of errors: several in one file; and what is not the input's fault: what the machine does not have, and what was
// not done to its end.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "traces/error.hpp"
#include "traces/text.hpp"

namespace zstep {

/// There is no more memory or room on the disk. Commands print it and exit with code 4.
class Exhausted : public InputError {
 public:
  using InputError::InputError;
};

/// A part is missing: of the file, or of the work, which came to the end of its budget. What was printed is right. Exit
/// code 3.
class Incomplete : public InputError {
 public:
  using InputError::InputError;
};

/// Several mistakes of one file: each a line of what(), as it may be shown.
class InputErrors : public InputError {
 public:
  explicit InputErrors(std::vector<std::string> lines) : InputError(printable_each(std::move(lines))) {}

 private:
  static std::vector<std::string> printable_each(std::vector<std::string> lines) {
    for (std::string& line : lines) line = printable(line);
    return lines;
  }
};

}  // namespace zstep
