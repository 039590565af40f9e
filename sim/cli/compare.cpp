#include "sim/cli/compare.hpp"

#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "sim/cli/chart_file.hpp"
#include "sim/cli/messages.hpp"
#include "sim/cli/words.hpp"
#include "sim/image/file.hpp"
#include "traces/error.hpp"
#if ZSTEP_HAS_VIEWER
#include "sim/viewer/charts/chart.hpp"
#endif

namespace zstep::cli {
namespace {

[[maybe_unused]] constexpr double no_mark = std::numeric_limits<double>::quiet_NaN();

}  // namespace

std::string bytes_text(std::int64_t bytes) {
  if (bytes < 0) return "?";
  const double kib = static_cast<double>(bytes) / 1024;
  return kib < 1024 ? three_digits(kib) + " KiB" : three_digits(kib / 1024) + " MiB";
}

std::vector<std::string> parts_of(const std::string& text, char between) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == between) parts.emplace_back();
    else parts.back() += c;
  }
  return parts;
}

std::vector<std::string> compare_outputs(const CompareOptions& options) {
  std::vector<std::string> files = chart_outputs(options.plot);
  if (!options.csv.empty()) files.insert(files.begin(), options.csv);
  return files;
}

void write_comparison(const CompareOptions& options, const std::string& csv, const std::function<Drawing()>& chart) {
  if (!options.csv.empty()) {
    write_file(options.csv, std::vector<std::uint8_t>(csv.begin(), csv.end()));
    say_written(options.csv, "the numbers");
  }
  if (!options.plot.empty()) say_written(options.plot, write_chart(options.plot, chart()));
}

#if ZSTEP_HAS_VIEWER
Drawing chart_of(const Scene& scene, const std::vector<compare::Compared>& methods, double limit) {
  DotChart chart;
  chart.title = fmt::format("{}: {}, {} x {} pixels", scene.name,
                            counted(static_cast<std::int64_t>(scene.polygons.size()), "polygon", "polygons"),
                            scene.raster.width, scene.raster.height);
  chart.subtitle = fmt::format(
      "Time: of the processor, median of runs without recording. Memory: the most held at once. Pixels: against {}.",
      methods.front().title);
  chart.columns = {{"Time", "milliseconds", {}},
                   {"Memory", "KiB", {}},
                   {"Steps", "that a recording has", {}},
                   {"Pixels", "that differ", {}}};
  for (const compare::Compared& compared : methods) {
    chart.rows.push_back(compared.title);
    const compare::Measured& m = compared.measured;
    const auto put = [&](std::size_t column, double value, const std::string& text, bool warning = false) {
      chart.columns[column].values.push_back({value, text, warning});
    };
    if (!m.done()) {
      put(0, no_mark, m.end == compare::Apart::End::out_of_time ? fmt::format("not within {:g} s", limit) : "failed");
      for (std::size_t column = 1; column < 4; ++column) put(column, no_mark, "");
      continue;
    }
    put(0, m.median_seconds() * 1000, seconds_text(m.median_seconds()));
    put(1, m.heap < 0 ? no_mark : static_cast<double>(m.heap) / 1024, bytes_text(m.heap));
    put(2, static_cast<double>(m.steps()), grouped(m.steps()));
    const compare::Agreement& a = compared.agreement;
    const std::int64_t differ = a.differing();
    if (!compared.comparable) put(3, no_mark, "not compared");
    else if (a.unexplained > 0)
      put(3, static_cast<double>(differ),
          (a.unexplained < differ ? grouped(differ) + ", " : "") + grouped(a.unexplained) + " wrong", true);
    else if (a.colors > 0)
      put(3, static_cast<double>(differ),
          (a.colors < differ ? grouped(differ) + ", " : "") + grouped(a.colors) + " in colour", compared.wrong());
    else put(3, static_cast<double>(differ), differ == 0 ? "0" : grouped(differ) + ", explained");
  }
  return draw_chart(chart);
}
#else
Drawing chart_of(const Scene&, const std::vector<compare::Compared>&, double) { return {}; }
#endif

}  // namespace zstep::cli
