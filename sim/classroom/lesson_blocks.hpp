// The blocks of a stop between `::: question`, `::: task`, `::: mark` or `::: notes` and `:::`.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sim/classroom/lesson.hpp"

namespace zstep::classroom {

struct Line {
  std::string_view text;
  std::int32_t number = 0;  ///< in the file, from 1
};

/// A lesson's file, and the line that is being read.
struct Lines {
  std::string file;
  std::vector<Line> all;
  std::size_t at = 0;

  std::string_view text() const { return all[at].text; }
  std::int32_t number() const { return all[at].number; }
  std::string where(std::size_t line) const { return file + ":" + std::to_string(all[line].number); }
  /// Throws InputError about the line that is being read.
  [[noreturn]] void fail(std::string_view what, std::string_view mend) const;
};

/// Reads the block that opens at the line into the stop, and ends at the line that closes it. Throws InputError.
void read_block(Lines& lines, Stop& stop);

bool starts_with(std::string_view text, std::string_view start);
/// Adds a line, with its end.
void append_line(std::string& text, std::string_view line);
/// Without blank lines around it; `line` follows its first one.
std::string strip_lines(const std::string& text, std::int32_t& line);

}  // namespace zstep::classroom
