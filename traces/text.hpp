// Text from outside, as it may be shown: in a terminal, a window, a file's name.
#pragma once

#include <string>
#include <string_view>

namespace zstep {

/// The same text with every character escaped that would not show itself but do something: controls (\n, \t, \x1b,
/// \u0085), marks that turn the direction of writing (\u202e), and bytes that are no UTF-8 (\xff). What stays is one
/// line that is what it seems to be.
std::string printable(std::string_view text);
/// The same line by line: line ends, and tabs, stay.
std::string printable_lines(std::string_view text);
/// The same for JSON that was written already: \u007f, \u0085, \u202e, so that it is read back as it was. Such
/// characters can only be in its texts; its line ends stay.
std::string printable_json(std::string_view json);

struct Header;
struct Scene;
/// Every text in them: whatever comes from a file passes here before it is shown, asked for or written to another.
void make_printable(Header& header);
void make_printable(Scene& scene);

}  // namespace zstep
