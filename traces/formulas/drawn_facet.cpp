#include "traces/formulas/drawn_facet.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "traces/formulas/coverage.hpp"
#include "traces/formulas/fill.hpp"
#include "traces/formulas/outlines.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/formulas/viewing.hpp"

namespace zstep::formulas {

namespace {

constexpr double operations_of_vertex = 16, operations_of_crossing = 8;

/// In view coordinates.
struct Viewed {
  std::int32_t vertex = -1;
  Rounded x, y, z;
};

/// What of an outline lies on one side of a depth: z_v >= limit where `sign` is 1, z_v <= limit where it is -1.
std::vector<Viewed> clip(const std::vector<Viewed>& outline, double limit, double sign) {
  std::vector<Viewed> kept;
  const auto inside = [&](const Viewed& corner) { return sign * (corner.z.value - limit); };
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Viewed &here = outline[i], &next = outline[(i + 1) % outline.size()];
    if (inside(here) >= 0) kept.push_back(here);
    if (!((inside(here) > 0 && inside(next) < 0) || (inside(here) < 0 && inside(next) > 0))) continue;
    const Rounded t = where_zero(here.z - Rounded(limit), next.z - Rounded(limit));
    kept.push_back({-1, part_of_way(here.x, next.x, t), part_of_way(here.y, next.y, t), Rounded(limit)});
  }
  return kept;
}

std::vector<Viewed> in_view(const Scene& scene, const Facet& facet) {
  std::vector<Viewed> corners;
  const glm::dmat4& view = scene.camera.view;
  for (std::int32_t i = 0; i < facet.corner_count; ++i) {
    const std::int32_t vertex = scene.corners[facet.first_corner + i];
    const glm::dvec3& w = scene.points[vertex];
    const auto row = [&](int of) {
      return matrix_row<Rounded>(view[0][of], view[1][of], view[2][of], view[3][of], w.x, w.y, w.z);
    };
    corners.push_back({vertex, row(0), row(1), row(2)});
  }
  return corners;
}

/// What the number format makes of a number that a program reads: nothing, or its own nearest one.
double off_when_read(double value, double roundoff) {
  const bool narrow = roundoff > std::numeric_limits<double>::epsilon();
  return narrow && static_cast<double>(static_cast<float>(value)) != value ? roundoff * std::abs(value) : 0;
}

/// How many bits the whole numbers have that these coordinates are multiples of a power of two by.
int bits_of_coordinates(std::span<const double> coordinates) {
  constexpr int bits_of_double = 53;
  int below = 0, above = 0;  // the point
  for (const double value : coordinates) {
    if (value == 0) continue;
    if (!std::isfinite(value)) return std::numeric_limits<int>::max() / 4;
    int exponent = 0;
    const auto whole = static_cast<std::uint64_t>(std::ldexp(std::frexp(std::abs(value), &exponent), bits_of_double));
    below = std::max(below, bits_of_double - std::countr_zero(whole) - exponent);
    above = std::max(above, exponent);
  }
  return below + above;
}

/// How far planes through three corners of an outline move at another one where those three are off by 1: through two
/// neighbours and a third: a program that cuts it into triangles, or takes one plane for all of it, may choose them.
double reach_of_planes(std::span<const DrawnCorner> outline) {
  constexpr double least = 3;
  constexpr std::size_t most_corners = 32;  // the cube of more takes too long
  const std::size_t count = outline.size();
  if (count > most_corners) return std::numeric_limits<double>::infinity();
  const auto area = [](const DrawnCorner& p, const DrawnCorner& q, const DrawnCorner& r) {
    return std::abs((q.x - p.x) * (r.y - p.y) - (r.x - p.x) * (q.y - p.y));
  };
  double reach = least;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j) {
      const DrawnCorner &p = outline[i], &q = outline[j], &r = outline[(j + 1) % count];
      const double of_three = area(p, q, r);
      if (of_three == 0) continue;
      for (const DrawnCorner& s : outline)
        reach = std::max(reach, (area(s, q, r) + area(p, s, r) + area(p, q, s)) / of_three);
    }
  return reach;
}

}  // namespace

