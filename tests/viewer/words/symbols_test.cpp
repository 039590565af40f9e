// The symbols of printed formulas: with what each name stands for in the scene and the state, taken from there and not
// from the line itself, a formula gives the number that it ends in.
#include <algorithm>
#include <map>
#include <string>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "sim/words/explain.hpp"
#include "tests/golden/golden.hpp"
#include "tests/viewer/words/printed.hpp"
#include "traces/formulas/walk.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;
using namespace zstep::test;

namespace {

using Meanings = std::map<std::string, double>;

void add_span(Meanings& means, const SpanBegin& span) {
  means["x_L"] = span.x_left, means["x_R"] = span.x_right;
  for (const char* depth : {"z", "z*", "z_v", "1/z_v"})
    means[std::string(depth) + "_L"] = span.z_left, means[std::string(depth) + "_R"] = span.z_right;
  means["dz/dx"] = span.dz_dx;
}

/// "x_0", "y_0", "z_0" of a vertex; false where it is not on the raster.
bool add_vertex(Meanings& means, const formulas::Situation& at, std::int32_t vertex, const std::string& end) {
  const auto p = at.on_raster(vertex);
  if (!p) return false;
  means["x_" + end] = p->x, means["y_" + end] = p->y, means["z_" + end] = p->z;
  return true;
}

/// What names stand for in the formulas of this event.
struct MeaningsOf {
  const formulas::Situation& at;
  const State& state;
  Meanings means{};

  void operator()(const SpanBegin& e) { add_span(means, e); }
  void operator()(const DepthInterpolate& e) { pixel(e.x, e.y); }
  void operator()(const PixelPaint& e) { pixel(e.x, e.y); }
  void operator()(const EdgeTableInsert& e) {
    if (!add_vertex(means, at, e.vertex_0, "0") || !add_vertex(means, at, e.vertex_1, "1")) means.clear();
    means["y"] = e.first_row, means["1/m"] = e.dx_dy;
  }
  void operator()(const PlaneDepth& e) {
    const Piece* piece = at.piece(e.piece);
    if (!piece || !piece->plane) return;
    means = {{"A", piece->plane->plane_a},
             {"B", piece->plane->plane_b},
             {"C", piece->plane->plane_c},
             {"D", piece->plane->plane_d},
             {"x", e.x_at},
             {"y", e.y_at}};
  }
  void operator()(const VertexSide& e) {
    const Piece* piece = at.piece(e.plane_of);
    if (!piece || !piece->plane) return;
    means = {{"A", piece->plane->plane_a},
             {"B", piece->plane->plane_b},
             {"C", piece->plane->plane_c},
             {"D", piece->plane->plane_d}};
    const auto vertex = static_cast<std::size_t>(e.vertex);
    if (at.on_screen()) return;
    const glm::dvec3 p = vertex < at.scene.points.size() ? at.scene.points[vertex] : state.vertices[vertex].world;
    means["x_w"] = p.x, means["y_w"] = p.y, means["z_w"] = p.z;
  }
  void operator()(const EyeSide& e) {
    const Piece* piece = at.piece(at.method().tree[static_cast<std::size_t>(e.node)].pieces.front());
    if (!piece || !piece->plane || at.on_screen()) return;
    const glm::dvec3 eye = at.camera->eye;
    means = {{"A", piece->plane->plane_a},
             {"B", piece->plane->plane_b},
             {"C", piece->plane->plane_c},
             {"D", piece->plane->plane_d},
             {"x_w", eye.x},
             {"y_w", eye.y},
             {"z_w", eye.z},
             {"w", at.camera->kind == Camera::Kind::perspective ? 1 : 0}};
  }
  void operator()(const LineCross& e) {
    const LineBegin& line = state.machine.lines[static_cast<std::size_t>(e.line)].entry;
    add_vertex(means, at, line.vertex_0, "0"), add_vertex(means, at, line.vertex_1, "1");
    means["t"] = e.t;
  }
  template <class E>
  void operator()(const E&) {}

 private:
  void pixel(std::int32_t x, std::int32_t y) {
    if (state.machine.span && state.machine.span->y == y) add_span(means, *state.machine.span);
    means["x"] = x, means["y"] = y;
  }
};

/// A formula with a number for each name; what has other names is no expression of numbers then.
std::string filled_in(const std::string& symbols, const Meanings& means) {
  const auto part_of_name = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '*' || c == '\'';
  };
  std::string text;
  for (std::size_t at = 0; at < symbols.size();) {
    std::string name;
    if (at == 0 || !part_of_name(symbols[at - 1]))
      for (const auto& [one, value] : means) {
        const std::size_t end = at + one.size();
        if (symbols.compare(at, one.size(), one) == 0 && (end == symbols.size() || !part_of_name(symbols[end])) &&
            one.size() > name.size())
          name = one;
      }
    if (name.empty()) {
      text += symbols[at++];
      continue;
    }
    std::string number = fmt::format("{:.12f}", means.at(name));
    if (number.front() == '-') number.replace(0, 1, "\u2212");
    text += "(" + number + ")";
    at += name.size();
  }
  return text;
}

