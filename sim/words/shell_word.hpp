// Text as a shell takes it.
#pragma once

#include <span>
#include <string>

namespace zstep {

/// As one word of a shell: in single quotes, if it needs them.
std::string shell_word(const std::string& text);

/// A command line of zstep's with these words, as a person types it: "./zstep lesson z-buffer" where the launcher was
/// typed (ZSTEP_CALLED).
std::string as_command(std::span<const std::string> words);

}  // namespace zstep
