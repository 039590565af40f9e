// PLY, the Polygon File Format (Greg Turk, Stanford University, 1994).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "algorithms/scene/files/tokens.hpp"
#include "traces/error.hpp"
#include "algorithms/scene/files/bytes.hpp"
#include "algorithms/scene/files/read_mesh.hpp"
#include "traces/math/whole.hpp"

namespace zstep::scene {

// The head of a PLY file: which elements follow, and what each is made of.

struct PlyProperty {
  enum class Type : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
  std::string name;
  Type type = Type::float32;
  bool list = false;
  Type count_type = Type::uint8;  ///< of a list
};

struct PlyElement {
  std::string name;
  std::int64_t count = 0;  ///< as declared: at most what the rest of the file could hold
  std::int32_t line = 0;   ///< where it is declared
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  enum class Encoding : std::uint8_t { ascii, little_endian, big_endian };
  Encoding encoding = Encoding::ascii;
  std::vector<PlyElement> elements;
  std::size_t size = 0;    ///< bytes of the head: the data begin here
  std::int32_t lines = 0;  ///< lines of the head
};

/// Bytes that a value of this type takes in a binary file.
std::size_t ply_size(PlyProperty::Type type);

/// Throws InputError at FILE:LINE.
PlyHeader read_ply_header(std::string_view bytes, const std::string& name);

namespace {

using Type = PlyProperty::Type;

std::optional<Type> type_of(std::string_view word) {
  constexpr std::array<std::pair<std::string_view, Type>, 16> names{{{"char", Type::int8},
                                                                     {"uchar", Type::uint8},
                                                                     {"short", Type::int16},
                                                                     {"ushort", Type::uint16},
                                                                     {"int", Type::int32},
                                                                     {"uint", Type::uint32},
                                                                     {"float", Type::float32},
                                                                     {"double", Type::float64},
                                                                     {"int8", Type::int8},
                                                                     {"uint8", Type::uint8},
                                                                     {"int16", Type::int16},
                                                                     {"uint16", Type::uint16},
                                                                     {"int32", Type::int32},
                                                                     {"uint32", Type::uint32},
                                                                     {"float32", Type::float32},
                                                                     {"float64", Type::float64}}};
  for (const auto& [text, type] : names)
    if (text == word) return type;
  return std::nullopt;
}

Type checked_type(Tokens& file, std::string_view word) {
  const auto type = type_of(word);
  if (!type)
    file.fail(fmt::format("{} is not a type that a property can have", in_quotes(word)),
              "use char, uchar, short, ushort, int, uint, float or double");
  return *type;
}

PlyProperty read_property(Tokens& file) {
  PlyProperty property;
  std::string_view word = file.next_in_line();
  if (word == "list") {
    property.list = true;
    property.count_type = checked_type(file, file.next_in_line());
    if (property.count_type == Type::float32 || property.count_type == Type::float64)
      file.fail("a list is counted by a fraction", "count it by uchar or int");
    word = file.next_in_line();
  }
  property.type = checked_type(file, word);
  property.name = std::string(file.next_in_line());
  if (property.name.empty()) file.fail("a property has no name", "write: property TYPE NAME");
  return property;
}

// The least that one record takes, so that a declared count can be refused before anything is made for it.
std::size_t least_size(const PlyElement& element, PlyHeader::Encoding encoding) {
  std::size_t size = 0;
  for (const PlyProperty& property : element.properties)
    size += encoding == PlyHeader::Encoding::ascii ? 2 : ply_size(property.list ? property.count_type : property.type);
  return size;
}

}  // namespace

std::size_t ply_size(PlyProperty::Type type) {
  constexpr ByEnum<PlyProperty::Type, std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[type];
}

PlyHeader read_ply_header(std::string_view bytes, const std::string& name) {
  Tokens file(bytes, name, Tokens::Comments::none);
  if (file.next_in_line() != "ply") file.fail("the file does not begin with 'ply'", "is this a PLY file?");
  PlyHeader header;
  bool format_known = false;
  constexpr std::size_t most_parts = 64;
  for (;;) {
    if (!file.next_line()) file.fail("the file ends before end_header", "get the file again: it was cut short");
    const std::string_view word = file.next_in_line();
    if (word.empty() || word == "comment" || word == "obj_info") continue;
    if (word == "end_header") break;
    if (word == "format") {
      const std::string_view encoding = file.next_in_line();
      if (encoding == "ascii") header.encoding = PlyHeader::Encoding::ascii;
      else if (encoding == "binary_little_endian") header.encoding = PlyHeader::Encoding::little_endian;
      else if (encoding == "binary_big_endian") header.encoding = PlyHeader::Encoding::big_endian;
      else
        file.fail(fmt::format("{} is no PLY format", in_quotes(encoding)),
                  "use ascii, binary_little_endian or binary_big_endian");
      if (const std::string_view version = file.next_in_line(); version != "1.0")
        file.fail(fmt::format("version {} is not read", in_quotes(version)), "save it as PLY 1.0");
      format_known = true;
    } else if (word == "element") {
      if (header.elements.size() == most_parts) file.fail("there are too many elements", "keep vertex and face");
      PlyElement element;
      element.line = file.line();
      element.name = std::string(file.next_in_line());
      element.count =
          file.count(file.next_in_line(), fmt::format("the number of {}", in_quotes(element.name)), INT64_MAX);
      for (const PlyElement& other : header.elements)
        if (other.name == element.name)
          file.fail(fmt::format("the element {} stands twice", in_quotes(element.name)), "keep one");
      header.elements.push_back(std::move(element));
    } else if (word == "property") {
      if (header.elements.empty()) file.fail("a property stands before any element", "put an element line before it");
      if (header.elements.back().properties.size() == most_parts)
        file.fail("there are too many properties", "remove some");
      header.elements.back().properties.push_back(read_property(file));
    } else {
      file.fail(fmt::format("{} is not a keyword of a PLY header", in_quotes(word)), "is this a PLY file?");
    }
  }
  if (!format_known) file.fail("the head has no format line", "write: format ascii 1.0");

  // The data begin after the line end, which in the head of a binary file is one of its own kind throughout: after CR
  // alone, a byte 0x0A already belongs to the data.
  const std::size_t end = bytes.size() - file.bytes_left();
  const std::size_t first_end = bytes.find_first_of("\r\n");
  const bool cr_lf = bytes.substr(first_end, 2) == "\r\n";
  header.size = std::min(bytes.size(), end + (cr_lf && bytes.substr(end, 2) == "\r\n" ? 2 : 1));
  if (end < bytes.size() && bytes[end] != '\r' && bytes[end] != '\n')
    file.fail("something follows end_header", "end the line there");
  header.lines = file.line();

  const std::size_t left = bytes.size() - header.size;
  for (const PlyElement& element : header.elements) {
    const std::size_t least = least_size(element, header.encoding);
    if (least > 0 && element.count > static_cast<std::int64_t>((left + 1) / least))
      throw InputError(fmt::format("{}:{}", name, element.line),
                       fmt::format("{} of element {} are declared, which {} bytes cannot hold", element.count,
                                   in_quotes(element.name), left),
                       "correct the count, or get the file again if it was cut short");
  }
  return header;
}

namespace {

using Type = PlyProperty::Type;

/// The values of an ascii file.
class AsciiValues {
 public:
  AsciiValues(std::string_view bytes, const std::string& name, const PlyHeader& header)
      : file_(bytes.substr(header.size), name, Tokens::Comments::none, Tokens::Joining::none, header.lines + 1) {}

