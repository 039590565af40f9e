// Ray casting: from the eye through the centre of each pixel, against one polygon after another.
#include <algorithm>
#include <array>

#include "tests/zoo/tools.hpp"

namespace zoo {
namespace {

struct Target {
  std::vector<Point> corners;
  Point normal;
  double d = 0;
  Point low, high;  // its box
};
struct Beam {
  Point from, along;
  double least = -INFINITY, most = INFINITY;  // what lies before or beyond is not seen
};

struct RayCaster {
  const Task& task;
  Output out{};
  std::vector<Target> targets{};

  bool is(const char* mistake) const { return task.mistake == mistake; }
  bool boxes() const { return !task.style.empty(); }

  void prepare() {
    // Boxes are made a little wider, so that a polygon in a plane x = 3 has a box of some width; or they are not.
    double size = task.style == "tight boxes" ? 0 : std::sqrt(dot(task.camera.eye, task.camera.eye));
    for (const Point& p : task.points)
      if (task.style != "tight boxes") size = std::max(size, std::sqrt(dot(p, p)));
    const Point pad{1e-9 * size, 1e-9 * size, 1e-9 * size};
    for (const Polygon& polygon : task.polygons) {
      Target target;
      for (const int corner : polygon.corners) target.corners.push_back(task.points[static_cast<std::size_t>(corner)]);
      const std::vector<Point>& p = target.corners;
      target.normal = cross(p[1] - p[0], p[2] - p[0]);
      target.d = -dot(target.normal, p[0]);
      target.low = target.high = p[0];
      for (const Point& q : p) {
        target.low = {std::min(target.low.x, q.x), std::min(target.low.y, q.y), std::min(target.low.z, q.z)};
        target.high = {std::max(target.high.x, q.x), std::max(target.high.y, q.y), std::max(target.high.z, q.z)};
      }
      target.low = target.low - pad, target.high = target.high + pad;
      const int number = static_cast<int>(targets.size());
      targets.push_back(target);
      if (!boxes()) continue;
      out.print("box", "box", number, "parent", -1, "x_min", target.low.x, "x_max", target.high.x, "y_min",
                target.low.y, "y_max", target.high.y, "z_min", target.low.z, "z_max", target.high.z);
      out.print("hold", "box", number, "facet", number);
    }
  }

  Beam beam(int x, int y) const {
    const Camera& camera = task.camera;
    if (!camera.there) return {{static_cast<double>(x), static_cast<double>(y), 0}, {0, 0, 1}};
    const double window_x = camera.window * task.width / task.height;
    const double x_p = -window_x + 2 * window_x * (x + 0.5) / task.width;
    const double y_p = camera.window - 2 * camera.window * (y + 0.5) / task.height;
    Beam beam{camera.eye, x_p * camera.right + y_p * camera.up + camera.d * camera.away};
    beam.least = camera.near / camera.d, beam.most = camera.far / camera.d;
    if (is("negative_t")) beam.least = -INFINITY;  // what lies behind the eye is seen, too
    return beam;
  }

  /// Is the point in the polygon? In the two coordinates in which the polygon is largest; how many sides are beside it?
  bool inside(const Target& target, Point point) const {
    const Point n{std::abs(target.normal.x), std::abs(target.normal.y), std::abs(target.normal.z)};
    const auto flat = [&](Point p) {
      if (n.z >= n.x && n.z >= n.y) return std::array<double, 2>{p.x, p.y};
      return n.y >= n.x ? std::array<double, 2>{p.x, p.z} : std::array<double, 2>{p.y, p.z};
    };
    const auto [x, y] = flat(point);
    bool odd = false;
    const std::size_t sides = is("inside_test_half") ? 2 : target.corners.size();  // the other sides are forgotten
    for (std::size_t i = 0; i < sides; ++i) {
      const auto a = flat(target.corners[i]), b = flat(target.corners[(i + 1) % target.corners.size()]);
      if ((a[1] <= y) == (b[1] <= y)) continue;
      if (a[0] + (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]) <= x) odd = !odd;
    }
    return odd;
  }

