#include "sim/cli/chart_file.hpp"

#include <cstdint>
#include <filesystem>

#include <fmt/format.h>

#include "sim/image/file.hpp"
#include "traces/error.hpp"

namespace zstep::cli {

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
