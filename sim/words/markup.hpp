#pragma once

#include <string>
#include <string_view>

namespace zstep {

/// A text as it stands in HTML or XML, in an element or in an attribute between double quotes.
std::string markup(std::string_view text);

}  // namespace zstep
