// What stands in the room of a scene beside its polygons, and what the step at work does there.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "sim/viewer/panes/ui.hpp"

namespace zstep::viewer {

// A pen that draws into the room of a scene that is seen from outside.

inline constexpr double as_near = 1e-3;  ///< what lies in a polygon's plane is not hidden by it

/// Which polygon is seen at each pixel, and its depth.
Picture polygons_seen(const Outside& outside, const Scene& polygons);
/// The same into a picture whose memory is kept from frame to frame.
void see_polygons(const Outside& outside, const Scene& polygons, Picture& seen);
/// Each polygon in its colour, and `paper` where none is seen, on a canvas of the picture's size.
void paint_polygons(Canvas& canvas, const Picture& seen, const std::vector<Pixel32>& colors, Pixel32 paper);
/// The same where there is glass: what lies behind it is seen through it. False, and nothing done, where there is none.
bool paint_with_glass(Canvas& canvas, const Outside& outside, const Scene& polygons, const std::vector<Pixel32>& colors,
                      Pixel32 paper);

/// Draws lines and planes into the room: what a polygon hides of them is faint. Thicknesses in thin lines.
class RoomPen {
 public:
  RoomPen(ChartPicture& picture, const Picture& seen, const Room& of, const Outside& outside, const Theme& theme,
          double thin)
      : room(of), colors(theme), picture_(picture), seen_(seen), outside_(outside), thin_(thin) {}

  void line(glm::dvec3 from, glm::dvec3 to, ImU32 color, double thickness = 1, bool dashed = false,
            bool through = false);  ///< `through`: what a polygon hides of it is seen nearly as well
  /// With a name at its tip.
  void arrow(glm::dvec3 from, glm::dvec3 to, ImU32 color, const std::string& name = "");
  void around(const std::vector<glm::dvec3>& corners, ImU32 color, double thickness = 1, bool dashed = false);
  void around(const std::array<glm::dvec3, 4>& corners, ImU32 color, double thickness = 1, bool dashed = false) {
    around(std::vector(corners.begin(), corners.end()), color, thickness, dashed);
  }
  /// `shape` as of Canvas::mark.
  void dot(glm::dvec3 at, double radius, int shape, ImU32 color);
  /// False, and nothing written, where the picture does not show that place. `first`: before the others, and in bold.
  bool word(glm::dvec3 at, const std::string& text, ImU32 color, bool first = false);
  /// A plane that one sees through; a convex outline. `share` of 255.
  void veil(const std::vector<glm::dvec3>& corners, ImU32 color, unsigned share);
  void veil(const std::array<glm::dvec3, 4>& corners, ImU32 color, unsigned share) {
    veil(std::vector(corners.begin(), corners.end()), color, share);
  }

  const Room& room;
  const Theme& colors;

 private:
  bool hidden(const Outside::Spot& a, const Outside::Spot& b) const;

  ChartPicture& picture_;
  const Picture& seen_;
  const Outside& outside_;
  double thin_;
};

/// What the lesson's stop names: vertices with dots, lines dashed where they are no edges, arrows, polygons.
void draw_labels(RoomPen& pen, const Moment& now);
/// The window of which the stop speaks: its four sides by their numbers, its distance along the line of sight, and the
/// angle α from its bottom to its top; or the view volume from there to the far plane.
void draw_told_window(RoomPen& pen, const StopWindow& window);

/// Edges, axes, the eye with its window and planes, the lamp, what the lesson's stop names; then what is at work.
/// `cell`: the pixel; `viewing`: 1 … 4 for the axes before and after T_1 … T_4, 0 for the world's.
void draw_in_space(RoomPen& pen, const Moment& now, const std::optional<Cell>& cell, int viewing, double arrived);

}  // namespace zstep::viewer
