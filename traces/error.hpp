// The one error that a user's input can cause.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

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

}  // namespace zstep
