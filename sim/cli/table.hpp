// Tables for a terminal, with columns as wide as what stands in them, and charts as files.
#pragma once

#include <string>
#include <vector>

#include "traces/image/png.hpp"

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

/// The file that --plot names, if it is given. Throws InputError where this zstep cannot draw charts.
std::vector<std::string> chart_outputs(const std::string& plot);

/// Writes an SVG where the file is called so, else a PNG; what was written, for people.
std::string write_chart(const std::string& plot, const Drawing& drawing);

}  // namespace zstep::cli
