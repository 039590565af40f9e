// Runs of wireframe and of hidden lines, with their lines and pieces at hand.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <vector>

#include "algorithms/hidden_line/hidden_line.hpp"
#include "algorithms/hidden_line/wireframe.hpp"
#include "traces/record/recorder.hpp"

namespace zstep::test {

struct Run {
  Picture picture;
  CollectRecorder record;
  std::map<std::int32_t, LineBegin> lines;
  std::map<std::int32_t, std::vector<LinePiece>> pieces;

  int pieces_of(bool visible) const {
    int count = 0;
    for (const auto& [line, parts] : pieces)
      count += static_cast<int>(
          std::count_if(parts.begin(), parts.end(), [&](const LinePiece& p) { return p.visible == visible; }));
    return count;
  }
  int lines_of(LineKind kind) const {
    return static_cast<int>(
        std::count_if(lines.begin(), lines.end(), [&](const auto& l) { return l.second.kind == kind; }));
  }
  int inked() const {
    return static_cast<int>(
        std::count_if(picture.ink.begin(), picture.ink.end(), [](std::uint32_t ink) { return ink != no_ink; }));
  }
};

template <class Method>
Run run_with(Method method, const Scene& scene, const Conventions& conventions) {
  Run run;
  run.picture = method(scene, conventions, run.record);
  for (const LineBegin& line : run.record.all<LineBegin>()) run.lines[line.line] = line;
  for (const LinePiece& piece : run.record.all<LinePiece>()) run.pieces[piece.line].push_back(piece);
  return run;
}

inline Run hide(const Scene& scene, bool cull = true, const char* hidden = "none") {
  Conventions conventions;
  conventions.cull = cull;
  conventions.options["hidden"] = hidden;
  return run_with(hidden_line::run<CollectRecorder>, scene, conventions);
}

inline Run wires(const Scene& scene, const char* edges = "all") {
  Conventions conventions;
  conventions.options["edges"] = edges;
  return run_with(wireframe::run<CollectRecorder>, scene, conventions);
}

inline Scene seen(const char* name, const ViewOptions& view = {}) {
  return look_at_scene(load_scene(name).scene, view);
}

// The pieces of each edge follow each other from end to end, hidden and visible by turns.
inline void check_sums(const Run& run) {
  CHECK(run.pieces.size() == run.lines.size());
  for (const auto& row : run.pieces) {
    const std::int32_t line = row.first;
    const std::vector<LinePiece>& parts = row.second;
    CAPTURE(line);
    double sum = 0;
    REQUIRE(parts.front().t_0 == 0);
    REQUIRE(parts.back().t_1 == 1);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      REQUIRE(parts[i].t_0 < parts[i].t_1);
      if (i > 0) REQUIRE(parts[i].t_0 == parts[i - 1].t_1);
      if (i > 0) REQUIRE(parts[i].visible != parts[i - 1].visible);
      sum += parts[i].t_1 - parts[i].t_0;
    }
    REQUIRE(sum == doctest::Approx(1).epsilon(1e-14));
  }
}

}  // namespace zstep::test
