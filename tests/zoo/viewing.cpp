// From the world to the screen: view coordinates, back faces, clipping, projection, viewport; then a Z-buffer that
// finds the crossings of each scan line with the polygon's edges.
#include <array>

#include "tests/zoo/tools.hpp"

namespace zoo {
namespace {

struct ViewedVertex {
  Point view, plane, screen;  // plane: x_p, y_p and the depth; screen: x_s, y_s and the depth
  bool seen = false;          // it has a place on the screen
};

struct Viewer {
  const Task& task;
  const Camera& camera = task.camera;
  Output out{};
  std::vector<ViewedVertex> vertices{};
  std::vector<double> depth{};
  double window_x = camera.window * task.width / task.height;

  bool is(const char* mistake) const { return task.mistake == mistake; }
  ViewedVertex& vertex(int number) { return vertices[static_cast<std::size_t>(number)]; }

  void to_screen(int number) {
    ViewedVertex& v = vertex(number);
    const double z_v = v.view.z, near = camera.near, far = camera.far;
    double scale = camera.d / z_v;
    if (is("no_divide")) scale = camera.d;                   // the division by z_v is forgotten
    if (is("divide_twice")) scale = camera.d / (z_v * z_v);  // once by w, and then by z_v again
    v.plane = {scale * v.view.x, scale * v.view.y, (far + near) / (far - near) - 2 * far * near / ((far - near) * z_v)};
    if (is("z_v_for_depth")) v.plane.z = z_v;  // which is not linear on the screen
    out.print("project", "vertex", number, "x_p", v.plane.x, "y_p", v.plane.y, "z", v.plane.z);
    double up = camera.window - v.plane.y;
    if (is("y_upside_down")) up = camera.window + v.plane.y;  // y grows upwards on the plane, downwards on the screen
    const double half = is("centres_half_off") ? 0 : 0.5;     // corners of pixels are taken for their centres
    v.screen = {(v.plane.x + window_x) / (2 * window_x) * task.width - half,
                up / (2 * camera.window) * task.height - half, v.plane.z};
    v.seen = true;
    out.print("to_viewport", "vertex", number, "x_s", v.screen.x, "y_s", v.screen.y);
  }

  void view_all() {
    for (const Point& p : task.points) {
      const int number = static_cast<int>(vertices.size());
      Point view = camera.origin + Point{dot(camera.right, p), dot(camera.up, p), dot(camera.away, p)};
      if (is("depth_axis_reversed")) view.z = -view.z;  // as where the camera looks along -z
      vertices.push_back({view, {}, {}});
      out.print("view_vertex", "vertex", number, "x_v", view.x, "y_v", view.y, "z_v", view.z);
      // A vertex before the near plane has no picture. Who does not clip there divides by a z_v that may be negative.
      if (view.z >= camera.near || (is("not_clipped_near") && view.z != 0)) to_screen(number);
    }
  }

  /// Is the front seen? In the four ways of the lecture, of which the third decides.
  bool faces_eye(const Polygon& polygon) {
    Point normal{}, turn{};
    double area = 0;
    const std::size_t n = polygon.corners.size();
    const auto world = [&](std::size_t i) { return task.points[static_cast<std::size_t>(polygon.corners[i % n])]; };
    for (std::size_t i = 0; i < n; ++i) {
      const ViewedVertex &a = vertex(polygon.corners[i]), &b = vertex(polygon.corners[(i + 1) % n]);
      normal = normal + cross(world(i) - world(0), world(i + 1) - world(0));
      turn = turn + cross(a.view, b.view);
      area += a.screen.x * b.screen.y - b.screen.x * a.screen.y;
      if (a.view.z < camera.near) area = NAN;
    }
    const double away = dot(world(0) - camera.eye, normal);
    const double determinant = dot(vertex(polygon.corners[0]).view, turn);
    const double at_eye = dot(normal, camera.eye) - dot(normal, world(0));
    const bool front = is("clockwise_front") ? away > 0 : away < 0;  // the order of the vertices is read the other way
    out.print("facing", "determinant", determinant, "plane_at_eye", at_eye, "view_dot_normal", away,
              "projected_normal_z", area, "facing",
              front       ? "front"
              : away == 0 ? "edge_on"
                          : "back");
    if (!front) reject(polygon, away == 0 ? "edge_on" : "back_facing");
    return front;
  }
  void reject(const Polygon& polygon, const char* why) {
    out.print("reject", "polygon", polygon.number, "reason", why);
  }

