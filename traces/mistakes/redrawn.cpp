#include "traces/mistakes/redrawn.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace zstep::mistakes {

using formulas::DrawnCorner, formulas::DrawnFacet;
using enum Mistake;

namespace {

/// What a mistake changes, in how many ways a program makes it, and in how many ways with one facet.
struct Made {
  Mistake mistake;
  Changes changes;
  int variants = 1, choices = 1;
};
constexpr std::array made_in_pixels{
    Made{z_v_for_depth, Changes::depths},
    Made{y_upside_down, Changes::places},
    Made{centres_half_off, Changes::places, 8},
    Made{clockwise_front, Changes::facing},
    Made{compare_reversed, Changes::buffer},
    Made{equal_wins, Changes::buffer},
    Made{buffer_begins_at_0, Changes::buffer},
    Made{depth_not_written, Changes::buffer},
    Made{depth_always, Changes::buffer},
    Made{colour_not_written, Changes::colours},
    Made{colour_always, Changes::colours},
    Made{x_y_exchanged, Changes::places},
    Made{picture_mirrored, Changes::places},
    Made{one_pixel_off, Changes::places, 4},
    Made{vertices_rounded, Changes::places},
    Made{vertices_truncated, Changes::places},
    Made{window_taken_for_square, Changes::places},
    Made{one_winding_only, Changes::facing, 2},
    Made{border_for_nobody, Changes::inside},
    Made{border_for_both, Changes::inside},
    Made{border_for_other_side, Changes::inside},
    Made{edge_not_asked, Changes::inside, 1, 3},
    Made{box_too_small, Changes::inside, 3},
    Made{inside_margin, Changes::inside, 2},
    Made{area_not_doubled, Changes::depths, 2, 4},
    Made{area_not_divided_by, Changes::depths, 2},
    Made{weights_exchanged, Changes::depths, 1, 3},
    Made{weights_turned, Changes::depths, 1, 2},
    Made{weight_negative, Changes::depths, 1, 3},
    Made{weight_left_out, Changes::depths, 1, 3},
    Made{vertex_depth_twice, Changes::depths, 1, 6},
    Made{depth_of_one_vertex, Changes::depths, 1, 3},
    Made{depth_is_mean, Changes::depths},
    Made{depth_truncated, Changes::depths, 2},
    Made{depth_by_reciprocals, Changes::depths},
    Made{stride_is_height, Changes::buffer},
    Made{colour_of_next, Changes::colours},
    Made{colour_beside, Changes::colours, 4},
};
const Made* made_as(Mistake mistake) {
  const auto found = std::find_if(made_in_pixels.begin(), made_in_pixels.end(),
                                  [&](const Made& one) { return one.mistake == mistake; });
  return found == made_in_pixels.end() ? nullptr : &*found;
}

double twice_area(std::span<const DrawnCorner> outline) {
  double twice = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const DrawnCorner &p = outline[i], &q = outline[(i + 1) % outline.size()];
    twice += (p.x - outline[0].x) * (q.y - outline[0].y) - (q.x - outline[0].x) * (p.y - outline[0].y);
  }
  return twice;
}

/// Where a vertex comes to.
void move(const Way& way, const Raster& raster, DrawnCorner& p) {
  const double width = raster.width, height = raster.height;
  const auto whole = [&](double (*rounded)(double)) { p.x = rounded(p.x), p.y = rounded(p.y), p.off_x = p.off_y = 0; };
  switch (way.mistake) {
    case y_upside_down:
      p.y = height - 1 - p.y;
      break;
    case picture_mirrored:
      p.x = width - 1 - p.x;
      break;
    case x_y_exchanged:
      std::swap(p.x, p.y), std::swap(p.off_x, p.off_y);
      break;
    case centres_half_off: {  // in both directions, or in one
      constexpr std::array<std::pair<double, double>, 8> by{
          {{0.5, 0.5}, {-0.5, -0.5}, {0.5, 0}, {-0.5, 0}, {0, 0.5}, {0, -0.5}, {0.5, -0.5}, {-0.5, 0.5}}};
      p.x += by[static_cast<std::size_t>(way.variant)].first, p.y += by[static_cast<std::size_t>(way.variant)].second;
      break;
    }
    case one_pixel_off:
      (way.variant < 2 ? p.x : p.y) += way.variant % 2 == 0 ? 1 : -1;
      break;
    case vertices_rounded:
      whole([](double x) { return std::round(x); });
      break;
    case vertices_truncated:
      whole([](double x) { return std::trunc(x); });
      break;
    case window_taken_for_square:
      p.x = (p.x + 0.5 - width / 2) * width / height + width / 2 - 0.5;
      p.off_x *= width / height;
      break;
    default:
      break;
  }
}

