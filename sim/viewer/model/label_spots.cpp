
#include "sim/viewer/model/label_spots.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "sim/words/explain.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/math/whole.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {
namespace {

/// The pixels that a map shows at least half of.
struct SeenPart {
  int left, right, low, high;  ///< the last ones exclusive
  int every = 1;               ///< of columns and rows one in so many is looked at, where there are very many
  int width() const { return (right - left + every - 1) / every; }
  int height() const { return (high - low + every - 1) / every; }
};

SeenPart seen_part_of(const RasterMap& map) {
  const auto first = [&](double begin) { return std::max(0, ceil_int(-begin / map.cell - 0.5)); };
  const auto end = [&](double begin, int box, int count) {
    return std::min(count, floor_int((box - begin) / map.cell + 0.5));
  };
  SeenPart seen{first(map.left), end(map.left, map.box_width, map.width), first(map.top),
                end(map.top, map.box_height, map.height)};
  if (map.y_up) seen = {seen.left, seen.right, map.height - seen.high, map.height - seen.low};
  constexpr double enough = 40'000;
  const double pixels = std::max(0, seen.right - seen.left) * static_cast<double>(std::max(0, seen.high - seen.low));
  seen.every = pixels <= enough ? 1 : ceil_int(std::sqrt(pixels / enough));
  return seen;
}

/// How many pixels in every direction have the same polygon: 1 at its border. Two passes over the window.
std::vector<int> depth_inside(const Picture& picture, const SeenPart& seen) {
  const int width = seen.width(), height = seen.height();
  std::vector<int> inside(pixel_count(width, height), 0);
  const auto polygon = [&](int x, int y) {
    return picture.polygon[picture.at(seen.left + x * seen.every, seen.low + y * seen.every)];
  };
  const auto at = [&](int x, int y) -> int& { return inside[pixel_at(x, y, width)]; };
  const auto beyond = [&](int x, int y, int to_x, int to_y) {
    const bool there = to_x >= 0 && to_y >= 0 && to_x < width && to_y < height;
    return there && polygon(to_x, to_y) == polygon(x, y) ? at(to_x, to_y) : 0;
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      at(x, y) = 1 + std::min({beyond(x, y, x - 1, y), beyond(x, y, x - 1, y - 1), beyond(x, y, x, y - 1),
                               beyond(x, y, x + 1, y - 1)});
  for (int y = height; y-- > 0;)
    for (int x = width; x-- > 0;)
      at(x, y) = std::min(at(x, y), 1 + std::min({beyond(x, y, x + 1, y), beyond(x, y, x + 1, y + 1),
                                                  beyond(x, y, x, y + 1), beyond(x, y, x - 1, y + 1)}));
  return inside;
}

struct Best {
  int depth = 0;
  std::int64_t pixels = 0, ties = 0, sum_x = 0, sum_y = 0;
  double distance = INFINITY;
  Cell cell;
};

}  // namespace

void find_label_spots(std::vector<LabelSpot>& spots, const RasterMap& map, const Picture& picture) {
  spots.clear();
  const SeenPart seen = seen_part_of(map);
  if (seen.width() <= 0 || seen.height() <= 0 || picture.width != map.width || picture.height != map.height) return;
  const std::vector<int> inside = depth_inside(picture, seen);
  std::map<std::int32_t, Best> best;
  const auto each = [&](auto&& visit) {
    std::size_t i = 0;
    for (int y = seen.low; y < seen.high; y += seen.every)
      for (int x = seen.left; x < seen.right; x += seen.every, ++i)
        if (const std::int32_t polygon = picture.polygon[picture.at(x, y)]; polygon >= 0)
          visit(best[polygon], inside[i], x, y);
  };
  each([](Best& one, int depth, int x, int y) {
    ++one.pixels;
    if (depth > one.depth) one = {depth, one.pixels, 0, 0, 0, INFINITY, {}};
    if (depth == one.depth) ++one.ties, one.sum_x += x, one.sum_y += y;
  });
  // Of pixels that lie as far inside, the one nearest to the middle of them.
  each([](Best& one, int depth, int x, int y) {
    if (depth != one.depth) return;
    const double distance = portable::length(x - ratio(one.sum_x, one.ties), y - ratio(one.sum_y, one.ties));
    if (distance < one.distance) one.distance = distance, one.cell = {x, y};
  });
  for (const auto& [polygon, one] : best) spots.push_back({polygon, one.cell, one.pixels * seen.every * seen.every});
  std::stable_sort(spots.begin(), spots.end(),
                   [](const LabelSpot& a, const LabelSpot& b) { return a.pixels > b.pixels; });
}

void find_label_spots(std::vector<LabelSpot>& spots, const RasterMap& map, const Moment& moment) {
  find_label_spots(spots, map, moment.picture());
}

namespace {

/// Marks the lines of the block in which a line stands; how many others there are.
std::size_t show_block(const Page& page, std::size_t line, std::vector<bool>& shown) {
  std::size_t first = line, last = line, others = 0;
  while (first > 0 && page[first - 1].indent >= page[line].indent) --first;
  while (last + 1 < page.size() && page[last + 1].indent >= page[line].indent) ++last;
  for (std::size_t i = first; i <= last; ++i) {
    if (page[i].indent != page[line].indent) continue;
    shown[i] = true;
    others += i != line;
  }
  return others;
}

}  // namespace

std::vector<bool> lines_near(const Page& page, std::size_t now) {
  std::vector<bool> shown(page.size(), false);
  bool alone = show_block(page, now, shown) == 0;
  for (std::size_t i = now + 1; i < page.size() && page[i].indent > page[now].indent; ++i) shown[i] = true;
  std::uint8_t indent = page[now].indent;
  for (std::size_t i = now; i-- > 0;) {
    if (page[i].indent >= indent) continue;
    indent = page[i].indent;
    shown[i] = true;
    if (alone) alone = show_block(page, i, shown) == 0;
  }
  return shown;
}

std::string why_no_lines(const Trace& trace, const ScanLineMarks::Interval& interval, std::int64_t position) {
  if (!trace.has(kind_of<ScanLineBegin>)) return "this run records no scan lines";
  if (trace.polygon_at_work(position) == no_polygon) return "no polygon is at work here, and so no scan line";
  const std::string polygon = "polygon " + polygon_label(trace.scene(), interval.polygon);
  const auto later = [&](const PolygonMark& mark) {
    return mark.polygon == interval.polygon && mark.position > interval.first;
  };
  const auto rejected = [&](const RejectMark& mark) {
    return mark.polygon == interval.polygon && mark.position > interval.first && mark.position <= interval.last;
  };
  if (const auto all = trace.rejects(); std::any_of(all.begin(), all.end(), rejected))
    return polygon + " is not drawn here: no scan lines";
  if (const auto all = trace.polygons(); std::any_of(all.begin(), all.end(), later))
    return "no scan lines of " + polygon + " yet";
  return polygon + " has no scan line in this run";  // whether it meets any, the run need not say
}

}  // namespace zstep::viewer
