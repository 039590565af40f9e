// The head of a PLY file: which elements follow, and what each is made of.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace zstep::scene {

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

}  // namespace zstep::scene
