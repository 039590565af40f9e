#include "sim/truth/explain_difference.hpp"
#include "traces/formulas/fill.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

namespace zstep::compare {

namespace {

double allowance(double z) { return tie_tolerance * std::abs(z); }

double relative(double one, double other) {
  const double size = std::max(std::abs(one), std::abs(other));
  return size > 0 ? std::abs(one - other) / size : 0;
}

Explanation edge_of(const Candidate& candidate) {
  return {Reason::edge, fmt::format("edge of polygon {} at distance {:.2g} px", candidate.polygon, candidate.edge)};
}

// The nearest facet that covers the centre whatever the rounding: what lies behind it cannot be seen.
const Candidate* screen_of(const Truth& truth, std::int32_t x, std::int32_t y) {
  for (const Candidate& candidate : truth.at(x, y)) {
    if (candidate.sure()) return &candidate;
  }
  return nullptr;
}

Explanation wrong(const Truth& truth, std::int32_t x, std::int32_t y, std::int32_t polygon, const Candidate* screen) {
  std::string text = fmt::format("polygon {} cannot be seen", polygon);
  if (polygon == no_polygon) text = "something must be seen";
  const Candidate* mine = nullptr;
  for (const Candidate& candidate : truth.at(x, y)) {
    if (candidate.polygon == polygon && !mine) mine = &candidate;
  }
  if (mine) text += fmt::format(", it lies at z = {:.9g}", mine->z);
  if (!mine && polygon != no_polygon) text += ", it does not reach there";
  if (screen) {
    text += fmt::format("; polygon {} covers the centre at z = {:.9g}, its nearest edge is {:.3g} px away",
                        screen->polygon, screen->z, screen->edge);
  }
  return {Reason::wrong, text};
}

// The depth that a picture holds at a pixel against the planes of the polygon that it shows there; the relative error,
// negative when it is more than allowed.
double depth_error(const Truth& truth, std::int32_t x, std::int32_t y, std::int32_t polygon, double z) {
  double best = std::numeric_limits<double>::infinity();
  bool right = false;
  for (const Candidate& candidate : truth.at(x, y)) {
    if (candidate.polygon != polygon) continue;
    if (candidate.edge_on) return 0;
    const double error = std::abs(z - candidate.z);
    const double outside = candidate.covers ? 0 : candidate.edge * candidate.slope;  // z was limited to the facet's
    const double allowed =
        depth_tolerance * std::abs(candidate.z) + depth_shift * candidate.slope + candidate.z_slack + outside;
    right = right || error <= allowed;
    best = std::min(best, relative(z, candidate.z));
  }
  return right ? best : -1;
}

void check_size(const Truth& truth, const Picture& picture) {
  const bool same = picture.width == truth.width() && picture.height == truth.height();
  if (!same || picture.polygon.size() != picture.depth.size())
    throw std::invalid_argument("pictures of different sizes");
}

void count(Verdict& verdict, const Difference& difference) {
  verdict.differences.push_back(difference);
  switch (difference.explanation.reason) {
    case Reason::edge:
      ++verdict.at_edges;
      break;
    case Reason::tie:
      ++verdict.ties;
      break;
    default:
      ++verdict.unexplained;
  }
}

}  // namespace

Explanation explain(const Truth& truth, std::int32_t x, std::int32_t y, std::int32_t polygon) {
  const Candidate* screen = screen_of(truth, x, y);
  const auto here = truth.at(x, y);
  const double reach = screen ? screen->z + allowance(screen->z) : std::numeric_limits<double>::infinity();
  const auto within_reach = [&](const Candidate& candidate) { return candidate.z <= reach; };

  if (polygon == no_polygon) {
    if (screen) return wrong(truth, x, y, polygon, screen);
    return here.empty() ? Explanation{} : edge_of(here.front());
  }
  const Candidate* mine = nullptr;  // the one of this polygon's facets that is surest to be seen
  for (const Candidate& candidate : here) {
    if (candidate.polygon == polygon && within_reach(candidate) && (!mine || (candidate.sure() && !mine->sure()))) {
      mine = &candidate;
    }
  }
  if (!mine) return wrong(truth, x, y, polygon, screen);
  if (!mine->sure()) return edge_of(*mine);
  for (const Candidate& candidate : here) {
    if (candidate.polygon != polygon && within_reach(candidate) && !candidate.sure() && candidate.z <= mine->z) {
      return edge_of(candidate);
    }
  }
  for (const Candidate& candidate : here) {
    const bool tie = std::abs(candidate.z - mine->z) <= allowance(screen->z);
    if (candidate.polygon == polygon || !within_reach(candidate) || !tie) continue;
    return {Reason::tie,
            fmt::format("tie of {} and {}: relative depth difference {:.2g}", std::min(polygon, candidate.polygon),
                        std::max(polygon, candidate.polygon), relative(candidate.z, mine->z))};
  }
  return {};
}

Verdict explain_difference(const Truth& truth, const Picture& one, const Picture& other) {
  check_size(truth, one);
  check_size(truth, other);
  Verdict verdict;
  for (std::int32_t y = 0; y < one.height; ++y) {
    for (std::int32_t x = 0; x < one.width; ++x) {
      const std::int32_t mine = one.polygon[one.at(x, y)], theirs = other.polygon[other.at(x, y)];
      if (mine == theirs) {
        ++(mine == no_polygon ? verdict.empty : verdict.equal);
        continue;
      }
      Explanation why_one = explain(truth, x, y, mine), why_other = explain(truth, x, y, theirs);
      // What needs more of an explanation explains both: wrong before edge before tie.
      const auto weight = [](const Explanation& why) {
        return why.reason == Reason::wrong ? 3 : why.reason == Reason::edge ? 2 : why.reason == Reason::tie ? 1 : 0;
      };
      if (weight(why_other) > weight(why_one)) std::swap(why_one, why_other);
      if (why_one.reason == Reason::none) throw std::logic_error("both polygons are the only one to be seen");
      count(verdict, {x, y, mine, theirs, why_one});
    }
  }
  return verdict;
}

Verdict explain_difference(const Scene& scene, const Conventions& conventions, const Picture& one,
                           const Picture& other) {
  std::vector<std::uint8_t> differs(one.polygon.size(), 0);
  if (one.polygon.size() == other.polygon.size()) {
    for (std::size_t pixel = 0; pixel < differs.size(); ++pixel)
      differs[pixel] = one.polygon[pixel] != other.polygon[pixel];
  }
  return explain_difference(Truth(scene, conventions.cull, differs, formulas::fills_non_zero(conventions)), one, other);
}

Verdict hold_against_truth(const Truth& truth, const Scene& scene, const Conventions& conventions,
                           const Picture& picture, bool depths) {
  check_size(truth, picture);
  Verdict verdict;
  for (std::int32_t y = 0; y < picture.height; ++y) {
    for (std::int32_t x = 0; x < picture.width; ++x) {
      const std::int32_t polygon = picture.polygon[picture.at(x, y)];
      Explanation why = explain(truth, x, y, polygon);
      if (why.reason == Reason::none) ++(polygon == no_polygon ? verdict.empty : verdict.equal);
      const bool seen = polygon != no_polygon && why.reason != Reason::wrong;
      if (why.reason != Reason::none) count(verdict, {x, y, polygon, truth.nearest(x, y), std::move(why)});

      const double stored = view_depth(scene.camera, conventions, picture.depth[picture.at(x, y)]);
      double error = 0;
      if (depths && polygon == no_polygon && stored != no_depth) error = -1;
      if (depths && seen) error = depth_error(truth, x, y, polygon, stored);
      verdict.worst_depth = std::max(verdict.worst_depth, error);
      if (error >= 0) continue;
      ++verdict.wrong_depths;
      verdict.differences.push_back(
          {x, y, polygon, polygon, {Reason::wrong, fmt::format("the depth {:.12g} is not that of its plane", stored)}});
    }
  }
  return verdict;
}

std::string Verdict::complaints(std::size_t most) const {
  std::string text;
  std::size_t lines = 0;
  for (const Difference& difference : differences) {
    if (difference.explanation.reason != Reason::wrong) continue;
    if (lines++ == most) return text + "  …\n";
    text += fmt::format("  pixel ({}, {}): {} and {}: {}\n", difference.x, difference.y, difference.one,
                        difference.other, difference.explanation.text);
  }
  return text;
}

}  // namespace zstep::compare