/// Depths at the corners of a triangle.
void change_depths(const Way& way, int choice, std::span<DrawnCorner> p) {
  const auto k = static_cast<std::size_t>(choice);
  const auto take = [](DrawnCorner& to, const DrawnCorner& from) { to.z = from.z, to.off_z = from.off_z; };
  const auto times = [](DrawnCorner& corner, double factor) { corner.z *= factor, corner.off_z *= std::abs(factor); };
  const auto exchange = [](DrawnCorner& one, DrawnCorner& other) {
    std::swap(one.z, other.z), std::swap(one.off_z, other.off_z);
  };
  const double twice = std::abs(twice_area(p));
  double last = 0;
  switch (way.mistake) {
    case weights_exchanged:
      exchange(p[k], p[(k + 1) % 3]);
      break;
    case weights_turned:
      exchange(p[0], p[1 + k]), exchange(p[1], p[2]);
      break;
    case weight_negative:
      times(p[k], -1);
      break;
    case weight_left_out:
      times(p[k], 0);
      break;
    case vertex_depth_twice:
      take(p[k / 2], p[(k / 2 + 1 + k % 2) % 3]);
      break;
    case depth_of_one_vertex:
      for (DrawnCorner& one : p) take(one, DrawnCorner(p[k]));
      break;
    case depth_is_mean: {
      const double mean = (p[0].z + p[1].z + p[2].z) / 3, off = std::max({p[0].off_z, p[1].off_z, p[2].off_z});
      for (DrawnCorner& one : p) one.z = mean, one.off_z = off;
      break;
    }
    case area_not_doubled:
      // Where the last weight is what the others leave of 1, only those are too large.
      if (k > 0) last = p[k - 1].z;
      for (DrawnCorner& one : p) {
        const double factor = way.variant == 0 ? 2 : 0.5;
        times(one, factor);
        one.z += (1 - factor) * last;
      }
      break;
    case area_not_divided_by:
      for (DrawnCorner& one : p) times(one, way.variant == 0 ? twice : twice / 2);
      break;
    case depth_by_reciprocals:
      for (DrawnCorner& one : p) one.off_z /= one.z * one.z, one.z = 1 / one.z;
      break;
    default:
      break;
  }
}

/// Of an outline without one of its edges: the two others go on beyond the picture.
std::vector<DrawnCorner> without_edge(std::span<const DrawnCorner> triangle, std::size_t edge, const Raster& raster) {
  const DrawnCorner &apex = triangle[(edge + 2) % 3], &one = triangle[edge], &other = triangle[(edge + 1) % 3];
  const auto far_from_apex = [&](const DrawnCorner& p) {
    return std::max(std::abs(p.x - apex.x), std::abs(p.y - apex.y));
  };
  constexpr double shortest = 1e-3;
  const double least = std::max(shortest, std::min(far_from_apex(one), far_from_apex(other)));
  double reach = raster.width + raster.height, times = 1;
  for (const DrawnCorner& p : triangle) reach = std::max({reach, std::abs(p.x), std::abs(p.y)});
  while (times * least < 4 * reach) times *= 2;
  const auto beyond = [&](const DrawnCorner& p) {
    DrawnCorner far = p;
    far.x = apex.x + (p.x - apex.x) * times, far.y = apex.y + (p.y - apex.y) * times;
    far.off_x *= times, far.off_y *= times;
    return far;
  };
  return {apex, beyond(one), beyond(other)};
}

const Way* way_that(std::span<const Way> ways, Changes changes) {
  const auto found =
      std::find_if(ways.begin(), ways.end(), [&](const Way& way) { return changes_of(way.mistake) == changes; });
  return found == ways.end() ? nullptr : &*found;
}

}  // namespace

std::optional<Changes> changes_of(Mistake mistake) {
  const Made* made = made_as(mistake);
  return made ? std::optional(made->changes) : std::nullopt;
}

