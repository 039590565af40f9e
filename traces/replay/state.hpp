// The state of a run at one position, rebuilt from its trace alone: the structures that methods live by, the stores,
// and where vertices are.
#pragma once

#include <cstdint>
#include <optional>
#include <tuple>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "traces/events/vocabulary.hpp"
#include "traces/formulas/samples.hpp"
#include "traces/replay/shared_chunks.hpp"
#include "traces/scene.hpp"

namespace zstep {

// The structures that methods live by, as a replay rebuilds them: what the viewer's panes are drawn from.

/// A facet, or what cutting left of one; a row of the polygon table.
struct Piece {
  std::int32_t polygon = -1, parent = -1;
  std::vector<std::int32_t> outline;  ///< indices into State::vertices
  std::optional<PlaneEquation> plane;
  std::int64_t plane_step = 0;  ///< that found it
  std::optional<Extent> extent;
  bool cut = false;  ///< pieces of it replace it
  auto members() const { return std::tie(polygon, parent, outline, plane, plane_step, extent, cut); }
};

/// An entry of depth sort's list.
struct ListEntry {
  std::int32_t piece = -1;
  bool marked = false;
  auto members() const { return std::tie(piece, marked); }
};

/// A node of a BSP tree.
struct TreeNode {
  std::int32_t parent = -1, front_child = -1, back_child = -1;
  std::vector<std::int32_t> pieces;  ///< the first one's plane divides space here
  std::optional<EyeSide> eye;
  bool front_skipped = false, back_skipped = false;
  auto members() const { return std::tie(parent, front_child, back_child, pieces, eye, front_skipped, back_skipped); }
};

/// The scan-line method along its line.
struct Sweep {
  std::vector<std::int32_t> inside;  ///< pieces whose flag is true, in the order in which they became so
  std::optional<FlagFlip> flip;      ///< the last one
  std::optional<SpanFlags> interval;
  std::vector<ImpliedEdge> implied;  ///< on this line
  std::vector<SpanWinner> winners;   ///< on this line, left to right
  std::vector<CoverageAdd> covered;  ///< of the pixel at work
  auto members() const { return std::tie(inside, flip, interval, implied, winners, covered); }
};

/// An area of Warnock's.
struct AreaRow {
  AreaBegin entry{};
  std::optional<AreaDecide> decided;
  auto members() const { return std::tie(entry, decided); }
};

/// A box around facets or around other boxes.
struct BoxRow {
  BoxMake entry{};
  std::vector<std::int32_t> facets;
  auto members() const { return std::tie(entry, facets); }
};

struct RayRow {
  RayBegin entry{};
  std::optional<RayEnd> end;
  auto members() const { return std::tie(entry, end); }
};

/// The rays of one pixel: the one from the eye and all that come of it.
struct RayWork {
  std::vector<RayRow> tree;            ///< in the order in which they were cast
  std::optional<std::int32_t> ray;     ///< number of the one at work
  std::vector<BoxTest> boxes;          ///< of the ray cast last
  std::vector<CellVisit> cells;        ///< of the ray cast last
  std::vector<RayHit> hits;            ///< of the ray cast last
  std::optional<RayPlane> plane_test;  ///< the last one
  std::int64_t planes_tested = 0;      ///< of the ray cast last
  auto members() const { return std::tie(tree, ray, boxes, cells, hits, plane_test, planes_tested); }
};

/// A curve on a column, and the horizons there before it moved them; NaN while these are not known.
struct HorizonPassage {
  HorizonTest test;
  double upper = 0, lower = 0;
  auto members() const { return std::tie(test, upper, lower); }
};

/// The floating horizons; an entry is NaN while nothing was drawn in its column.
struct HorizonWork {
  std::vector<double> upper, lower;  ///< rows, by column
  std::optional<CurveBegin> curve;
  std::optional<CurveSegment> segment;
  std::optional<HorizonTest> test;
  std::optional<HorizonCross> cross;
  std::optional<HorizonPassage> before, here;  ///< of the curve at work, on the last two columns that it came to
  auto members() const { return std::tie(upper, lower, curve, segment, test, cross, before, here); }
};

/// An edge of the mesh as a line of the picture.
struct LineRow {
  LineBegin entry{};
  std::vector<LineHide> hidden;
  std::vector<LinePiece> pieces;
  auto members() const { return std::tie(entry, hidden, pieces); }
};

/// The triangle at work, as three half-planes.
struct TriangleWork {
  std::optional<TriangleSetup> setup;
  std::vector<EdgeFunction> edges;  ///< at most three
  std::optional<TileTest> tile;
  std::optional<TileDepthTest> tile_depth;
  std::optional<InsideTest> test;             ///< of the pixel at work
  std::optional<BarycentricWeights> weights;  ///< likewise
  std::optional<SampleTest> sample;           ///< the last one of that pixel
  formulas::SampleRow before;                 ///< what a sample showed before it was compared last
  std::optional<SampleMask> mask;             ///< of that pixel
  auto members() const { return std::tie(setup, edges, tile, tile_depth, test, weights, sample, before, mask); }
  /// Another pixel, or a tile of them, is at work.
  void leave_pixel() { test.reset(), weights.reset(), sample.reset(), before = {}, mask.reset(); }
};

/// How far a vertex has come on its way to the raster. The world coordinates of the scene's points are the scene's.
struct VertexStages {
  enum Stage : std::uint8_t { untouched = 0, viewed = 1, projected = 2, on_raster = 3 };
  Stage stage = untouched;
  glm::dvec3 view{0};    ///< (x_v, y_v, z_v)
  glm::dvec3 plane{0};   ///< (x_p, y_p, z): on the projection plane, with the depth that is interpolated
  glm::dvec2 raster{0};  ///< (x_s, y_s)
  glm::dvec3 world{0};   ///< of vertices that cutting in the world made; 0 for all others
  auto members() const { return std::tie(stage, view, plane, raster, world); }
};

/// Where an edge of the edge table has got to.
enum class EdgeStage : std::uint8_t { waiting, active, retired };

/// The stages of all entries, four in a byte.
class EdgeStages {
 public:
  std::size_t size() const { return size_; }
  EdgeStage operator[](std::size_t edge) const {
    return static_cast<EdgeStage>(words_[edge / in_word] >> shift(edge) & mask);
  }
  void set(std::size_t edge, EdgeStage stage) {
    std::uint64_t& word = words_.edit(edge / in_word);
    word = (word & ~(mask << shift(edge))) | static_cast<std::uint64_t>(stage) << shift(edge);
  }
  void push_back(EdgeStage stage) {
    if (size_ % in_word == 0) words_.push_back(0);
    set(size_++, stage);
  }
  void clear() { words_.clear(), size_ = 0; }
  auto members() const { return std::tie(size_, words_); }

