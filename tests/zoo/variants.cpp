// Z-buffers put together from parts: which pixel comes next, what is inside, how depth is found, and in which numbers.
// Triangles only.
#include <algorithm>
#include <array>
#include <cstdint>

#include "tests/zoo/tools.hpp"

namespace zoo {
namespace {

template <class Number>
struct Variant {
  const Task& task;
  Output out{};
  std::vector<Number> depth = std::vector<Number>(static_cast<std::size_t>(task.width * task.height), INFINITY);

  bool has(const char* word) const { return task.style.find(word) != std::string::npos; }
  std::array<Point, 3> corners(const Polygon& polygon) const {
    std::array<Point, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = task.points[static_cast<std::size_t>(polygon.corners[i])];
    return p;
  }
  static Number n(double number) { return static_cast<Number>(number); }

  /// By the edges that cross the scan line on the left of the pixel.
  static bool between_crossings(const std::array<Point, 3>& p, int x, int y) {
    bool inside = false;
    for (std::size_t i = 0; i < 3; ++i) {
      const Point a = p[i], b = p[(i + 1) % 3];
      if ((a.y <= y) == (b.y <= y)) continue;
      if (a.x + (y - a.y) * (b.x - a.x) / (b.y - a.y) <= x) inside = !inside;
    }
    return inside;
  }
  /// By three edge functions in whole numbers: points lie on eighths of a pixel.
  static bool by_edge_functions(const std::array<Point, 3>& p, int x, int y) {
    const auto whole = [](double number) { return static_cast<std::int64_t>(std::lround(8 * number)); };
    const auto turn = [&](Point a, Point b, std::int64_t x_8, std::int64_t y_8) {
      return (whole(b.x) - whole(a.x)) * (y_8 - whole(a.y)) - (whole(b.y) - whole(a.y)) * (x_8 - whole(a.x));
    };
    const std::int64_t area = turn(p[0], p[1], whole(p[2].x), whole(p[2].y));
    for (std::size_t i = 0; i < 3; ++i) {
      const Point a = area > 0 ? p[i] : p[(i + 1) % 3], b = area > 0 ? p[(i + 1) % 3] : p[i];
      const bool top_or_left = b.y < a.y || (a.y == b.y && b.x > a.x);
      if (turn(a, b, 8 * x, 8 * y) < (top_or_left ? 0 : 1)) return false;
    }
    return area != 0;
  }

  Number depth_at(const std::array<Point, 3>& p, int x, int y) const {
    const Point u = p[1] - p[0], v = p[2] - p[0], away{x - p[0].x, y - p[0].y, 0};
    const Number area = n(u.x) * n(v.y) - n(u.y) * n(v.x);
    if (has("plane")) {  // z_0 + dz/dx (x - x_0) + dz/dy (y - y_0)
      const Number dz_dx = (n(u.z) * n(v.y) - n(v.z) * n(u.y)) / area;
      const Number dz_dy = (n(v.z) * n(u.x) - n(u.z) * n(v.x)) / area;
      return n(p[0].z) + dz_dx * n(away.x) + dz_dy * n(away.y);
    }
    if (has("weights")) {  // how much of each vertex
      const Number second = (n(away.x) * n(v.y) - n(away.y) * n(v.x)) / area,
                   third = (n(u.x) * n(away.y) - n(u.y) * n(away.x)) / area;
      return (1 - second - third) * n(p[0].z) + second * n(p[1].z) + third * n(p[2].z);
    }
    std::array<std::pair<Number, Number>, 2> ends{};  // x and z where the scan line crosses two edges
    std::size_t found = 0;
    for (std::size_t i = 0; i < 3 && found < 2; ++i) {
      const Point a = p[i], b = p[(i + 1) % 3];
      if ((a.y <= y) == (b.y <= y)) continue;
      const Number t = n(y - a.y) / n(b.y - a.y);
      ends[found++] = {n(a.x) + t * n(b.x - a.x), n(a.z) + t * n(b.z - a.z)};
    }
    const auto [left, right] = std::pair(ends[0], ends[1]);
    return left.second + (right.second - left.second) * (n(x) - left.first) / (right.first - left.first);
  }

  void begin(const Polygon& polygon) { out.print("polygon", "polygon", polygon.number, "facet", polygon.number); }
  void pixel(const Polygon& polygon, int x, int y, bool begins = false) {
    const std::array<Point, 3> p = corners(polygon);
    if (!(has("crossings") ? between_crossings(p, x, y) : by_edge_functions(p, x, y))) return;
    if (begins) begin(polygon);
    const Number z = depth_at(p, x, y);
    Number& stored = depth[static_cast<std::size_t>(y * task.width + x)];
    const bool nearer = z < stored;
    out.print("compare", "x", x, "y", y, "z", static_cast<double>(z), "nearer", nearer);
    if (!nearer) return;
    stored = z;
    out.print("write_pixel", "x", x, "y", y, "polygon", polygon.number);
    out.print("write_depth", "x", x, "y", y, "z", static_cast<double>(z));
  }
  /// The four quarters of a rectangle, down to one pixel.
  void quarter(const Polygon& polygon, int x_0, int y_0, int x_1, int y_1) {
    if (x_0 >= x_1 || y_0 >= y_1) return;
    if (x_1 - x_0 == 1 && y_1 - y_0 == 1) return pixel(polygon, x_0, y_0);
    const int x = (x_0 + x_1) / 2, y = (y_0 + y_1) / 2;
    quarter(polygon, x_0, y_0, x, y), quarter(polygon, x, y_0, x_1, y);
    quarter(polygon, x_0, y, x, y_1), quarter(polygon, x, y, x_1, y_1);
  }

  std::string run() {
    out.print("clear", "z", INFINITY);
    if (has("pixels")) {  // one after another, with all polygons
      for (int i = 0; i < task.width * task.height; ++i)
        for (const Polygon& polygon : task.polygons) pixel(polygon, i % task.width, i / task.width, true);
      return out.text;
    }
    for (const Polygon& polygon : task.polygons) {
      begin(polygon);
      if (has("quarters")) quarter(polygon, 0, 0, task.width, task.height);
      for (int i = 0; i < task.width * task.height && !has("quarters"); ++i) {
        if (has("columns")) pixel(polygon, i / task.height, i % task.height);
        else pixel(polygon, i % task.width, has("upwards") ? task.height - 1 - i / task.width : i / task.width);
      }
    }
    return out.text;
  }
};

}  // namespace

std::string variants(const Task& task) {
  const bool narrow = task.style.find("float32") != std::string::npos;
  return narrow ? Variant<float>{task}.run() : Variant<double>{task}.run();
}

}  // namespace zoo
