// The error that a user's input can cause, several of them in one file, and what is not the input's fault: what the
// machine does not have, and what was not done to its end.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "traces/text.hpp"

namespace zstep {

/// Bad input. what() is one line: WHERE: what is wrong; how to mend it. Commands print it and exit with code 2.
class InputError : public std::runtime_error {
 public:
  InputError(std::string_view where, std::string_view what, std::string_view mend)
      : std::runtime_error(std::string(where) + ": " + std::string(what) + "; " + std::string(mend)) {}
  /// Several mistakes of one file, each a line of what().
  explicit InputError(const std::vector<std::string>& lines) : std::runtime_error(joined(lines)) {}

 private:
  static std::string joined(const std::vector<std::string>& lines) {
    std::string all;
    for (const std::string& line : lines) all += (all.empty() ? "" : "\n") + line;
    return all;
  }
};

// More of errors: several in one file; and what is not the input's fault: what the machine does not have, and what was
// not done to its end.

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
