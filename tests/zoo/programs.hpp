// Programs as students write them: each draws a scene in its own way and prints what it does, a JSON object a line.
// They share nothing with the engine, and each can be told to make a mistake.
#pragma once

#include <string>
#include <vector>

namespace zoo {

struct Point {
  double x = 0, y = 0, z = 0;
};
struct Polygon {
  int number = 0;
  std::vector<int> corners;  ///< indices of points
  Point color{};             ///< red, green, blue, 0 to 1
};
struct Camera {
  bool there = false;  ///< else points are on the raster already
  Point right, up, away, eye;
  Point origin;  ///< of the world, in view coordinates
  double d = 1, window = 1, near = 0, far = 0;
};
struct Task {
  int width = 0, height = 0;
  std::vector<Point> points;
  std::vector<Polygon> polygons;
  Camera camera{};
  int columns = 0;        ///< of a surface: points come in rows of so many, one curve each
  std::string style{};    ///< what a program does in another, right way; "" for its usual one
  std::string mistake{};  ///< "" for none
  int nth = 0;            ///< where it can be made once: at which place, from 0
};

/// Edge table with buckets, active edges in a list, everything by increments; in float64.
std::string edge_table(const Task& task);
/// A span from the two crossings of each scan line, found anew each time; in float32.
std::string crossings(const Task& task);
/// Inside the three half-planes, depth from the plane, column by column; triangles only.
std::string half_planes(const Task& task);
/// Three edge functions and barycentric weights, in many styles (see there); triangles only, on the raster or by a
/// camera in front of which they all lie.
std::string barycentric(const Task& task);
/// A renderer after OpenGL, Vulkan, Direct3D or tinyrenderer (see there); triangles in front of a camera.
std::string gl(const Task& task);
/// Ray casting. Style "boxes": with a box around each polygon, a little wider; "tight boxes": not any wider.
std::string rays(const Task& task);
/// The scan-line method: edges of all polygons in one table, and a flag for each polygon.
std::string scan_line_flags(const Task& task);
/// All of viewing before a Z-buffer: needs a camera.
std::string viewing(const Task& task);
/// Warnock's areas; on the raster.
std::string areas(const Task& task);
/// The floating horizon, with both horizons and without side edges.
std::string horizon(const Task& task);
/// Depth sort of convex polygons on the raster.
std::string depth_sort(const Task& task);
/// The BSP tree with the first polygon as its root; all polygons must be in view.
std::string bsp(const Task& task);
/// Z-buffers that go through the pixels otherwise, and have inside and depth by other means; the style has a word for
/// each: "rows", "upwards", "columns", "quarters" or "pixels"; "crossings" or "edge_functions"; "plane", "weights" or
/// "span"; "float64" or "float32".
std::string variants(const Task& task);
/// In whole numbers; the style is the bits of a depth, and has "adds" for sums of slopes, "down" for quotients that are
/// rounded down.
std::string fixed_point(const Task& task);

}  // namespace zoo
