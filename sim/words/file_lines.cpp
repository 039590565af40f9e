#include "sim/words/file_lines.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "traces/text.hpp"

namespace zstep {

FileLines::FileLines(const std::string& path, bool header, std::vector<PassedOver::Range> passed_over)
    : passed_over_(std::move(passed_over)), objects_(header ? 0 : 1) {
  if (std::filesystem::path(path).extension() == ".jsonl") in_.emplace(InputFile(path));
}

std::int64_t FileLines::of(std::int64_t step) {
  std::string text;
  while (in_ && objects_ < step + 1 && std::getline(*in_, text)) {
    ++line_;
    while (next_ < passed_over_.size() && passed_over_[next_].last < line_) ++next_;
    if (next_ < passed_over_.size() && passed_over_[next_].first <= line_) continue;
    for (const char c : text) look_at(c);
  }
  return objects_ >= step + 1 ? line_ : 0;
}

/// An object may stand on several lines.
void FileLines::look_at(char c) {
  if (in_text_) {
    if (c == '"' && !escaped_) in_text_ = false;
    escaped_ = c == '\\' && !escaped_;
  } else if (c == '"') {
    in_text_ = true;
  } else if (c == '{') {
    ++depth_;
  } else if (c == '}') {
    objects_ += --depth_ == 0;
  }
}

std::string place_of_step(const std::string& path, FileLines& lines, std::int64_t step) {
  const std::int64_t line = lines.of(step);
  return line > 0 ? fmt::format("{}:{}", printable(path), line) : fmt::format("{}, step {}", printable(path), step);
}

}  // namespace zstep
