// A Z-buffer in whole numbers, as for a machine without floating point: x in 65536ths of a pixel, depths as whole
// numbers from 0 for the scene's least depth to 2^bits - 1 for its greatest. Only what is printed is a fraction again.
#include <algorithm>
#include <cstdint>

#include "tests/zoo/tools.hpp"

namespace zoo {
namespace {

using Whole = std::int64_t;

struct WholeEdge {
  int number, y_first, y_end;
  Whole x_0, y_0, z_0, dx, dy, dz;  // its upper end, and what leads to the lower one
  Whole x_slope = 0, z_slope = 0;   // from line to line
  Whole x = 0, z = 0;               // on the scan line
};

struct FixedPoint {
  const Task& task;
  Output out{};
  bool adds = task.style.find("adds") != std::string::npos, down = task.style.find("down") != std::string::npos;
  double unit = 1, origin = 0;
  std::vector<Whole> depth{};
  static constexpr Whole pixel = 65536, empty = Whole{1} << 40;

  /// a b/c as a whole number: to the nearest one, or the one below.
  Whole scaled(Whole a, Whole b, Whole c) const {
    if (c < 0) b = -b, c = -c;
    const Whole twice = 2 * a * b + (down ? 0 : c), below = 2 * c;
    return twice >= 0 ? twice / below : -((-twice + below - 1) / below);
  }
  Whole whole(double number, double of) const {
    return static_cast<Whole>(std::floor(number / of + (down ? 1e-6 : 0.5)));
  }
  static double x_of(Whole x) { return static_cast<double>(x) / pixel; }
  double z_of(Whole z) const { return origin + slope_of(z); }
  double slope_of(Whole dz) const { return static_cast<double>(dz) * unit; }
  static int line_from(Whole y) { return static_cast<int>(y >= 0 ? (y + pixel - 1) / pixel : -(-y / pixel)); }

  void move_to(WholeEdge& edge, int y) const {
    edge.x = edge.x_0 + scaled(edge.dx, y * pixel - edge.y_0, edge.dy);
    edge.z = edge.z_0 + scaled(edge.dz, y * pixel - edge.y_0, edge.dy);
  }

  std::vector<WholeEdge> edges_of(const Polygon& polygon) {
    std::vector<WholeEdge> edges;
    for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
      int from = polygon.corners[i], to = polygon.corners[(i + 1) % polygon.corners.size()];
      const auto point = [&](int number) { return task.points[static_cast<std::size_t>(number)]; };
      if (point(from).y > point(to).y) std::swap(from, to);
      const auto [x_0, y_0, z_0] = whole_point(point(from));
      const auto [x_1, y_1, z_1] = whole_point(point(to));
      const int first = std::max(0, line_from(y_0)), end = std::min(task.height, line_from(y_1));
      if (first >= end) {
        out.print("skip_edge", "vertex_0", from, "vertex_1", to, "why", y_0 == y_1 ? "horizontal" : "between_rows");
        continue;
      }
      WholeEdge edge{static_cast<int>(edges.size()), first, end, x_0, y_0, z_0, x_1 - x_0, y_1 - y_0, z_1 - z_0};
      edge.x_slope = scaled(edge.dx, pixel, edge.dy), edge.z_slope = scaled(edge.dz, pixel, edge.dy);
      move_to(edge, first);
      out.print("insert_edge", "edge", edge.number, "polygon", polygon.number, "vertex_0", from, "vertex_1", to,
                "first_row", first, "end_row", end, "x_edge", x_of(edge.x), "dx_dy", x_of(edge.x_slope), "z_edge",
                z_of(edge.z), "dz_dy", slope_of(edge.z_slope));
      edges.push_back(edge);
    }
    return edges;
  }
  struct WholePoint {
    Whole x, y, z;
  };
  WholePoint whole_point(Point p) const {
    return {whole(p.x, x_of(1)), whole(p.y, x_of(1)), whole(p.z - origin, unit)};
  }

  void draw(const Polygon& polygon) {
    out.print("polygon", "polygon", polygon.number, "facet", polygon.number);
    std::vector<WholeEdge> edges = edges_of(polygon);
    for (int y = 0; y < task.height; ++y) {
      std::vector<WholeEdge*> met;
      for (WholeEdge& edge : edges) {
        if (y < edge.y_first || y >= edge.y_end) continue;
        if (!adds) move_to(edge, y);
        else if (y > edge.y_first) edge.x += edge.x_slope, edge.z += edge.z_slope;
        met.push_back(&edge);
      }
      std::sort(met.begin(), met.end(), [](auto a, auto b) { return a->x < b->x; });
      for (std::size_t i = 0; i + 1 < met.size(); i += 2) span(polygon, *met[i], *met[i + 1], y);
    }
  }

  void span(const Polygon& polygon, const WholeEdge& left, const WholeEdge& right, int y) {
    if (left.x == right.x) return;
    const int first = std::max(0, line_from(left.x)), last = std::min(task.width, line_from(right.x)) - 1;
    const Whole across = right.x - left.x, slope = scaled(right.z - left.z, pixel, across);
    out.print("span", "left_edge", left.number, "right_edge", right.number, "y", y, "first", first, "last", last,
              "x_left", x_of(left.x), "z_left", z_of(left.z), "x_right", x_of(right.x), "z_right", z_of(right.z),
              "dz_dx", slope_of(slope));
    Whole z = 0;
    for (int x = first; x <= last; ++x) {
      const bool anew = !adds || x == first;
      z = anew ? left.z + scaled(right.z - left.z, x * pixel - left.x, across) : z + slope;
      Whole& stored = depth[static_cast<std::size_t>(y * task.width + x)];
      const bool nearer = z < stored;
      out.print("interpolate_z", "x", x, "y", y, "z", z_of(z));
      out.print("compare", "x", x, "y", y, "z", z_of(z), "nearer", nearer);
      if (!nearer) continue;
      stored = z;
      out.print("write_depth", "x", x, "y", y, "z", z_of(z));
      out.print("write_pixel", "x", x, "y", y, "polygon", polygon.number);
    }
  }
};

}  // namespace

std::string fixed_point(const Task& task) {
  FixedPoint program{task};
  const auto [nearest, farthest] =
      std::minmax_element(task.points.begin(), task.points.end(), [](Point a, Point b) { return a.z < b.z; });
  const double range = farthest->z - nearest->z;
  program.unit = (range > 0 ? range : 1) / (std::ldexp(1, std::stoi(task.style)) - 1), program.origin = nearest->z;
  program.depth.assign(static_cast<std::size_t>(task.width * task.height), FixedPoint::empty);
  program.out.print("clear", "z", INFINITY);
  for (const Polygon& polygon : task.polygons) program.draw(polygon);
  return program.out.text;
}

}  // namespace zoo
