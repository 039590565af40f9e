// A lesson's file: its TOML head, and its stops.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "sim/classroom/lesson.hpp"

namespace zstep::classroom {

/// Fills what the head says: title, summary, theme, scene, method, view and conventions. `line` is the line at which
/// `head` begins in the file. Throws InputError with FILE:LINE for bad TOML, unknown keys and impossible values.
void read_lesson_head(Lesson& lesson, const std::string& file, std::string_view head, std::int32_t line);

}  // namespace zstep::classroom
