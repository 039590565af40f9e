// STL, the format of 3D Systems' StereoLithography Interface Specification (1989), ascii and binary.
#include <cmath>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "algorithms/scene/files/tokens.hpp"
#include "algorithms/scene/files/polygon_soup.hpp"
#include "algorithms/scene/files/read_mesh.hpp"
#include "traces/error.hpp"
#include "traces/text.hpp"

namespace zstep::scene {

namespace {

constexpr std::size_t binary_head = 84, binary_triangle = 50;

std::uint32_t u32_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::uint32_t{byte_of(bytes[at + i])} << (8 * i);
  return value;
}
double float_at(std::string_view bytes, std::size_t at) {
  const std::uint32_t bits = u32_at(bytes, at);
  float value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// Binary files may begin with "solid" too. One whose size fits its count is binary; else text is what holds no zero
/// byte.
bool is_binary(std::string_view bytes) {
  if (bytes.size() >= binary_head && bytes.size() == binary_head + binary_triangle * std::size_t{u32_at(bytes, 80)})
    return true;
  const std::size_t start = bytes.find_first_not_of(" \t\r\n");
  if (start == std::string_view::npos) return false;
  const std::string_view word = bytes.substr(start, 5);
  if (word != "solid" && word != "SOLID" && word != "Solid") return true;
  return bytes.substr(0, 1024).find('\0') != std::string_view::npos;
}

PolygonSoup read_binary(std::string_view bytes, const std::string& name) {
  if (bytes.size() < binary_head)
    throw InputError(fmt::format("{}:byte {}", name, bytes.size()), "the file ends within its head",
                     "an STL file begins with 'solid' or with 84 bytes of head");
  const std::size_t count = u32_at(bytes, 80);
  if ((bytes.size() - binary_head) / binary_triangle < count)
    throw InputError(fmt::format("{}:byte 80", name),
                     fmt::format("{} triangles are declared, but the file holds {}", count,
                                 (bytes.size() - binary_head) / binary_triangle),
                     "get the file again: it was cut short");
  PolygonSoup soup;
  PointMerger merger;
  for (std::size_t triangle = 0; triangle < count; ++triangle) {
    const std::size_t start = binary_head + triangle * binary_triangle;
    std::size_t at = start;
    const auto where = [&] { return fmt::format("{}:byte {}", name, at); };
    for (std::size_t corner = 0; corner < 3; ++corner) {
      glm::dvec3 point;
      for (int axis = 0; axis < 3; ++axis) {
        at = start + 12 + 12 * corner +
             4 * static_cast<std::size_t>(axis);  // the normal comes first: the corners say it better
        const double value = float_at(bytes, at);
        if (!(std::abs(value) <= largest_coordinate)) checked_coordinate(value, where(), "a coordinate");
        point[axis] = value;
      }
      soup.add_corner(merger.add(soup, point, 0, where), where);
    }
    soup.close_outline(0, std::nullopt, where);
  }
  return soup;
}

bool is_word(std::string_view token, std::string_view word) {
  if (token.size() != word.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i)
    if ((token[i] | 0x20) != word[i]) return false;
  return true;
}

class AsciiReader {
 public:
  AsciiReader(std::string_view bytes, const std::string& name) : file_(bytes, name, Tokens::Comments::none) {}

  PolygonSoup read() {
    for (std::string_view word = file_.next(); !word.empty(); word = file_.next()) {
      if (!is_word(word, "solid")) unexpected(word, "solid");
      file_.rest_of_line();  // the name
      for (word = file_.next(); is_word(word, "facet"); word = file_.next()) facet();
      if (!is_word(word, "endsolid")) unexpected(word, "facet or endsolid");
      file_.rest_of_line();
    }
    return std::move(soup_);
  }

 private:
  void facet() {
    const std::int32_t line = file_.line();
    const auto where = [&] { return file_.where(); };
    expect("normal");
    for (int axis = 0; axis < 3; ++axis) {
      // Many exporters write nan for the normal of a thin triangle; it is not used.
      if (const std::string_view token = file_.next(); !parse_number(token))
        unexpected(token, "a number of the normal");
    }
    expect("outer");
    expect("loop");
    for (int corner = 0; corner < 3; ++corner) {
      expect("vertex");
      const std::int32_t vertex_line = file_.line();
      glm::dvec3 point;
      point.x = file_.coordinate(file_.next(), "x of a vertex");
      point.y = file_.coordinate(file_.next(), "y of a vertex");
      point.z = file_.coordinate(file_.next(), "z of a vertex");
      soup_.add_corner(merger_.add(soup_, point, vertex_line, where), where);
    }
    expect("endloop");
    expect("endfacet");
    soup_.close_outline(line, std::nullopt, where);
  }

  void expect(std::string_view word) {
    if (const std::string_view token = file_.next(); !is_word(token, word)) unexpected(token, word);
  }
  [[noreturn]] void unexpected(std::string_view token, std::string_view wanted) const {
    if (token.empty())
      file_.fail(fmt::format("the file ends where {} should stand", wanted), "get the file again: it was cut short");
    file_.fail(fmt::format("{} stands where {} should", in_quotes(token), wanted),
               "is this an STL file, and is it whole?");
  }

  Tokens file_;
  PolygonSoup soup_;
  PointMerger merger_;
};

}  // namespace

PolygonSoup read_stl(std::string_view bytes, const std::string& name) {
  if (is_binary(bytes)) return read_binary(bytes, name);
  return AsciiReader(bytes, name).read();
}

}  // namespace zstep::scene
