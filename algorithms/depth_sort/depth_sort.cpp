
#include "algorithms/depth_sort/depth_sort.hpp"

#include <algorithm>

#include "algorithms/depth_sort/pair_tests.hpp"
#include "traces/record/all_recorders.hpp"
#include "traces/scene.hpp"

namespace zstep::depth_sort {

namespace {

template <Recorder R>
struct DepthSort {
  pieces::Pieces all;
  double tolerance;
  DrawingList list;
  R& record;

  // Of two pieces in one plane, is `a` to be drawn first?
  bool later_in_file(std::int32_t a, std::int32_t b) const { return all[a].polygon >= all[b].polygon; }
  bool is_behind(const SideTest& test) const {
    return test.side == Side::behind || (test.side == Side::on && later_in_file(test.piece, test.plane_of));
  }
  bool is_before(const SideTest& test) const {
    return test.side == Side::front || (test.side == Side::on && later_in_file(test.plane_of, test.piece));
  }

  // May P be drawn before Q? The first test that says so settles it (002).
  bool passes_a_test(std::int32_t p, std::int32_t q) {
    const ExtentTest x = extent_test(all, p, q, Axis::x);
    record(step::test_1, x);
    if (!x.overlap) return true;

    const ExtentTest y = extent_test(all, p, q, Axis::y);
    record(step::test_2, y);
    if (!y.overlap) return true;

    const SideTest p_to_q = side_test(all, p, q, tolerance);
    record(step::test_3, p_to_q);
    if (is_behind(p_to_q)) return true;

    const SideTest q_to_p = side_test(all, q, p, tolerance);
    record(step::test_4, q_to_p);
    if (is_before(q_to_p)) return true;

    const OverlapTest projections = overlap_test(all, p, q);
    record(step::test_5, projections);
    return !projections.overlap;
  }

  // May Q be drawn before P? Tests 1, 2 and 5 are the same for both.
  bool passes_swapped(std::int32_t p, std::int32_t q) {
    const SideTest q_to_p = side_test(all, q, p, tolerance);
    record(step::test_3_swapped, q_to_p);
    if (is_behind(q_to_p)) return true;

    const SideTest p_to_q = side_test(all, p, q, tolerance);
    record(step::test_4_swapped, p_to_q);
    return is_before(p_to_q);
  }

  void move_to_front(std::size_t place) {
    const std::int32_t q = list.pieces[place];
    record(step::take_out, ListRemove{q});
    list.move_to_front(place);
    record(step::move, ListInsert{q, 0});
    record(step::mark, ListMark{q});
  }

  void take_back(std::int32_t piece) {
    const std::int32_t place = list.place_for(all, piece);
    list.insert(piece, place);
    record(step::insert_part, ListInsert{piece, place});
  }

  // Cuts the piece at a place of the list by the plane of the one at another, if it crosses that plane.
  bool split(std::size_t place, std::size_t other) {
    const std::int32_t whole = list.pieces[place], plane_of = list.pieces[other];
    const SideTest test = side_test(all, whole, plane_of, tolerance);
    if (test.side != Side::crossing) return false;
    record(step::split, test);

    const pieces::Plane plane = all[plane_of].plane;
    const pieces::Parts parts = pieces::cut(all, whole, plane, tolerance, record);
    const std::vector<std::int32_t> gone(list.pieces.begin(), list.pieces.begin() + place);
    for (std::size_t i = 0; i <= place; ++i) {
      record(step::remove, ListRemove{list.pieces.front()});
      list.remove(0);
    }
    for (const std::int32_t piece : gone) take_back(piece);  // moved for the sake of the whole
    take_back(parts.positive);
    take_back(parts.negative);
    return true;
  }

  // P is the first of the list and can neither come before the piece at `place` nor after it.
  bool split_ring(std::size_t place) {
    if (split(0, place) || split(place, 0)) return true;
    for (std::size_t i = 0; i <= place; ++i) {
      for (std::size_t j = 0; j <= place; ++j) {
        if (split(i, j)) return true;
      }
    }
    return false;
  }

  // Is P, the first of the list, to be drawn now? If not, there is another P.
  bool first_is_next() {
    const std::int32_t p = list.pieces.front();
    for (std::size_t place = 1; place < list.pieces.size(); ++place) {
      const std::int32_t q = list.pieces[place];
      const bool marked = place < list.moved;
      record(step::pair, PairBegin{p, q});

      if (all[q].high.z < all[p].low.z) {
        record(step::z_extents, extent_test(all, p, q, Axis::z));
        if (marked) continue;
        return true;  // the list is sorted from here on
      }
      if (passes_a_test(p, q)) continue;

      if (!marked && passes_swapped(p, q)) {
        move_to_front(place);
        return false;
      }
      if (split_ring(place)) return false;
    }
    return true;
  }
};

}  // namespace

template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record) {
  Picture picture(scene.raster.width, scene.raster.height);
  record(step::clear, BuffersClear{no_depth});

  pieces::Pieces all = pieces::gather(scene, conventions, record);
  const double tolerance = tolerance_for(all);
  DepthSort<R> sort{std::move(all), tolerance, {}, record};
  for (std::int32_t piece = 0; piece < size32(sort.all.pieces); ++piece) {
    const std::int32_t place = sort.list.place_for(sort.all, piece);
    sort.list.insert(piece, place);
    record(step::insert, ListInsert{piece, place});
  }

  while (!sort.list.pieces.empty()) {
    if (!sort.first_is_next()) continue;
    const std::int32_t p = sort.list.pieces.front(), polygon = sort.all[p].polygon;
    record(step::draw, PieceDraw{p, polygon});
    pieces::paint(sort.all, sort.all[p].outline, polygon, scene, picture, record);
    record(step::drawn, ListRemove{p});
    sort.list.remove(0);
  }
  return picture;
}

#define INSTANTIATE(R) template Picture run<R>(const Scene&, const Conventions&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

namespace {

std::ptrdiff_t offset(std::size_t place) { return static_cast<std::ptrdiff_t>(place); }

}  // namespace

bool farther(const pieces::Pieces& all, std::int32_t a, std::int32_t b) {
  const pieces::Piece &one = all[a], &other = all[b];
  if (one.high.z != other.high.z) return one.high.z > other.high.z;
  return one.polygon != other.polygon ? one.polygon > other.polygon : a > b;
}

std::int32_t DrawingList::place_for(const pieces::Pieces& all, std::int32_t piece) const {
  const auto place = std::lower_bound(pieces.begin() + offset(moved), pieces.end(), piece,
                                      [&](std::int32_t a, std::int32_t b) { return farther(all, a, b); });
  return static_cast<std::int32_t>(place - pieces.begin());
}

void DrawingList::insert(std::int32_t piece, std::int32_t place) { pieces.insert(pieces.begin() + place, piece); }

void DrawingList::remove(std::size_t place) {
  pieces.erase(pieces.begin() + offset(place));
  if (place < moved) --moved;
}

void DrawingList::move_to_front(std::size_t place) {
  std::rotate(pieces.begin(), pieces.begin() + offset(place), pieces.begin() + offset(place) + 1);
  ++moved;
}

}  // namespace zstep::depth_sort
