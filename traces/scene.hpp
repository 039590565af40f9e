// What a run was given: polygons, camera, raster, conventions and light, and how large a scene may be. A trace carries
// all of it, so it can be read without the files it came from. algorithms/scene fills it from files; the algorithms run
// on it; the viewer draws it.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "traces/conventions.hpp"

namespace zstep {

/// How many there are, in the type of the numbers of vertices, polygons and pixels. For what is held to the limits
/// below or is no longer than a page.
template <class Items>
constexpr std::int32_t size32(const Items& items) {
  return static_cast<std::int32_t>(items.size());
}
/// The number of one of them.
template <std::unsigned_integral Index>
constexpr std::int32_t index32(Index index) {
  return static_cast<std::int32_t>(index);
}
/// What share of `whole` a count is.
template <std::integral Count, std::integral Whole>
constexpr double ratio(Count count, Whole whole) {
  return static_cast<double>(count) / static_cast<double>(whole);
}

// How large a scene can be. Files from others are held to these before memory is asked for.

inline constexpr std::int32_t largest_side = 16384;   ///< of a raster
inline constexpr std::int64_t most_pixels = 1 << 25;  ///< of a raster: 7680 x 4320 fits

inline constexpr std::int64_t most_points = 2'000'000;
inline constexpr std::int64_t most_polygons = 2'500'000;
inline constexpr std::int64_t most_facets = 4'000'000;
inline constexpr std::int64_t most_corners = 6'000'000;
inline constexpr std::int64_t most_corners_of_polygon = 20'000;  ///< the active edge list is searched from the left
inline constexpr std::int64_t most_values = 6'000'000;           ///< of one attribute, as one a corner
inline constexpr std::int32_t most_components = 4;               ///< of one attribute
inline constexpr std::int32_t most_attributes = 8;
inline constexpr std::int32_t most_textures = 64;
inline constexpr std::int64_t most_texels = 1 << 20;                   ///< of all textures together
inline constexpr double largest_value = 1e30;                          ///< of an attribute
inline constexpr double least_refraction = 0.1, most_refraction = 10;  ///< diamond has 2.4
inline constexpr std::int64_t most_surface_samples = 250'000;          ///< columns times rows
inline constexpr std::size_t longest_formula = 200;                    ///< characters

// A value that is T{} nearly everywhere it could stand: names and materials of polygons, of which a mesh has millions.

/// Takes the room of a pointer, and memory only where it is anything else than T{}. Read it as one reads an optional.
template <class T>
class Rare {
 public:
  Rare() = default;
  template <class U>
  requires(std::convertible_to<U, T> && !std::same_as<std::remove_cvref_t<U>, Rare>) Rare(U&& value)
      : Rare(std::in_place, T(std::forward<U>(value))) {}
  Rare(const Rare& other) : value_(other.value_ ? std::make_unique<T>(*other.value_) : nullptr) {}
  Rare(Rare&&) noexcept = default;
  Rare& operator=(const Rare& other) { return *this = Rare(other); }
  Rare& operator=(Rare&&) noexcept = default;
  Rare& operator=(T value) { return *this = Rare(std::in_place, std::move(value)); }
  ~Rare() = default;

  const T& operator*() const { return value_ ? *value_ : usual_; }
  const T* operator->() const { return &**this; }
  bool is_usual() const { return !value_; }

  friend bool operator==(const Rare& a, const Rare& b) { return *a == *b; }

 private:
  Rare(std::in_place_t, T value) : value_(value == T{} ? nullptr : std::make_unique<T>(std::move(value))) {}

