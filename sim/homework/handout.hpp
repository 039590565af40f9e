// The hand-out of a homework as a page to print.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/homework/homework.hpp"

namespace zstep::homework {

// What hand-outs and starters say of steps, for those steps alone that a homework asks for.

/// A hand-out without its blocks for steps that no program prints. A block stands between the lines
///     <!-- for insert_edge, skip_edge -->
///     <!-- end -->
/// and is for all of these steps, or, by the word `buffers`, for parts of that level; it stays where any of them is
/// asked for. Throws InputError at FILE:LINE where a block is for what the method does not have, or has no end.
std::string handout_asked(const Homework& homework, std::string_view text, const std::string& file);
/// Such a text without the lines that begin and end blocks.
std::string without_block_lines(std::string_view text);

/// A program without the lines of comment that call steps, as emit.span(…), emit_span(…) or Emit.span(…), and none that
/// a program is to print.
std::string starter_asked(const Homework& homework, std::string_view text);

// The files that a hand-out names.

/// Of the files and folders that a page names in its commands and code spans, those that are neither in the homework's
/// folder nor in its starter/, each with its line. Runs and pictures are left out: students make them.
std::vector<std::pair<int, std::string>> missing_in_handout(const std::string& page,
                                                            const std::filesystem::path& folder);

/// The Markdown of a hand-out, and after it what the reference draws of each public scene: its picture and its depth
/// buffer.
std::string handout_html(const Homework& homework, std::string_view markdown);

}  // namespace zstep::homework
