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
#include "traces/text.hpp"

namespace zstep::scene {

// The head of a PLY file: which elements follow, and what each is made of.

// Keywords and names in capitals are the same in small letters.

struct PlyProperty {
  enum class Type : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };
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
  std::string texture, texture_where;  ///< that a comment names, and where; the first one
  PassedOver textures;                 ///< the others
  std::size_t size = 0;                ///< bytes of the head: the data begin here
  std::int32_t lines = 0;              ///< lines of the head
};

/// Bytes that a value of this type takes in a binary file.
std::size_t ply_size(PlyProperty::Type type);

/// Throws InputError at FILE:LINE.
PlyHeader read_ply_header(std::string_view bytes, const std::string& name);

namespace {

using Type = PlyProperty::Type;

std::optional<Type> type_of(std::string_view word) {
  constexpr std::array<std::pair<std::string_view, Type>, 18> names{{{"char", Type::int8},
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
                                                                     {"int64", Type::int64},
                                                                     {"uint64", Type::uint64},
                                                                     {"float32", Type::float32},
                                                                     {"float64", Type::float64}}};
  for (const auto& [text, type] : names)
    if (same_word(word, text)) return type;
  return std::nullopt;
}

Type checked_type(Tokens& file, std::string_view word) {
  const auto type = type_of(word);
  if (!type)
    file.fail(fmt::format("{} is not a type that a property can have", in_quotes(word)),
              "use char, uchar, short, ushort, int, uint, float, double, or int8 to uint64");
  return *type;
}

PlyProperty read_property(Tokens& file) {
  PlyProperty property;
  std::string_view word = file.next_in_line();
  if (same_word(word, "list")) {
    property.list = true;
    property.count_type = checked_type(file, file.next_in_line());
    word = file.next_in_line();
  }
  property.type = checked_type(file, word);
  property.name = lower_case(file.next_in_line());
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
  constexpr ByEnum<PlyProperty::Type, std::size_t, 10> sizes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return sizes[type];
}

PlyHeader read_ply_header(std::string_view bytes, const std::string& name) {
  Tokens file(bytes, name, Tokens::Comments::none);
  if (!same_word(file.next_in_line(), "ply")) file.fail("the file does not begin with 'ply'", "is this a PLY file?");
  PlyHeader header;
  bool format_known = false;
  constexpr std::size_t most_parts = 64;
  for (;;) {
    if (!file.next_line()) file.fail("the file ends before end_header", "get the file again: it was cut short");
    const std::string word = lower_case(file.next_in_line());
    if (word == "comment" && same_word(file.next_in_line(), "texturefile")) {
      if (header.texture.empty()) header.texture = file.rest_of_line(), header.texture_where = file.where();
      else header.textures.add([&] { return file.where(); });
    }
    if (word.empty() || word[0] == '#' || word == "comment" || word == "obj_info") continue;
    if (word == "end_header") break;
    if (word == "format") {
      const std::string encoding = lower_case(file.next_in_line());
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
      element.name = lower_case(file.next_in_line());
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
      : file_(bytes.substr(header.size), name, Tokens::Comments::hash, Tokens::Joining::none, header.lines + 1) {}

  double next(Type) {
    const std::string_view token = next_token();
    if (token.empty()) file_.fail("the file ends before the last element", "get the file again: it was cut short");
    const auto value = parse_number(token);
    if (!value) file_.fail(fmt::format("{} is not a number", in_quotes(token)), "write a decimal number");
    return *value;
  }
  std::size_t bytes_left() const { return file_.bytes_left(); }
  std::size_t least_bytes(Type) const { return 2; }
  std::int32_t line() const { return file_.line(); }
  std::string where() const { return file_.where(); }
  /// What follows after the last element, for a note; nothing where the file ends.
  std::string rest() {
    const std::string_view more = next_token();
    if (more.empty()) return {};
    return fmt::format(
        "{}: {} and what follows it, after the last element, is not read; are the counts in the head right?",
        file_.where(), in_quotes(more));
  }

 private:
  /// Some programs write comments among the data as they stand in a head.
  std::string_view next_token() {
    for (;;) {
      const std::string_view token = file_.next();
      if (token != "comment" && token != "obj_info") return token;
      file_.rest_of_line();
    }
  }

  Tokens file_;
};

/// The values of a binary file.
class BinaryValues {
 public:
  BinaryValues(std::string_view bytes, const std::string& name, const PlyHeader& header)
      : file_(bytes, name, header.size, header.encoding == PlyHeader::Encoding::big_endian),
        name_(name),
        size_(bytes.size()) {}

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
      case Type::int64:
        return static_cast<double>(file_.take<std::int64_t>());
      case Type::uint64:
        return static_cast<double>(file_.take<std::uint64_t>());
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
  std::string rest() const {
    if (bytes_left() == 0) return {};
    return fmt::format("{}:byte {}: {} bytes after the last element are not read", name_, size_ - bytes_left(),
                       bytes_left());
  }

 private:
  BinaryReader file_;
  const std::string& name_;
  std::size_t size_;
};

/// What a property of a vertex or a face means to us.
enum class Use : std::uint8_t { none, x, y, z, red, green, blue, alpha, corners, strip, texture };

Use use_of_name(std::string_view name) {
  if (name == "red" || name == "diffuse_red" || name == "r") return Use::red;
  if (name == "green" || name == "diffuse_green" || name == "g") return Use::green;
  if (name == "blue" || name == "diffuse_blue" || name == "b") return Use::blue;
  if (name == "alpha" || name == "a") return Use::alpha;
  return Use::none;
}

bool is_fraction(Type type) { return type == Type::float32 || type == Type::float64; }

/// The list of an element's vertices: that of the usual names, else its only list of whole numbers, whatever its name.
const PlyProperty* list_of_vertices(const PlyElement& element) {
  const PlyProperty* only = nullptr;
  int lists = 0;
  for (const PlyProperty& property : element.properties) {
    if (!property.list) continue;
    if (property.name == "vertex_indices" || property.name == "vertex_index") return &property;
    if (!is_fraction(property.type)) only = &property, ++lists;
  }
  return lists == 1 ? only : nullptr;
}

Use use_in(const PlyElement& element, const PlyProperty& property) {
  const std::string_view name = property.name;
  if (property.list) {
    if (element.name == "face" && name == "texcoord") return Use::texture;
    if (&property != list_of_vertices(element)) return Use::none;
    return element.name == "face" ? Use::corners : element.name == "tristrips" ? Use::strip : Use::none;
  }
  if (element.name == "vertex") {
    if (name == "x") return Use::x;
    if (name == "y") return Use::y;
    if (name == "z") return Use::z;
  }
  return element.name == "vertex" || element.name == "face" ? use_of_name(name) : Use::none;
}

bool has(const PlyElement& element, Use use) {
  for (const PlyProperty& property : element.properties)
    if (use_in(element, property) == use) return true;
  return false;
}

bool is_colored(const PlyElement& element) {
  return has(element, Use::red) && has(element, Use::green) && has(element, Use::blue);
}

bool is_read(const PlyElement& element) {
  return element.name == "vertex" || element.name == "face" || element.name == "tristrips";
}

template <class Values>
class PlyReader {
 public:
  PlyReader(const PlyHeader& header, Values values) : header_(header), values_(std::move(values)) {}

  PolygonSoup read(const std::string& name) {
    soup_.losses.textures = header_.textures;
    for (const PlyElement& element : header_.elements)
      if (element.name == "vertex") declared_points_ = element.count;
    // What stands behind the last element that is read need not be understood.
    const auto last = std::find_if(header_.elements.rbegin(), header_.elements.rend(), is_read).base();
    for (auto element = header_.elements.begin(); element != last; ++element) read_element(*element);
    if (std::none_of(last, header_.elements.end(), takes_bytes))
      if (std::string rest = values_.rest(); !rest.empty()) soup_.notes.push_back(std::move(rest));
    note_unread(name);
    give_texture();
    return finish_soup(std::move(soup_), name);
  }

 private:
  /// The image of the head is that of all polygons.
  void give_texture() {
    if (!at_corners_.values.empty() && std::ssize(soup_.attributes) < most_attributes) {
      value_of_corner_.resize(soup_.corners.size(), no_value);
      std::erase_if(soup_.attributes, [](const VertexAttribute& known) { return known.name == uv_attribute; });
      soup_.give_to_corners(at_corners_, value_of_corner_);
      soup_.attributes.push_back(std::move(at_corners_));
    }
    if (header_.texture.empty()) return;
    Material material;
    material.texture = soup_.texture(header_.texture, header_.texture_where);
    soup_.materials.assign(soup_.outlines.size(), material);
  }

  static bool takes_bytes(const PlyElement& element) { return element.count > 0 && !element.properties.empty(); }

  void note_unread(const std::string& name) {
    for (const PlyElement& element : header_.elements)
      if (!is_read(element) && takes_bytes(element))
        soup_.notes.push_back(fmt::format("{}:{}: {} of element {} are not read", name, element.line, element.count,
                                          in_quotes(element.name)));
  }

  void read_element(const PlyElement& element) {
    if (element.properties.empty()) return;  // it takes no bytes, whatever its count
    std::vector<Use> uses;
    for (const PlyProperty& property : element.properties) uses.push_back(use_in(element, property));
    const bool vertex = element.name == "vertex", face = element.name == "face", colored = is_colored(element);
    const std::vector<Slot> slots = vertex ? slots_of(element) : std::vector<Slot>(uses.size());
    const auto where = [&] { return values_.where(); };
    for (std::int64_t i = 0; i < element.count; ++i) {
      glm::dvec3 point(0), color(0);
      double alpha = 255;
      std::int32_t line = 0;
      for (std::size_t k = 0; k < uses.size(); ++k) {
        const PlyProperty& property = element.properties[k];
        if (property.list) read_list(property, uses[k]);
        else if (const double value = read_value(property, uses[k], point, color, alpha); slots[k].attribute >= 0)
          numbers_[slots[k].attribute][slots[k].component] = slots[k].is_color ? value / 255 : value;
        if (k == 0) line = values_.line();
      }
      if (vertex) soup_.add_point(point, line, where);
      if (vertex)
        for (std::size_t a = 0; a < soup_.attributes.size(); ++a)
          soup_.add_value_of_point(soup_.attributes[a], numbers_[a], line, where);
      if (!face) continue;
      keep_texture_coordinates(line);
      if (colored && alpha != 255) soup_.losses.opacities.add(where);
      soup_.close_outline(line, colored ? std::optional(soup_.color_of(color, where)) : std::nullopt, where);
    }
  }

  /// Of the corners of the face that was read: u and v of each.
  void keep_texture_coordinates(std::int32_t line) {
    if (texture_coordinates_.empty()) return;
    const auto where = [&] { return values_.where(); };
    const std::size_t first = static_cast<std::size_t>(soup_.first_corner());
    if (texture_coordinates_.size() == 2 * (soup_.corners.size() - first)) {
      value_of_corner_.resize(first, no_value);
      for (std::size_t k = 0; k < texture_coordinates_.size(); k += 2) {
        value_of_corner_.push_back(static_cast<std::int32_t>(std::ssize(at_corners_.values) / 2));
        soup_.add_value(at_corners_, std::span(texture_coordinates_).subspan(k, 2), line, where);
      }
    } else {
      soup_.losses.values.add(where);
    }
    texture_coordinates_.clear();
  }

  /// Where a number of a vertex goes.
  struct Slot {
    std::int32_t attribute = -1;
    std::size_t component = 0;
    bool is_color = false;
  };
  /// An attribute for each property that is no coordinate: those of one thing together, the others by themselves.
  std::vector<Slot> slots_of(const PlyElement& element) {
    struct Known {
      std::string_view property;
      const char* attribute;
      std::size_t component;
      std::int32_t components;
    };
    constexpr std::array<Known, 9> known{{{"nx", normal_attribute, 0, 3},
                                          {"ny", normal_attribute, 1, 3},
                                          {"nz", normal_attribute, 2, 3},
                                          {"u", uv_attribute, 0, 2},
                                          {"v", uv_attribute, 1, 2},
                                          {"s", uv_attribute, 0, 2},
                                          {"t", uv_attribute, 1, 2},
                                          {"texture_u", uv_attribute, 0, 2},
                                          {"texture_v", uv_attribute, 1, 2}}};
    const bool colored = is_colored(element);
    const auto where = [&] { return values_.where(); };
    std::vector<Slot> slots;
    for (const PlyProperty& property : element.properties) {
      const Use use = use_in(element, property);
      Slot slot;
      std::string_view name = property.name;
      std::int32_t components = 1;
      if (property.list || use == Use::x || use == Use::y || use == Use::z) {
        if (property.list && element.count > 0) soup_.losses.components.add(where);
        slots.push_back(slot);
        continue;
      }
      const auto color = static_cast<std::size_t>(static_cast<int>(use) - static_cast<int>(Use::red));
      if (colored && color < 3) name = color_attribute, components = 3, slot.component = color, slot.is_color = true;
      for (const Known& one : known)
        if (one.property == name) name = one.attribute, components = one.components, slot.component = one.component;
      const VertexAttribute* attribute = soup_.attribute(name, components, where);
      slot.attribute = attribute && slot.component < static_cast<std::size_t>(attribute->components)
                           ? static_cast<std::int32_t>(attribute - soup_.attributes.data())
                           : -1;
      slots.push_back(slot);
    }
    return slots;
  }

  double read_value(const PlyProperty& property, Use use, glm::dvec3& point, glm::dvec3& color, double& alpha) {
    const double value = values_.next(property.type);
    const double of_255 = is_fraction(property.type) ? 255 * value : value;
    switch (use) {
      case Use::x:
      case Use::y:
      case Use::z:
        if (std::isfinite(value) && std::abs(value) > largest_coordinate)
          checked_coordinate(value, values_.where(), fmt::format("{} of a vertex", property.name));
        point[static_cast<int>(use) - static_cast<int>(Use::x)] = value;
        break;
      case Use::red:
      case Use::green:
      case Use::blue:
        color[static_cast<int>(use) - static_cast<int>(Use::red)] = of_255;
        break;
      case Use::alpha:
        alpha = of_255;
        break;
      default:
        break;
    }
    return use == Use::red || use == Use::green || use == Use::blue ? of_255 : value;
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
      } else if (use == Use::texture) {
        texture_coordinates_.push_back(index);
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

  const PlyHeader& header_;
  Values values_;
  PolygonSoup soup_;
  std::int64_t declared_points_ = 0;
  std::array<std::array<double, most_components>, most_attributes> numbers_{};  ///< of the vertex at work
  std::vector<double> texture_coordinates_;                                     ///< of the face at work
  VertexAttribute at_corners_{uv_attribute, 2, {}, {}, {}, {}};
  std::vector<std::int32_t> value_of_corner_;
};

}  // namespace

namespace {

std::string property_names(const PlyElement& element) {
  std::string names;
  for (const PlyProperty& property : element.properties)
    names += fmt::format("{}{}", names.empty() ? "" : ", ", in_quotes(property.name));
  return names.empty() ? "none" : names;
}

/// Throws InputError where an element that is read lacks what it needs, or where faces would have to be made first.
void check_elements(const PlyHeader& header, const std::string& name) {
  bool polygons = false;
  for (const PlyElement& element : header.elements) {
    const auto refuse = [&](std::string_view what, std::string_view mend) {
      throw InputError(fmt::format("{}:{}", name, element.line),
                       fmt::format("{}: the properties are {}", what, property_names(element)), mend);
    };
    if (element.count == 0 || !is_read(element)) continue;
    if (element.name == "vertex") {
      if (!(has(element, Use::x) && has(element, Use::y) && has(element, Use::z)))
        refuse("the vertices lack x, y or z", "give all three as properties of element vertex");
      continue;
    }
    polygons = true;
    if (list_of_vertices(element) != nullptr) continue;
    if (element.name == "face")
      refuse("the faces have no list vertex_indices", "add: property list uchar int vertex_indices");
    refuse("the triangle strips have no list vertex_indices", "add: property list int int vertex_indices");
  }
  for (const PlyElement& element : header.elements)
    if (!polygons && element.count > 0 && element.name == "range_grid")
      throw InputError(fmt::format("{}:{}", name, element.line),
                       "a range grid of points is not read, and there are no faces",
                       "make faces of it in a modelling program");
}

}  // namespace

PolygonSoup read_ply(std::string_view bytes, const std::string& name) {
  const PlyHeader header = read_ply_header(bytes, name);
  check_elements(header, name);
  if (header.encoding == PlyHeader::Encoding::ascii)
    return PlyReader(header, AsciiValues(bytes, name, header)).read(name);
  return PlyReader(header, BinaryValues(bytes, name, header)).read(name);
}

}  // namespace zstep::scene
