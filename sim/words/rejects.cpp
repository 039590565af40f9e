#include "sim/words/rejects.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "algorithms/viewing/back_face.hpp"
#include "sim/words/numbers.hpp"

namespace zstep {
namespace {

constexpr double rounding = 1e-9;  // of sines and areas: less says nothing

std::span<const std::int32_t> corners_of(const Scene& scene, std::int32_t facet) {
  if (facet < 0 || facet >= std::ssize(scene.facets)) return {};
  const Facet& shape = scene.facets[facet];
  return std::span(scene.corners).subspan(shape.first_corner, shape.corner_count);
}

const glm::dvec3& point_of(const Scene& scene, std::int32_t corner) { return scene.points[corner]; }

/// Of a facet in screen coordinates, in pixels.
double area_of(const Scene& scene, std::span<const std::int32_t> corners) {
  double twice = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 &here = point_of(scene, corners[i]), &next = point_of(scene, corners[(i + 1) % corners.size()]);
    twice += here.x * next.y - next.x * here.y;
  }
  return std::abs(twice) / 2;
}

RejectCheck against(std::string text) { return {false, true, std::move(text)}; }

/// What of (p − e)·n is rounding.
double least_of(const Scene& scene, std::span<const std::int32_t> corners) {
  const glm::dvec3 sight = scene.camera.kind == Camera::Kind::perspective
                               ? point_of(scene, corners[0]) - scene.camera.eye
                               : scene.camera.eye;
  return rounding * glm::length(sight) * glm::length(clipping::newell_normal(scene, corners));
}

/// By the numbers that the trace has.
RejectCheck check_test(const FacingVotes& votes, Reject reason) {
  const Facing wanted = reason == Reject::edge_on ? Facing::edge_on : Facing::back;
  if (votes.disagree()) return against("the four numbers of its facing test do not agree");
  if (votes.speak_against(wanted))
    return against(fmt::format("by the numbers of its facing test it {}",
                               facing_text(votes.front ? Facing::front : Facing::back)));
  return {};
}

RejectCheck check_facing(const Scene& scene, std::span<const std::int32_t> corners, Reject reason) {
  const double value = clipping::view_dot_normal(scene, corners), least = least_of(scene, corners);
  const std::string shown = fmt::format("(p \u2212 e)\u00b7n = {}", factor(value));
  if (reason == Reject::back_facing && value < -least)
    return against(fmt::format("it faces the eye: {} is negative", shown));
  if (reason == Reject::edge_on && std::abs(value) > least) return against(fmt::format("{} is not 0", shown));
  return {};
}

RejectCheck check_on_screen(const Scene& scene, std::span<const std::int32_t> corners, Reject reason) {
  const Raster& raster = scene.raster;
  switch (reason) {
    case Reject::back_facing:
      return {true, false, "the scene is given in screen coordinates, without an eye, so that cannot be checked"};
    case Reject::edge_on:
    case Reject::degenerate: {
      const double area = area_of(scene, corners);
      const bool fits = std::all_of(corners.begin(), corners.end(), [&](std::int32_t corner) {
        return std::abs(point_of(scene, corner).x) < 1e9 && std::abs(point_of(scene, corner).y) < 1e9;
      });
      if (fits && area > rounding) return against(fmt::format("on the raster its area is {} pixels", number(area)));
      break;
    }
    case Reject::outside:
      for (const std::int32_t corner : corners) {
        const glm::dvec3& p = point_of(scene, corner);
        if (p.x > -0.5 && p.y > -0.5 && p.x < raster.width - 0.5 && p.y < raster.height - 0.5)
          return against(
              fmt::format("its vertex {} lies on the raster, at ({}, {})", corner, number(p.x), number(p.y)));
      }
      break;
  }
  return {};
}

}  // namespace

FacingVotes votes_of(const Scene& scene, std::int32_t facet, const FacingTest& test) {
  const auto corners = corners_of(scene, facet);
  const bool in_space = scene.camera.kind != Camera::Kind::screen && !corners.empty();
  const double least = in_space ? least_of(scene, corners) : rounding;
  FacingVotes votes;
  const auto vote = [&](double away, double rounded) {
    votes.back = votes.back || away > rounded, votes.front = votes.front || away < -rounded;
  };
  vote(test.view_dot_normal, least), vote(-test.plane_at_eye, least), vote(-test.determinant, least);
  vote(scene.raster.y_up ? -test.projected_normal_z : test.projected_normal_z, 1e-6);  // in pixels, twice an area
  return votes;
}

const char* facing_text(Facing facing) {
  switch (facing) {
    case Facing::front:
      return "faces the eye";
    case Facing::back:
      return "faces away from the eye";
    default:
      return "is seen edge-on";
  }
}

RejectCheck check_reject(const Scene& scene, std::int32_t facet, Reject reason, const FacingTest* test) {
  const auto corners = corners_of(scene, facet);
  if (corners.size() < 3) return {};
  const bool by_facing = reason == Reject::back_facing || reason == Reject::edge_on;
  if (by_facing && test) return check_test(votes_of(scene, facet, *test), reason);
  if (scene.camera.kind == Camera::Kind::screen) return check_on_screen(scene, corners, reason);
  return by_facing && !clipping::degenerate(scene, corners) ? check_facing(scene, corners, reason) : RejectCheck{};
}

}  // namespace zstep
