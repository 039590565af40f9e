// Pages of HTML that hold all they need: they open from disk, and nothing is fetched from anywhere.
#pragma once

#include <string>
#include <string_view>

#include "sim/image/png.hpp"

namespace zstep {

/// Everything up to the page's first heading. `title` is any text.
std::string page_begin(std::string_view title);
inline constexpr std::string_view page_end = "</main></body></html>\n";

/// A text from outside as it stands in a page: nothing in it acts, neither as markup nor as a control character.
std::string shown(std::string_view text);

/// A picture with its caption; small ones are shown with large pixels. `alternative` says the same in words.
std::string figure(const Image& image, std::string_view caption, std::string_view alternative);

}  // namespace zstep
