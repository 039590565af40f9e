// The one error that a user's input can cause.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace zstep {

/// Bad input. what() is one line: WHERE: what is wrong; how to mend it. Commands print it and exit with code 2.
class InputError : public std::runtime_error {
 public:
  InputError(std::string_view where, std::string_view what, std::string_view mend)
      : std::runtime_error(std::string(where) + ": " + std::string(what) + "; " + std::string(mend)) {}
};

}  // namespace zstep