std::optional<DrawnFacet> DrawnFacet::from_scene(const Scene& scene, const Header& header, std::int32_t facet,
                                                 double roundoff) {
  const Facet& of = scene.facets[facet];
  const Camera& camera = scene.camera;
  std::vector<DrawnCorner> outline;
  if (camera.kind == Camera::Kind::screen) {
    for (std::int32_t i = 0; i < of.corner_count; ++i) {
      const std::int32_t vertex = scene.corners[of.first_corner + i];
      const glm::dvec3& p = scene.points[vertex];
      outline.push_back({vertex, p.x, p.y, p.z, off_when_read(p.x, roundoff), off_when_read(p.y, roundoff),
                         off_when_read(p.z, roundoff)});
    }
    return from_run(scene, header, std::move(outline), roundoff);
  }
  if (!(camera.near < camera.far)) return std::nullopt;
  const bool parallel = camera.kind == Camera::Kind::orthographic;
  const std::vector<Viewed> corners = clip(clip(in_view(scene, of), camera.near, 1), camera.far, -1);
  const Rounded width(scene.raster.width), height(scene.raster.height), w_y(camera.window),
      w_x = window_width(w_y, width, height), d(camera.d);
  const auto scale = depth_scale(camera, header.conventions.depth, [](double number) { return Rounded(number); });
  for (const Viewed& corner : corners) {
    const Rounded x = screen_x(parallel ? corner.x : projected(d, corner.x, corner.z), w_x, width, scene.raster),
                  y = screen_y(parallel ? corner.y : projected(d, corner.y, corner.z), w_y, height, scene.raster),
                  z = vertex_depth(scale, corner.z);
    const double off = operations_of_vertex * roundoff;
    outline.push_back({corner.vertex, x.value, y.value, z.value, off * x.spread, off * y.spread, off * z.spread});
  }
  // A left-handed view mirrors what it shows, and so do rows that go up.
  const bool mirrors = (glm::determinant(glm::dmat3(camera.view)) < 0) != scene.raster.y_up;
  DrawnFacet exact;
  exact.outline_ = outline;
  const bool is_area = outline.size() >= 3 && exact.find_plane(roundoff);
  const bool faces_away = is_area && (mirrors ? exact.twice_area_ > 0 : exact.twice_area_ < 0);
  if (const int parts = parts_of_pixel(header.conventions.positions); parts > 0)
    for (DrawnCorner& corner : outline)
      for (const auto& [at, off] :
           {std::pair(&DrawnCorner::x, &DrawnCorner::off_x), std::pair(&DrawnCorner::y, &DrawnCorner::off_y)}) {
        const double in_parts = corner.*at * parts, to_middle = std::abs(in_parts - std::floor(in_parts) - 0.5);
        if (to_middle <= corner.*off * parts)  // rounding decides at which one it is
          corner.*off += 0.5 / parts;
        else corner.*at = snapped(corner.*at, header.conventions.positions), corner.*off = 0;
      }
  auto drawn = from_run(scene, header, std::move(outline), roundoff);
  if (drawn) drawn->faces_away_ = faces_away;
  return drawn;
}

std::optional<DrawnFacet> DrawnFacet::from_run(const Scene& scene, const Header& header,
                                               std::vector<DrawnCorner> outline, double roundoff) {
  for (const DrawnCorner& corner : outline)
    if (!std::isfinite(corner.x) || !std::isfinite(corner.y) || !std::isfinite(corner.z)) return std::nullopt;
  if (outline.size() < 3) return std::nullopt;
  DrawnFacet drawn;
  drawn.outline_ = std::move(outline);
  if (bits_of(header.conventions.number_format) > 0) {
    if (header.conventions.depth == Conventions::Depth::corrected) return std::nullopt;
    drawn.unit_ = depth_unit(scene, header.conventions);
  }
  if (!drawn.find_plane(roundoff)) return std::nullopt;
  drawn.find_intervals(scene, header, roundoff);
  return drawn;
}

