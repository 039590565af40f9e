// The scene from outside: the run's own eye, its window and its clipping planes stand in it as things, and a reader
// walks round them and picks vertices and edges. Looking never changes the run.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "algorithms/viewing/camera.hpp"
#include "traces/events/vocabulary.hpp"
#include "traces/formulas/viewing.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {

// Vertices and edges of a scene as a reader picks them: the same at every step, whatever polygon is at work.

/// Up to so many corners of its polygons, a scene's edges are drawn and can be picked.
inline constexpr std::size_t most_corners_picked = 2000;

/// An edge by its vertices, the smaller number first.
using EdgeEnds = std::pair<std::int32_t, std::int32_t>;

/// Each edge of the scene's polygons once, in order; none of a scene with too many.
std::vector<EdgeEnds> edges_of(const Scene& scene);

/// A vertex or an edge.
struct ScenePart {
  std::optional<std::int32_t> vertex;
  std::optional<EdgeEnds> edge;
  bool operator==(const ScenePart&) const = default;
  bool any() const { return vertex || edge; }
};

/// The polygons that have it, by their numbers.
std::vector<std::int32_t> polygons_with(const Scene& scene, const ScenePart& part);
/// "vertex B", "edge AB", "edge 3–7".
std::string name_of(const Scene& scene, const ScenePart& part);
/// "solids.off:12": where the file has it, an edge's first vertex; empty where it has no line.
std::string place_in_file(const Scene& scene, const ScenePart& part);
/// What it is, in a sentence.
std::string told_of(const Scene& scene, const ScenePart& part);
/// Is the step about it?
bool is_about(const Event& event, const ScenePart& part);

/// From where a reader looks, against where one begins: at the side of the run's eye, and above.
struct Look {
  double turn = 0, tilt = 0;  ///< degrees: to the right, and upwards
  double zoom = 1;
  double across = 0, up = 0;  ///< moved, in parts of what is seen
  bool operator==(const Look&) const = default;
};

/// From straight below to straight above.
inline constexpr double first_tilt = 24, least_tilt = -88 - first_tilt, most_tilt = 88 - first_tilt;

/// The scene with z upwards. A screen scene is set up in it: x to the right, its rows from the top down, and depth
/// away.
class Room {
 public:
  Room() = default;
  /// With lines of sight from its eye; `by_lamp`: from its light, whose picture is made.
  explicit Room(const Scene& scene, bool by_lamp = false);

  const Scene& polygons() const { return polygons_; }
  /// A point of the space that the scene is given in.
  glm::dvec3 place(glm::dvec3 point) const;
  /// The point of that space which stands at this place.
  glm::dvec3 point_at(glm::dvec3 place) const;
  /// What is seen at this place of the raster and has this z_v; in a screen scene z. Pixels' centres are at integers.
  glm::dvec3 behind(double x, double y, double z_v) const;
  /// The four corners of a rectangle of the raster at this z_v, in order around it.
  std::array<glm::dvec3, 4> rectangle(double left, double top, double right, double bottom, double z_v) const;
  std::array<glm::dvec3, 4> window(double z_v) const;

  const Camera& camera() const { return camera_; }  ///< from which lines of sight go
  bool by_lamp() const { return by_lamp_; }
  glm::dvec3 towards() const { return towards_; }  ///< from the polygons to the scene's own eye
  bool has_eye() const { return camera_.kind == Camera::Kind::perspective; }
  double near() const { return near_; }  ///< z_v from where, and to where, lines of sight are drawn
  double end() const { return end_; }
  bool far_is_there() const { return far_is_there_; }  ///< the far plane is not too far away to be shown
  glm::dvec3 low() const { return low_; }              ///< the box around the polygons
  glm::dvec3 high() const { return high_; }
  double size() const;
  /// Where this plane of the scene's space cuts that box, a little enlarged: the corners in order; none where it does
  /// not. A x + B y + C z + D = 0.
  std::vector<glm::dvec3> section(double a, double b, double c, double d) const;
  /// These too.
  void show(const std::vector<glm::dvec3>& more) { marks_.insert(marks_.end(), more.begin(), more.end()); }
  /// These alone, large.
  void show_only(std::vector<glm::dvec3> marks) { marks_ = std::move(marks); }
  /// Four corners of a window in view coordinates, in order around it from its left bottom.
  std::array<glm::dvec3, 4> rectangle_in_view(double left, double right, double bottom, double top, double z_v) const;
  /// All that should be seen at first.
  const std::vector<glm::dvec3>& marks() const { return marks_; }

 private:
  Scene polygons_;
  Camera camera_;
  Raster raster_;
  std::optional<formulas::EyeRays> sight_;
  double depth_scale_ = 1, depth_middle_ = 0;  ///< of a screen scene's z
  double near_ = 0, end_ = 1;
  bool far_is_there_ = false, by_lamp_ = false;
  glm::dvec3 towards_{0, -1, 0};
  glm::dvec3 low_{0}, high_{0}, low_given_{0}, high_given_{0};  ///< in the room, and in the scene's own space
  std::vector<glm::dvec3> marks_;
};

/// Where things of a room are in a picture of it.
class Outside {
 public:
  Outside(const Room& room, const Look& look, int width, int height);

  /// The room's scene as this reader sees it: for a picture of polygons and depths.
  Scene seen(const Scene& polygons) const;
  struct Spot {
    double x, y, depth;  ///< pixels from the picture's corner; depth as such a picture has it
  };
  std::optional<Spot> spot(glm::dvec3 point) const;
  /// Where a point is to go so that it is seen so many pixels to the right and further down, as far from this eye.
  glm::dvec3 pulled(glm::dvec3 point, double right, double down) const;
  /// Both ends of what is seen of a line.
  std::optional<std::array<Spot, 2>> line(glm::dvec3 from, glm::dvec3 to) const;

 private:
  Spot spot_of(glm::dvec3 view) const;

  Camera camera_;
  Raster raster_;
  std::optional<viewing::Lens> lens_;
};

}  // namespace zstep::viewer
