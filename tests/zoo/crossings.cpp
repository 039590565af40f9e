// No tables: for each scan line, from the last to the first, the crossings with the polygon's edges, in float32; pixels
// from right to left.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/zoo/programs.hpp"

namespace zoo {
namespace {

struct Crossing {
  float x, z;
};

}  // namespace

std::string crossings(const Task& task) {
  std::string out;
  const auto say = [&](const char* format, auto... values) {
    char line[256];
    std::snprintf(line, sizeof line, format, values...);
    out += line;
    out += '\n';
  };
  const auto is = [&](const char* mistake) { return task.mistake == mistake; };
  std::vector<float> depth(static_cast<std::size_t>(task.width) * static_cast<std::size_t>(task.height), INFINITY);
  int pixels = 0;
  say("{\"step\":\"clear\",\"z\":\"%s\"}", "inf");
  for (const Polygon& polygon : task.polygons) {
    say("{\"step\":\"polygon\",\"polygon\":%d,\"facet\":%d}", polygon.number, polygon.number);
    for (int y = task.height - 1; y >= 0; --y) {
      std::vector<Crossing> crossings;
      const std::size_t n = polygon.corners.size();
      for (std::size_t i = 0; i < n; ++i) {
        const Point& p = task.points[static_cast<std::size_t>(polygon.corners[i])];
        const Point& q = task.points[static_cast<std::size_t>(polygon.corners[(i + 1) % n])];
        const double top = std::min(p.y, q.y), bottom = std::max(p.y, q.y);
        const bool meets = is("both_ends_met") ? top <= y && y <= bottom : top <= y && y < bottom;
        if (!meets || p.y == q.y) continue;
        const float t = (static_cast<float>(y) - static_cast<float>(p.y)) / static_cast<float>(q.y - p.y);
        const float u = is("z_along_x") ? t * t : t;
        crossings.push_back({static_cast<float>(p.x) + t * static_cast<float>(q.x - p.x),
                             static_cast<float>(p.z) + u * static_cast<float>(q.z - p.z)});
      }
      std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) { return a.x < b.x; });
      for (std::size_t pair = 0; pair + 1 < crossings.size(); pair += 2) {
        const Crossing left = crossings[pair], right = crossings[pair + 1];
        for (int x = std::min(task.width, static_cast<int>(std::ceil(right.x))) - 1;
             x >= std::max(0, static_cast<int>(std::ceil(left.x))); --x) {
          const float share = (static_cast<float>(x) - left.x) / (right.x - left.x);
          float z = left.z + share * (right.z - left.z);
          if (is("z_from_the_right")) z = right.z + share * (left.z - right.z);
          if (is("z_of_the_line")) z = left.z;
          if (is("one_depth_off") && pixels++ == task.nth) z += 0.01f;
          float& stored = depth[static_cast<std::size_t>(y * task.width + x)];
          const bool nearer = is("farther_wins") ? z > stored || std::isinf(stored) : z < stored;
          say("{\"step\":\"z\",\"x\":%d,\"y\":%d,\"z\":%.9g}", x, y, static_cast<double>(z));
          say("{\"step\":\"compare\",\"x\":%d,\"y\":%d,\"z\":%.9g,\"nearer\":%s}", x, y, static_cast<double>(z),
              nearer ? "true" : "false");
          if (!nearer) continue;
          if (!is("depth_kept")) stored = z;
          say("{\"step\":\"wz\",\"x\":%d,\"y\":%d,\"z\":%.9g}", x, y, static_cast<double>(z));
          say("{\"step\":\"wp\",\"x\":%d,\"y\":%d,\"polygon\":%d}", x, y,
              is("colour_of_the_next") ? (polygon.number + 1) % static_cast<int>(task.polygons.size())
                                       : polygon.number);
        }
      }
    }
  }
  return out;
}

}  // namespace zoo