bool DrawnFacet::find_plane(double roundoff) {
  // Newell's normal about the first corner.
  const DrawnCorner& origin = outline_.front();
  double a = 0, b = 0, twice_area = 0, off_corner = 0;
  double least_x = origin.x, most_x = origin.x, least_y = origin.y, most_y = origin.y, x = 0, y = 0, z = 0;
  for (std::size_t i = 0; i < outline_.size(); ++i) {
    const DrawnCorner &p = outline_[i], &q = outline_[(i + 1) % outline_.size()];
    const double p_x = p.x - origin.x, p_y = p.y - origin.y, p_z = p.z - origin.z;
    const double q_x = q.x - origin.x, q_y = q.y - origin.y, q_z = q.z - origin.z;
    a += p_y * q_z - p_z * q_y, b += p_z * q_x - p_x * q_z, twice_area += p_x * q_y - p_y * q_x;
    least_x = std::min(least_x, p.x), most_x = std::max(most_x, p.x);
    least_y = std::min(least_y, p.y), most_y = std::max(most_y, p.y);
    x = std::max(x, std::abs(p.x)), y = std::max(y, std::abs(p.y)), z = std::max(z, std::abs(p.z));
    off_corner = std::max({off_corner, p.off_x, p.off_y});
  }
  const double width = most_x - least_x, height = most_y - least_y, size = std::abs(twice_area);
  // An outline without an area, or with one that rounding may turn round.
  if (!(size > 8 * off_corner * (width + height) + 32 * roundoff * x * y)) return false;
  twice_area_ = twice_area, dz_dx_ = -a / twice_area, dz_dy_ = -b / twice_area;
  double off_vertices = 0, bend = 0;
  for (const DrawnCorner& p : outline_) {
    off_vertices = std::max(off_vertices, p.off_z + std::abs(dz_dx_) * p.off_x + std::abs(dz_dy_) * p.off_y);
    bend = std::max(bend, std::abs(p.z - linear_at(p.x, p.y)));
  }
  bend = outline_.size() > 3 && bend > 0 ? bend * reach_of_planes(outline_) : 0;
  const double steps = width + height + 2;
  off_edge_function_ = roundoff * (24 * x * y + steps * 2 * width * height);
  const double size_z = z + std::abs(dz_dx_) * width + std::abs(dz_dy_) * height;
  const double of_formula = size_z * (roundoff * (8 + steps) + 4 * off_edge_function_ / size);
  // Of corners that do not lie in one plane each way of interpolating finds another depth between them.
  constexpr double side_of_block = 8;
  off_ = of_formula + 2 * off_vertices + bend + unit_ * (steps + 2 * side_of_block + 2);
  has_depth_ = std::isfinite(off_) && std::isfinite(dz_dx_) && std::isfinite(dz_dy_);
  return true;
}

struct DrawnFacet::Crossing {
  std::int32_t edge;
  double x, off;
  std::int32_t way = 0;  ///< 1 where the outline goes down there, -1 where it goes up
};

DrawnFacet::Crossing DrawnFacet::crossing(std::size_t edge, std::int32_t y, double roundoff) const {
  const DrawnCorner &p = outline_[edge], &q = outline_[(edge + 1) % outline_.size()];
  const auto number = static_cast<std::int32_t>(edge);
  const double rise = q.y - p.y, slope = (q.x - p.x) / rise;
  if (rise == 0) return {number, std::max(p.x, q.x), std::max(p.off_x, q.off_x)};
  const Rounded at = on_line(Rounded(p.x), Rounded(q.x), Rounded(y), Rounded(p.y), Rounded(q.y));
  const double of_fixed = unit_ > 0 ? 0x1p-16 * (std::abs(rise) + 2) : 0;
  const double of_corners = std::max(p.off_x, q.off_x) + std::abs(slope) * std::max(p.off_y, q.off_y) + of_fixed;
  // Whole multiples of a power of two with few bits, along a slope that is one, too: nothing is rounded, however it is
  // computed.
  if (of_corners == 0) {
    const std::array<double, 4> corners{p.x, p.y, q.x, q.y};
    const int bits = bits_of_coordinates(corners), digits = roundoff > 1e-10 ? 24 : 53;
    const std::array<double, 2> of_slope{slope, at.value};
    if (slope * rise == q.x - p.x && 2 * bits + 2 <= digits && bits_of_coordinates(of_slope) + bits <= digits)
      return {number, at.value, 0};
  }
  const double added = roundoff * (std::abs(rise) + 1) * std::max(std::abs(p.x), std::abs(q.x));
  const double of_function = off_edge_function_ / std::abs(rise);
  return {number, at.value, operations_of_crossing * roundoff * at.spread + added + of_function + of_corners};
}