  /// How far inside one of the six planes; by z_v, or by w ± x.
  double inside(std::size_t plane, Point v) const {
    const double x = camera.d * v.x / window_x, y = camera.d * v.y / camera.window;
    return std::array{v.z - camera.near, camera.far - v.z, v.z + x, v.z - x, v.z + y, v.z - y}[plane];
  }

  /// Sutherland and Hodgman: against one plane after the other.
  std::vector<int> clipped(const Polygon& polygon) {
    static constexpr std::array names{"near", "far", "left", "right", "bottom", "top"};
    std::vector<int> outline = polygon.corners;
    unsigned some = 0, all = 63;
    for (const int corner : outline) {
      unsigned code = 0;
      for (std::size_t plane = 0; plane < 6; ++plane)
        code |= static_cast<unsigned>(inside(plane, vertex(corner).view) < 0) << plane;
      some |= code, all &= code;
    }
    out.print("clip_test", "outside_some", some, "outside_all", all);
    if (all != 0) return {};
    vertices.resize(task.points.size());  // those of the polygon before are done with
    for (std::size_t plane = is("not_clipped_near") ? 1 : 0; plane < 6; ++plane) {
      if ((some >> plane & 1) == 0) continue;
      std::vector<int> kept;
      for (std::size_t i = 0; i < outline.size(); ++i) {
        const int here = outline[i], next = outline[(i + 1) % outline.size()];
        const double d_here = inside(plane, vertex(here).view), d_next = inside(plane, vertex(next).view);
        out.print("clip_vertex", "plane", names[plane], "vertex", here, "distance", d_here, "inside", d_here >= 0);
        if (d_here >= 0) kept.push_back(here);
        if ((d_here >= 0) != (d_next >= 0)) kept.push_back(cut(names[plane], here, next, d_here, d_next));
      }
      outline = kept;
    }
    return outline;
  }
  int cut(const char* plane, int from, int to, double d_from, double d_to) {
    if (d_from < 0) std::swap(from, to), std::swap(d_from, d_to);
    const double t = d_from / (d_from - d_to);
    const Point a = vertex(from).view, b = vertex(to).view, view = a + t * (b - a);
    const int number = static_cast<int>(vertices.size());
    out.print("clip_cross", "plane", plane, "vertex_inside", from, "vertex_outside", to, "t", t, "vertex", number,
              "x_v", view.x, "y_v", view.y, "z_v", view.z);
    vertices.push_back({view, {}, {}});
    return number;
  }

  void pixel(const Polygon& polygon, int x, int y, double z) {
    double& stored = depth[static_cast<std::size_t>(y * task.width + x)];
    const bool nearer = z < stored;
    out.print("interpolate_z", "x", x, "y", y, "z", z);
    out.print("compare", "x", x, "y", y, "z", z, "nearer", nearer);
    if (!nearer) return;
    stored = z;
    out.print("write_depth", "x", x, "y", y, "z", z);
    out.print("write_pixel", "x", x, "y", y, "polygon", polygon.number);
  }
};

}  // namespace

std::string viewing(const Task& task) {
  Viewer viewer{task};
  viewer.depth.assign(static_cast<std::size_t>(task.width * task.height), INFINITY);
  viewer.out.print("clear", "z", INFINITY);
  viewer.view_all();
  int facet = 0;
  for (const Polygon& polygon : task.polygons) {
    viewer.out.print("polygon", "polygon", polygon.number, "facet", facet++);
    if (!viewer.faces_eye(polygon)) continue;
    const std::vector<int> outline = viewer.clipped(polygon);
    if (outline.size() < 3) {
      viewer.reject(polygon, "outside");
      continue;
    }
    for (const int corner : outline)
      if (!viewer.vertex(corner).seen) viewer.to_screen(corner);
    for (const int corner : outline) viewer.out.print("outline", "vertex", corner);
    std::vector<Point> corners;
    for (const int corner : outline) corners.push_back(viewer.vertex(corner).screen);
    fill(task, corners, [&](int x, int y, double z) { viewer.pixel(polygon, x, y, z); });
  }
  return viewer.out.text;
}

}  // namespace zoo