std::span<const Way> ways_to_draw() {
  static const std::vector<Way> all = [] {
    std::vector<Way> ways;
    for (const Mistake mistake : values_of<Mistake>)
      if (const Made* made = made_as(mistake))
        for (int variant = 0; variant < made->variants; ++variant) ways.push_back({mistake, variant});
    return ways;
  }();
  return all;
}

int Redrawn::choices(std::span<const Way> ways) {
  int choices = 1;
  for (const Way& way : ways) choices *= made_as(way.mistake)->choices;
  return choices;
}

bool Redrawn::is_left_out(const DrawnFacet& right, std::span<const Way> ways, bool cull, const Given& given) {
  const Way* way = way_that(ways, Changes::facing);
  if (!way) return cull && right.faces_away();
  if (way->mistake == clockwise_front)
    return cull && given.scene.camera.kind != Camera::Kind::screen && !right.faces_away();
  return is_clockwise(right) == (way->variant == 0) || (cull && right.faces_away());
}

bool Redrawn::is_clockwise(const DrawnFacet& right) { return twice_area(right.outline()) > 0; }

bool Redrawn::may_meet(const DrawnFacet& right, std::span<const Way> ways, Rows rows, const Given& given) {
  const Way* places = way_that(ways, Changes::places);
  double top = std::numeric_limits<double>::infinity(), bottom = -top;
  for (DrawnCorner corner : right.outline()) {
    if (places) move(*places, given.scene.raster, corner);
    top = std::min(top, corner.y - corner.off_y), bottom = std::max(bottom, corner.y + corner.off_y);
  }
  constexpr double beside = 2;  // as conventions of coverage, and the ends of a box, may have it
  return top - beside < rows.end && bottom + beside >= rows.first;
}

bool Redrawn::is_known(const DrawnFacet& right, std::span<const Way> ways, const Given& given) {
  const Conventions::Depth depth = given.header.conventions.depth;
  return std::all_of(ways.begin(), ways.end(), [&](const Way& way) {
    switch (way.mistake) {
      case z_v_for_depth:
        return given.scene.camera.kind == Camera::Kind::perspective && depth != Conventions::Depth::view;
      case depth_by_reciprocals:
      case depth_truncated:
        return depth != Conventions::Depth::corrected;
      case edge_not_asked:
      case inside_margin:
        return right.outline().size() == 3;
      default:
        return true;
    }
  });
}

std::optional<Redrawn> Redrawn::of(const DrawnFacet& right, std::span<const Way> ways, int choice, const Given& given) {
  if (!is_known(right, ways, given)) return std::nullopt;
  const Way *places = way_that(ways, Changes::places), *inside = way_that(ways, Changes::inside),
            *depths = way_that(ways, Changes::depths);
  const int choices_inside = inside ? made_as(inside->mistake)->choices : 1;
  std::vector<DrawnCorner> outline(right.outline().begin(), right.outline().end());
  if (places)
    for (DrawnCorner& corner : outline) move(*places, given.scene.raster, corner);
  Redrawn redrawn(right, given.scene.raster);
  if (places || inside)
    if (!redrawn.find_inside(outline, inside, choice % choices_inside, given)) return std::nullopt;
  if (!places && !depths) redrawn.depths_ = {right};
  else if (!redrawn.find_depths(std::move(outline), depths, choice / choices_inside, given)) return std::nullopt;
  const bool divides = given.header.conventions.depth == Conventions::Depth::corrected;
  if (divides && !(depths && depths->mistake == z_v_for_depth)) redrawn.after_ = After::reciprocal;
  return redrawn;
}

namespace {

std::optional<DrawnFacet> drawn(std::vector<DrawnCorner> outline, const Header& header, const Given& given) {
  return DrawnFacet::from_run(given.scene, header, std::move(outline), given.roundoff);
}

}  // namespace