  double next(Type) {
    const std::string_view token = file_.next();
    if (token.empty()) file_.fail("the file ends before the last element", "get the file again: it was cut short");
    const auto value = parse_number(token);
    if (!value) file_.fail(fmt::format("{} is not a number", in_quotes(token)), "write a decimal number");
    return *value;
  }
  std::size_t bytes_left() const { return file_.bytes_left(); }
  std::size_t least_bytes(Type) const { return 2; }
  std::int32_t line() const { return file_.line(); }
  std::string where() const { return file_.where(); }
  void finish() {
    if (const std::string_view more = file_.next(); !more.empty())
      file_.fail(fmt::format("{} follows after the last element", in_quotes(more)), "correct the counts in the head");
  }

 private:
  Tokens file_;
};

/// The values of a binary file.
class BinaryValues {
 public:
  BinaryValues(std::string_view bytes, const std::string& name, const PlyHeader& header)
      : file_(bytes, name, header.size, header.encoding == PlyHeader::Encoding::big_endian) {}

  double next(Type type) {
    switch (type) {
      case Type::int8:
        return file_.take<std::int8_t>();
      case Type::uint8:
        return file_.take<std::uint8_t>();
      case Type::int16:
        return file_.take<std::int16_t>();
      case Type::uint16:
        return file_.take<std::uint16_t>();
      case Type::int32:
        return file_.take<std::int32_t>();
      case Type::uint32:
        return file_.take<std::uint32_t>();
      case Type::float32:
        return file_.take<float>();
      case Type::float64:
        return file_.take<double>();
    }
    return 0;
  }
  std::size_t bytes_left() const { return file_.bytes_left(); }
  std::size_t least_bytes(Type type) const { return ply_size(type); }
  std::int32_t line() const { return 0; }
  std::string where() const { return file_.where(); }
  void finish() const {}  // some exporters pad binary files

