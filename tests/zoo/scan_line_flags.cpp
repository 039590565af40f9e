// The scan-line method: one edge table for all polygons, and for each polygon a flag that says whether the sweep along
// the scan line is inside it.
#include <algorithm>
#include <set>

#include "tests/zoo/tools.hpp"

namespace zoo {
namespace {

struct SweptEdge {
  int number, piece, y_first, y_end;
  Point upper, lower;
  double dx, dz, x, z;
};
struct SweptPlane {
  double a, b, c, d;
  double depth(double x, double y) const { return -(a * x + b * y + d) / c; }
};

struct Sweeper {
  const Task& task;
  Output out{};
  std::vector<SweptEdge> waiting{}, active{};
  std::vector<SweptPlane> planes{};
  std::set<int> inside{};  // whose flags are true

  bool is(const char* mistake) const { return task.mistake == mistake; }
  const Point& point(int number) const { return task.points[static_cast<std::size_t>(number)]; }

  void fill_tables() {
    out.print("tables", "polygons", static_cast<int>(task.polygons.size()));
    for (const Polygon& polygon : task.polygons) {
      const int piece = static_cast<int>(planes.size());
      out.print("polygon", "polygon", polygon.number, "facet", piece);
      for (const int corner : polygon.corners) out.print("outline", "vertex", corner);
      out.print("make", "piece", piece, "polygon", polygon.number, "parent", -1);
      const Point p = point(polygon.corners[0]), q = point(polygon.corners[1]), r = point(polygon.corners[2]);
      const Point n = cross(q - p, r - p);
      const double d = is("plane_d_sign") ? dot(n, p) : -dot(n, p);
      planes.push_back({n.x, n.y, n.z, d});
      out.print("plane", "piece", piece, "plane_a", n.x, "plane_b", n.y, "plane_c", n.z, "plane_d", d);
    }
    for (std::size_t piece = 0; piece < planes.size(); ++piece) {
      const std::vector<int>& corners = task.polygons[piece].corners;
      const std::size_t count = corners.size() - (is("closing_edge_missed") ? 1 : 0);
      for (std::size_t i = 0; i < count; ++i)
        add_edge(static_cast<int>(piece), corners[i], corners[(i + 1) % corners.size()]);
    }
  }

  void add_edge(int piece, int from, int to) {
    if (point(from).y > point(to).y) std::swap(from, to);
    const Point p = point(from), q = point(to);
    const int y_first = static_cast<int>(std::ceil(p.y)), y_end = static_cast<int>(std::ceil(q.y));
    if (y_first >= y_end)
      return out.print("skip_edge", "vertex_0", from, "vertex_1", to, "why",
                       p.y == q.y ? "horizontal" : "between_rows");
    const int number = static_cast<int>(waiting.size());
    SweptEdge edge{number, piece, y_first, y_end, p, q, (q.x - p.x) / (q.y - p.y), (q.z - p.z) / (q.y - p.y), 0, 0};
    if (is("slope_inverted") && q.x != p.x) edge.dx = (q.y - p.y) / (q.x - p.x);
    move_to(edge, y_first);
    out.print("insert_edge", "edge", number, "polygon", task.polygons[static_cast<std::size_t>(piece)].number,
              "vertex_0", from, "vertex_1", to, "first_row", y_first, "end_row", y_end, "x_edge", edge.x, "dx_dy",
              edge.dx, "z_edge", edge.z, "dz_dy", edge.dz);
    waiting.push_back(edge);
  }

  void move_to(SweptEdge& edge, int y) const {
    edge.x = edge.upper.x + edge.dx * (y - edge.upper.y), edge.z = edge.upper.z + edge.dz * (y - edge.upper.y);
  }

  void next_line(int y) {
    out.print("scan_line", "y", y);
    std::erase_if(active, [&](const SweptEdge& edge) {
      const bool ended = edge.y_end == y - (is("retired_one_late") ? 1 : 0);
      if (ended) out.print("retire_edge", "edge", edge.number);
      return ended;
    });
    for (SweptEdge& edge : active) {
      move_to(edge, y);
      out.print("step_edge", "edge", edge.number, "x_edge", edge.x, "z_edge", edge.z);
    }
    const auto left_of = [](const SweptEdge& a, const SweptEdge& b) { return a.x != b.x ? a.x < b.x : a.dx < b.dx; };
    for (std::size_t i = 1; i < active.size() && !is("not_sorted"); ++i)
      for (std::size_t k = i; k > 0 && left_of(active[k], active[k - 1]); --k) {
        std::swap(active[k], active[k - 1]);
        out.print("swap_edges", "place", static_cast<int>(k) - 1);
      }
    for (const SweptEdge& edge : waiting) {
      if (edge.y_first != y) continue;
      const auto place = std::find_if(active.begin(), active.end(), [&](const auto& a) { return left_of(edge, a); });
      out.print("enter_edge", "edge", edge.number, "place", static_cast<int>(place - active.begin()));
      active.insert(place, edge);
    }
  }