bool Redrawn::find_inside(const std::vector<DrawnCorner>& outline, const Way* way, int choice, const Given& given) {
  double least_x = outline[0].x, most_x = least_x, least_y = outline[0].y, most_y = least_y;
  for (const DrawnCorner& p : outline) {
    least_x = std::min(least_x, p.x), most_x = std::max(most_x, p.x);
    least_y = std::min(least_y, p.y), most_y = std::max(most_y, p.y);
  }
  const Box most{std::floor(least_x), std::ceil(most_x), std::floor(least_y), std::ceil(most_y)},
      least{std::ceil(least_x), std::floor(most_x), std::ceil(least_y), std::floor(most_y)};
  Header header = given.header;
  std::vector<DrawnCorner> border = outline;
  bool for_nobody = false;
  if (way) {
    const double twice = twice_area(outline);
    switch (way->mistake) {
      case border_for_nobody:
        for_nobody = true;
        break;
      case border_for_both:
        header.conventions.coverage = Conventions::Coverage::inclusive;
        break;
      case border_for_other_side:
        is_turned_ = true;
        break;
      case edge_not_asked:
        border = without_edge(outline, static_cast<std::size_t>(choice), given.scene.raster);
        box_ = least, box_at_most_ = most;
        break;
      case inside_margin:
        margin_ = Margin{{outline[0], outline[1], outline[2]}, way->variant == 0 ? twice : std::copysign(1.0, twice)};
        box_ = least, box_at_most_ = most;
        break;
      case box_too_small:
        box_ = most;
        if (way->variant != 1) box_->last_x = least.last_x - 1;
        if (way->variant != 0) box_->last_y = least.last_y - 1;
        box_at_most_ = box_;
        break;
      default:
        break;
    }
  }
  std::vector<DrawnCorner> turned = border;
  for (DrawnCorner& p : turned) p.x = width_ - 1 - p.x, p.y = height_ - 1 - p.y;
  if (for_nobody) also_inside_ = drawn(turned, header, given);
  auto found = drawn(is_turned_ ? std::move(turned) : std::move(border), header, given);
  if (!found || (for_nobody && !also_inside_)) return false;
  inside_ = std::move(*found);
  return true;
}

bool Redrawn::find_depths(std::vector<DrawnCorner> outline, const Way* way, int choice, const Given& given) {
  const Conventions& conventions = given.header.conventions;
  if (way && way->mistake == z_v_for_depth) {
    const bool divides = conventions.depth == Conventions::Depth::corrected;
    for (DrawnCorner& p : outline) {
      const double linear = p.z;
      p.z = divides ? 1 / linear : view_depth(given.scene.camera, conventions, linear);
      p.off_z = divides ? p.off_z * p.z * p.z : view_depth_error(given.scene.camera, conventions, linear, p.off_z);
    }
  }
  if (way && way->mistake == depth_by_reciprocals) after_ = After::reciprocal;
  if (way && way->mistake == depth_truncated) after_ = way->variant == 0 ? After::truncated : After::rounded;
  if (!way || way->mistake == z_v_for_depth || way->mistake == depth_truncated) {
    if (auto whole = drawn(std::move(outline), given.header, given)) depths_.push_back(std::move(*whole));
    return !depths_.empty();
  }
  // Weights are those of triangles: of more corners, as a fan.
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
    std::vector<DrawnCorner> triangle{outline[0], outline[i], outline[i + 1]};
    change_depths(*way, choice, triangle);
    if (auto one = drawn(std::move(triangle), given.header, given)) depths_.push_back(std::move(*one));
  }
  return !depths_.empty();
}

Redrawn::Cover Redrawn::cover(std::int32_t x, std::int32_t y) const {
  if (margin_) return box_at_most_->holds(x, y) ? Cover::either : Cover::outside;
  const std::int32_t turned_x = width_ - 1 - x, turned_y = height_ - 1 - y;
  Cover found = is_turned_ ? inside_.cover(turned_x, turned_y) : inside_.cover(x, y);
  if (also_inside_) found = std::min(found, also_inside_->cover(turned_x, turned_y));
  if (box_at_most_ && !box_at_most_->holds(x, y)) return Cover::outside;
  return box_ && !box_->holds(x, y) ? std::min(found, Cover::either) : found;
}

double Redrawn::least_weight(std::int32_t x, std::int32_t y) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const DrawnCorner &p = margin_->corners[i], &q = margin_->corners[(i + 1) % 3];
    least = std::min(least, ((q.x - p.x) * (y - p.y) - (x - p.x) * (q.y - p.y)) / margin_->divided_by);
  }
  return least;
}