  inline static const T usual_{};
  std::unique_ptr<T> value_;  ///< null: T{}
};

// Pixels by row, row 0 first: where they stand in one list, whatever is kept of them.

constexpr std::size_t pixel_count(std::int32_t width, std::int32_t height) {
  return static_cast<std::size_t>(width) * height;
}
constexpr std::size_t pixel_at(std::int32_t x, std::int32_t y, std::int32_t width) {
  return static_cast<std::size_t>(y) * width + x;
}

/// sRGB, 0…255.
struct Color {
  std::uint8_t red = 0, green = 0, blue = 0;
  bool operator==(const Color&) const = default;
};

/// An image that polygons carry, the top row first.
struct Texture {
  std::string source;  ///< its file
  std::int32_t width = 0, height = 0;
  std::vector<Color> texels;  ///< [height*width]
  bool operator==(const Texture&) const = default;
};
inline constexpr std::int32_t no_texture = -1;

/// What light does at a polygon beside giving it its colour. Only methods that follow light read it, and of the texture
/// only those that interpolate.
struct Material {
  double opacity = 1;                 ///< 0…1, the part of what lies behind that it hides; 0 is not to be seen at all
  double reflectance = 0;             ///< 0…1, the part of the colour that comes along the mirrored ray
  double refraction = 1;              ///< index of refraction n of what lies behind the face, against n = 1 before it
  std::int32_t texture = no_texture;  ///< of Scene::textures
  bool operator==(const Material&) const = default;
};

/// One polygon as the file has it. Its index in Scene::polygons is the id that every buffer and event uses.
struct Polygon {
  Rare<std::string> name;  ///< a short label ("A"); empty for most meshes
  Color color;
  std::int32_t source_line = 0;  ///< line of the file it stands at, 0 if there is none
  Rare<Material> material{};
  bool operator==(const Polygon&) const = default;
};

/// Numbers at the vertices of polygons besides their places: a colour, a texture coordinate, a normal, anything.
struct VertexAttribute {
  /// A polygon's own value at a point, as on either side of a seam of a texture.
  struct Own {
    std::int32_t polygon = 0, point = 0, value = 0;
    auto operator<=>(const Own&) const = default;
  };
  std::string name;  ///< "color" (red, green, blue of 0 to 1), "uv", "normal", or as its file calls it
  std::int32_t components = 1;
  std::vector<double> values;          ///< components of value 0, then those of value 1 …
  std::vector<std::int32_t> lines;     ///< line of its file each value stands at; empty if none has one
  std::vector<std::int32_t> of_point;  ///< by point: its value, -1 where it has none
  std::vector<Own> own;                ///< where a polygon has another one than the point has, in order

  /// The number of a value: -1 where there is none.
  std::int32_t value_of(std::int32_t polygon, std::int32_t point) const;
  bool operator==(const VertexAttribute&) const = default;
};
inline constexpr std::int32_t no_value = -1;
inline constexpr const char *color_attribute = "color", *uv_attribute = "uv", *normal_attribute = "normal";

/// A planar piece of a polygon: what the algorithms loop over. A planar polygon, concave or not, is one facet; a
/// polygon that is not planar is cut into triangles, each a facet of the same polygon (docs/architecture.md,
/// "Degenerate input").
struct Facet {
  std::int32_t polygon = 0;
  std::int32_t first_corner = 0;  ///< its vertices are corners[first_corner .. first_corner + corner_count)
  std::int32_t corner_count = 0;
  bool operator==(const Facet&) const = default;
};

/// How the scene is seen. Left-handed view coordinates: x_v right, y_v up, z_v away from the eye.
struct Camera {
  enum class Kind : std::uint8_t {
    screen,        ///< points are (x_s, y_s, z) already: no viewing at all
    perspective,   ///< x_p = d x_v / z_v
    orthographic,  ///< x_p = x_v
  };
  /// Where the depths `zero_to_one` and `reversed` go from 0 to 1, the depth buffer has these, low < high:
  /// glDepthRange, the MinDepth and MaxDepth of a viewport, or what a program's own formula makes of the near and the
  /// far plane.
  struct DepthRange {
    double low = 0, high = 1;
    bool is_standard() const { return *this == DepthRange{}; }
    /// Can it be one? Two numbers of ordinary size, the smaller one first.
    bool is_right() const { return low < high && -1e30 <= low && high <= 1e30; }
    bool operator==(const DepthRange&) const = default;
  };

  Kind kind = Kind::perspective;
  bool polar = true;                     ///< rho, theta, phi say where the eye is (Eckert); else `view` alone does
  double rho = 4, theta = 30, phi = 60;  ///< distance; angles in degrees, phi from the z axis
  double d = 1;                          ///< distance of the projection plane from the eye
  double window = 1;                     ///< half the height of the window on the projection plane
  double near = 0, far = 0;              ///< z_v of the clipping planes
  DepthRange depth_range;                ///< what depths of 0 and 1 become in the depth buffer
  glm::dmat4 view{1};                    ///< world to view: v = view * w, column vectors (T_v of the notes)
  glm::dvec3 eye{0};                     ///< world; for orthographic the direction towards the eye, unit length

