// What a mesh reader hands on: points and outlines, in the order of the file, checked; points that are the same are
// merged.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/vec3.hpp>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "traces/math/whole.hpp"
#include "traces/scene.hpp"

namespace zstep::scene {

/// Things of one sort that a file holds and that are not drawn: how many, and where the first stands.
struct PassedOver {
  std::int64_t count = 0;
  std::string where;

  template <class Where>
  void add(Where&& where_it_stands) {
    if (count++ == 0) where = where_it_stands();
  }
};

/// What any format may hold and zstep does not draw. Readers count it; finish_soup says it.
struct Losses {
  PassedOver textures, opacities;
  PassedOver values;      ///< of attributes that are no finite number, or that a corner names and the file lacks
  PassedOver components;  ///< of an attribute, or whole attributes, beyond what a scene keeps
  PassedOver clamped_colors;
  PassedOver unplaced;  ///< polygons left out, as a vertex of theirs is no finite number
};

/// What one scene may hold. With these, the largest file that is accepted needs less than 1 GiB to load.

/// Every corner is an index into `points`, every coordinate is finite once finish_soup was called, and nothing is
/// beyond the limits.
struct PolygonSoup {
  std::vector<glm::dvec3> points;
  std::vector<std::int32_t> point_lines;    ///< one a point; empty for a binary file
  std::vector<Facet> outlines;              ///< the k-th is polygon k, with its corners as the file has them
  std::vector<std::int32_t> outline_lines;  ///< one a polygon; empty for a binary file
  std::vector<std::int32_t> corners;
  std::vector<std::optional<Color>> colors;  ///< one a polygon, or none at all
  std::vector<Material> materials;           ///< one a polygon, or none at all
  std::vector<std::string> names;            ///< one a polygon, or none at all
  std::vector<VertexAttribute> attributes;   ///< of_point may be shorter than points until finish_soup was called
  /// What materials' textures stand for: files that the mesh names, and once load_textures() has read them, images.
  struct NamedTexture {
    std::string named, where;  ///< as the file has it, and where
    auto operator<=>(const NamedTexture&) const = default;
  };
  std::vector<NamedTexture> named_textures;
  std::vector<Texture> textures;
  std::vector<std::string> notes;  ///< what was passed over, one sentence each
  Losses losses;

  /// Adds a point; throws InputError at `where()` beyond the limit. `line` 0: the file has no lines.
  template <class Where>
  void add_point(glm::dvec3 point, std::int32_t line, Where&& where) {
    if (std::ssize(points) == most_points) too_much(where(), "points", most_points);
    points.push_back(point);
    if (line > 0) point_lines.push_back(line);
  }
  /// Of the polygon that is being read.
  std::int32_t first_corner() const {
    return outlines.empty() ? 0 : outlines.back().first_corner + outlines.back().corner_count;
  }
  /// Adds a polygon whose corners were pushed to `corners` since the last one; throws InputError beyond the limit.
  template <class Where>
  void close_outline(std::int32_t line, std::optional<Color> color, Where&& where) {
    if (std::ssize(outlines) == most_polygons) too_much(where(), "polygons", most_polygons);
    const std::int32_t first = first_corner();
    const auto polygon = size32(outlines);
    if (std::ssize(corners) - first > most_corners_of_polygon)
      too_much(where(), "corners of one polygon", most_corners_of_polygon);
    outlines.push_back({polygon, first, size32(corners) - first});
    if (line > 0) outline_lines.push_back(line);
    if (color && colors.empty()) colors.resize(outlines.size() - 1);
    if (color || !colors.empty()) colors.push_back(color);
  }
  template <class Where>
  void add_corner(std::int64_t point, Where&& where) {
    if (std::ssize(corners) == most_corners) too_much(where(), "corners", most_corners);
    corners.push_back(static_cast<std::int32_t>(point));
  }

  /// The number of a texture that the file names.
  std::int32_t texture(std::string_view named, std::string_view where) {
    for (std::size_t k = 0; k < named_textures.size(); ++k)
      if (named_textures[k].named == named) return static_cast<std::int32_t>(k);
    if (std::ssize(named_textures) == most_textures) {
      losses.textures.add([&] { return std::string(where); });
      return no_texture;
    }
    named_textures.push_back({std::string(named), std::string(where)});
    return static_cast<std::int32_t>(named_textures.size() - 1);
  }

