#include "sim/cost/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <fmt/format.h>

#include "algorithms/scene/load.hpp"
#include "algorithms/scene/mesh.hpp"
#include "sim/truth/explain_difference.hpp"
#include "traces/error.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/scene.hpp"
#include "traces/text.hpp"

namespace zstep::compare {

Entrant read_entrant(const std::string& text, const std::string& who) {
  Entrant entrant{nullptr, {}, text, ""};
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(':', at), text.size());
    const std::string part = text.substr(at, end - at);
    at = end + 1;
    if (entrant.method) {
      entrant.changes.push_back(read_change(part, who + " " + text + ":"));
      entrant.title += fmt::format(", {} = {}", entrant.changes.back().name, entrant.changes.back().value);
      continue;
    }
    std::string ids;
    for (const Method& method : methods()) {
      if (method.id == part) entrant.method = &method, entrant.title = method.title;
      ids += (ids.empty() ? "" : ", ") + std::string(method.id);
    }
    if (!entrant.method)
      throw InputError(fmt::format("{} {}", who, text), fmt::format("there is no method '{}'", part),
                       fmt::format("give one of {}, or one with a change, as bsp:root=random", ids));
  }
  return entrant;
}

namespace {

/// A convention's key or word as a trace's header has it.
std::string with_underscores(std::string text) {
  std::replace(text.begin(), text.end(), '-', '_');
  return text;
}

Conventions with(Conventions conventions, const Method& method, const std::string& name, const std::string& word) {
  const auto is_it = [&](const Option& option) { return option.name == name; };
  if (std::any_of(method.options.begin(), method.options.end(), is_it)) conventions.options[name] = word;
  else ConventionChoices{{{with_underscores(name), with_underscores(word)}}}.apply(conventions);
  return conventions;
}

}  // namespace

std::vector<Entrant> all_entrants(const Scene& scene, const Conventions& conventions) {
  std::vector<Entrant> all;
  for (const Method& method : methods()) {
    const Conventions its = conventions_for(method, conventions);
    if (!can_draw(method, scene, its)) continue;
    all.push_back(read_entrant(std::string(method.id)));
    for (const Changeable& what : changeables(method, scene, its)) {
      if (what.name == "cull") continue;
      for (const std::string& word : what.choices)
        if (word != what.value && can_draw(method, scene, with(its, method, what.name, word)))
          all.push_back(read_entrant(fmt::format("{}:{}={}", method.id, what.name, word)));
    }
  }
  return all;
}

Agreement agreement(const Scene& scene, const Conventions& conventions, const Picture& first, const Picture& other) {
  const Verdict verdict = explain_difference(scene, conventions, first, other);
  Agreement result;
  result.pixels = std::ssize(first.polygon);
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

namespace {

// The mean area of a triangle whose corners are drawn evenly from a square of side 1.
constexpr double mean_triangle = 11.0 / 144;

struct Numbers {
  std::mt19937_64 engine;
  double between(double low, double high) { return low + (high - low) * static_cast<double>(engine() >> 11) * 0x1p-53; }
  glm::dvec3 in_box(double half) {
    const double x = between(-half, half), y = between(-half, half);
    return {x, y, between(-half, half)};
  }
};

}  // namespace

Scene random_scene(int triangles, double layers, std::int32_t side, unsigned seed) {
  constexpr double window = 2;  // its side: the box spans -1 … 1
  const double square = std::sqrt(layers * window * window / (triangles * mean_triangle));

  Scene scene;
  scene.name = "random-" + std::to_string(triangles);
  scene.source = "random";
  Numbers random{std::mt19937_64(seed)};
  for (std::int32_t polygon = 0; polygon < triangles; ++polygon) {
    const auto first = size32(scene.points);
    const glm::dvec3 centre = random.in_box(1);
    for (std::int32_t corner = 0; corner < 3; ++corner) {
      scene.points.push_back(centre + random.in_box(square / 2));
      scene.corners.push_back(first + corner);
    }
    scene.polygons.push_back({"", scene::palette[static_cast<std::size_t>(polygon) % scene::palette.size()], 0});
    scene.facets.push_back({polygon, first, 3});
  }
  // From above, so that x and y of the box are those of the picture.
  ViewOptions view;
  view.rho = 10, view.theta = -90, view.phi = 0;
  view.window = window / 2, view.orthographic = true;
  view.width = view.height = side;
  return look_at_scene(std::move(scene), view);
}

double growth_exponent(double n_0, double cost_0, double n_1, double cost_1) {
  return portable::log(cost_1 / cost_0) / portable::log(n_1 / n_0);
}

}  // namespace zstep::compare
