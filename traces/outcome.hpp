// Errors that are not the input's fault: what the machine does not have, and what was not done to its end.
#pragma once

#include "traces/error.hpp"

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

}  // namespace zstep
