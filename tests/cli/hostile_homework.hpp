// A homework, and what is to hold of whatever is handed in.
#pragma once

#include <string>

#include "tests/cli/program.hpp"

namespace zstep::test {

/// Sanitizers have memory of their own, which no limit reaches.
#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool sanitized = true;
#elif defined(__has_feature)
inline constexpr bool sanitized = __has_feature(address_sanitizer);
#else
inline constexpr bool sanitized = false;
#endif

/// The text with a part of it replaced, everywhere; it must be there.
std::string with_changed(std::string text, const std::string& from, const std::string& to);
/// A folder hw with a public and a hidden scene, triangle and overlap, whose programs are `sh program.sh` with small
/// limits; beside it the right runs of these and of crossing.
void hostile_homework(const Folder& folder);
/// One of them, without its header.
std::string right_run(const Folder& folder, const std::string& scene = "triangle");
/// Names and contents of everything in a folder but for runs/.
std::string everything_in(const Folder& folder);
/// Whether a terminal would do something on it.
bool shows_controls(const std::string& text);
/// Grades runs/ in each format within a minute of the processor's time and the memory that docs/homework.md allows a
/// small submission; checks that each result is one, and that they agree. Returns the points.
double grade_in_every_format(const Folder& folder);

}  // namespace zstep::test
