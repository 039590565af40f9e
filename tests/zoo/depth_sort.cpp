// Depth sort: the farthest polygon first, where five tests allow it; if not, another one before it, or a part of it.
#include "tests/zoo/pieces.hpp"

namespace zoo {
namespace {

struct DepthSorter {
  const Task& task;
  Output out{};
  PieceTable table{task, out};
  std::vector<int> list{};
  std::size_t moved = 0;  // the first of the list, which were moved there and may not be moved again

  bool is(const char* mistake) const { return task.mistake == mistake; }
  int at(std::size_t place) const { return list[place]; }

  bool farther(int a, int b) const {
    double z_a = table[a].high.z, z_b = table[b].high.z;
    if (is("sorted_by_nearest")) z_a = table[a].low.z, z_b = table[b].low.z;
    if (z_a != z_b) return z_a > z_b;
    // Of equal ones the later polygon is drawn first; or the one that comes first in the file, which nobody asked for.
    const auto key = [&](int piece) { return std::pair(table[piece].polygon, piece); };
    return is("ties_unstable") ? key(a) < key(b) : key(a) > key(b);
  }
  void insert(const char* step, int piece) {
    std::size_t place = moved;
    while (place < list.size() && farther(list[place], piece)) ++place;
    out.print(step, "piece", piece, "place", static_cast<int>(place));
    list.insert(list.begin() + static_cast<std::ptrdiff_t>(place), piece);
  }
  void remove(const char* step, std::size_t place) {
    out.print(step, "piece", list[place]);
    list.erase(list.begin() + static_cast<std::ptrdiff_t>(place));
    if (place < moved) --moved;
  }

  bool overlaps(const char* step, int p, int q, const char* axis, double Point::*along) {
    const FlatPiece &one = table[p], &other = table[q];
    const bool overlap = one.low.*along < other.high.*along && other.low.*along < one.high.*along;
    out.print(step, "piece", p, "other", q, "axis", axis, "low", one.low.*along, "high", one.high.*along, "other_low",
              other.low.*along, "other_high", other.high.*along, "overlap", overlap);
    return overlap;
  }

  /// On which side of the other one's plane; the eye is in front, where z is small.
  std::string side(const char* step, int p, int plane_of) {
    double least = INFINITY, greatest = -INFINITY;
    const double turn = table[plane_of].n.z > 0 ? 1 : -1;
    for (const int corner : table[p].corners) {
      const double value = turn * table[plane_of].value(table.point(corner));
      least = std::min(least, value), greatest = std::max(greatest, value);
    }
    const bool before = least<-1e-9, beyond = greatest> 1e-9;
    const std::string found = before && beyond ? "crossing" : before ? "front" : beyond ? "behind" : "on";
    out.print(step, "piece", p, "plane_of", plane_of, "least", least, "greatest", greatest, "side", found.c_str());
    return found;
  }
  bool is_behind(const std::string& side, int p, int q) const {
    return side == "behind" || (side == "on" && table[p].polygon >= table[q].polygon);
  }
  bool is_before(const std::string& side, int p, int q) const {
    return side == "front" || (side == "on" && table[q].polygon >= table[p].polygon);
  }

  /// Do the projections overlap? A point inside both: of the outline of the one, what lies inside the other (both are
  /// convex), and its middle.
  bool projections_overlap(int p, int q) {
    std::vector<Point> shape;
    for (const int corner : table[p].corners) shape.push_back(table.point(corner));
    const FlatPiece& other = table[q];
    for (std::size_t i = 0; i < other.corners.size(); ++i) {
      const Point a = table.corner(other, i), along = table.corner(other, i + 1) - a;
      const double turn = other.n.z > 0 ? 1 : -1;
      const auto inside = [&](Point v) { return turn * (along.x * (v.y - a.y) - along.y * (v.x - a.x)); };
      std::vector<Point> kept;
      for (std::size_t k = 0; k < shape.size(); ++k) {
        const Point here = shape[k], next = shape[(k + 1) % shape.size()];
        const double d_0 = inside(here), d_1 = inside(next);
        if (d_0 >= 0) kept.push_back(here);
        if ((d_0 > 0 && d_1 < 0) || (d_0 < 0 && d_1 > 0)) kept.push_back(here + d_0 / (d_0 - d_1) * (next - here));
      }
      shape = kept;
    }
    double area = 0;
    Point middle{};
    for (std::size_t k = 0; k < shape.size(); ++k) {
      const Point a = shape[k], b = shape[(k + 1) % shape.size()];
      area += (a.x * b.y - b.x * a.y) / 2, middle = middle + 1.0 / static_cast<double>(shape.size()) * a;
    }
    const bool overlap = std::abs(area) > 1e-9;
    out.print("test_5", "piece", p, "other", q, "overlap", overlap, "x_at", overlap ? middle.x : NAN, "y_at",
              overlap ? middle.y : NAN);
    return overlap;
  }