  /// Two matrices of another program: world to its view coordinates, and those to its clip coordinates, column vectors.
  struct Matrices {
    glm::dmat4 view{1}, projection{1};
    bool operator==(const Matrices&) const = default;
  };
  /// What the camera was made from by take_matrices(), where it was.
  std::optional<Matrices> matrices = {};
  bool operator==(const Camera&) const = default;
};

/// Far planes are no farther than this times near. "Infinite" ones are there: no number of float64 that has z_v and
/// near beside far shows the difference.
inline constexpr double infinitely_far = 0x1p60;
inline bool is_infinitely_far(const Camera& camera) {
  return camera.kind == Camera::Kind::perspective && camera.near > 0 && camera.far >= infinitely_far * camera.near;
}

/// A lamp, and all that makes a camera of it: what it shines on is what that camera sees. It looks from `position` at
/// `target` with the world's z axis upwards, in perspective, with its projection plane at distance 1.
struct Light {
  glm::dvec3 position{0};    ///< world
  glm::dvec3 target{0};      ///< world
  double window = 0;         ///< half the height and half the width of the window on its projection plane
  double near = 0, far = 0;  ///< distances of its clipping planes along the line of sight
  bool operator==(const Light&) const = default;
};

/// A surface y = f(x, z) as a grid of samples: sample (column, row) is Scene::points[row * columns + column], and all
/// of a row have the same z. The height y is drawn upwards, so a sample stands at (x, z, y) in the world.
struct Surface {
  std::string formula;  ///< f, without "y ="
  double x_min = 0, x_max = 0, z_min = 0, z_max = 0;
  std::int32_t columns = 0, rows = 0;  ///< samples along x, samples along z
  bool operator==(const Surface&) const = default;
};

/// Points that a scene file took from a mesh, and where it put them: p of the mesh's file became linear * p + offset.
struct Placement {
  std::int32_t first_point = 0, point_count = 0;
  std::string source;     ///< the mesh's file, or the name of a built-in one
  std::int32_t line = 0;  ///< of the scene's file, where it places the mesh
  glm::dmat3 linear{1};
  glm::dvec3 offset{0};
  glm::dvec3 operator()(const glm::dvec3& point) const { return linear * point + offset; }
  bool operator==(const Placement&) const = default;
};

/// The whole scene, once placed, moved into the ball of radius 1 round the origin.
struct Fit {
  glm::dvec3 centre{0};
  double radius = 1;
  glm::dvec3 operator()(const glm::dvec3& point) const { return (point - centre) / radius; }
  bool operator==(const Fit&) const = default;
};

struct Raster {
  std::int32_t width = 64, height = 64;
  bool y_up = false;     ///< row 0 is at the bottom, as textbooks and OpenGL have it
  bool corners = false;  ///< through a camera pixels are seen at their first corner, not at their centre
  bool operator==(const Raster&) const = default;
};

/// Makes of view coordinates as another program has them those by which zstep sees the same picture: with the window's
/// middle in the line of sight, half its height and d both 1, and z_v = w_c. x_c, y_c and w_c may be any that are
/// linear in view coordinates.
glm::dmat4 view_of_matrices(const glm::dmat4& projection, const Raster& raster);
/// Sets view, eye, d and window of a camera in perspective from its matrices; false where they have no eye, or w_c is
/// the same everywhere.
[[nodiscard]] bool take_matrices(Camera& camera, const Raster& raster);
/// What the row of z_c of a camera's projection says against its near and far plane: z_c/w_c must go there from -1 or 0
/// to 1, the other way, or between the ends of the depth range. Empty where it agrees, and where it is all 0 and says
/// nothing.
std::string planes_against_matrix(const Camera& camera);
inline constexpr std::string_view row_of_depth_remedy =
    "give near and far where it has -1 or 0 and 1, or the depth_range that it has, or write 0 in that row";

struct Scene {
  std::string name;                ///< "pyramid"
  std::string source;              ///< the file or "built-in"
  std::vector<glm::dvec3> points;  ///< world; for Camera::Kind::screen (x_s, y_s, z)
  std::vector<std::int32_t>
      point_lines;  ///< line of its file each point stands at, 0 if there is none; empty if none has one
  std::vector<Polygon> polygons;
  std::vector<Facet> facets;
  std::vector<std::int32_t> corners;        ///< indices into points
  std::vector<VertexAttribute> attributes;  ///< each of another name
  std::vector<Texture> textures;            ///< that polygons' materials name
  Color background{255, 255, 255};
  Camera camera;
  Raster raster;
  std::optional<Light> light;
  std::optional<Surface> surface;     ///< if the scene is one; its cells are the polygons
  std::vector<Placement> placements;  ///< by their points; those of no placement stand in the scene's own file
  std::optional<Fit> fit;
  std::vector<glm::dvec3> file_points;  ///< as their files have them: as many as points; empty if those were not moved
  bool operator==(const Scene&) const = default;
};

/// The attribute of this name; nullptr where there is none.
const VertexAttribute* attribute_named(const Scene& scene, std::string_view name);

/// The placement a point comes from; none if it is the scene's own.
const Placement* placement_of(const Scene& scene, std::int32_t point);

inline constexpr std::int32_t no_polygon = -1;
inline constexpr double no_depth = std::numeric_limits<double>::infinity();

/// A colour of a pixel's own as Picture::ink keeps it.
inline constexpr std::uint32_t no_ink = 0;
constexpr std::uint32_t ink_of(Color color) {
  return 0xff000000u | static_cast<std::uint32_t>(color.red) << 16 | static_cast<std::uint32_t>(color.green) << 8 |
         color.blue;
}
constexpr Color color_of(std::uint32_t ink) {
  return {static_cast<std::uint8_t>(ink >> 16), static_cast<std::uint8_t>(ink >> 8), static_cast<std::uint8_t>(ink)};
}

/// The two buffers, and a third where a method writes colours that are no polygon's own. Row-major, `width` numbers a
/// row; row 0 first.
struct Picture {
  std::int32_t width = 0, height = 0;
  std::vector<std::int32_t> polygon;  ///< [height*width], index of the polygon seen, no_polygon where none is
  std::vector<double> depth;          ///< [height*width], the buffer's own numbers, no_depth where nothing was drawn
  std::vector<std::uint32_t> ink;     ///< [height*width] or empty; what ink_of() made, no_ink: the polygon's own colour

