// Puts polygons into a scene: placed, coloured, named, cut into planar facets.
#pragma once

#include <optional>
#include <string>

#include "algorithms/scene/facets.hpp"
#include "algorithms/scene/files/polygon_soup.hpp"
#include "algorithms/scene/load.hpp"

namespace zstep::scene {

/// The parts of a material that a scene file states; they go before what a mesh's own file says.
struct MaterialKeys {
  std::optional<double> opacity, reflectance, refraction;
  Material over(const Material& own) const {
    return {opacity.value_or(own.opacity), reflectance.value_or(own.reflectance), refraction.value_or(own.refraction)};
  }
};

class SceneBuilder {
 public:
  explicit SceneBuilder(SceneFile file) : file_(std::move(file)) {}

  enum class Bare : std::uint8_t { palette, shaded };  ///< what polygons without a colour get

  struct Style {
    Placement placement;  ///< linear and offset; a mirroring turns the polygons round, so that outside stays outside
    Bare bare = Bare::palette;
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
  void add_points(PolygonSoup& soup, const std::string& where, const Style& style);
  void add_facets(std::span<const std::int32_t> corners, std::int32_t polygon, const std::string& where,
                  std::int32_t line);

  SceneFile file_;
  EarClipper clipper_;
  std::vector<std::int32_t> ring_, triangles_;
  std::int64_t cut_ = 0, too_few_corners_ = 0, no_area_ = 0;  // of the soup at work
};

}  // namespace zstep::scene
