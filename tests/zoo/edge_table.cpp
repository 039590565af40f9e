// The textbook's Z-buffer: a table of edges with a bucket for each scan line, a list of active edges, and increments.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <list>
#include <utility>

#include "tests/zoo/programs.hpp"

namespace zoo {
namespace {

struct Edge {
  int number, from, to, y_first, y_end;
  double x, dx, z, dz;
};

struct Program {
  const Task& task;
  std::string out;
  std::vector<double> depth;
  // Places where a mistake can be made once.
  int edges = 0, steps = 0, roundings = 0, retirements = 0, early = 0, inserted = 0, spans = 0;

  double first_dz = 0;

  /// Several mistakes are written as "one+other".
  bool is(const std::string& mistake) const {
    return ("+" + task.mistake + "+").find("+" + mistake + "+") != std::string::npos;
  }
  bool once(const char* mistake, int& counter) {
    if (!is(mistake)) return false;
    return counter++ == task.nth;
  }

  template <class... Numbers>
  void say(const char* format, Numbers... numbers) {
    char line[512];
    std::snprintf(line, sizeof line, format, numbers...);
    out += line;
    out += '\n';
  }

  // y first as it is needed: the first scan line at or below it.
  static int line_from(double y) { return static_cast<int>(std::ceil(y)); }

  std::vector<std::list<Edge>> table_of(const Polygon& polygon) {
    std::vector<std::list<Edge>> buckets(static_cast<std::size_t>(task.height) + 1);
    int number = 0;
    const std::size_t n = polygon.corners.size();
    for (std::size_t i = 0; i < n; ++i) {
      int a = polygon.corners[i], b = polygon.corners[(i + 1) % n];
      Point p = task.points[static_cast<std::size_t>(a)], q = task.points[static_cast<std::size_t>(b)];
      if (is("closing_edge_left_out") && i + 1 == n) continue;
      if (is("x_y_read_exchanged")) std::swap(p.x, p.y), std::swap(q.x, q.y);
      if (p.y == q.y && is("horizontal_inserted") && line_from(p.y) >= 0 && line_from(p.y) < task.height) {
        Edge edge{number++, a, b, line_from(p.y), line_from(p.y) + 1, p.x, 0, p.z, 0};
        insert(polygon, edge);
        buckets[static_cast<std::size_t>(edge.y_first)].push_back(edge);
        continue;
      }
      if (p.y == q.y) {
        say("{\"step\":\"skip\",\"vertex_0\":%d,\"vertex_1\":%d,\"why\":\"horizontal\"}", a, b);
        continue;
      }
      if (p.y > q.y) {
        std::swap(a, b);
        if (is("z_not_swapped")) std::swap(p.x, q.x), std::swap(p.y, q.y);
        else std::swap(p, q);
      }
      if (once("swapped_vertex", inserted)) std::swap(p.x, q.x);
      Edge edge{};
      edge.from = a, edge.to = b;
      edge.y_first = std::max(0, line_from(p.y)), edge.y_end = std::min(task.height, line_from(q.y));
      if (is("starts_one_early")) edge.y_first = std::max(0, static_cast<int>(std::floor(p.y)));
      if (is("rows_rounded_down"))
        edge.y_first = std::max(0, static_cast<int>(std::floor(p.y))),
        edge.y_end = std::min(task.height, static_cast<int>(std::floor(q.y)));
      if (edge.y_first >= edge.y_end) {
        say("{\"step\":\"skip\",\"vertex_0\":%d,\"vertex_1\":%d,\"why\":\"between_rows\"}", a, b);
        continue;
      }
      edge.number = number++;
      edge.dx = (q.x - p.x) / (q.y - p.y);
      if (is("slope_inverted") && q.x != p.x) edge.dx = (q.y - p.y) / (q.x - p.x);
      if (is("slope_whole")) edge.dx = std::trunc(edge.dx);
      if (once("slope_ulp", edges)) edge.dx = std::nextafter(edge.dx, 1e9);
      if (is("slope_negative")) edge.dx = -edge.dx;
      edge.dz = (q.z - p.z) / (q.y - p.y);
      if (is("z_slope_halved")) edge.dz /= 2;
      if (is("z_slope_of_x")) edge.dz = edge.dx;
      if (is("z_slope_of_x_inverted") && q.x != p.x) edge.dz = (q.y - p.y) / (q.x - p.x);
      edge.x = p.x + edge.dx * (edge.y_first - p.y);
      if (is("x_at_vertex")) edge.x = p.x;
      edge.z = p.z + edge.dz * (edge.y_first - p.y);
      if (is("z_at_vertex")) edge.z = p.z;
      if (is("ends_one_late")) ++edge.y_end;
      insert(polygon, edge);
      buckets[static_cast<std::size_t>(edge.y_first)].push_back(edge);
    }
    return buckets;
  }

