// OFF, as the manual of Geomview has it (The Geometry Center, University of Minnesota, 1992–), ascii only.
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "algorithms/scene/files/number.hpp"
#include "algorithms/scene/files/read_mesh.hpp"
#include "algorithms/scene/files/tokens.hpp"
#include "traces/error.hpp"

namespace zstep::scene {

namespace {

struct Kind {
  bool extra_numbers =
      false;  ///< colours, normals or texture coordinates follow the coordinates, to the end of the line
};

bool starts_with(std::string_view text, std::string_view start) { return text.substr(0, start.size()) == start; }

/// The keyword: OFF with any of the prefixes ST, C and N, in this order.
std::optional<Kind> kind_of_keyword(std::string_view word) {
  Kind kind;
  for (const std::string_view prefix : {"ST", "C", "N"})
    if (starts_with(word, prefix)) {
      word.remove_prefix(prefix.size());
      kind.extra_numbers = true;
    }
  if (word != "OFF") return std::nullopt;
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
    *channels[i] = static_cast<std::uint8_t>(std::lround(value));
  }
  return color;
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
    token = file.next();
    if (token == "BINARY") file.fail("binary OFF is not read", "save it as ascii OFF, or as PLY");
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
    if (kind.extra_numbers) file.rest_of_line();
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
