#include "algorithms/scene/files/ply_header.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "algorithms/scene/files/number.hpp"
#include "algorithms/scene/files/tokens.hpp"
#include "traces/error.hpp"

namespace zstep::scene {

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
    file.fail(fmt::format("{} is no type of a property", in_quotes(word)),
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
  constexpr std::array<std::size_t, 8> sizes{1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
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
      file.fail(fmt::format("{} is no word of a PLY head", in_quotes(word)), "is this a PLY file?");
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

}  // namespace zstep::scene