 private:
  static constexpr std::size_t in_word = 32;
  static constexpr std::uint64_t mask = 3;
  static unsigned shift(std::size_t edge) { return static_cast<unsigned>(edge % in_word) * 2; }

  std::size_t size_ = 0;
  SharedChunks<std::uint64_t> words_;
};

/// An entry of the active edge list: its x and depth on the current scan line.
struct ActiveEdge {
  std::int32_t edge = 0;  ///< index into State::edge_table
  double x = 0, z = 0;
  auto members() const { return std::tie(edge, x, z); }
};

/// The pixel at work.
struct Fragment {
  std::int32_t x = 0, y = 0;
  double z = 0;                              ///< the polygon's depth there
  double stored = 0;                         ///< the depth buffer's before this fragment
  std::int32_t stored_polygon = no_polygon;  ///< the frame's before this fragment
  std::uint32_t stored_ink = no_ink;         ///< and the colour of the pixel's own, if the frame held one
  std::optional<bool> nearer;                ///< the compare's outcome, once it was made
  auto members() const { return std::tie(x, y, z, stored, stored_polygon, stored_ink, nearer); }
};

/// What a method has at hand: everything a pane shows besides buffers and vertices.
struct MethodState {
  // One polygon, or one piece, at work.
  std::int32_t polygon = no_polygon, facet = -1, piece = -1;
  std::optional<FacingTest> facing;  ///< of that facet, once tested
  std::optional<ClipTest> clip_test;
  std::optional<Reject> rejected;
  std::vector<std::int32_t> outline;  ///< its vertices as drawn (indices into vertices)
  // What changes often stands apart from what does not, so that copies share the most.
  SharedChunks<EdgeTableInsert> edge_table;  ///< by edge number; buckets by first_row
  EdgeStages edge_stages;                    ///< likewise by number
  std::vector<ActiveEdge> active;            ///< left to right
  std::size_t looked_up = 0;  ///< a place in it, from which the next edge is looked for: no part of the state
  std::optional<std::int32_t> scan_line;
  std::optional<PlaneSlopes> slopes;  ///< of the polygon's plane, where depths go by it
  std::optional<SpanBegin> span;
  TriangleWork triangle;
  std::int32_t width = 0, samples_a_pixel = 0;           ///< of the raster: no part of the state
  SharedChunks<formulas::SampleRow> samples;             ///< by pixel, and in it by number; it grows as they are kept
  SharedChunks<std::vector<formulas::PixelMask>> masks;  ///< by pixel, likewise
  std::optional<Fragment> fragment;
  std::optional<AttributeInterpolate> attribute;  ///< the last one of the polygon at work
  std::int32_t component = 0;                     ///< which number of its pixel that is
  std::array<double, 3> components{};             ///< those of the pixel so far