  bool may_come_first(int p, int q) {
    if (!overlaps("test_1", p, q, "x", &Point::x) || !overlaps("test_2", p, q, "y", &Point::y)) return true;
    const std::string third = side("test_3", p, q);
    // Exchanged: P before Q's plane, and Q behind P's plane, are taken for a yes.
    if (is("tests_3_4_swapped") ? is_before(third, p, q) : is_behind(third, p, q)) return true;
    const std::string fourth = side("test_4", q, p);
    if (is("tests_3_4_swapped") ? is_behind(fourth, q, p) : is_before(fourth, q, p)) return true;
    return !projections_overlap(p, q);
  }

  bool split(std::size_t place, std::size_t other) {
    const int whole = at(place);
    const FlatPiece plane = table[at(other)];
    double least = INFINITY, greatest = -INFINITY;
    for (const int corner : table[whole].corners) {
      const double value = plane.value(table.point(corner));
      least = std::min(least, value), greatest = std::max(greatest, value);
    }
    if (!(least < -1e-9 && greatest > 1e-9)) return false;
    side("split", whole, at(other));
    const auto parts = cut_outline(
        table[whole].corners, [&](int corner) { return plane.value(table.point(corner)); },
        [&](int from, int to, double t) {
          const Point point = table.point(from) + t * (table.point(to) - table.point(from));
          const int made = static_cast<int>(table.points.size());
          out.print("cut", "vertex_0", from, "vertex_1", to, "t", t, "vertex", made, "space", "raster", "x_cut",
                    point.x, "y_cut", point.y, "z_cut", point.z);
          table.points.push_back(point);
          return made;
        });
    const std::vector<int> before(list.begin(), list.begin() + static_cast<std::ptrdiff_t>(place));
    std::vector<int> again = before;
    for (const auto& outline : {parts.first, parts.second}) {
      FlatPiece part = table[whole];
      part.corners = outline;
      again.push_back(table.add(part, whole, "cutting.outline", "part"));
    }
    for (std::size_t i = 0; i <= place; ++i) remove("remove", 0);
    if (is("pieces_lost")) again = before;  // the parts of what was cut are not put back
    for (const int piece : again) insert("insert_part", piece);
    return true;
  }

  /// Is the first of the list to be drawn? If not, another one has become the first.
  bool first_is_next() {
    const int p = at(0);
    for (std::size_t place = 1; place < list.size(); ++place) {
      const int q = at(place);
      const bool marked = place < moved;
      out.print("pair", "piece", p, "other", q);
      if (table[q].high.z < table[p].low.z) {
        overlaps("z_extents", p, q, "z", &Point::z);
        if (marked) continue;
        return true;
      }
      if (may_come_first(p, q)) continue;
      if (!marked && (is_behind(side("test_3_swapped", q, p), q, p) || is_before(side("test_4_swapped", p, q), p, q))) {
        out.print("take_out", "piece", q);
        list.erase(list.begin() + static_cast<std::ptrdiff_t>(place));
        list.insert(list.begin(), q);
        ++moved;
        out.print("move", "piece", q, "place", 0);
        out.print("mark", "piece", q);
        return false;
      }
      if (split(0, place) || split(place, 0)) return false;
    }
    return true;
  }
};

}  // namespace

std::string depth_sort(const Task& task) {
  DepthSorter sorter{task};
  sorter.out.print("clear", "z", INFINITY);
  sorter.table.gather("clipping.outline");
  for (std::size_t i = 0; i < task.polygons.size(); ++i) sorter.insert("insert", static_cast<int>(i));
  while (!sorter.list.empty()) {
    if (!sorter.first_is_next()) continue;
    const int p = sorter.at(0);
    sorter.out.print("draw", "piece", p, "polygon", sorter.table[p].polygon);
    sorter.table.paint(sorter.table[p], 0, 0, task.width, task.height);
    sorter.remove("drawn", 0);
  }
  return sorter.out.text;
}

}  // namespace zoo