 private:
  BinaryReader file_;
};

/// What a property of a vertex or a face means to us.
enum class Use : std::uint8_t { none, x, y, z, red, green, blue, corners, strip };

Use use_in(const PlyElement& element, const PlyProperty& property) {
  const std::string_view name = property.name;
  if (element.name == "vertex" && !property.list) {
    if (name == "x") return Use::x;
    if (name == "y") return Use::y;
    if (name == "z") return Use::z;
  }
  const bool indices = property.list && (name == "vertex_indices" || name == "vertex_index");
  if (element.name == "tristrips") return indices ? Use::strip : Use::none;
  if (element.name == "face") {
    if (property.list) return indices ? Use::corners : Use::none;
    if (name == "red" || name == "diffuse_red" || name == "r") return Use::red;
    if (name == "green" || name == "diffuse_green" || name == "g") return Use::green;
    if (name == "blue" || name == "diffuse_blue" || name == "b") return Use::blue;
  }
  return Use::none;
}

bool has(const PlyElement& element, Use use) {
  for (const PlyProperty& property : element.properties)
    if (use_in(element, property) == use) return true;
  return false;
}

template <class Values>
class PlyReader {
 public:
  PlyReader(const PlyHeader& header, Values values) : header_(header), values_(std::move(values)) {}

  PolygonSoup read() {
    for (const PlyElement& element : header_.elements)
      if (element.name == "vertex") declared_points_ = element.count;
    for (const PlyElement& element : header_.elements) {
      if (element.properties.empty()) continue;  // it takes no bytes, whatever its count
      std::vector<Use> uses;
      for (const PlyProperty& property : element.properties) uses.push_back(use_in(element, property));
      const bool vertex = element.name == "vertex", face = element.name == "face";
      const bool colored = face && has(element, Use::red) && has(element, Use::green) && has(element, Use::blue);
      for (std::int64_t i = 0; i < element.count; ++i) {
        glm::dvec3 point(0), color(0);
        std::int32_t line = 0;
        for (std::size_t k = 0; k < uses.size(); ++k) {
          const PlyProperty& property = element.properties[k];
          if (property.list) read_list(property, uses[k]);
          else read_value(property, uses[k], point, color);
          if (k == 0) line = values_.line();
        }
        if (vertex) soup_.add_point(point, line, [&] { return values_.where(); });
        if (face)
          soup_.close_outline(line, colored ? std::optional(color_of(color)) : std::nullopt,
                              [&] { return values_.where(); });
      }
    }
    values_.finish();
    return std::move(soup_);
  }

 private:
  void read_value(const PlyProperty& property, Use use, glm::dvec3& point, glm::dvec3& color) {
    const double value = values_.next(property.type);
    const bool fraction = property.type == Type::float32 || property.type == Type::float64;
    switch (use) {
      case Use::x:
      case Use::y:
      case Use::z:
        if (!(std::abs(value) <= largest_coordinate))
          checked_coordinate(value, values_.where(), fmt::format("{} of a vertex", property.name));
        point[static_cast<int>(use) - static_cast<int>(Use::x)] = value;
        break;
      case Use::red:
      case Use::green:
      case Use::blue:
        color[static_cast<int>(use) - static_cast<int>(Use::red)] = fraction ? 255 * value : value;
        break;
      default:
        break;
    }
  }

