// What an expression throws, for checks on the text of errors.
#pragma once

#include <string>

#include "traces/error.hpp"

namespace zstep::test {

/// The message of the InputError that `call` throws; "no error" if it throws none.
template <class Call>
std::string input_error(Call&& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace zstep::test
