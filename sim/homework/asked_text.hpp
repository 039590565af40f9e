// What hand-outs and starters say of steps, for those steps alone that a homework asks for.
#pragma once

#include <string>
#include <string_view>

#include "sim/homework/homework.hpp"

namespace zstep::homework {

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

}  // namespace zstep::homework