  void insert(const Polygon& polygon, const Edge& edge) {
    say("{\"step\":\"insert\",\"edge\":%d,\"polygon\":%d,\"vertex_0\":%d,\"vertex_1\":%d,\"first_row\":%d,"
        "\"end_row\":%d,\"x_edge\":%.17g,\"dx_dy\":%.17g,\"z_edge\":%.17g,\"dz_dy\":%.17g}",
        edge.number, polygon.number, edge.from, edge.to, edge.y_first, edge.y_end, edge.x, edge.dx, edge.z, edge.dz);
  }

  void pixel(const Polygon& polygon, int x, int y, double z) {
    if (is("y_upside_down")) y = task.height - 1 - y;
    say("{\"step\":\"z\",\"x\":%d,\"y\":%d,\"z\":%.17g}", x, y, z);
    double& stored = depth[static_cast<std::size_t>((is("buffer_of_one_line") ? 0 : y * task.width) + x)];
    bool nearer = z < stored;
    if (is("compare_reversed")) nearer = z > stored || std::isinf(stored);
    if (is("equal_wins")) nearer = z <= stored;
    if (is("written_before_test")) stored = z, say("{\"step\":\"wz\",\"x\":%d,\"y\":%d,\"z\":%.17g}", x, y, z);
    say("{\"step\":\"compare\",\"x\":%d,\"y\":%d,\"z\":%.17g,\"nearer\":%s}", x, y, z, nearer ? "true" : "false");
    if (!nearer && !is("colour_always") && !is("depth_always")) return;
    if ((nearer || is("depth_always")) && !is("depth_not_written") && !is("written_before_test")) {
      stored = z;
      say("{\"step\":\"wz\",\"x\":%d,\"y\":%d,\"z\":%.17g}", x, y, z);
    }
    if (!nearer && is("depth_always")) return;
    if (is("colour_not_written") && polygon.number > 0) return;
    if (is("x_y_exchanged") && x < task.height && y < task.width) std::swap(x, y);
    if (is("colour_one_to_the_right")) x = std::min(x + 1, task.width - 1);
    if (is("colour_upside_down")) y = task.height - 1 - y;
    const int drawn = is("first_polygon_always") ? 0 : polygon.number;
    say("{\"step\":\"wp\",\"x\":%d,\"y\":%d,\"polygon\":%d}", x, y, drawn);
  }

  void span(const Polygon& polygon, const Edge& left, const Edge& right, int y) {
    if (is("spans_of_even_lines") && y % 2 == 1) return;
    double dz = right.x != left.x ? (right.z - left.z) / (right.x - left.x) : 0;
    if (is("dz_dx_of_first_span")) {
      // In a plane all spans have one slope, but for rounding; those without a length have none.
      if (std::exchange(spans, spans + 1) == 0) first_dz = dz;
      else if (right.x != left.x && std::abs(dz - first_dz) > 1e-9) dz = first_dz;
    }
    int first = std::max(0, static_cast<int>(std::ceil(left.x)));
    int last = std::min(task.width, static_cast<int>(std::ceil(right.x))) - 1;
    if (is("right_end_included")) last = std::min(task.width - 1, static_cast<int>(std::floor(right.x) + 1));
    if (is("left_end_excluded")) first = std::max(0, static_cast<int>(std::floor(left.x)) + 1);
    if (is("ends_truncated"))
      first = std::max(0, static_cast<int>(left.x)), last = std::min(task.width - 1, static_cast<int>(right.x));
    if (is("ends_rounded"))
      first = std::max(0, static_cast<int>(std::lround(left.x))), last = static_cast<int>(std::lround(right.x));
    if (once("wrong_rounding", roundings)) first = std::max(0, static_cast<int>(std::floor(left.x)) - 1);
    say("{\"step\":\"span\",\"left_edge\":%d,\"right_edge\":%d,\"y\":%d,\"first\":%d,\"last\":%d,\"x_left\":%.17g,"
        "\"z_left\":%.17g,\"x_right\":%.17g,\"z_right\":%.17g,\"dz_dx\":%.17g}",
        left.number, right.number, y, first, last, left.x, left.z, right.x, right.z, dz);
    double z = left.z + dz * (first - left.x);
    if (is("z_not_to_centre")) z = left.z;
    if (is("z_stepped_before_use")) z += dz;
    if (is("mean_depth")) z = (left.z + right.z) / 2;
    for (int x = first; x <= last && x < task.width; ++x) {
      if (is("depth_doubled_at_ends") && x == last) z *= 2;
      if (x >= 0) pixel(polygon, x, y, z);
      z += is("z_by_slope_of_x") ? left.dx : is("z_by_slope_of_edge") ? left.dz : dz;
      if (is("adds_in_float32")) z = static_cast<float>(z);
    }
  }