void DrawnFacet::find_intervals(const Scene& scene, const Header& header, double roundoff) {
  using Coverage = Conventions::Coverage;
  const std::int32_t width = scene.raster.width, height = scene.raster.height;
  const Coverage coverage = coverage_ = header.conventions.coverage;
  // Which pixels a polygon owns at its edges is then for the program to say, within half a pixel.
  const double undeclared = header.declares(Convention::coverage) ? 0 : 0.5;
  double top = outline_[0].y, bottom = top;
  for (const DrawnCorner& corner : outline_) top = std::min(top, corner.y), bottom = std::max(bottom, corner.y);
  const bool past_end = coverage == Coverage::inclusive, non_zero = fills_non_zero(header.conventions);
  first_row_ = row_from(top - undeclared - 0.5, height);
  const std::int32_t end = std::min(height, row_from(bottom + undeclared + 0.5, height) + 1);
  std::vector<Crossing> crossings;
  std::vector<double> least_x, most_x;  // of the crossings
  begin_of_row_.push_back(0);
  for (std::int32_t y = first_row_; y < end; ++y) {
    crossings.clear();
    bool unsure = false;       // whether the line meets a corner
    bool by_rounding = false;  // and rounding says so
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (std::size_t edge = 0; edge < outline_.size(); ++edge) {
      const DrawnCorner &p = outline_[edge], &q = outline_[(edge + 1) % outline_.size()];
      const double upper = std::min(p.y, q.y), lower = std::max(p.y, q.y);
      const double slack = p.off_y + undeclared;
      unsure = unsure || (slack > 0 && std::abs(p.y - y) <= slack);
      by_rounding = by_rounding || (p.off_y > 0 && std::abs(p.y - y) <= p.off_y);
      if (upper - slack <= y + 0.5 && lower + slack >= y - 0.5)
        least = std::min({least, p.x, q.x}), most = std::max({most, p.x, q.x});
      const auto goes_on = past_end ? turns_down(outline_.size(), p.y == lower ? edge : (edge + 1) % outline_.size(),
                                                 [&](std::size_t i) { return std::optional(outline_[i].y); })
                                    : std::optional(false);
      unsure = unsure || (!goes_on && y == std::floor(lower));
      if (first_row(upper) <= y && y < end_row(lower, goes_on.value_or(false)) && upper < lower)
        crossings.push_back(crossing(edge, y, roundoff)), crossings.back().way = p.y < q.y ? 1 : -1;
    }
    std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) { return a.x < b.x; });
    // How often the outline goes round a place depends on which of two crossings comes first.
    if (non_zero && crossings.size() > 2)
      for (std::size_t i = 0; i + 1 < crossings.size(); ++i)
        unsure = unsure || crossings[i + 1].x - crossings[i].x <= crossings[i].off + crossings[i + 1].off;
    if (unsure || crossings.size() % 2 != 0) {
      if (least <= most)
        intervals_.push_back({y, width, -1, std::max(0, limited_column(std::floor(least - 1), width)),
                              std::min(width - 1, limited_column(std::ceil(most + 1), width)), 0, 0, least, most,
                              by_rounding ? std::numeric_limits<double>::infinity() : 0});
    } else {
      // Where two lie closer together than they are known, either may come first: but the k-th from the left is not
      // left of the k-th of the places that they are at least at, nor right of the k-th of those at most.
      least_x.clear(), most_x.clear();
      for (const Crossing& one : crossings) {
        const double off = one.off + undeclared;
        least_x.push_back(one.x - off), most_x.push_back(one.x + off);
      }
      std::sort(least_x.begin(), least_x.end()), std::sort(most_x.begin(), most_x.end());
      const auto add = [&](std::size_t i, std::size_t j) {
        const Crossing &left = crossings[i], &right = crossings[j];
        const auto first = [&](double x) { return std::max(0, limited_column(first_pixel(x, coverage), width)); };
        const auto last = [&](double x) { return std::min(width - 1, limited_column(last_pixel(x, coverage), width)); };
        intervals_.push_back({y, first(most_x[i]), last(least_x[j]), first(least_x[i]), last(most_x[j]), left.edge,
                              right.edge, left.x, right.x, std::max(left.off, right.off)});
      };
      each_span_inside(
          crossings.size(), non_zero, [&](std::size_t i) { return crossings[i].way; }, add);
    }
    begin_of_row_.push_back(intervals_.size());
  }
  for (const Interval& of : intervals_) inside_ += std::max(0, of.last - of.first + 1);
}

