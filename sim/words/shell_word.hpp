// Text as a shell takes it.
#pragma once

#include <string>

namespace zstep {

/// As one word of a shell: in single quotes, if it needs them.
std::string shell_word(const std::string& text);

}  // namespace zstep
