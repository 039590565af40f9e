// OFF, as the manual of Geomview has it (The Geometry Center, University of Minnesota, 1992–), ascii and binary.
#include <array>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "algorithms/scene/files/bytes.hpp"
#include "algorithms/scene/files/tokens.hpp"
#include "algorithms/scene/files/read_mesh.hpp"
#include "traces/error.hpp"
#include "traces/math/whole.hpp"

namespace zstep::scene {

namespace {

struct Kind {
  int extra_numbers = 0;  ///< texture coordinates, a colour or a normal follow the coordinates of each vertex
  std::string_view rest;  ///< of the word: some programs write the first count right behind it
};

/// The keyword: OFF with any of the prefixes ST, C and N, in this order.
std::optional<Kind> kind_of_keyword(std::string_view word) {
  struct Prefix {
    std::string_view letters;
    int numbers;
  };
  Kind kind;
  for (const auto& [letters, numbers] : {Prefix{"ST", 2}, Prefix{"C", 4}, Prefix{"N", 3}})
    if (word.starts_with(letters)) {
      word.remove_prefix(letters.size());
      kind.extra_numbers += numbers;
    }
  if (!word.starts_with("OFF")) return std::nullopt;
  kind.rest = word.substr(3);
  if (!kind.rest.empty() && !parse_integer(kind.rest)) return std::nullopt;
  return kind;
}

/// The colour that may stand after a face's corners: nothing, an index into a colour map (which is passed over), or
/// three or four numbers, of 0 … 255 when all are whole and of 0 … 1 otherwise.
std::optional<Color> face_color(Tokens& file) {
  double values[4] = {};
  int count = 0;
  bool whole = true;
  for (std::string_view token = file.next_in_line(); !token.empty(); token = file.next_in_line()) {
    if (count == 4) file.fail("more than four numbers follow the corners", "a colour is r g b or r g b a");
    values[count] = file.coordinate(token, "the face's colour");
    whole = whole && parse_integer(token).has_value();
    ++count;
  }
  if (count == 0 || count == 1) return std::nullopt;
  if (count == 2) file.fail("two numbers follow the corners", "a colour is r g b or r g b a");
  Color color;
  std::uint8_t* channels[3] = {&color.red, &color.green, &color.blue};
  for (int i = 0; i < 3; ++i) {
    const double value = whole ? values[i] : 255 * values[i];
    if (!(value >= 0 && value <= 255))
      file.fail("a colour's number is out of range", "use whole numbers of 0 to 255, or fractions of 0 to 1");
    *channels[i] = nearest_byte(value);
  }
  return color;
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
  const std::int32_t points = count("vertices", 12), faces = count("faces", 8);
  file.take<std::int32_t>();  // the number of edges, which nobody needs
  for (std::int32_t i = 0; i < points; ++i) {
    glm::dvec3 point;
    for (int axis = 0; axis < 3; ++axis)
      point[axis] = checked_coordinate(file.take<float>(), where(), "a coordinate of a vertex");
    for (int k = 0; k < kind.extra_numbers; ++k) file.take<float>();
    soup.add_point(point, 0, where);
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
    std::array<std::uint8_t, 4> channels{};
    for (std::int32_t k = 0; k < components; ++k) {
      const double value = file.take<float>();
      if (!(value >= 0 && value <= 1))
        throw InputError(where(), "a colour's number is out of range", "use fractions of 0 to 1");
      channels[k] = nearest_byte(255 * value);
    }
    if (components >= 3) color = Color{channels[0], channels[1], channels[2]};
    soup.close_outline(0, color, where);
  }
  return soup;
}

}  // namespace

PolygonSoup read_off(std::string_view bytes, const std::string& name) {
  Tokens file(bytes, name, Tokens::Comments::hash);
  const auto where = [&] { return file.where(); };
  PolygonSoup soup;

  std::string_view token = file.next();
  Kind kind;
  if (const auto known = kind_of_keyword(token)) {
    kind = *known;
    token = kind.rest.empty() ? file.next() : kind.rest;
    if (token == "BINARY") {
      // The numbers begin after the line's end, be it LF or CR LF.
      const std::size_t end = bytes.find('\n', bytes.size() - file.bytes_left());
      if (end == std::string_view::npos)
        file.fail("the file ends after BINARY", "get the file again: it was cut short");
      return read_binary(bytes, name, end + 1, kind);
    }
  } else if (!parse_integer(token)) {  // the keyword may be missing altogether
    if (token.find("OFF") != std::string_view::npos)
      file.fail(fmt::format("{} is not read", in_quotes(token)),
                "only OFF in three dimensions is, with the prefixes ST, C and N");
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

  for (std::int64_t i = 0; i < declared_points; ++i) {
    glm::dvec3 point;
    point.x = file.coordinate(file.next(), "x of a vertex");
    const std::int32_t line = file.line();
    point.y = file.coordinate(file.next(), "y of a vertex");
    point.z = file.coordinate(file.next(), "z of a vertex");
    if (kind.extra_numbers > 0) file.rest_of_line();
    soup.add_point(point, line, where);
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
    soup.close_outline(line, face_color(file), where);
  }
  if (const std::string_view more = file.next(); !more.empty())
    file.fail(fmt::format("{} follows after the last face", in_quotes(more)),
              "correct the counts in the head of the file");
  return soup;
}

}  // namespace zstep::scene
