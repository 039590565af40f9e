// Text where only some letters may stand: in a link, in the name of a file.
#pragma once

#include <string>
#include <string_view>

namespace zstep {

/// Letters and digits of ASCII and these signs stay as they are; each other byte becomes %XX.
std::string percent_encoded(std::string_view text, std::string_view signs);

}  // namespace zstep
