// The BSP tree: the plane of the first polygon divides the others into those before it and those behind it, and so on.
// From an eye the far side is drawn first, then the node, then the near side. All polygons must be in view.
#include "tests/zoo/pieces.hpp"

namespace zoo {
namespace {

struct WorldPiece {
  int polygon;
  std::vector<int> corners;
  Point n;
  double d;
};
struct TreeOfPieces {
  std::vector<int> pieces;  // of the node: the one that divides, and what lies in its plane
  int front = -1, back = -1;
};

struct Divider {
  const Task& task;
  Output out{};
  std::vector<Point> points = task.points;
  std::vector<WorldPiece> pieces{};
  std::vector<TreeOfPieces> nodes{};
  std::vector<Point> screen{};
  int drawn = 0;

  bool is(const char* mistake) const { return task.mistake == mistake; }
  WorldPiece& piece(int number) { return pieces[static_cast<std::size_t>(number)]; }
  const Point& point(int number) const { return points[static_cast<std::size_t>(number)]; }
  double value(const WorldPiece& plane, int vertex) const { return dot(plane.n, point(vertex)) + plane.d; }

  void gather() {
    out.print("tables", "polygons", static_cast<int>(task.polygons.size()));
    for (const Polygon& polygon : task.polygons) {
      const int number = static_cast<int>(pieces.size());
      out.print("polygon", "polygon", polygon.number, "facet", number);
      for (const int corner : polygon.corners) out.print("corner", "vertex", corner);
      out.print("make", "piece", number, "polygon", polygon.number, "parent", -1);
      const Point p = point(polygon.corners[0]);
      const Point n = cross(point(polygon.corners[1]) - p, point(polygon.corners[2]) - p);
      pieces.push_back({polygon.number, polygon.corners, n, -dot(n, p)});
    }
  }

  std::string side_of(int number, int root) {
    double least = INFINITY, greatest = -INFINITY;
    const auto word = [](double low, double high) {
      const bool behind = low<-1e-9, front = high> 1e-9;
      return behind && front ? "crossing" : behind ? "behind" : front ? "front" : "on";
    };
    for (const int corner : piece(number).corners) {
      const double at = value(piece(root), corner);
      out.print("vertex_side", "vertex", corner, "plane_of", root, "value", at, "side", word(at, at));
      least = std::min(least, at), greatest = std::max(greatest, at);
    }
    out.print("side", "piece", number, "plane_of", root, "least", least, "greatest", greatest, "side",
              word(least, greatest));
    return word(least, greatest);
  }

  void cut(int number, int root, std::vector<int>& front, std::vector<int>& back) {
    const WorldPiece plane = piece(root), whole = piece(number);
    const char* space = task.camera.there ? "world" : "raster";
    const auto parts = cut_outline(
        whole.corners, [&](int corner) { return value(plane, corner); },
        [&](int from, int to, double t) {
          const Point made = point(from) + t * (point(to) - point(from));
          const int vertex = static_cast<int>(points.size());
          out.print("cut", "vertex_0", from, "vertex_1", to, "t", t, "vertex", vertex, "space", space, "x_cut", made.x,
                    "y_cut", made.y, "z_cut", made.z);
          points.push_back(made);
          return vertex;
        });
    for (const bool positive : {true, false}) {
      WorldPiece part = whole;
      part.corners = positive ? parts.first : parts.second;
      for (const int corner : part.corners) out.print("cutting.outline", "vertex", corner);
      const int made = static_cast<int>(pieces.size());
      out.print("part", "piece", made, "polygon", part.polygon, "parent", number);
      (positive ? front : back).push_back(made);
      pieces.push_back(part);
    }
  }

  int build(const std::vector<int>& all, int parent, bool at_front) {
    if (all.empty()) return -1;
    const int node = static_cast<int>(nodes.size()), root = all[0];
    out.print("node", "node", node, "parent", parent, "front", at_front, "piece", root);
    const WorldPiece plane = piece(root);
    out.print("plane", "piece", root, "plane_a", plane.n.x, "plane_b", plane.n.y, "plane_c", plane.n.z, "plane_d",
              plane.d);
    nodes.push_back({{root}});
    std::vector<int> front, back;
    for (const int other : all) {
      if (other == root) continue;
      const std::string side = side_of(other, root);
      if (side == "on") {
        nodes[static_cast<std::size_t>(node)].pieces.push_back(other);
        out.print("add", "node", node, "piece", other);
      } else if (side == "crossing" && !is("spanning_not_split")) {
        cut(other, root, front, back);
      } else {
        (side == "behind" ? back : front).push_back(other);  // not split, it is put whole on the front side
      }
    }
    const int before = build(front, node, true), behind = build(back, node, false);
    nodes[static_cast<std::size_t>(node)].front = before;
    nodes[static_cast<std::size_t>(node)].back = behind;
    return node;
  }

  void draw(int number) {
    if (number < 0) return;
    const TreeOfPieces node = nodes[static_cast<std::size_t>(number)];
    const WorldPiece plane = piece(node.pieces[0]);
    // On the raster the eye is far away, in the direction of -z, and D does not matter.
    double value = task.camera.there ? dot(plane.n, task.camera.eye) + plane.d : -plane.n.z;
    if (is("side_by_normal")) value = dot(plane.n, task.camera.eye);  // which way the normal turns is not enough
    const bool eye_in_front = value > 0;
    out.print("eye_side", "node", number, "value", value, "front", eye_in_front);
    const bool front_first = is("near_side_first") ? eye_in_front : !eye_in_front;
    draw(front_first ? node.front : node.back);
    // Of those in one plane the first one of the scene is to be seen, so it is drawn last.
    std::vector<int> parts = node.pieces;
    std::sort(parts.begin(), parts.end(), [&](int a, int b) { return piece(a).polygon > piece(b).polygon; });
    for (const int part : parts) {
      if (is("cleared_again") && drawn++ == 1) out.print("clear", "z", INFINITY);  // and the first piece is lost
      out.print("draw", "piece", part, "polygon", piece(part).polygon);
      std::vector<Point> outline;
      for (const int corner : piece(part).corners) {
        out.print("clipping.outline", "vertex", corner);
        outline.push_back(screen[static_cast<std::size_t>(corner)]);
      }
      fill(task, outline,
           [&](int x, int y, double z) { out.print("paint", "x", x, "y", y, "z", z, "polygon", piece(part).polygon); });
    }
    draw(front_first ? node.back : node.front);
  }
};

}  // namespace

std::string bsp(const Task& task) {
  Divider divider{task};
  divider.gather();
  std::vector<int> all;
  for (std::size_t i = 0; i < divider.pieces.size(); ++i) all.push_back(static_cast<int>(i));
  divider.build(all, -1, false);
  divider.out.print("clear", "z", INFINITY);
  for (const Point& p : divider.points)
    divider.screen.push_back(see(task, divider.out, static_cast<int>(divider.screen.size()), p));
  divider.draw(0);
  return divider.out.text;
}

}  // namespace zoo
