// Tables for a terminal: columns as wide as what stands in them.
#pragma once

#include <string>
#include <vector>

namespace zstep::cli {

class Table {
 public:
  enum class Align : unsigned char { left, right };

  explicit Table(std::vector<Align> columns) : columns_(std::move(columns)) {}
  void row(std::vector<std::string> cells);
  /// The rows, `indent` spaces before each, two between columns, none at the end of a line.
  std::string text(std::size_t indent = 2) const;

 private:
  std::vector<Align> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace zstep::cli
