// For the programs that work with all polygons at once, on the raster: their planes, boxes and parts.
#pragma once

#include <algorithm>
#include <utility>

#include "tests/zoo/tools.hpp"

namespace zoo {

struct FlatPiece {
  int polygon = 0;
  std::vector<int> corners;
  Point n;  ///< of any length
  double d = 0;
  Point low, high;

  double value(Point p) const { return dot(n, p) + d; }
  double depth(double x, double y) const { return -(n.x * x + n.y * y + d) / n.z; }
};

class PieceTable {
 public:
  PieceTable(const Task& task, Output& out) : points(task.points), task_(task), out_(out) {}
  std::vector<Point> points;
  std::vector<FlatPiece> pieces;

  const FlatPiece& operator[](int piece) const { return pieces[static_cast<std::size_t>(piece)]; }
  const Point& point(int number) const { return points[static_cast<std::size_t>(number)]; }
  Point corner(const FlatPiece& piece, std::size_t i) const { return point(piece.corners[i % piece.corners.size()]); }

  /// All polygons of the task. `outline` is the name of the step by which a program prints the corners.
  void gather(const char* outline) {
    out_.print("tables", "polygons", static_cast<int>(task_.polygons.size()));
    int facet = 0;
    for (const Polygon& polygon : task_.polygons) {
      out_.print("polygon", "polygon", polygon.number, "facet", facet++);
      FlatPiece piece{polygon.number, polygon.corners, {}, 0, {}, {}};
      const Point p = corner(piece, 0);
      piece.n = cross(corner(piece, 1) - p, corner(piece, 2) - p), piece.d = -dot(piece.n, p);
      add(piece, -1, outline, "make");
    }
  }

  int add(FlatPiece piece, int parent, const char* outline, const char* make) {
    const int number = static_cast<int>(pieces.size());
    piece.low = {INFINITY, INFINITY, INFINITY}, piece.high = -1 * piece.low;
    for (const int corner : piece.corners) {
      out_.print(outline, "vertex", corner);
      const Point p = point(corner);
      piece.low = {std::min(piece.low.x, p.x), std::min(piece.low.y, p.y), std::min(piece.low.z, p.z)};
      piece.high = {std::max(piece.high.x, p.x), std::max(piece.high.y, p.y), std::max(piece.high.z, p.z)};
    }
    out_.print(make, "piece", number, "polygon", piece.polygon, "parent", parent);
    out_.print("plane", "piece", number, "plane_a", piece.n.x, "plane_b", piece.n.y, "plane_c", piece.n.z, "plane_d",
               piece.d);
    out_.print("extent", "piece", number, "x_min", piece.low.x, "x_max", piece.high.x, "y_min", piece.low.y, "y_max",
               piece.high.y, "z_min", piece.low.z, "z_max", piece.high.z);
    pieces.push_back(piece);
    return number;
  }

  /// Where the line y goes into the outline and out of it, from left to right.
  std::vector<double> crossings(const FlatPiece& piece, double y) const {
    std::vector<double> found;
    for (std::size_t i = 0; i < piece.corners.size(); ++i) {
      const Point a = corner(piece, i), b = corner(piece, i + 1);
      if ((a.y <= y) != (b.y <= y)) found.push_back(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
    }
    std::sort(found.begin(), found.end());
    return found;
  }
  bool covers(const FlatPiece& piece, double x, double y) const {
    const std::vector<double> found = crossings(piece, y);
    return std::count_if(found.begin(), found.end(), [&](double at) { return at <= x; }) % 2 == 1;
  }
  void paint(const FlatPiece& piece, int x, int y) const {
    out_.print("paint", "x", x, "y", y, "z", piece.depth(x, y), "polygon", piece.polygon);
  }
  /// The pixels of the outline within a rectangle of the raster.
  void paint(const FlatPiece& piece, int x_0, int y_0, int x_1, int y_1) const {
    for (int y = y_0; y < y_1; ++y)
      for (int x = x_0; x < x_1; ++x)
        if (covers(piece, x, y)) paint(piece, x, y);
  }

 private:
  const Task& task_;
  Output& out_;
};

/// The two parts of an outline, on the positive side of a plane and on its negative one. `make(from, to, t)` makes a
/// vertex on the way from one vertex to the other.
template <class Value, class Make>
std::pair<std::vector<int>, std::vector<int>> cut_outline(const std::vector<int>& outline, Value&& value, Make&& make) {
  std::pair<std::vector<int>, std::vector<int>> parts;
  constexpr double on = 1e-9;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const int here = outline[i], next = outline[(i + 1) % outline.size()];
    const double d_0 = value(here), d_1 = value(next);
    if (d_0 >= -on) parts.first.push_back(here);
    if (d_0 <= on) parts.second.push_back(here);
    if (!((d_0 > on && d_1 < -on) || (d_0 < -on && d_1 > on))) continue;
    const int made = d_0 > 0 ? make(here, next, d_0 / (d_0 - d_1)) : make(next, here, d_1 / (d_1 - d_0));
    parts.first.push_back(made), parts.second.push_back(made);
  }
  return parts;
}

}  // namespace zoo
