// STL, the format of 3D Systems' StereoLithography Interface Specification (1989), ascii and binary.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "algorithms/scene/files/tokens.hpp"
#include "algorithms/scene/files/polygon_soup.hpp"
#include "algorithms/scene/files/read_mesh.hpp"
#include "traces/error.hpp"
#include "traces/math/whole.hpp"
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

bool begins_with(std::string_view token, std::string_view word) {
  return same_word(token.substr(0, word.size()), word);
}

/// Binary files may begin with "solid" too. One whose size fits its count is binary; else text is what holds no zero
/// byte: the highest of a count is one.
bool is_binary(std::string_view bytes) {
  if (bytes.size() >= binary_head && bytes.size() == binary_head + binary_triangle * std::size_t{u32_at(bytes, 80)})
    return true;
  return bytes.substr(0, 1024).find('\0') != std::string_view::npos;
}

// The two bytes behind each triangle have a colour of 5 bits a channel in files of some programs, by one of two
// conventions. VisCAM and SolidView: bit 15 says that there is one, blue is lowest. Magics, whose head has COLOR= with
// the four bytes of the whole part's: bit 15 says that the triangle has that one, red is lowest.

class FacetColors {
 public:
  explicit FacetColors(std::string_view bytes, std::size_t count) {
    constexpr std::string_view key = "COLOR=";
    const std::size_t at = bytes.substr(0, head_text).find(key);
    if (at == std::string_view::npos || at + key.size() + 4 > head_text) return;
    const auto channel = [&](std::size_t i) { return byte_of(bytes[at + key.size() + i]); };
    of_part_ = Color{channel(0), channel(1), channel(2)};
    // All of them 0: no program puts black on each, so they were not set.
    for (std::size_t k = 0; k < count && !any_; ++k) any_ = attribute_of(bytes, k) != 0;
  }

  static std::uint16_t attribute_of(std::string_view bytes, std::size_t triangle) {
    const std::size_t at = binary_head + (triangle + 1) * binary_triangle - 2;
    return static_cast<std::uint16_t>(byte_of(bytes[at]) | byte_of(bytes[at + 1]) << 8);
  }

  /// Nothing where the bytes are none.
  std::optional<Color> color_of(std::uint16_t attribute) const {
    const bool bit_15 = (attribute & 0x8000) != 0;
    const auto channel = [&](int shift) { return nearest_byte(255.0 * (attribute >> shift & 31) / 31); };
    if (!of_part_) return bit_15 ? std::optional(Color{channel(10), channel(5), channel(0)}) : std::nullopt;
    return bit_15 || !any_ ? *of_part_ : Color{channel(0), channel(5), channel(10)};
  }

 private:
  static constexpr std::size_t head_text = 80;
  std::optional<Color> of_part_;
  bool any_ = false;
};

/// As the head declares it; by the file's size where it declares none, as programs do that write into a pipe.
std::size_t triangle_count(std::string_view bytes, const std::string& name, PolygonSoup& soup) {
  if (bytes.size() < binary_head)
    throw InputError(fmt::format("{}:byte {}", name, bytes.size()), "the file ends within its head",
                     "an STL file begins with 'solid' or with 84 bytes of head");
  const std::string where = fmt::format("{}:byte 80", name);
  const std::size_t declared = u32_at(bytes, 80), left = bytes.size() - binary_head, held = left / binary_triangle;
  if (held < declared)
    throw InputError(where, fmt::format("{} triangles are declared, but the file holds {}", declared, held),
                     "get the file again: it was cut short");
  if (declared == 0 && left > 0 && left % binary_triangle == 0) {
    soup.notes.push_back(fmt::format("{}: no triangles are declared, but {} follow and are read", where, held));
    return held;
  }
  if (const std::size_t more = left - declared * binary_triangle; more > 0)
    soup.notes.push_back(fmt::format("{}:byte {}: {} bytes after the last of {} triangles are not read", name,
                                     bytes.size() - more, more, declared));
  return declared;
}

PolygonSoup read_binary(std::string_view bytes, const std::string& name) {
  PolygonSoup soup;
  PointMerger merger;
  PassedOver other_attributes;
  const std::size_t count = triangle_count(bytes, name, soup);
  const FacetColors colors(bytes, count);
  for (std::size_t triangle = 0; triangle < count; ++triangle) {
    const std::size_t start = binary_head + triangle * binary_triangle;
    std::size_t at = start;
    const auto where = [&] { return fmt::format("{}:byte {}", name, at); };
    std::array<glm::dvec3, 3> points;
    std::optional<std::size_t> unplaced;
    for (std::size_t k = 0; k < 9; ++k) {
      at = start + 12 + 4 * k;  // the normal comes first: the corners say it better
      const double value = float_at(bytes, at);
      if (!std::isfinite(value)) unplaced = unplaced.value_or(at);
      else if (std::abs(value) > largest_coordinate) checked_coordinate(value, where(), "a coordinate");
      points[k / 3][static_cast<int>(k % 3)] = value;
    }
    if (unplaced) {
      at = *unplaced;
      soup.losses.unplaced.add(where);
      continue;
    }
    for (const glm::dvec3& point : points) soup.add_corner(merger.add(soup, point, 0, where), where);
    at = start + binary_triangle - 2;
    const std::uint16_t attribute = FacetColors::attribute_of(bytes, triangle);
    const auto color = colors.color_of(attribute);
    if (!color && attribute != 0) other_attributes.add(where);
    soup.close_outline(0, color, where);
  }
  soup.note(other_attributes, "triangle has", "triangles have",
            " attribute bytes that are no colour (bit 15 is not set) and are not read");
  return finish_soup(std::move(soup), name);
}