DrawnFacet::Cover DrawnFacet::cover(std::int32_t x, std::int32_t y) const {
  const std::int64_t row = std::int64_t{y} - first_row_;
  Cover found = Cover::outside;
  if (row < 0 || row + 1 >= std::ssize(begin_of_row_)) return found;
  for (std::size_t i = begin_of_row_[row]; i < begin_of_row_[row + 1]; ++i) {
    const Interval& of = intervals_[i];
    if (x >= of.first && x <= of.last) return Cover::inside;
    if (x >= of.first_maybe && x <= of.last_maybe) found = Cover::either;
  }
  return found;
}

bool DrawnFacet::has_depth_at(std::int32_t x, std::int32_t y) const {
  if (!has_depth_) return false;
  const std::int64_t row = std::int64_t{y} - first_row_;
  if (row < 0 || row + 1 >= std::ssize(begin_of_row_)) return false;
  const bool only_inside = coverage_ == Conventions::Coverage::top_left;
  const auto says = [&](const Interval& of) {
    if (only_inside && (x < of.first_maybe || x > of.last_maybe)) return false;
    if (!only_inside && (of.first > of.last || x < of.x_left || x > of.x_right)) return false;
    const bool is_wide = of.first <= of.last && of.x_right - of.x_left >= 1;
    return of.off == 0 || is_wide || (x >= of.x_left + of.off && x <= of.x_right - of.off);
  };
  return std::any_of(intervals_.begin() + static_cast<std::ptrdiff_t>(begin_of_row_[row]),
                     intervals_.begin() + static_cast<std::ptrdiff_t>(begin_of_row_[row + 1]), says);
}

std::optional<DrawnFacet::Beside> DrawnFacet::beside(std::int32_t x, std::int32_t y) const {
  const std::int64_t row = std::int64_t{y} - first_row_;
  if (row < 0 || row + 1 >= std::ssize(begin_of_row_)) return std::nullopt;
  const Interval* nearest = nullptr;
  const auto distance = [&](const Interval& of) { return std::max({of.x_left - x, x - of.x_right, 0.0}); };
  for (std::size_t i = begin_of_row_[row]; i < begin_of_row_[row + 1]; ++i)
    if (!nearest || distance(intervals_[i]) < distance(*nearest)) nearest = &intervals_[i];
  if (!nearest) return std::nullopt;
  const bool is_left = x < nearest->x_right && (x <= nearest->x_left || cover(x, y) != Cover::outside);
  const std::size_t edge = is_left ? nearest->left : nearest->right;
  return Beside{outline_[edge].vertex, outline_[(edge + 1) % outline_.size()].vertex,
                is_left ? nearest->x_left : nearest->x_right, is_left};
}

}  // namespace zstep::formulas
