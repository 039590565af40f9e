// A facet as the scene has it on the raster, whatever program draws it and however: which pixels are its own, how deep
// it is at each, and how far off any sensible way of computing that may be.
//
// The ways are those of the field: spans between edges (000), slopes of the plane (004), barycentric weights in any
// order, edge functions evaluated or stepped (J. Pineda, "A Parallel Algorithm for Polygon Rasterization", SIGGRAPH
// 1988), and 1/z_v. With the unit roundoff u of the number format (2^-53 of float64, 2^-24 of float32) each operation
// is off by u of its result at most, so what k operations make of operands is off by at most k u times the sum of the
// sizes of all that was added on the way, which is what Rounded carries as its spread (N. J. Higham, "Accuracy and
// Stability of Numerical Algorithms", section 3.1). So:
//
// - A vertex that came through the camera: k = 16 (view, clipping, projection, viewport). One that the run prints, or
//   that the scene has on the raster, is as it stands.
// - An edge function A x + B y + C with C = x_1 y_2 - x_2 y_1: 4u of 6 X Y at most, where X and Y are the largest
//   coordinates. Stepped over a box of w by h, u times (w + h) more of the largest that it is there, 2 w h.
// - x of an edge on a scan line: by the line's formula k = 8; by adding the slope, u |x| more for each line; by the
//   edge function's sign, what that is off, divided by the height of the edge.
// - The depth of a pixel: three edge functions, divided by twice the area S and added up with the corners' depths, of
//   which Z is the largest: what they are off times Z/S, as much for S itself, 8 u Z for dividing, multiplying and
//   adding, and u (w + h) Z for adding slopes. By the plane's slopes, which are off as an edge function and S are, all
//   that they gain over the box, p w + q h with slopes p and q, stands beside Z.
// - And what its vertices are off, moved along the plane.
// - In fixed point, one unit of depth for each corner's, for the first pixel's and, where slopes are added that are
//   whole units, for each step from the corner of a block of up to 8 by 8 pixels that the box begins in; and for x of
//   an edge 2^-16 of a pixel for each line.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "traces/file/header.hpp"
#include "traces/scene.hpp"

namespace zstep::formulas {

/// A vertex of an outline on the raster, and how far off each of its numbers may be.
struct DrawnCorner {
  std::int32_t vertex = -1;    ///< its number; -1 where near or far plane made it, and the run has no number for it
  double x = 0, y = 0, z = 0;  ///< z: what is linear on the picture, 1/z_v where the depth is z_v by way of it
  double off_x = 0, off_y = 0, off_z = 0;
};

class DrawnFacet {
 public:
  /// A pixel's centre: where rounding decides, or a convention that is not declared, a program may draw it or not.
  enum class Cover : std::uint8_t { outside, either, inside };

  /// From the scene's points and its camera. `roundoff` is u of what the program computes with. Nothing where the facet
  /// is not seen as an area: before near or beyond far, from the side, or behind the eye.
  static std::optional<DrawnFacet> from_scene(const Scene& scene, const Header& header, std::int32_t facet,
                                              double roundoff);
  /// From vertices as a run has them.
  static std::optional<DrawnFacet> from_run(const Scene& scene, const Header& header, std::vector<DrawnCorner> outline,
                                            double roundoff);

  Cover cover(std::int32_t x, std::int32_t y) const;
  /// How many pixels of the raster are its own for certain.
  std::int64_t pixels_inside() const { return inside_; }
  /// visit(x, y, cover) for each pixel that is inside or may be, row by row.
  template <class Visit>
  void each_pixel(Visit&& visit) const {
    for (const Interval& of : intervals_)
      for (std::int32_t x = of.first_maybe; x <= of.last_maybe; ++x)
        visit(x, of.y, x >= of.first && x <= of.last ? Cover::inside : Cover::either);
  }

  /// What a pixel's centre lies beside: of its line's edges the one that it would have to cross to get inside, or, of a
  /// pixel inside, the one on its left.
  struct Beside {
    std::int32_t vertex_0 = -1, vertex_1 = -1;  ///< the edge
    double x_edge = 0;                          ///< where it meets the pixel's line
    bool is_left = true;                        ///< the facet is on its right
  };
  /// Nothing where its line does not meet the facet.
  std::optional<Beside> beside(std::int32_t x, std::int32_t y) const;

  // Its plane: the depth, or what is linear in its place, at (x, y) is z + dz_dx (x - x of the origin) + …

  const DrawnCorner& origin() const { return outline_.front(); }
  double dz_dx() const { return dz_dx_; }
  double dz_dy() const { return dz_dy_; }
  /// Has it one? Not where it is too narrow for its own rounding.
  bool has_depth() const { return has_depth_; }
  /// Does its plane say how deep it is at a pixel? Not beside it, where some conventions of coverage draw pixels, too,
  /// nor where rounding decides whether it is inside: of a narrow span the depth there is anything.
  bool has_depth_at(std::int32_t x, std::int32_t y) const;
  /// By how much the depth at its pixels may be off, in what is linear on the picture.
  double off() const { return off_; }
  double linear_at(double x, double y) const {
    return origin().z + (dz_dx_ * (x - origin().x) + dz_dy_ * (y - origin().y));
  }
  std::span<const DrawnCorner> outline() const { return outline_; }
  /// Does it show its back, whatever the rounding? Corners go counter-clockwise as seen from outside. In a scene on the
  /// screen none does.
  bool faces_away() const { return faces_away_; }
  /// The same as another one, of the same facet.
  void faces_as(const DrawnFacet& other) { faces_away_ = other.faces_away_; }

 private:
  /// The part of a scan line between two edges: the pixels that are inside for certain, and those that may be.
  struct Interval {
    std::int32_t y, first, last, first_maybe, last_maybe;
    std::int32_t left, right;     ///< the edges, from outline_[left] to the next
    double x_left, x_right, off;  ///< where they are, and how far off that may be
  };
  struct Crossing;

  bool find_plane(double roundoff);
  void find_intervals(const Scene& scene, const Header& header, double roundoff);
  Crossing crossing(std::size_t edge, std::int32_t y, double roundoff) const;

  std::vector<DrawnCorner> outline_;
  double twice_area_ = 0;  ///< on the raster; positive where the corners go clockwise as it is seen, y going down
  bool faces_away_ = false;
  double dz_dx_ = 0, dz_dy_ = 0, off_ = 0;
  double off_edge_function_ = 0;
  double unit_ = 0;  ///< of depths in fixed point; else 0
  bool has_depth_ = false;
  Conventions::Coverage coverage_ = Conventions::Coverage::top_left;
  std::int64_t inside_ = 0;
  std::int32_t first_row_ = 0;
  std::vector<std::size_t> begin_of_row_;  ///< places in intervals_, one more than rows
  std::vector<Interval> intervals_;
};

}  // namespace zstep::formulas
