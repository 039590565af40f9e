// The line of a JSON Lines file that a step stands at.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "traces/file/input.hpp"
#include "traces/file/lenient.hpp"

namespace zstep {

class FileLines {
 public:
  /// `header`: whether the first object is one, and not a step. What was `passed_over` holds no steps.
  explicit FileLines(const std::string& path, bool header = true, std::vector<PassedOver::Range> passed_over = {});
  /// 0 in a file of another kind. Steps must be asked for in order.
  std::int64_t of(std::int64_t step);

 private:
  void look_at(char c);

  std::optional<InputStream> in_;  ///< none of a file of another kind
  std::vector<PassedOver::Range> passed_over_;
  std::size_t next_ = 0;             ///< of these
  std::int64_t line_ = 0, objects_;  ///< objects: the header, there or not, is one
  int depth_ = 0;
  bool in_text_ = false, escaped_ = false;
};

/// "run.jsonl:12" for step 11, or "run.ztrace, step 11".
std::string place_of_step(const std::string& path, FileLines& lines, std::int64_t step);

}  // namespace zstep
