#include "sim/cost/comparison.hpp"

#include <fmt/format.h>

#include "sim/truth/explain_difference.hpp"
#include "traces/text.hpp"

namespace zstep::compare {

Agreement agreement(const Scene& scene, const Conventions& conventions, const Picture& first, const Picture& other) {
  const Verdict verdict = explain_difference(scene, conventions, first, other);
  Agreement result;
  result.pixels = static_cast<std::int64_t>(first.polygon.size());
  for (std::size_t pixel = 0; pixel < first.polygon.size(); ++pixel)
    result.colors += first.polygon[pixel] == other.polygon[pixel] &&
                     !(color_at(first, scene, pixel) == color_at(other, scene, pixel));
  result.equal = verdict.equal + verdict.empty - result.colors;
  result.at_edges = verdict.at_edges, result.ties = verdict.ties, result.unexplained = verdict.unexplained;
  return result;
}

std::string csv_cell(const std::string& raw) {
  const std::string text = printable(raw);
  if (text.find_first_of(",\"") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_of(const std::string& scene, const std::vector<Compared>& methods) {
  std::string text = "scene,method,measure,step,value\n";
  for (const Compared& compared : methods) {
    const Measured& measured = compared.measured;
    const auto line = [&](std::string_view measure, const auto& value, const std::string& step = "") {
      text += fmt::format("{},{},{},{},{}\n", csv_cell(scene), csv_cell(compared.id), measure, csv_cell(step), value);
    };
    if (!measured.done()) {
      line("end", measured.end == Apart::End::out_of_time ? "out_of_time" : "failed");
      continue;
    }
    if (compared.comparable) {
      const Agreement& a = compared.agreement;
      line("pixels", a.pixels);
      line("equal", a.equal);
      line("differing", a.differing());
      line("at_edges", a.at_edges);
      line("ties", a.ties);
      line("unexplained", a.unexplained);
      line("colors", a.colors);
    }
    line("runs", measured.seconds.size());
    line("time_s", measured.median_seconds());
    if (measured.heap >= 0) line("heap_bytes", measured.heap);
    line("steps", measured.steps());
    for (const StepInfo& step : measured.method->page())
      line("count", measured.count[step.id], step.module + "." + step.name);
  }
  return text;
}

}  // namespace zstep::compare