  Picture() = default;
  Picture(std::int32_t width_, std::int32_t height_)
      : width(width_),
        height(height_),
        polygon(pixel_count(width_, height_), no_polygon),
        depth(polygon.size(), no_depth) {}

  std::size_t at(std::int32_t x, std::int32_t y) const { return pixel_at(x, y, width); }
  bool operator==(const Picture&) const = default;
  void use_ink() { ink.assign(polygon.size(), no_ink); }
};

/// The colour of a pixel: its ink where it has one, else its polygon's, else the background.
Color color_at(const Picture& picture, const Scene& scene, std::size_t pixel);

/// z_v at a pixel from the number in the buffer. Infinity stays infinity; a screen scene's z is returned as it is.
double view_depth(const Camera& camera, const Conventions& conventions, double buffer_depth);
/// And back.
double buffer_depth(const Camera& camera, const Conventions& conventions, double view_depth);

/// By how much z_v is off where the number in the buffer is off by so much.
double view_depth_error(const Camera& camera, const Conventions& conventions, double buffer_depth, double off);

/// How far apart the depths of a run can lie: from the near plane to the far one; in a screen scene, from the least z
/// of its points to the greatest. 1 where that is nothing.
double depth_range(const Scene& scene, Conventions::Depth depth);
/// The least and the greatest of them.
std::pair<double, double> ends_of_depths(const Scene& scene, Conventions::Depth depth);
/// By how much two fixed-point depths differ at least; 0 where the format is floating point.
double depth_unit(const Scene& scene, const Conventions& conventions);
/// The same of positions on the raster.
inline constexpr double fixed_positions_a_pixel = 65536;

// A lamp as a camera, and the matrices of cameras: a trace has the lamp alone, and what it sees follows from it.

/// World to view, from its first three rows.
glm::dmat4 view_from_rows(glm::dvec4 row_1, glm::dvec4 row_2, glm::dvec4 row_3);

/// World to view for an eye that looks at `target`, with `up` upwards in the picture; left-handed as T_v is. `eye` and
/// `target` must differ. An `up` along the line of sight says nothing: the world axis furthest from that line stands
/// in.
glm::dmat4 look_at_view(glm::dvec3 eye, glm::dvec3 target, glm::dvec3 up);

/// The light as a camera that sees what it shines on, with the world's z axis upwards.
Camera camera_of(const Light& light);

}  // namespace zstep