Redrawn::Depths Redrawn::depths(std::int32_t x, std::int32_t y) const {
  constexpr double any = std::numeric_limits<double>::infinity();
  Depths depths{any, -any};
  for (const DrawnFacet& facet : depths_) {
    if (depths_.size() > 1 && facet.cover(x, y) == Cover::outside) continue;
    if (!facet.has_depth()) return {-any, any};
    const double linear = facet.linear_at(x, y), low = linear - facet.off(), high = linear + facet.off();
    switch (after_) {
      case After::nothing:
        depths = {std::min(depths.low, low), std::max(depths.high, high)};
        break;
      case After::reciprocal:
        if (low <= 0 && high >= 0) return {-any, any};
        depths = {std::min(depths.low, 1 / high), std::max(depths.high, 1 / low)};
        break;
      case After::truncated:
        depths = {std::min(depths.low, std::trunc(low)), std::max(depths.high, std::trunc(high))};
        break;
      case After::rounded:
        depths = {std::min(depths.low, std::round(low)), std::max(depths.high, std::round(high))};
        break;
    }
  }
  return depths.low <= depths.high ? depths : Depths{-any, any};
}

Buffer::Buffer(std::span<const Way> ways, const Given& given)
    : ways_(ways),
      comparison_(given.header.comparison),
      empty_(given.header.empty_depth()),
      width_(given.scene.raster.width),
      height_(given.scene.raster.height),
      stored_(pixel_count(width_, height_)) {
  begins_with_ = first_depths();
  clear();
}

Redrawn::Depths Buffer::first_depths() const {
  double first = made(buffer_begins_at_0) ? 0 : empty_;
  if (comparison_.nearer == Comparison::Nearer::greater) first = -first;
  return {first, first};
}

void Buffer::begin_again(std::span<const Way> ways, Rows rows) {
  ways_ = ways, begins_with_ = first_depths();
  std::fill(stored_.begin() + std::ptrdiff_t{rows.first} * width_, stored_.begin() + std::ptrdiff_t{rows.end} * width_,
            begins_with_);
}

bool Buffer::made(Mistake mistake) const {
  return std::any_of(ways_.begin(), ways_.end(), [&](const Way& way) { return way.mistake == mistake; });
}

Redrawn::Depths& Buffer::stored(std::int32_t x, std::int32_t y) {
  const std::size_t stride = static_cast<std::size_t>(made(stride_is_height) ? height_ : width_);
  return stored_[(static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x)) % stored_.size()];
}

std::optional<bool> Buffer::answer(Redrawn::Depths z, Redrawn::Depths stored) const {
  const bool reversed = made(compare_reversed);
  const bool last = (comparison_.ties == Comparison::Ties::last) != made(equal_wins);
  if (z.high < stored.low) return !reversed;
  if (z.low > stored.high) return reversed;
  const bool same = z.low == z.high && stored.low == stored.high;
  return same ? std::optional(last) : std::nullopt;
}

std::optional<bool> Buffer::ask(std::int32_t x, std::int32_t y, Redrawn::Depths z) {
  if (comparison_.nearer == Comparison::Nearer::greater) z = {-z.high, -z.low};
  Redrawn::Depths& there = stored(x, y);
  const std::optional<bool> nearer = answer(z, there);
  if (made(depth_always)) there = z;
  else if (made(depth_not_written)) return nearer;
  else if (!nearer) there = {std::min(z.low, there.low), std::max(z.high, there.high)};
  else if (*nearer) there = z;
  return nearer;
}

void Buffer::may_ask(std::int32_t x, std::int32_t y, Redrawn::Depths z) {
  const Redrawn::Depths before = stored(x, y);
  ask(x, y, z);
  Redrawn::Depths& there = stored(x, y);
  there = {std::min(before.low, there.low), std::max(before.high, there.high)};
}

bool Buffer::may_answer(std::int32_t x, std::int32_t y, Redrawn::Depths z, bool nearer) {
  if (comparison_.nearer == Comparison::Nearer::greater) z = {-z.high, -z.low};
  Redrawn::Depths& there = stored(x, y);
  const std::optional<bool> known = answer(z, there);
  if (made(depth_always) || (nearer && !made(depth_not_written))) there = z;
  return !known || *known == nearer;
}

}  // namespace zstep::mistakes