class AsciiReader {
 public:
  AsciiReader(std::string_view bytes, const std::string& name) : file_(bytes, name, Tokens::Comments::none) {}

  PolygonSoup read() {
    std::string_view word = file_.next();
    while (!word.empty()) {
      const bool one_more_end = !soup_.outlines.empty() && (begins_with(word, "endsolid") || same_word(word, "end"));
      if (!one_more_end && !same_word(word, "solid")) unexpected(word, "solid");
      if (one_more_end) file_.rest_of_line();
      word = one_more_end ? file_.next() : solid();
    }
    soup_.note(colors_, "'color' line is", "'color' lines are", " left out: the colour of a solid is not read");
    return finish_soup(std::move(soup_), file_.name());
  }

 private:
  /// Gives the first word after the solid.
  std::string_view solid() {
    file_.rest_of_line();  // the name
    for (;;) {
      std::string_view word = file_.next();
      if (word.empty() && soup_.outlines.empty() && soup_.losses.unplaced.count == 0)
        unexpected(word, "facet or endsolid");
      if (word.empty()) {
        soup_.notes.push_back(
            fmt::format("{}: the file ends without endsolid: it may have been cut short", file_.where()));
        return word;
      }
      if (same_word(word, "solid")) {  // the same line again, or no endsolid before the next solid
        file_.rest_of_line();
      } else if (same_word(word, "color")) {
        colors_.add([&] { return file_.where(); });
        file_.rest_of_line();
      } else if (same_word(word, "facet")) {
        facet();
      } else {
        // Some programs write a blank within the word, some none before the name.
        if (same_word(word, "end")) expect("solid");
        else if (!begins_with(word, "endsolid")) unexpected(word, "facet or endsolid");
        file_.rest_of_line();
        return file_.next();
      }
    }
  }

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
    loop();
    expect_end("facet");
    const bool placed = std::all_of(loop_.begin(), loop_.end(), [](const Vertex& vertex) {
      return std::isfinite(vertex.point.x + vertex.point.y + vertex.point.z);
    });
    if (!placed) return soup_.losses.unplaced.add([&] { return fmt::format("{}:{}", file_.name(), line); });
    for (const Vertex& vertex : loop_) soup_.add_corner(merger_.add(soup_, vertex.point, vertex.line, where), where);
    soup_.close_outline(line, std::nullopt, where);
  }

  /// Three vertices by the specification; some programs write more.
  void loop() {
    loop_.clear();
    for (;;) {
      const std::string_view word = file_.next();
      if (loop_.size() >= 3 && ends(word, "loop")) return;
      if (!same_word(word, "vertex")) unexpected(word, loop_.size() < 3 ? "vertex" : "endloop");
      if (std::ssize(loop_) > most_corners_of_polygon)
        PolygonSoup::too_much(file_.where(), "corners of one polygon", most_corners_of_polygon);
      Vertex& vertex = loop_.emplace_back();
      vertex.line = file_.line();
      vertex.point.x = file_.coordinate_or_nan(file_.next(), "x of a vertex");
      vertex.point.y = file_.coordinate_or_nan(file_.next(), "y of a vertex");
      vertex.point.z = file_.coordinate_or_nan(file_.next(), "z of a vertex");
    }
  }

  /// Whether the word is "endloop", or is "end" with "loop" behind it.
  bool ends(std::string_view word, std::string_view part) {
    if (!same_word(word, "end")) return begins_with(word, "end") && same_word(word.substr(3), part);
    expect(part);
    return true;
  }
  void expect_end(std::string_view part) {
    if (const std::string_view word = file_.next(); !ends(word, part)) unexpected(word, fmt::format("end{}", part));
  }
  void expect(std::string_view word) {
    if (const std::string_view token = file_.next(); !same_word(token, word)) unexpected(token, word);
  }
  [[noreturn]] void unexpected(std::string_view token, std::string_view wanted) const {
    if (token.empty())
      file_.fail(fmt::format("the file ends where {} should stand", wanted), "get the file again: it was cut short");
    file_.fail(fmt::format("{} stands where {} should", in_quotes(token), wanted),
               "is this an STL file, and is it whole?");
  }

  struct Vertex {
    glm::dvec3 point{0};
    std::int32_t line = 0;
  };

  Tokens file_;
  PolygonSoup soup_;
  PointMerger merger_;
  std::vector<Vertex> loop_;  // of the facet at work
  PassedOver colors_;
};

}  // namespace

PolygonSoup read_stl(std::string_view bytes, const std::string& name) {
  if (is_binary(bytes)) return read_binary(bytes, name);
  return AsciiReader(bytes, name).read();
}

}  // namespace zstep::scene