  /// The attribute of this name, made where there is none; nullptr, and counted as a loss, where a scene has no room.
  template <class Where>
  VertexAttribute* attribute(std::string_view name, std::int32_t components, Where&& where) {
    for (VertexAttribute& known : attributes)
      if (known.name == name) return &known;
    if (std::ssize(attributes) == most_attributes) {
      losses.components.add(where);
      return nullptr;
    }
    attributes.push_back({std::string(name), components, {}, {}, {}, {}});
    return &attributes.back();
  }
  /// Adds a value, of as many numbers as the attribute has. What is no finite number becomes 0, and is counted.
  template <class Where>
  void add_value(VertexAttribute& to, std::span<const double> numbers, std::int32_t line, Where&& where) {
    if (std::ssize(to.values) >= most_values * to.components) too_much(where(), "values of an attribute", most_values);
    bool sound = true;
    for (std::int32_t k = 0; k < to.components; ++k) {
      const double number = k < std::ssize(numbers) ? numbers[k] : 0;
      const bool is_value = std::abs(number) <= largest_value;
      sound = sound && is_value;
      to.values.push_back(is_value ? number : 0);
    }
    if (!sound) losses.values.add(where);
    if (line > 0) to.lines.push_back(line);
  }
  /// The same, for the last point.
  template <class Where>
  void add_value_of_point(VertexAttribute& to, std::span<const double> numbers, std::int32_t line, Where&& where) {
    add_value(to, numbers, line, where);
    to.of_point.resize(points.size(), no_value);
    to.of_point.back() = static_cast<std::int32_t>(std::ssize(to.values) / to.components - 1);
  }
  /// Values by corner, no_value where one has none: what most polygons have at a point is the point's.
  void give_to_corners(VertexAttribute& to, std::span<const std::int32_t> value_of_corner);

  /// A colour by numbers of 0 … 255. What lies beyond is taken as the nearest of them, and counted.
  template <class Where>
  Color color_of(glm::dvec3 numbers, Where&& where) {
    for (int i = 0; i < 3; ++i)
      if (!(numbers[i] > -0.5 && numbers[i] < 255.5)) {
        losses.clamped_colors.add(where);
        break;
      }
    const auto channel = [](double value) { return nearest_byte(std::fmin(255, std::fmax(0, value))); };
    return {channel(numbers.x), channel(numbers.y), channel(numbers.z)};
  }

  /// A note of what was passed over, if anything was: "WHERE: 2 textures are not drawn" of "texture is", "textures are"
  /// and " not drawn".
  void note(const PassedOver& passed, std::string_view one, std::string_view several, std::string_view rest);

  std::span<const std::int32_t> corners_of(const Facet& outline) const {
    return {corners.data() + outline.first_corner, static_cast<std::size_t>(outline.corner_count)};
  }

  [[noreturn]] static void too_much(std::string_view where, std::string_view what, std::int64_t most);
};

/// What every reader does at its end: leaves out the polygons with a vertex that is no finite number, and notes what
/// was lost. Vertices keep their numbers; one without a place that no polygon uses harms nobody. Throws InputError
/// where no polygon is left. `name` is what notes call the file.
PolygonSoup finish_soup(PolygonSoup soup, const std::string& name);

// Equal points become one, so that polygons given by their coordinates share their vertices.

/// A hash table of the points of one soup.
class PointMerger {
 public:
  /// The index of `point` in the soup, which gets it if it is new; always the same soup. Equal means equal in every
  /// bit, but -0 is 0.
  template <class Where>
  std::int64_t add(PolygonSoup& soup, glm::dvec3 point, std::int32_t line, Where&& where) {
    point += 0.0;
    if (2 * (count_ + 1) > slots_.size()) grow(soup);
    std::int32_t& slot = slots_[place_of(soup, point)];
    if (slot < 0) {
      soup.add_point(point, line, where);
      slot = size32(soup.points) - 1;
      ++count_;
    }
    return slot;
  }

 private:
  // The slot that holds the point, or the empty one where it belongs.
  std::size_t place_of(const PolygonSoup& soup, const glm::dvec3& point) const {
    std::uint64_t hash = seed_;
    for (int axis = 0; axis < 3; ++axis) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &point[axis], sizeof bits);
      hash = (hash ^ bits) * 0x9E3779B97F4A7C15ULL;
      hash ^= hash >> 32;
    }
    const std::size_t mask = slots_.size() - 1;
    std::size_t place = static_cast<std::size_t>(hash) & mask;
    while (slots_[place] >= 0 && soup.points[slots_[place]] != point) place = (place + 1) & mask;
    return place;
  }

  void grow(const PolygonSoup& soup) {
    const std::vector<std::int32_t> old = std::move(slots_);
    slots_.assign(old.empty() ? 64 : 2 * old.size(), -1);
    for (const std::int32_t index : old)
      if (index >= 0) slots_[place_of(soup, soup.points[index])] = index;
  }

  std::vector<std::int32_t> slots_;  // indices into the soup's points, -1 where empty; at least half of them are
  std::size_t count_ = 0;
  // Anew each time, so that no file can be made whose points all meet in one slot. The indices do not depend on it.
  std::uint64_t seed_ = std::random_device{}();
};

}  // namespace zstep::scene