  void read_list(const PlyProperty& property, Use use) {
    const double count = values_.next(property.count_type);
    const auto most = static_cast<double>((values_.bytes_left() + 1) / values_.least_bytes(property.type));
    if (!(count >= 0 && count <= most) || count != std::floor(count))
      throw InputError(values_.where(),
                       fmt::format("a list of {} {} is declared, but the rest of the file holds at most {}", count,
                                   in_quotes(property.name), most),
                       "correct the count, or get the file again if it was cut short");
    Strip strip;
    for (std::int64_t i = 0; i < static_cast<std::int64_t>(count); ++i) {
      const double index = values_.next(property.type);
      if (use == Use::strip) {
        if (index == -1) strip = {};
        else extend(strip, checked(index));
      } else if (use == Use::corners) {
        soup_.add_corner(checked(index), [&] { return values_.where(); });
      }
    }
  }

  std::int64_t checked(double index) const {
    if (!(index >= 0 && index < static_cast<double>(declared_points_)) || index != std::floor(index))
      throw InputError(values_.where(), fmt::format("there is no vertex {}", index),
                       declared_points_ > 0 ? fmt::format("the indices are 0 to {}", declared_points_ - 1)
                                            : std::string("the head declares no vertices"));
    return static_cast<std::int64_t>(index);
  }

  /// The last two vertices of a triangle strip, and how many came before.
  struct Strip {
    std::int64_t before_last = -1, last = -1, count = 0;
  };

  /// Each vertex after the second makes a triangle with the two before it, every other one the other way round.
  /// Triangles with a vertex twice only lead the strip on.
  void extend(Strip& strip, std::int64_t vertex) {
    if (strip.count >= 2 && vertex != strip.last && vertex != strip.before_last && strip.last != strip.before_last) {
      const auto where = [&] { return values_.where(); };
      const bool swapped = strip.count % 2 == 1;
      soup_.add_corner(swapped ? strip.last : strip.before_last, where);
      soup_.add_corner(swapped ? strip.before_last : strip.last, where);
      soup_.add_corner(vertex, where);
      soup_.close_outline(values_.line(), std::nullopt, where);
    }
    strip = {strip.last, vertex, strip.count + 1};
  }

  Color color_of(glm::dvec3 color) const {
    for (int i = 0; i < 3; ++i)
      if (!(color[i] >= 0 && color[i] < 255.5))
        throw InputError(values_.where(), "a face's colour is out of range",
                         "use whole numbers of 0 to 255, or fractions of 0 to 1");
    return {nearest_byte(color.x), nearest_byte(color.y), nearest_byte(color.z)};
  }

  const PlyHeader& header_;
  Values values_;
  PolygonSoup soup_;
  std::int64_t declared_points_ = 0;
};

}  // namespace

PolygonSoup read_ply(std::string_view bytes, const std::string& name) {
  const PlyHeader header = read_ply_header(bytes, name);
  for (const PlyElement& element : header.elements) {
    if (element.name == "vertex" && element.count > 0 &&
        !(has(element, Use::x) && has(element, Use::y) && has(element, Use::z)))
      throw InputError(fmt::format("{}:{}", name, element.line), "the vertices lack x, y or z",
                       "give all three as properties of element vertex");
    if (element.name == "face" && element.count > 0 && !has(element, Use::corners))
      throw InputError(fmt::format("{}:{}", name, element.line), "the faces have no list vertex_indices",
                       "add: property list uchar int vertex_indices");
    if (element.name == "tristrips" && element.count > 0 && !has(element, Use::strip))
      throw InputError(fmt::format("{}:{}", name, element.line), "the triangle strips have no list vertex_indices",
                       "add: property list int int vertex_indices");
  }
  if (header.encoding == PlyHeader::Encoding::ascii) return PlyReader(header, AsciiValues(bytes, name, header)).read();
  return PlyReader(header, BinaryValues(bytes, name, header)).read();
}

}  // namespace zstep::scene
