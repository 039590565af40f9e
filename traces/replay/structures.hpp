// The structures that methods live by, as a replay rebuilds them: what the viewer's panes are drawn from.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <tuple>
#include <vector>

#include "traces/events/vocabulary.hpp"
#include "traces/replay/shared_chunks.hpp"

namespace zstep {

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

}  // namespace zstep
