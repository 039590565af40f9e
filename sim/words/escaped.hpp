// Text as others take it: a link or the name of a file, a shell, HTML and XML.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace zstep {

/// Letters and digits of ASCII and these signs stay as they are; each other byte becomes %XX.
std::string percent_encoded(std::string_view text, std::string_view signs);

// Text as a shell takes it.

/// As one word of a shell: in single quotes, if it needs them.
std::string shell_word(const std::string& text);

/// A command line of zstep's with these words, as a person types it: "./zstep lesson z-buffer" where the launcher was
/// typed (ZSTEP_CALLED).
std::string as_command(std::span<const std::string> words);

/// A text as it stands in HTML or XML, in an element or in an attribute between double quotes.
std::string markup(std::string_view text);

}  // namespace zstep