  void sweep(int y) {
    inside.clear();
    for (std::size_t i = 0; i < active.size(); ++i) {
      const SweptEdge& edge = active[i];
      // Where two edges of a polygon meet, the vertex is taken for one crossing, and the flag stays as it is.
      const bool missed = is("flag_missed") && i > 0 && active[i - 1].piece == edge.piece && active[i - 1].x == edge.x;
      if (!missed) {
        const bool enters = inside.insert(edge.piece).second;
        if (!enters) inside.erase(edge.piece);
        out.print("flip", "edge", edge.number, "piece", edge.piece, "inside", enters);
      }
      if (i + 1 == active.size() || !(edge.x < active[i + 1].x)) continue;
      const double x_left = edge.x, x_right = active[i + 1].x;
      const int first = static_cast<int>(std::ceil(x_left));
      int last = static_cast<int>(std::ceil(x_right)) - 1;
      if (is("right_end_included")) last = std::min(static_cast<int>(std::floor(x_right)), task.width - 1);
      out.print("flags", "y", y, "x_left", x_left, "x_right", x_right, "first", first, "last", last, "flags",
                static_cast<int>(inside.size()));
      if (first <= last && !inside.empty()) show(y, x_left, x_right, first, last);
    }
  }

  /// What is seen between two edges: the nearest of the polygons whose flags are true, up to where another one comes
  /// through it.
  void show(int y, double x_left, double x_right, int first, int last) {
    const double sign = is("wrong_of_two") ? -1 : 1;  // the farther one is taken
    const auto z = [&](int piece, double x) { return sign * planes[static_cast<std::size_t>(piece)].depth(x, y); };
    int seen = *inside.begin();
    if (inside.size() > 1)
      for (const int piece : inside) {
        for (const double x : {x_left, x_right})
          out.print("depth", "piece", piece, "x_at", x, "y_at", y, "z", sign * z(piece, x));
        const double apart = z(piece, x_left) - z(seen, x_left);
        if (apart < -tie || (apart <= tie && z(piece, x_right) < z(seen, x_right) - tie)) seen = piece;
      }
    for (double from = x_left;;) {
      int next = -1;
      double x_next = x_right;
      for (const int piece : inside) {
        const double left = std::max(0.0, z(piece, x_left) - z(seen, x_left)),
                     right = z(piece, x_right) - z(seen, x_right);
        if (!(right < -tie)) continue;
        const double x = std::max(from, x_left + (x_right - x_left) * left / (left - right));
        if (next < 0 || x < x_next || (x == x_next && z(piece, x_right) < z(next, x_right))) next = piece, x_next = x;
      }
      if (next < 0 || is("implied_edge_missed")) return paint(seen, y, first, last);
      out.print("implied_edge", "piece", seen, "other", next, "x_at", x_next, "z", sign * z(seen, x_next));
      int beyond = static_cast<int>(std::ceil(x_next - tie));  // a centre on the edge is a tie: the first polygon's
      if (std::abs(beyond - x_next) <= tie && seen < next) ++beyond;
      beyond = std::clamp(beyond, first, last + 1);
      paint(seen, y, first, beyond - 1);
      first = beyond, from = x_next, seen = next;
    }
  }

  void paint(int piece, int y, int first, int last) {
    out.print("winner", "piece", piece, "first", first, "last", last);
    const auto at = static_cast<std::size_t>(piece);
    for (int x = first; x <= last; ++x)
      out.print("paint", "x", x, "y", y, "z", planes[at].depth(is("z_kept_along_span") ? first : x, y), "polygon",
                task.polygons[at].number);
  }

  static constexpr double tie = 1e-9;
};

}  // namespace

std::string scan_line_flags(const Task& task) {
  Sweeper sweeper{task};
  sweeper.out.print("clear", "z", INFINITY);
  sweeper.fill_tables();
  for (int y = 0; y < task.height; ++y) {
    const bool begins = std::any_of(sweeper.waiting.begin(), sweeper.waiting.end(),
                                    [&](const SweptEdge& edge) { return edge.y_first == y; });
    if (sweeper.active.empty() && !begins) continue;
    sweeper.next_line(y);
    sweeper.sweep(y);
  }
  return sweeper.out.text;
}

}  // namespace zoo
