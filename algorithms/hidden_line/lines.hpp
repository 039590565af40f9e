// The edges of a scene's polygons as lines of the picture: which there are, what meets at them, and how one is drawn.
#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/viewing/vertices.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

// The steps that wireframe and hidden lines share.

#define ZSTEP_MODULE lines
#define ZSTEP_FIRST_STEP 56
#define ZSTEP_STEPS "algorithms/hidden_line/line_steps.def"
#include "traces/record/declare_steps.hpp"

namespace zstep::lines {

struct Edge {
  std::int32_t vertex_0, vertex_1;
  std::int32_t left_facet, right_facet;  ///< -1: none, or one without area
  LineKind kind;
};

/// The edges of all polygons, each once, from the half-edge mesh. The cuts that made facets of a polygon that is not
/// planar are none. Of a screen scene all faces count as facing the eye. `vertices`: the scene's points, viewed.
std::vector<Edge> find_edges(const Scene& scene, const viewing::Vertices& vertices);

/// Cuts an edge to the view volume; new ends are put behind the vertices. False if nothing of it is to be seen: it is
/// out of view, or seen end-on, as a point (below 1e-9 px).
template <Recorder R>
bool bring_into_view(Edge& edge, const Scene& scene, const viewing::Lens& lens, viewing::Vertices& vertices, R& record);

/// A line of the picture, and the colours it is drawn in.
struct Line {
  glm::dvec3 from, to;  ///< (x_s, y_s, depth)
  double length() const;
};
Color visible_ink(const Scene& scene);  ///< black on a bright background, white on a dark one
Color hidden_ink(const Scene& scene);   ///< half-way from it to the background

/// Draws the interval from t_0 to t_1. In each column (in each row, if the line is steep) the one pixel nearest to the
/// whole line, so the pieces of an edge lie on the pixels of the edge; of two equally near the lower or right one. With
/// `dashed` two of four pixels, and none that is drawn on.
template <Recorder R>
void draw(const Line& line, double t_0, double t_1, Color color, bool dashed, Picture& picture, R& record);

}  // namespace zstep::lines
