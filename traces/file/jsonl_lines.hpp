// The lines of a file of JSON Lines, and those that a torn one ends with.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <istream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "traces/file/json_text.hpp"

namespace zstep {

/// The header line holds the scene. A parsed line takes up to thirty times its length in memory, more when it is nested
/// without end, so both are bounded: what comes from others may be made to fill the machine.
inline constexpr std::size_t line_limit = std::size_t{24} << 20;

inline constexpr std::size_t most_faults = 10;  ///< that are reported of one file
/// That are passed over of a run that is judged: it takes long to say of a line why it cannot be read.
inline constexpr std::size_t most_passed_over = 100'000;

/// A file's lines, of at most line_limit + 1 characters each: what comes from others may have no line end at all.
class TextLines {
 public:
  explicit TextLines(std::istream& in) : in_(in) {}
  bool next(std::string& line) {
    line.clear();
    for (;;) {
      if (at_ == end_ && !fill()) return !line.empty();
      const char* from = block_.data() + at_;
      const std::size_t room = std::min(end_ - at_, line_limit + 1 - line.size());
      const void* const found = std::memchr(from, '\n', room);
      const std::size_t length = found ? static_cast<std::size_t>(static_cast<const char*>(found) - from) : room;
      line.append(from, length);
      at_ += length + (found != nullptr);
      if (found || line.size() > line_limit) return true;
    }
  }

 private:
  bool fill() {
    at_ = 0;
    end_ = static_cast<std::size_t>(
        std::max<std::streamsize>(0, in_.rdbuf()->sgetn(block_.data(), static_cast<std::streamsize>(block_.size()))));
    return end_ > 0;
  }
  std::istream& in_;
  std::vector<char> block_ = std::vector<char>(std::size_t{1} << 18);
  std::size_t at_ = 0, end_ = 0;
};

/// What a file ends with when the program that wrote it crashed: no whole object from some line on.
class TornTail {
 public:
  struct Line {
    std::int64_t number;
    std::string text;
    json_text::Fault fault;
  };
  void add(std::int64_t line, std::string_view text, const json_text::Fault& fault) {
    if (count_++ == 0) line_ = line;
    last_line_ = line;
    if (first_.size() < most_faults) first_.push_back({line, std::string(text.substr(0, kept)), fault});
    last_ = json_text::shown(text, 80);
  }
  bool empty() const { return count_ == 0; }
  std::int64_t line() const { return line_; }
  std::int64_t last_line() const { return last_line_; }
  /// "Traceback (most recent call last):", …, "ZeroDivisionError: division by zero"
  std::string quoted() const {
    std::string text = fmt::format("\u201c{}\u201d", json_text::shown(first_.front().text, 80));
    if (count_ == 3) text += fmt::format(", \u201c{}\u201d", json_text::shown(first_[1].text, 80));
    if (count_ > 3) text += ", \u2026";
    if (count_ > 1) text += fmt::format(", \u201c{}\u201d", last_);
    return text;
  }
  /// Its first lines, when more came that was whole: they are mistakes then.
  std::vector<Line> give_up() {
    count_ = 0;
    return std::exchange(first_, {});
  }

 private:
  static constexpr std::size_t kept = 4096;
  std::int64_t line_ = 0, last_line_ = 0, count_ = 0;
  std::vector<Line> first_;
  std::string last_;
};

}  // namespace zstep
