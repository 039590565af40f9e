// The state of a run at one position, rebuilt from its trace alone.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "traces/scene.hpp"
#include "traces/events/vocabulary.hpp"

namespace zstep {

/// How far a vertex has come on its way to the raster. Its world coordinates are the scene's.
struct VertexWay {
  enum Stage : std::uint8_t { untouched = 0, viewed = 1, projected = 2, on_raster = 3 };
  Stage stage = untouched;
  glm::dvec3 view{0};    ///< (x_v, y_v, z_v)
  glm::dvec3 plane{0};   ///< (x_p, y_p, z): on the projection plane, with the depth that is interpolated
  glm::dvec2 raster{0};  ///< (x_s, y_s)
  bool operator==(const VertexWay&) const;  ///< to the bit
};

/// A row of the edge table.
struct EdgeRow {
  enum class Where : std::uint8_t { waiting, active, retired };
  EdgeTableInsert entry{};
  Where where = Where::waiting;
  bool operator==(const EdgeRow&) const;
};

/// An entry of the active edge list: its x and depth on the current scan line.
struct ActiveEdge {
  std::int32_t edge = 0;  ///< index into State::edge_table
  double x = 0, z = 0;
  bool operator==(const ActiveEdge&) const;  ///< to the bit
};

/// The pixel at work.
struct Fragment {
  std::int32_t x = 0, y = 0;
  double z = 0;                              ///< the polygon's depth there
  double stored = 0;                         ///< the depth buffer's before this fragment
  std::int32_t stored_polygon = no_polygon;  ///< the frame's before this fragment
  std::optional<bool> nearer;                ///< the compare's outcome, once it was made
  bool operator==(const Fragment&) const;    ///< to the bit
};

/// What a method has at hand: everything a pane shows besides buffers and vertices.
struct Machine {
  std::int32_t polygon = no_polygon, facet = -1;  ///< at work
  std::optional<FacingTest> facing;               ///< of that facet, once tested
  std::optional<ClipTest> clip_test;
  std::optional<Reject> rejected;
  std::vector<std::int32_t> outline;  ///< its vertices as drawn (indices into vertices)
  std::vector<EdgeRow> edge_table;    ///< by edge number; buckets by entry.first_row
  std::vector<ActiveEdge> active;     ///< left to right
  std::optional<std::int32_t> scan_line;
  std::optional<SpanBegin> span;
  std::optional<Fragment> fragment;
  bool operator==(const Machine&) const;
};

struct State {
  std::int64_t position = 0;
  Machine machine;
  Picture picture;  ///< frame (polygon indices) and depth
  std::vector<VertexWay>
      vertices;  ///< scene points first, then the vertices that clipping made for the current polygon
  bool operator==(const State&) const;
};

}  // namespace zstep