  bool meets_box(const Target& target, int number, const Beam& beam, double nearest) {
    double enter = -INFINITY, leave = INFINITY;
    const auto slab = [&](double low, double high, double from, double along) {
      if (along == 0) {
        // A ray along the slab is inside it all the way, or nowhere. Wrongly taken as missing it in any case:
        if (from < low || from > high || is("box_misses_at_0")) leave = -INFINITY;
        return;
      }
      const double t_0 = (low - from) / along, t_1 = (high - from) / along;
      enter = std::max(enter, std::min(t_0, t_1)), leave = std::min(leave, std::max(t_0, t_1));
    };
    slab(target.low.x, target.high.x, beam.from.x, beam.along.x);
    slab(target.low.y, target.high.y, beam.from.y, beam.along.y);
    slab(target.low.z, target.high.z, beam.from.z, beam.along.z);
    enter = std::max(enter, beam.least), leave = std::min(leave, beam.most);
    const bool hit = enter <= leave && enter <= nearest;
    out.print("box_test", "box", number, "t_enter", enter, "t_leave", leave, "hit", hit);
    return hit;
  }

  void cast(int ray, int x, int y) {
    const Beam beam = this->beam(x, y);
    const auto [from, along] = std::pair(beam.from, beam.along);
    out.print("ray", "ray", ray, "parent", -1, "role", "eye", "x", x, "y", y, "x_0", from.x, "y_0", from.y, "z_0",
              from.z, "dir_x", along.x, "dir_y", along.y, "dir_z", along.z);
    int best = -1, tests = 0;
    double t_best = INFINITY;
    for (std::size_t i = 0; i < targets.size(); ++i) {
      const Target& target = targets[i];
      const int facet = static_cast<int>(i);
      if (boxes() && !meets_box(target, facet, beam, t_best)) continue;
      ++tests;
      const double numerator = -(dot(target.normal, from) + target.d), denominator = dot(target.normal, along);
      const double t = numerator / denominator;
      out.print("plane", "facet", facet, "numerator", numerator, "denominator", denominator, "t",
                denominator == 0 ? NAN : t);
      if (denominator == 0 || !(t >= beam.least && t <= beam.most)) continue;
      const Point point = from + t * along;
      const bool in = inside(target, point);
      bool nearest = in && t < t_best;
      if (is("nearest_by_index")) nearest = in;  // the last polygon of the list that is hit is kept
      out.print("hit", "facet", facet, "t", t, "x_hit", point.x, "y_hit", point.y, "z_hit", point.z, "inside", in,
                "nearest", nearest);
      if (nearest) best = facet, t_best = t;
    }
    if (boxes()) out.print("saved", "coherence", "extent", "tests", static_cast<int>(targets.size()) - tests);
    const Polygon* polygon = best < 0 ? nullptr : &task.polygons[static_cast<std::size_t>(best)];
    const Point color = polygon ? polygon->color : Point{1, 1, 1};
    out.print("ray_end", "ray", ray, "nearest_facet", best, "t", t_best, "tests", tests, "red", color.x, "green",
              color.y, "blue", color.z);
    if (polygon) out.print("paint", "x", x, "y", y, "z", depth(t_best), "polygon", polygon->number);
  }

  double depth(double t) const {
    const Camera& camera = task.camera;
    if (!camera.there) return t;
    const double z_v = t * camera.d, range = camera.far - camera.near;
    return (camera.far + camera.near) / range - 2 * camera.far * camera.near / (range * z_v);
  }
};

}  // namespace

std::string rays(const Task& task) {
  RayCaster caster{task};
  caster.out.print("clear", "z", INFINITY);
  caster.prepare();
  int ray = 0;
  for (int y = 0; y < task.height; ++y)
    for (int x = 0; x < task.width; ++x) caster.cast(ray++, x, y);
  return caster.out.text;
}

}  // namespace zoo
