// PLY, the Polygon File Format (Greg Turk, Stanford University, 1994).
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "algorithms/scene/files/number.hpp"
#include "algorithms/scene/files/ply_header.hpp"
#include "algorithms/scene/files/read_mesh.hpp"
#include "algorithms/scene/files/tokens.hpp"
#include "traces/error.hpp"

namespace zstep::scene {

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
      : bytes_(bytes), name_(name), at_(header.size), big_(header.encoding == PlyHeader::Encoding::big_endian) {}

  double next(Type type) {
    switch (type) {
      case Type::int8:
        return take<std::int8_t>();
      case Type::uint8:
        return take<std::uint8_t>();
      case Type::int16:
        return take<std::int16_t>();
      case Type::uint16:
        return take<std::uint16_t>();
      case Type::int32:
        return take<std::int32_t>();
      case Type::uint32:
        return take<std::uint32_t>();
      case Type::float32:
        return static_cast<double>(take<float>());
      case Type::float64:
        return take<double>();
    }
    return 0;
  }
  std::size_t bytes_left() const { return bytes_.size() - at_; }
  std::size_t least_bytes(Type type) const { return ply_size(type); }
  std::int32_t line() const { return 0; }
  std::string where() const { return fmt::format("{}:byte {}", name_, last_); }
  void finish() const {}  // some exporters pad binary files

 private:
  template <class T>
  T take() {
    last_ = at_;
    if (bytes_left() < sizeof(T))
      throw InputError(where(), "the file ends before the last element", "get the file again: it was cut short");
    unsigned char raw[sizeof(T)];
    std::memcpy(raw, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) bits |= std::uint64_t{raw[big_ ? sizeof(T) - 1 - i : i]} << (8 * i);
    T value{};
    if constexpr (sizeof(T) == 1) {
      const auto b = static_cast<std::uint8_t>(bits);
      std::memcpy(&value, &b, 1);
    }
    if constexpr (sizeof(T) == 2) {
      const auto b = static_cast<std::uint16_t>(bits);
      std::memcpy(&value, &b, 2);
    }
    if constexpr (sizeof(T) == 4) {
      const auto b = static_cast<std::uint32_t>(bits);
      std::memcpy(&value, &b, 4);
    }
    if constexpr (sizeof(T) == 8) std::memcpy(&value, &bits, 8);
    return value;
  }

  std::string_view bytes_;
  const std::string& name_;
  std::size_t at_, last_ = 0;
  bool big_;
};

/// What a property of a vertex or a face means to us.
enum class Use : std::uint8_t { none, x, y, z, red, green, blue, corners };

Use use_in(const PlyElement& element, const PlyProperty& property) {
  const std::string_view name = property.name;
  if (element.name == "vertex" && !property.list) {
    if (name == "x") return Use::x;
    if (name == "y") return Use::y;
    if (name == "z") return Use::z;
  }
  if (element.name == "face") {
    if (property.list) return name == "vertex_indices" || name == "vertex_index" ? Use::corners : Use::none;
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
class Reader {
 public:
  Reader(const PlyHeader& header, Values values) : header_(header), values_(std::move(values)) {}

  PolygonSoup read() {
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex") declared_points_ = element.count;
      if (element.name == "tristrips" && element.count > 0)
        soup_.notes.emplace_back("triangle strips are not read; export the mesh with faces");
    }
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
          if (property.list) read_list(property, uses[k] == Use::corners);
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

  void read_list(const PlyProperty& property, bool corners) {
    const double count = values_.next(property.count_type);
    const auto most = static_cast<double>((values_.bytes_left() + 1) / values_.least_bytes(property.type));
    if (!(count >= 0 && count <= most) || count != std::floor(count))
      throw InputError(values_.where(),
                       fmt::format("a list of {} {} is declared, but the rest of the file holds at most {}", count,
                                   in_quotes(property.name), most),
                       "correct the count, or get the file again if it was cut short");
    for (std::int64_t i = 0; i < static_cast<std::int64_t>(count); ++i) {
      const double index = values_.next(property.type);
      if (!corners) continue;
      if (!(index >= 0 && index < static_cast<double>(declared_points_)) || index != std::floor(index))
        throw InputError(values_.where(), fmt::format("there is no vertex {}", index),
                         declared_points_ > 0 ? fmt::format("the indices are 0 to {}", declared_points_ - 1)
                                              : std::string("the head declares no vertices"));
      soup_.add_corner(static_cast<std::int64_t>(index), [&] { return values_.where(); });
    }
  }

  Color color_of(glm::dvec3 color) const {
    for (int i = 0; i < 3; ++i)
      if (!(color[i] >= 0 && color[i] < 255.5))
        throw InputError(values_.where(), "a face's colour is out of range",
                         "use whole numbers of 0 to 255, or fractions of 0 to 1");
    return {static_cast<std::uint8_t>(std::lround(color.x)), static_cast<std::uint8_t>(std::lround(color.y)),
            static_cast<std::uint8_t>(std::lround(color.z))};
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
  }
  if (header.encoding == PlyHeader::Encoding::ascii) return Reader(header, AsciiValues(bytes, name, header)).read();
  return Reader(header, BinaryValues(bytes, name, header)).read();
}

}  // namespace zstep::scene
