// Depth sort: the list of polygons is put into an order in which each may be drawn over those before it.
//
// M. E. Newell, R. G. Newell and T. L. Sancha, "A Solution to the Hidden Surface Problem", Proceedings of the ACM
// National Conference 1972; as taught in 002, "Depth Sort Algorithm"; Foley, van Dam, Feiner and Hughes, "Computer
// Graphics: Principles and Practice", 1990, section 15.5.1. In raster space with pseudodepth, the viewport's side of a
// plane is where z is smaller (003).
//
// Departures from the page, each because the page alone would not be exact or not end:
// - P is compared with every Q that does not lie wholly before it in z, also with one that lies wholly behind it: once
//   a polygon has been moved to the front of the list, such a Q may stand after it.
// - Pieces in one plane: the later one in the file goes first, so that the earlier is seen, as with the Z-buffer. "On
//   the plane" passes tests 3 and 4 in that order only.
// - When a marked Q would have to be moved again, P and Q stand in a ring with those between them in the list. Nearly
//   always P or Q crosses the other's plane and is split. Where neither does, another pair of the ring is split. There
//   is one: if no piece of the ring crossed the plane of another, a BSP tree of them would order them without a cut,
//   and there would be no ring.
// - When a piece of a ring is split, those that were moved for its sake go back to their places, unmarked.
//
// Why it ends. Between two splits a piece is moved at most once, as it is marked; so after finitely many moves a piece
// is drawn or split. Parts keep the plane of the facet they come from, so there are as many planes as facets. A split
// needs corners further than the tolerance (tolerance_for) on both sides of the plane; the new corners lie in that
// plane but for rounding, which is hundreds of times smaller. Corners of polygons from files lie off their own plane by
// what was rounded there, so a facet's corners must lie that much further off (Piece::bend): else its parts would seem
// to cross each other, and be taken for others that are in the way. So no descendant is cut by the same plane again: a
// facet is cut by each plane once at most along each line of descent, and the number of splits is finite. Where
// rounding leaves a pair that neither order nor split can mend, P is drawn first.
#pragma once

#include <cstdint>
#include <vector>

#include "algorithms/pieces/pieces.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

// The steps of depth sort.

#define ZSTEP_MODULE depth_sort
#define ZSTEP_FIRST_STEP 64
#define ZSTEP_STEPS "algorithms/depth_sort/steps.def"
#include "traces/record/declare_steps.hpp"

namespace zstep::depth_sort {

/// Draws the scene's facets, cut where they must be, back to front. Whatever is drawn later is nearer wherever two
/// overlap, or equally near and earlier in the file.
template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record);

// The list of pieces still to be drawn, the farthest first.

/// Does `a` come before `b` by its farthest z? Of equal ones the later in the file comes first: it is drawn first, so
/// that the earlier one is seen, as with the Z-buffer.
bool farther(const pieces::Pieces& all, std::int32_t a, std::int32_t b);

/// Numbers of pieces in the order in which they are to be drawn. The first `moved` were moved there and are marked; the
/// others are sorted.
struct DrawingList {
  std::vector<std::int32_t> pieces;
  std::size_t moved = 0;

  /// The place among the sorted ones where a piece belongs.
  std::int32_t place_for(const pieces::Pieces& all, std::int32_t piece) const;
  void insert(std::int32_t piece, std::int32_t place);
  void remove(std::size_t place);
  /// Makes an unmarked piece the first, and marks it.
  void move_to_front(std::size_t place);
};

}  // namespace zstep::depth_sort