  // The whole run.
  bool keeps_all = false;       ///< edges, vertices and pieces of all polygons are kept (tables_begin)
  bool compares_write = false;  ///< a compare that finds its depth nearer writes it, as the run has no steps for that
  bool edges_told = true;       ///< else the run has no edge table, and its spans and flags may speak of any edges
  bool enters_told = true;      ///< else the run does not say which edges are active
  bool polygons_told = true;    ///< else the run does not always say when work on a polygon or a piece begins
  bool rays_told = true;        ///< else the run does not say which rays it casts, and may end any
  Pass pass = Pass::eye;
  SharedChunks<Piece> pieces;
  SharedChunks<std::int32_t> drawn;               ///< pieces, in the order in which they were drawn
  SharedList<ListEntry, &ListEntry::piece> list;  ///< depth sort's, from the front
  std::optional<PairBegin> pair;                  ///< under test
  SharedChunks<TreeNode> tree;                    ///< node 0 is the root
  std::int32_t node = -1;                         ///< at work
  Sweep sweep;                                    ///< along the scan line
  SharedChunks<AreaRow> areas;                    ///< by number
  std::int32_t area = -1;                         ///< at work
  std::vector<AreaBin> bins;                      ///< of that area
  SharedChunks<BoxRow> boxes;                     ///< by number
  std::optional<GridMake> grid;
  SharedChunks<CellHold> cells;  ///< what the grid's cells hold
  RayWork rays;
  HorizonWork horizon;
  SharedChunks<LineRow> lines;               ///< by number
  std::int32_t line = -1;                    ///< at work
  std::optional<LineAgainst> against;        ///< the face that line was last held against
  std::optional<ShadowCompare> shadow;       ///< the last one
  std::optional<ShadowBias> shadow_bias;     ///< the last one
  SharedChunks<ShadowNeighbour> neighbours;  ///< of that compare
  std::optional<LightShare> light_share;     ///< the last one
  ByEnum<Coherence, std::int64_t> saved{};   ///< tests, by coherence

