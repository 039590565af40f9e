// The state of a run at one position, rebuilt from its trace alone.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <tuple>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "traces/events/vocabulary.hpp"
#include "traces/replay/shared_chunks.hpp"
#include "traces/replay/shared_list.hpp"
#include "traces/replay/structures.hpp"
#include "traces/scene.hpp"

namespace zstep {

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
  std::optional<Fragment> fragment;
  std::optional<AttributeInterpolate> attribute;  ///< the last one of the polygon at work

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
  SharedChunks<LineRow> lines;                                   ///< by number
  std::int32_t line = -1;                                        ///< at work
  std::optional<LineAgainst> against;                            ///< the face that line was last held against
  std::optional<ShadowCompare> shadow;                           ///< the last one
  std::array<std::int64_t, words_of<Coherence>.size()> saved{};  ///< tests, by coherence

  auto members() const {
    return std::tie(polygon, facet, piece, facing, clip_test, rejected, outline, edge_table, edge_stages, active,
                    scan_line, slopes, span, fragment, attribute, keeps_all, compares_write, edges_told, enters_told,
                    polygons_told, rays_told, pass, pieces, drawn, list, pair, tree, node, sweep, areas, area, bins,
                    boxes, grid, cells, rays, horizon, lines, line, against, shadow, saved);
  }
};

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

}  // namespace zstep
