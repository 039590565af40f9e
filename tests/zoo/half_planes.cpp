// A triangle is what lies inside three half-planes, and its depth is a plane: column by column, the last polygon first.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "tests/zoo/programs.hpp"

namespace zoo {

std::string half_planes(const Task& task) {
  std::string out;
  const auto say = [&](const char* format, auto... values) {
    char line[256];
    std::snprintf(line, sizeof line, format, values...);
    out += line;
    out += '\n';
  };
  const auto is = [&](const char* mistake) { return task.mistake == mistake; };
  std::vector<double> depth(static_cast<std::size_t>(task.width) * static_cast<std::size_t>(task.height), INFINITY);
  say("{\"step\":\"clear\",\"z\":\"%s\"}", "inf");
  for (const Polygon& polygon : task.polygons) {
    std::array<Point, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = task.points[static_cast<std::size_t>(polygon.corners[i])];
    double twice_area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
    if (twice_area == 0) continue;
    if (twice_area < 0) std::swap(p[1], p[2]), twice_area = -twice_area;
    say("{\"step\":\"polygon\",\"polygon\":%d,\"facet\":%d}", polygon.number, polygon.number);
    for (int x = 0; x < task.width; ++x) {
      for (int y = 0; y < task.height; ++y) {
        std::array<double, 3> w{};
        bool inside = true;
        for (std::size_t i = 0; i < 3; ++i) {
          const Point &a = p[(i + 1) % 3], &b = p[(i + 2) % 3];
          w[i] = (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
          const bool top = a.y == b.y && b.x > a.x, left = b.y < a.y;
          const bool owned = is("border_for_nobody") ? w[i] > 0
                             : is("border_for_all")  ? w[i] >= 0
                                                     : w[i] > 0 || (w[i] == 0 && (top || left));
          inside = inside && owned;
        }
        if (!inside) continue;
        double z = (w[0] * p[0].z + w[1] * p[1].z + w[2] * p[2].z) / twice_area;
        if (is("weights_turned")) z = (w[0] * p[1].z + w[1] * p[2].z + w[2] * p[0].z) / twice_area;
        double& stored = depth[static_cast<std::size_t>(y * task.width + x)];
        const bool nearer = is("or_equal") ? z <= stored : z < stored;
        say("{\"step\":\"compare\",\"x\":%d,\"y\":%d,\"z\":%.17g,\"nearer\":%s}", x, y, z, nearer ? "true" : "false");
        if (!nearer) continue;
        stored = z;
        say("{\"step\":\"wz\",\"x\":%d,\"y\":%d,\"z\":%.17g}", x, y, is("half_the_depth") ? z / 2 : z);
        say("{\"step\":\"wp\",\"x\":%d,\"y\":%d,\"polygon\":%d}", x, y, polygon.number);
      }
    }
  }
  return out;
}

}  // namespace zoo