bool holds(const std::string& symbols, const Meanings& means, const std::string& result) {
  const auto formula = read(filled_in(symbols, means)), number = read(result);
  if (!formula || !number) return true;
  constexpr double rounding = 1e-6;  // of differences that are divided
  return formula->value.low <= number->value.high + rounding && number->value.low <= formula->value.high + rounding;
}

}  // namespace

TEST_CASE("law: the symbols of a printed formula stand for what the scene and the state have under these names") {
  std::map<std::string, int> evaluated;
  for_each_golden([&](const std::string& name, const Trace& trace) {
    CAPTURE(name);
    // What is added to, or rounded, has another value by the time that it is told.
    const Conventions& c = trace.header().conventions;
    if (bits_of(c.number_format) > 0 || c.number_format == NumberFormat::float32) return;
    if (c.depth == Conventions::Depth::corrected) return;
    Replay replay(trace);
    while (replay.position() < trace.size()) {
      replay.step_forward();
      const RecordedEvent recorded = *replay.current();
      const formulas::Situation at = formulas::situation_of(trace, replay.state());
      MeaningsOf meanings{at, replay.state()};
      visit_event([&](const auto& e) { meanings(e); }, recorded.event);
      if (meanings.means.empty()) continue;
      const auto step = replay.position();
      CAPTURE(step);
      const std::string kind(visit_event(
          [](const auto& known) { return description_of<std::decay_t<decltype(known)>>.name; }, recorded.event));
      for (const std::string& line : explain(trace, replay.state(), recorded).formulas) {
        const std::vector<std::string> sides = parts(line, " = ");
        if (sides.size() < 3) continue;
        CAPTURE(line);
        if (!read(filled_in(sides[1], meanings.means))) continue;
        REQUIRE(holds(sides[1], meanings.means, sides.back()));
        ++evaluated[kind];
      }
    }
  });
  for (const char* kind : {"span_begin", "depth_interpolate", "pixel_paint", "edge_table_insert", "plane_depth",
                           "vertex_side", "eye_side", "line_cross"}) {
    CAPTURE(kind);
    CHECK(evaluated[kind] > 0);
  }
}

TEST_CASE("law: t = 0 and t = 1 are where the edge's vertices are, and x_L, x_R and the depths there are the span's") {
  int lines = 0, spans = 0;
  for_each_golden([&](const std::string& name, const Trace& trace) {
    CAPTURE(name);
    Replay replay(trace);
    while (replay.position() < trace.size()) {
      replay.step_forward();
      const auto* begin = get_if<LineBegin>(&replay.current()->event);
      const auto* span = get_if<SpanBegin>(&replay.current()->event);
      if (!begin && !span) continue;
      const auto step = replay.position();
      CAPTURE(step);
      const Explanation told = explain(trace, replay.state(), *replay.current());
      // The numbers of a line that follow its names, in order.
      const auto are = [](const std::string& line, std::initializer_list<std::pair<std::string, double>> named) {
        std::size_t from = 0;
        for (const auto& [name_of_it, value] : named) {
          from = line.find(name_of_it, from);
          if (from == std::string::npos) return false;
          from += name_of_it.size();
          const auto all = numbers_in(line.substr(from));
          if (all.empty() || all[0].first != 0 || !shown_as(value, line.substr(from, all[0].second))) return false;
        }
        return true;
      };
      const std::string z = depth_symbol(trace.scene(), trace.header().conventions);
      if (begin) {
        const formulas::Situation at = formulas::situation_of(trace, replay.state());
        const auto a = at.on_raster(begin->vertex_0), b = at.on_raster(begin->vertex_1);
        if (!a || !b) continue;
        REQUIRE(told.formulas.size() == 2);
        CHECK(are(told.formulas[0], {{"t = 0 at (", a->x}, {", ", a->y}, {z + " = ", a->z}}));
        CHECK(are(told.formulas[1], {{"t = 1 at (", b->x}, {", ", b->y}, {z + " = ", b->z}}));
        ++lines;
      } else {
        const std::string along = symbol_along(trace.scene(), trace.header().conventions);
        CAPTURE(told.formulas[0]);
        CHECK(are(told.formulas[0], {{"x_L = ", span->x_left},
                                     {"x_R = ", span->x_right},
                                     {along + "_L = ", span->z_left},
                                     {along + "_R = ", span->z_right}}));
        ++spans;
      }
    }
  });
  CHECK(lines > 0);
  CHECK(spans > 100);
}
