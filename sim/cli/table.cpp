
#include "sim/cli/table.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fmt/format.h>

#include "traces/image/file.hpp"
#include "traces/error.hpp"
#include "traces/text.hpp"

namespace zstep::cli {
namespace {

/// Characters, not bytes: the continuation bytes of UTF-8 take no room.
std::size_t width_of(const std::string& text) {
  return text.size() - std::count_if(text.begin(), text.end(), continues_character);
}

}  // namespace

void Table::row(std::vector<std::string> cells) {
  cells.resize(columns_.size());
  for (std::string& cell : cells) cell = printable(cell);
  rows_.push_back(std::move(cells));
}

std::string Table::text(std::size_t indent) const {
  std::vector<std::size_t> widths(columns_.size(), 0);
  for (const auto& row : rows_)
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], width_of(row[k]));
  std::string text;
  for (const auto& row : rows_) {
    std::string line(indent, ' ');
    for (std::size_t k = 0; k < row.size(); ++k) {
      const std::string padding(widths[k] - width_of(row[k]), ' ');
      line += columns_[k] == Align::right ? padding + row[k] : row[k] + padding;
      if (k + 1 < row.size()) line += "  ";
    }
    while (!line.empty() && line.back() == ' ') line.pop_back();
    text += line + '\n';
  }
  return text;
}

std::vector<std::string> chart_outputs(const std::string& plot) {
  if (plot.empty()) return {};
#if !ZSTEP_HAS_VIEWER
  throw InputError("--plot", "this zstep was built without the viewer, which draws charts",
                   "leave it out, or build again with -DZSTEP_VIEWER=ON");
#endif
  return {plot};
}

std::string write_chart(const std::string& plot, const Drawing& drawing) {
  if (std::filesystem::path(plot).extension() == ".svg")
    write_file(plot, std::vector<std::uint8_t>(drawing.svg.begin(), drawing.svg.end()));
  else write_png(plot, drawing.width, drawing.height, drawing.rgb);
  return fmt::format("the chart, {}x{} pixels", drawing.width, drawing.height);
}

}  // namespace zstep::cli