  std::size_t pixel(std::int32_t x, std::int32_t y) const { return pixel_at(x, y, width); }
  /// What a sample shows; where it lies nowhere it shows nothing.
  formulas::SampleRow sample(std::int32_t x, std::int32_t y, std::int32_t number) const {
    const std::size_t at = pixel(x, y) * static_cast<std::size_t>(samples_a_pixel) + static_cast<std::size_t>(number);
    return number >= 0 && number < samples_a_pixel && at < samples.size() ? samples[at] : formulas::SampleRow{};
  }

  auto members() const {
    return std::tie(polygon, facet, piece, facing, clip_test, rejected, outline, edge_table, edge_stages, active,
                    scan_line, slopes, span, triangle, samples, masks, fragment, attribute, component, components,
                    keeps_all, compares_write, edges_told, enters_told, polygons_told, rays_told, pass, pieces, drawn,
                    list, pair, tree, node, sweep, areas, area, bins, boxes, grid, cells, rays, horizon, lines, line,
                    against, shadow, shadow_bias, neighbours, light_share, saved);
  }
};

/// Which number of the pixel's attribute the next one there is: those of a pixel come one after the other.
inline std::int32_t next_component(const MethodState& machine, std::int32_t x, std::int32_t y) {
  const bool same = machine.attribute && machine.attribute->x == x && machine.attribute->y == y;
  return same && machine.component + 1 < std::ssize(machine.components) ? machine.component + 1 : 0;
}

/// By piece: it was the n-th to be drawn, from 0; -1 where it was not drawn yet.
std::vector<std::int32_t> draw_places(const MethodState& machine);

struct State {
  std::int64_t position = 0;
  MethodState machine;
  Picture picture;  ///< frame (polygon indices, colours of their own where the method writes such) and depth
  Picture light;    ///< what the light sees; without pixels where the method makes no such pass
  SharedChunks<VertexStages> vertices;  ///< scene points first, then the vertices that clipping and cutting made

  /// The buffers that the pass at work writes to.
  Picture& picture_of_pass() { return machine.pass == Pass::light ? light : picture; }
  const Picture& picture_of_pass() const { return machine.pass == Pass::light ? light : picture; }
  bool operator==(const State&) const;  ///< to the bit
};

// Where the vertices of a state are.

/// On the raster, and how deep; whether it came through a camera or was given in screen coordinates.
struct OnRaster {
  double x = 0, y = 0, z = 0;
};
inline std::optional<OnRaster> on_raster(const Scene& scene, const State& state, std::int32_t vertex) {
  const std::size_t at = vertex;
  if (vertex < 0) return std::nullopt;
  if (scene.camera.kind == Camera::Kind::screen && at < scene.points.size())
    return OnRaster{scene.points[at].x, scene.points[at].y, scene.points[at].z};
  if (at >= state.vertices.size() || state.vertices[at].stage < VertexStages::on_raster) return std::nullopt;
  const VertexStages& stages = state.vertices[at];
  return OnRaster{stages.raster.x, stages.raster.y, stages.plane.z};
}

/// Are pieces cut in the world, as those of a tree are, and not on the raster with its depth?
inline bool cuts_in_world(const Scene& scene, const MethodState& method) {
  return !method.tree.empty() && scene.camera.kind != Camera::Kind::screen;
}
/// In the space in which pieces are cut.
inline std::optional<glm::dvec3> cutting_point(const Scene& scene, const State& state, std::int32_t vertex) {
  const std::size_t at = vertex;
  if (vertex >= 0 && cuts_in_world(scene, state.machine)) {
    if (at < scene.points.size()) return scene.points[at];
    return at < state.vertices.size() ? std::optional(state.vertices[at].world) : std::nullopt;
  }
  const auto found = on_raster(scene, state, vertex);
  return found ? std::optional(glm::dvec3(found->x, found->y, found->z)) : std::nullopt;
}

}  // namespace zstep
