// Drawing into a scene that is seen from outside: its polygons, and among them lines, arrows and words, faint where a
// polygon hides them.
#include "sim/viewer/panes/scene_in_space.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "algorithms/fast/z_buffer.hpp"
#include "traces/scene.hpp"

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
    for (int x = 0; x < seen.width; ++x) row[x] = polygons[x] == no_polygon ? paper : colors[polygons[x]];
  }
}

bool paint_with_glass(Canvas& canvas, const Outside& outside, const Scene& polygons, const std::vector<Pixel32>& colors,
                      Pixel32 paper) {
  constexpr std::ptrdiff_t most_glass = 16;
  const auto is_glass = [&](const Facet& facet) { return polygons.polygons[facet.polygon].material->opacity < 1; };
  const auto count = std::count_if(polygons.facets.begin(), polygons.facets.end(), is_glass);
  if (count == 0 || count > most_glass) return false;
  Scene part = polygons;
  std::erase_if(part.facets, is_glass);
  const Picture behind = polygons_seen(outside, part);
  paint_polygons(canvas, behind, colors, paper);
  std::vector<std::pair<double, Picture>> panes;  // by their mean depths
  for (const Facet& facet : polygons.facets) {
    if (!is_glass(facet)) continue;
    part.facets = {facet};
    Picture seen = polygons_seen(outside, part);
    double sum = 0, pixels = 0;
    for (std::size_t at = 0; at < seen.polygon.size(); ++at)
      if (seen.polygon[at] != no_polygon) sum += seen.depth[at], ++pixels;
    if (pixels > 0) panes.emplace_back(sum / pixels, std::move(seen));
  }
  std::stable_sort(panes.begin(), panes.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  for (const auto& [depth, seen] : panes)
    for (int y = 0; y < seen.height; ++y)
      for (int x = 0; x < seen.width; ++x) {
        const std::size_t at = seen.at(x, y);
        const std::int32_t polygon = seen.polygon[at];
        if (polygon == no_polygon || seen.depth[at] > behind.depth[at] + as_near) continue;
        const double share = 255 * std::clamp(polygons.polygons[polygon].material->opacity, 0.0, 1.0);
        canvas.row(y)[x] = mixed(canvas.row(y)[x], colors[polygon], static_cast<unsigned>(share));
      }
  return true;
}

void RoomPen::line(glm::dvec3 from, glm::dvec3 to, ImU32 color, double thickness, bool dashed, bool through) {
  const auto ends = outside_.line(from, to);
  if (!ends) return;
  const Outside::Spot a = (*ends)[0], b = (*ends)[1];
  const double length = portable::length(b.x - a.x, b.y - a.y);
  if (!std::isfinite(length)) return;
  const int parts = static_cast<int>(std::clamp(length / 3, 1.0, 2000.0));
  const auto at = [&](int k) {
    const double t = ratio(k, parts);
    return Outside::Spot{a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.depth + (b.depth - a.depth) * t};
  };
  for (int first = 0; first < parts;) {
    const bool behind = hidden(at(first), at(first + 1));
    int last = first + 1;
    while (last < parts && hidden(at(last), at(last + 1)) == behind && !(dashed && (last - first) >= 2)) ++last;
    const Outside::Spot from_here = at(first), to_here = at(last);
    picture_.canvas.line(from_here.x, from_here.y, to_here.x, to_here.y, thickness * thin_, to_pixel(color),
                         behind ? (through ? 170 : 70) : 255);
    first = last + (dashed ? 2 : 0);
  }
}

void RoomPen::arrow(glm::dvec3 from, glm::dvec3 to, ImU32 color, const std::string& name) {
  line(from, to, color, 2.4);
  const auto foot = outside_.spot(from), tip = outside_.spot(to);
  const glm::dvec2 way = foot && tip ? glm::dvec2(tip->x - foot->x, tip->y - foot->y) : glm::dvec2(0);
  if (!(glm::length(way) > 1)) return;
  const glm::dvec2 back = glm::normalize(way) * (9 * thin_), across = 0.45 * glm::dvec2(-back.y, back.x);
  for (const double side : {1.0, -1.0})
    picture_.canvas.line(tip->x, tip->y, tip->x - back.x + side * across.x, tip->y - back.y + side * across.y,
                         2.4 * thin_, to_pixel(color));
  if (!name.empty()) word(to + 0.06 * (to - from), name, color);
}

void RoomPen::around(const std::vector<glm::dvec3>& corners, ImU32 color, double thickness, bool dashed) {
  for (std::size_t k = 0; k < corners.size(); ++k)
    line(corners[k], corners[(k + 1) % corners.size()], color, thickness, dashed);
}

void RoomPen::dot(glm::dvec3 at, double radius, int shape, ImU32 color) {
  if (const auto spot = outside_.spot(at))
    picture_.canvas.mark(spot->x, spot->y, radius * thin_, shape, to_pixel(color));
}

bool RoomPen::word(glm::dvec3 at, const std::string& text, ImU32 color, bool first) {
  const auto spot = outside_.spot(at);
  if (!spot || !(spot->x >= 0 && spot->y >= 0 && spot->x < seen_.width && spot->y < seen_.height)) return false;
  const ImVec2 place{static_cast<float>(spot->x), static_cast<float>(spot->y)};
  for (ChartPicture::Word& other : picture_.words)  // of two names of one point the fuller one
    if (other.at.x == place.x && other.at.y == place.y) {
      if (text.size() > other.text.size()) other = {place, color, text, first || other.first};
      return true;
    }
  picture_.words.push_back({place, color, text, first});
  return true;
}

void RoomPen::veil(const std::vector<glm::dvec3>& corners, ImU32 color, unsigned share) {
  if (corners.size() < 3) return;
  Scene plane;
  plane.points = corners;
  plane.polygons.resize(1);
  plane.facets.push_back({0, 0, size32(corners)});
  for (std::size_t k = 0; k < corners.size(); ++k) plane.corners.push_back(index32(k));
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
