#include "sim/viewer/panes/room_pen.hpp"

#include <algorithm>
#include <cmath>

#include "algorithms/fast/z_buffer.hpp"
#include "traces/math/portable_math.hpp"

namespace zstep::viewer {

Picture polygons_seen(const Outside& outside, const Scene& polygons) {
  Picture seen;
  see_polygons(outside, polygons, seen);
  return seen;
}

void see_polygons(const Outside& outside, const Scene& polygons, Picture& seen) {
  Conventions plain;
  plain.cull = false;
  z_buffer::run_fast(outside.seen(polygons), plain, seen);
}

void paint_polygons(Canvas& canvas, const Picture& seen, const std::vector<Pixel32>& colors, Pixel32 paper) {
  if (canvas.width() != seen.width || canvas.height() != seen.height) canvas.resize(seen.width, seen.height);
  for (int y = 0; y < seen.height; ++y) {
    Pixel32* const row = canvas.row(y);
    const std::int32_t* const polygons = seen.polygon.data() + seen.at(0, y);
    for (int x = 0; x < seen.width; ++x)
      row[x] = polygons[x] == no_polygon ? paper : colors[static_cast<std::size_t>(polygons[x])];
  }
}

void RoomPen::line(glm::dvec3 from, glm::dvec3 to, ImU32 color, double thickness, bool dashed) {
  const auto ends = outside_.line(from, to);
  if (!ends) return;
  const Outside::Spot a = (*ends)[0], b = (*ends)[1];
  const double length = portable::length(b.x - a.x, b.y - a.y);
  if (!std::isfinite(length)) return;
  const int parts = static_cast<int>(std::clamp(length / 3, 1.0, 2000.0));
  const auto at = [&](int k) {
    const double t = static_cast<double>(k) / parts;
    return Outside::Spot{a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.depth + (b.depth - a.depth) * t};
  };
  for (int first = 0; first < parts;) {
    const bool behind = hidden(at(first), at(first + 1));
    int last = first + 1;
    while (last < parts && hidden(at(last), at(last + 1)) == behind && !(dashed && (last - first) >= 2)) ++last;
    const Outside::Spot from_here = at(first), to_here = at(last);
    picture_.canvas.line(from_here.x, from_here.y, to_here.x, to_here.y, thickness * thin_, to_pixel(color),
                         behind ? 70 : 255);
    first = last + (dashed ? 2 : 0);
  }
}

void RoomPen::around(const std::vector<glm::dvec3>& corners, ImU32 color, double thickness, bool dashed) {
  for (std::size_t k = 0; k < corners.size(); ++k)
    line(corners[k], corners[(k + 1) % corners.size()], color, thickness, dashed);
}

void RoomPen::dot(glm::dvec3 at, double radius, int shape, ImU32 color) {
  if (const auto spot = outside_.spot(at))
    picture_.canvas.mark(spot->x, spot->y, radius * thin_, shape, to_pixel(color));
}

void RoomPen::word(glm::dvec3 at, const std::string& text, ImU32 color) {
  const auto spot = outside_.spot(at);
  if (spot && spot->x >= 0 && spot->y >= 0 && spot->x < seen_.width && spot->y < seen_.height)
    picture_.words.push_back({{static_cast<float>(spot->x), static_cast<float>(spot->y)}, color, text});
}

void RoomPen::veil(const std::vector<glm::dvec3>& corners, ImU32 color, unsigned share) {
  if (corners.size() < 3) return;
  Scene plane;
  plane.points = corners;
  plane.polygons.resize(1);
  plane.facets.push_back({0, 0, static_cast<std::int32_t>(corners.size())});
  for (std::size_t k = 0; k < corners.size(); ++k) plane.corners.push_back(static_cast<std::int32_t>(k));
  const Picture veil = polygons_seen(outside_, plane);
  for (int y = 0; y < veil.height; ++y)
    for (int x = 0; x < veil.width; ++x) {
      const std::size_t at = veil.at(x, y);
      if (veil.polygon[at] == no_polygon) continue;
      Pixel32& pixel = picture_.canvas.row(y)[x];
      pixel = mixed(pixel, to_pixel(color), veil.depth[at] <= seen_.depth[at] + as_near ? share : share / 5);
    }
}

bool RoomPen::hidden(const Outside::Spot& a, const Outside::Spot& b) const {
  const double x = (a.x + b.x) / 2, y = (a.y + b.y) / 2, depth = (a.depth + b.depth) / 2;
  if (!(x >= 0 && y >= 0 && x < seen_.width && y < seen_.height)) return false;
  return depth > seen_.depth[seen_.at(static_cast<int>(x), static_cast<int>(y))] + as_near;
}

}  // namespace zstep::viewer
