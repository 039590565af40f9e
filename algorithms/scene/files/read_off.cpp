// OFF, as the manual of Geomview has it (The Geometry Center, University of Minnesota, 1992–), ascii and binary.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "algorithms/scene/files/bytes.hpp"
#include "algorithms/scene/files/tokens.hpp"
#include "algorithms/scene/files/read_mesh.hpp"
#include "traces/error.hpp"
#include "traces/text.hpp"

namespace zstep::scene {

namespace {

struct Kind {
  bool homogeneous = false;  ///< a weight w follows x y z
  bool colored = false;      ///< a colour, r g b a
  bool has_normal = false;   ///< a normal comes before that
  bool has_texture = false;  ///< texture coordinates come after it
  std::string_view rest;     ///< of the word: some programs write the first count right behind it
};

/// The keyword: OFF with any of the prefixes ST, C, N and 4, in capitals or not, each once. Geomview's order is this
/// one; MeshLab writes NCOFF.
std::optional<Kind> kind_of_keyword(std::string_view word) {
  if (word.find("nOFF") != std::string_view::npos) return std::nullopt;  // the small n: of n dimensions
  std::array<std::string_view, 4> prefixes{"st", "c", "n", "4"};
  const std::string letters = lower_case(word);
  std::string_view left = letters;
  const auto take = [&](std::string_view& prefix) {
    if (prefix.empty() || !left.starts_with(prefix)) return false;
    left.remove_prefix(std::exchange(prefix, {}).size());
    return true;
  };
  while (std::any_of(prefixes.begin(), prefixes.end(), take)) {
  }
  if (!left.starts_with("off")) return std::nullopt;
  Kind kind;
  kind.rest = word.substr(word.size() - left.size() + 3);
  if (!kind.rest.empty() && !parse_integer(kind.rest)) return std::nullopt;
  const auto has = [&](std::size_t prefix) { return prefixes[prefix].empty(); };
  kind.homogeneous = has(3);
  kind.colored = has(1);
  kind.has_normal = has(2);
  kind.has_texture = has(0);
  return kind;
}

/// What stands behind a vertex's place: a normal, a colour, texture coordinates, as far as there are any.
void add_values(PolygonSoup& soup, const Kind& kind, std::span<const double> numbers, bool whole, std::int32_t line,
                auto&& where) {
  const auto add = [&](const char* name, std::span<const double> value, std::size_t components) {
    if (value.size() < components) return soup.losses.values.add(where);
    if (VertexAttribute* to = soup.attribute(name, static_cast<std::int32_t>(components), where))
      soup.add_value_of_point(*to, value.first(components), line, where);
  };
  if (kind.has_normal)
    add(normal_attribute, numbers, 3), numbers = numbers.subspan(std::min<std::size_t>(3, numbers.size()));
  const std::size_t texture = kind.has_texture ? 2 : 0;
  const std::span color = numbers.first(numbers.size() - std::min(texture, numbers.size()));
  if (color.size() >= 3) {
    std::array<double, 3> rgb{color[0], color[1], color[2]};
    if (whole)
      for (double& channel : rgb) channel /= 255;
    add(color_attribute, rgb, 3);
    if (color.size() > 3 && color[3] != (whole ? 255 : 1)) soup.losses.components.add(where);
  }
  if (kind.has_texture) add(uv_attribute, numbers.last(std::min(texture, numbers.size())), 2);
}

/// The point of x, y, z and a weight that is not 0.
glm::dvec3 divided(glm::dvec3 point, double weight, const std::string& where) {
  if (weight == 0)
    throw InputError(where, "w of a vertex is 0, which puts it at infinity", "give it another weight, usually 1");
  return point / weight;
}

/// The colour that may stand after a face's corners: nothing, an index into a colour map, or three or four numbers, of
/// 0 … 255 when all are whole and of 0 … 1 otherwise.
std::optional<Color> face_color(Tokens& file, PolygonSoup& soup, PassedOver& map_indices) {
  const auto where = [&] { return file.where(); };
  double values[4] = {};
  int count = 0;
  bool whole = true;
  for (std::string_view token = file.next_in_line(); !token.empty(); token = file.next_in_line()) {
    if (count == 4) file.fail("more than four numbers follow the corners", "a colour is r g b or r g b a");
    values[count] = file.number(token, "the face's colour");
    whole = whole && parse_integer(token).has_value();
    ++count;
  }
  if (count == 2) file.fail("two numbers follow the corners", "a colour is r g b or r g b a");
  if (count == 1) map_indices.add(where);
  if (count < 3) return std::nullopt;
  if (count == 4 && values[3] != (whole ? 255 : 1)) soup.losses.opacities.add(where);
  return soup.color_of((whole ? 1.0 : 255.0) * glm::dvec3(values[0], values[1], values[2]), where);
}

/// Whether more numbers than those of a point in the line of the first vertex are a colour, as programs write it also
/// where the keyword has no C: then each vertex and each face has a line of its own. Else they are the next vertex.
bool colors_follow(Tokens file, const Kind& kind, std::int64_t vertices_and_faces) {
  const int of_point = kind.homogeneous ? 4 : 3;
  if (!file.next_in_line().empty()) return false;  // the vertices begin in the line of the counts
  std::int64_t lines = 0;
  while (lines < vertices_and_faces && file.next_line()) {
    if (file.next_in_line().empty()) continue;
    if (++lines > 1) continue;
    int numbers = 1;
    while (!file.next_in_line().empty()) ++numbers;
    if (numbers <= of_point) return false;
    if (numbers % of_point != 0) return true;
  }
  return lines == vertices_and_faces;
}

PolygonSoup finished(PolygonSoup soup, const PassedOver& map_indices, const std::string& name) {
  soup.note(map_indices, "polygon has", "polygons have", " an index into a colour map, which is not read; write r g b");
  return finish_soup(std::move(soup), name);
}

/// What follows the line "OFF BINARY": counts and indices in four bytes each and numbers in float32, the highest byte
/// first; after the corners of a face the number of its colour's components, and these.
PolygonSoup read_binary(std::string_view bytes, const std::string& name, std::size_t at, const Kind& kind) {
  BinaryReader file(bytes, name, at, true);
  const auto where = [&] { return file.where(); };
  const auto count = [&](std::string_view what, std::size_t least_bytes) {
    const auto value = file.take<std::int32_t>();
    if (value < 0 || static_cast<std::size_t>(value) > file.bytes_left() / least_bytes)
      throw InputError(where(),
                       fmt::format("{} {} are declared, which {} bytes cannot hold", value, what, file.bytes_left()),
                       "correct the count, or get the file again if it was cut short");
    return value;
  };
  PolygonSoup soup;
  PassedOver map_indices;
  const std::int32_t points = count("vertices", 12), faces = count("faces", 8);
  file.take<std::int32_t>();  // the number of edges, which nobody needs
  for (std::int32_t i = 0; i < points; ++i) {
    glm::dvec3 point;
    for (int axis = 0; axis < 3; ++axis) {
      point[axis] = file.take<float>();
      if (std::isfinite(point[axis])) checked_coordinate(point[axis], where(), "a coordinate of a vertex");
    }
    if (kind.homogeneous) point = divided(point, file.take<float>(), where());
    std::vector<double> more((kind.has_normal ? 3 : 0) + (kind.colored ? 4 : 0) + (kind.has_texture ? 2 : 0));
    for (double& number : more) number = file.take<float>();
    soup.add_point(point, 0, where);
    add_values(soup, kind, more, false, 0, where);
  }
  for (std::int32_t i = 0; i < faces; ++i) {
    const std::int32_t corners = count("corners of a face", 4);
    for (std::int32_t k = 0; k < corners; ++k) {
      const auto index = file.take<std::int32_t>();
      if (index < 0 || index >= points)
        throw InputError(where(), fmt::format("there is no vertex {}", index),
                         fmt::format("the indices are 0 to {}", points - 1));
      soup.add_corner(index, where);
    }
    std::optional<Color> color;
    const std::int32_t components = count("components of a colour", 4);
    if (components > 4)
      throw InputError(where(), fmt::format("a colour of {} components", components), "a colour is r g b or r g b a");
    std::array<double, 4> values{};
    for (std::int32_t k = 0; k < components; ++k) values[k] = file.take<float>();
    if (components >= 3) color = soup.color_of(255.0 * glm::dvec3(values[0], values[1], values[2]), where);
    if (components == 4 && values[3] != 1) soup.losses.opacities.add(where);
    if (components == 1) map_indices.add(where);
    soup.close_outline(0, color, where);
  }
  return finished(std::move(soup), map_indices, name);
}

}  // namespace

PolygonSoup read_off(std::string_view bytes, const std::string& name) {
  Tokens file(bytes, name, Tokens::Comments::hash);
  const auto where = [&] { return file.where(); };
  PolygonSoup soup;
  PassedOver map_indices;

  std::string_view token = file.next();
  Kind kind;
  if (const auto known = kind_of_keyword(token)) {
    kind = *known;
    token = kind.rest.empty() ? file.next() : kind.rest;
    if (lower_case(token) == "binary") {
      // The numbers begin after the line's end, be it LF or CR LF.
      const std::size_t end = bytes.find('\n', bytes.size() - file.bytes_left());
      if (end == std::string_view::npos)
        file.fail("the file ends after BINARY", "get the file again: it was cut short");
      return read_binary(bytes, name, end + 1, kind);
    }
  } else if (!parse_integer(token)) {  // the keyword may be missing altogether
    if (lower_case(token).find("off") != std::string::npos)
      file.fail(fmt::format("{} is not read", in_quotes(token)),
                "only OFF in three dimensions is, with the prefixes ST, C, N and 4, each once");
    file.fail(fmt::format("{} is not the beginning of an OFF file", in_quotes(token)), "begin with OFF");
  }

  constexpr std::int64_t any = std::numeric_limits<std::int32_t>::max();
  const std::int64_t declared_points = file.count(token, "the number of vertices", any);
  const std::int64_t declared_faces = file.count(file.next(), "the number of faces", any);
  if (const std::string_view edges = file.next_in_line(); !edges.empty()) file.count(edges, "the number of edges", any);
  // A vertex takes six bytes at least ("0 0 0\n"), a face two ("0\n"); the last line may lack its end.
  const auto left = static_cast<std::int64_t>(file.bytes_left()) + 1;
  if (declared_points > left / 6 || declared_faces > left / 2)
    file.fail(fmt::format("{} vertices and {} faces are declared, which {} bytes cannot hold", declared_points,
                          declared_faces, left - 1),
              "correct the counts, or get the file again if it was cut short");

  const bool announced = kind.colored || kind.has_normal || kind.has_texture;
  const bool more_follow = announced || colors_follow(file, kind, declared_points + declared_faces);
  for (std::int64_t i = 0; i < declared_points; ++i) {
    glm::dvec3 point;
    point.x = file.coordinate_or_nan(file.next(), "x of a vertex");
    const std::int32_t line = file.line();
    point.y = file.coordinate_or_nan(file.next(), "y of a vertex");
    point.z = file.coordinate_or_nan(file.next(), "z of a vertex");
    if (kind.homogeneous) point = divided(point, file.coordinate_or_nan(file.next(), "w of a vertex"), where());
    std::vector<double> more;
    bool whole = true;
    if (more_follow) {
      for (std::string_view next = file.next_in_line(); !next.empty(); next = file.next_in_line()) {
        more.push_back(parse_number(next).value_or(std::nan("")));
        whole = whole && parse_integer(next).has_value();
      }
      if (!announced && !more.empty() && more.size() != 3 && more.size() != 4)
        file.fail(fmt::format("after x, y and z of a vertex stand {} more numbers", more.size()),
                  "a colour is r g b or r g b a; put 4 before OFF for a weight, N for a normal, ST for a texture");
    }
    soup.add_point(point, line, where);
    if (!more.empty()) add_values(soup, kind, more, whole, line, where);
  }
  for (std::int64_t i = 0; i < declared_faces; ++i) {
    const std::string_view first = file.next();
    const std::int32_t line = file.line();
    const std::int64_t corners =
        file.count(first, "the number of corners", static_cast<std::int64_t>(file.bytes_left() / 2));
    for (std::int64_t k = 0; k < corners; ++k) {
      const std::string_view corner = file.next();
      const auto index = parse_integer(corner);
      if (!index)
        file.fail(corner.empty() ? "the file ends within a face"
                                 : fmt::format("the corner {} is not an index", in_quotes(corner)),
                  "a face is: number of corners, then that many indices from 0");
      if (*index < 0 || *index >= declared_points)
        file.fail(fmt::format("there is no vertex {}", *index),
                  fmt::format("the indices are 0 to {}", declared_points - 1));
      soup.add_corner(*index, where);
    }
    const auto color = face_color(file, soup, map_indices);
    soup.close_outline(line, color, where);
  }
  if (const std::string_view more = file.next(); !more.empty())
    file.fail(fmt::format("{} follows after the last face", in_quotes(more)),
              "correct the counts in the head of the file");
  return finished(std::move(soup), map_indices, name);
}

}  // namespace zstep::scene
