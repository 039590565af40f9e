// Puts polygons into a scene: placed, coloured, named, cut into planar facets.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "traces/scene.hpp"
#include "algorithms/scene/files/polygon_soup.hpp"
#include "algorithms/scene/load.hpp"

namespace zstep::scene {

// Polygons into planar facets.

/// Newell's normal: the sum of the cross products of neighbouring corners, seen from the first. Its length is twice the
/// area that the polygon encloses, its direction that from which the corners run counter-clockwise. M. E. Newell, after
/// I. E. Sutherland, R. F. Sproull and R. A. Schumacker, "A Characterization of Ten Hidden-Surface Algorithms", 1974.
glm::dvec3 newell_normal(std::span<const glm::dvec3> points, std::span<const std::int32_t> corners);

/// Whether no corner is further from the polygon's plane (through the mean of its corners, along Newell's normal) than
/// planarity_tolerance times the diagonal of its bounding box. Polygons that enclose no area are planar if their
/// corners lie on one line.
inline constexpr double planarity_tolerance = 1e-5;
bool is_planar(std::span<const glm::dvec3> points, std::span<const std::int32_t> corners);

/// Cuts polygons that are not planar into triangles.
class EarClipper {
 public:
  /// Appends the corners of corners.size() - 2 triangles, each in the order of the polygon, to `triangles`. Ears are
  /// cut in the plane of Newell's normal; where the outline crosses itself there and no ear is left, the sharpest
  /// corner is cut. False, with nothing appended, when the work in all calls together would take too long (see
  /// most_steps).
  bool cut(std::span<const glm::dvec3> points, std::span<const std::int32_t> corners,
           std::vector<std::int32_t>& triangles);

  static constexpr std::int64_t most_steps = 500'000'000;

 private:
  std::int64_t steps_ = 0;
};

/// The outline that EarClipper cuts into just these triangles: empty where there is none.
std::vector<std::int32_t> outline_of(std::span<const glm::dvec3> points, std::span<const std::int32_t> triangles);

/// Puts the polygons of a scene into another order, and the facets with them: polygon k becomes place_of[k].
void put_in_order(Scene& scene, std::span<const std::int32_t> place_of);

/// The parts of a material that a scene file states; they go before what a mesh's own file says.
struct MaterialKeys {
  std::optional<double> opacity, reflectance, refraction;
  Material over(const Material& own) const {
    return {opacity.value_or(own.opacity), reflectance.value_or(own.reflectance), refraction.value_or(own.refraction),
            own.texture};
  }
};

class SceneBuilder {
 public:
  explicit SceneBuilder(SceneFile file) : file_(std::move(file)) {}

  enum class Bare : std::uint8_t { of_palette, shaded };  ///< what polygons without a colour get

  struct Style {
    Placement placement;  ///< linear and offset; a mirroring turns the polygons round, so that outside stays outside
    Bare bare = Bare::of_palette;
    Color bare_color;       ///< of the shaded ones, before shading
    std::int32_t line = 0;  ///< where the scene's file places a mesh; 0: the soup's own lines are of the scene's file
    MaterialKeys material{};
    bool open = false;  ///< a surface with two sides: neither its edges nor its bent cells are worth a note
    bool is_placed_mesh() const { return line > 0 && !open; }
  };

  /// Appends the soup's polygons. `where` names the soup's file in errors and notes.
  void add(PolygonSoup soup, const std::string& where, const Style& style);

  /// Polygons so far.
  std::size_t size() const { return file_.scene.polygons.size(); }

  /// The scene, its unnamed polygons called A, B, C … if there are no more than 26.
  SceneFile finish();

 private:
  void check_limits(const PolygonSoup& soup, const std::string& where) const;
  void keep_origins(const PolygonSoup& soup, const std::string& where, const Style& style);
  void add_attributes(PolygonSoup& soup, const std::string& where, const Style& style);
  void add_textures(PolygonSoup& soup, const std::string& where);
  void add_points(PolygonSoup& soup, const std::string& where, const Style& style);
  void note_topology(const PolygonSoup& soup, const std::string& where, const Style& style);
  void add_facets(std::span<const std::int32_t> corners, std::int32_t polygon, const std::string& where,
                  std::int32_t line);

  SceneFile file_;
  EarClipper clipper_;
  std::vector<std::int32_t> ring_, triangles_;
  std::int64_t cut_ = 0, too_few_corners_ = 0, no_area_ = 0;  // of the soup at work
};

}  // namespace zstep::scene