  void draw(const Polygon& polygon) {
    spans = 0;
    say("{\"step\":\"polygon\",\"polygon\":%d,\"facet\":%d}", polygon.number, polygon.number);
    auto buckets = table_of(polygon);
    std::list<Edge> active;
    for (int y = 0; y < task.height; ++y) {
      auto& fresh = buckets[static_cast<std::size_t>(y)];
      if (active.empty() && fresh.empty()) continue;
      say("{\"step\":\"line\",\"y\":%d}", y);
      for (auto edge = active.begin(); edge != active.end();) {
        const bool ends_next = edge->y_end == y + 1 && edge->y_first < y && once("early_retirement", early);
        if (ends_next || (edge->y_end + is("retired_one_late") <= y && !is("never_retired") &&
                          !once("missing_retirement", retirements))) {
          say("{\"step\":\"retire\",\"edge\":%d}", edge->number);
          edge = active.erase(edge);
        } else {
          ++edge;
        }
      }
      for (Edge& edge : active) step(edge);
      if (is("stepped_twice"))
        for (Edge& edge : active) step(edge);
      sort(active);
      for (const Edge& edge : fresh) enter(active, edge);
      if (is("stepped_too_early"))
        for (Edge& edge : active)
          if (edge.y_first == y) step(edge);
      fresh.clear();
      for (auto edge = active.begin(); edge != active.end() && std::next(edge) != active.end(); std::advance(edge, 2)) {
        span(polygon, *edge, *std::next(edge), y);
        if (std::next(edge) == active.end() || std::next(edge, 2) == active.end()) break;
      }
    }
  }

  void step(Edge& edge) {
    if (once("dropped_increment", steps)) return;
    edge.x += edge.dx;
    if (is("rounded_then_stepped")) edge.x = std::round(edge.x);
    if (!is("z_not_carried")) edge.z += edge.dz;
    say("{\"step\":\"step\",\"edge\":%d,\"x_edge\":%.17g,\"z_edge\":%.17g}", edge.number, edge.x, edge.z);
  }

  void sort(std::list<Edge>& active) {
    if (is("not_sorted")) return;
    for (bool moved = true; moved;) {
      moved = false;
      int place = 0;
      for (auto edge = active.begin(); edge != active.end() && std::next(edge) != active.end(); ++edge, ++place) {
        if (edge->x <= std::next(edge)->x) continue;
        std::swap(*edge, *std::next(edge));
        say("{\"step\":\"swap\",\"place\":%d}", place);
        moved = true;
      }
    }
  }

  void enter(std::list<Edge>& active, const Edge& edge) {
    auto at = active.begin();
    int place = 0;
    while (at != active.end() && !is("entered_in_front") && (at->x < edge.x || (at->x == edge.x && at->dx <= edge.dx)))
      ++at, ++place;
    say("{\"step\":\"enter\",\"edge\":%d,\"place\":%d}", edge.number, place);
    active.insert(at, edge);
  }
};

}  // namespace

std::string edge_table(const Task& task) {
  Program program{task, {}, {}};
  const bool zero = program.is("buffer_begins_at_0");
  const std::size_t cells = static_cast<std::size_t>(task.width) * static_cast<std::size_t>(task.height);
  program.depth.assign(cells, zero ? 0 : INFINITY);
  program.say("{\"step\":\"clear\",\"z\":%s}", zero ? "0" : "\"inf\"");
  for (const Polygon& polygon : task.polygons) {
    program.draw(polygon);
    if (program.is("buffer_reset")) program.depth.assign(cells, INFINITY);
  }
  return program.out;
}

}  // namespace zoo
