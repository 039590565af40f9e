// The hand-out of a homework as a page to print.
#pragma once

#include <string>
#include <string_view>

#include "sim/homework/homework.hpp"

namespace zstep::homework {

/// The Markdown of a hand-out, and after it what the reference draws of each public scene: its picture and its depth
/// buffer.
std::string handout_html(const Homework& homework, std::string_view markdown);

}  // namespace zstep::homework
