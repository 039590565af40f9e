// Small meshes as text and as bytes.
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace zstep::test {

inline const std::string cube_off = R"(OFF
# a cube; three of its sides have a colour
8 6 12
-1 -1 -1
1 -1 -1   # a comment after a vertex
1 1 -1
-1 1 -1

-1 -1 1
1 -1 1
1 1 1
-1 1 1
4 0 1 5 4  255 0 0
4 1 2 6 5  0.0 1.0 0.0
4 2 3 7 6  0 0 255 255
4 3 0 4 7  # no colour
4 4 5 6 7
4 3 2 1 0
)";

inline const std::string pyramid_obj = R"(# a pyramid
mtllib paint.mtl
o pyramid
v 1 1 0
v -1 1 0
v -1 -1 0 1.0
v 1 -1 0
v 0 0 1.5e0
vt 0 0
vn 0 0 1
usemtl red paint
f 1 2 5
f 2/1 3/1 5/1
usemtl none such
f -3//1 -2//1 -1//1
f 4/1/1 1/1/1 \
  5/1/1  # joined by the backslash
usemtl blue
f 4 3 2 1
)";

inline const std::string square_ply = R"(ply
format ascii 1.0
comment a square of two triangles
obj_info nothing
element vertex 4
property float x
property float y
property float z
property uchar red
element face 2
property list uchar int vertex_indices
property uchar red
property uchar green
property uchar blue
element edge 1
property int vertex1
property int vertex2
end_header
0 0 0 9
1 0 0 9
1 1 0 9
0 1 0 9
3 0 1 2 255 128 0
3 0 2 3 0 0 7
0 1
)";

inline const std::string tetrahedron_stl = R"(solid a tetrahedron
  facet normal 0 0 -1
    outer loop
      vertex 0 0 0
      vertex 0 1 0
      vertex 1 0 0
    endloop
  endfacet
  facet normal 0 -1 0
    outer loop
      vertex 0 0 0
      vertex 1 0 0
      vertex 0 0 1
    endloop
  endfacet
  facet normal nan nan nan
    outer loop
      vertex 0 0 0
      vertex 0 0 1
      vertex 0 1 0
    endloop
  endfacet
  FACET NORMAL 1 1 1
    OUTER LOOP
      VERTEX 1 0 0
      VERTEX 0 1 0
      VERTEX 0 0 1
    ENDLOOP
  ENDFACET
endsolid a tetrahedron
)";

/// Puts a value's bytes at the end, the most significant first if `big`.
template <class T>
void put(std::string& bytes, T value, bool big = false) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes += raw[big ? sizeof(T) - 1 - i : i];
}

/// The square of square_ply in a binary file.
inline std::string binary_square_ply(bool big, const std::string& line_end = "\n") {
  std::string bytes;
  for (const char* line : {"ply", big ? "format binary_big_endian 1.0" : "format binary_little_endian 1.0",
                           "element vertex 4", "property double x", "property float y", "property short z",
                           "element face 2", "property list uint8 uint32 vertex_index", "property float32 red",
                           "property float32 green", "property float32 blue", "end_header"})
    bytes += line + line_end;
  for (int i = 0; i < 4; ++i) {
    put(bytes, static_cast<double>(i == 1 || i == 2), big);
    put(bytes, static_cast<float>(i >= 2), big);
    put(bytes, std::int16_t{0}, big);
  }
  for (const std::uint32_t i : {0U, 1U}) {
    put(bytes, std::uint8_t{3}, big);
    for (const std::uint32_t corner : {0U, i + 1, i + 2}) put(bytes, corner, big);
    for (const float channel : {1.0F, 0.5F, 0.0F}) put(bytes, channel, big);
  }
  return bytes;
}

/// The tetrahedron of tetrahedron_stl in a binary file, whose head begins as an ascii file does.
inline std::string binary_tetrahedron_stl() {
  std::string bytes = "solid, but binary";
  bytes.resize(80, ' ');
  put(bytes, std::uint32_t{4});
  const float points[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const auto& triangle : {std::vector<int>{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
    for (int i = 0; i < 3; ++i) put(bytes, 0.0F);
    for (const int corner : triangle)
      for (const float coordinate : points[corner]) put(bytes, coordinate);
    put(bytes, std::uint16_t{0});
  }
  return bytes;
}

inline std::string with_line_ends(const std::string& text, const std::string& end) {
  std::string result;
  for (const char c : text) {
    if (c == '\n') result += end;
    else result += c;
  }
  return result;
}

/// One triangle with a colour, as Geomview writes it in binary: the highest byte first.
inline std::string binary_triangle_off() {
  std::string bytes = "OFF BINARY\n";
  const auto put = [&](std::uint32_t bits) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(bits >> shift & 255);
  };
  for (const std::uint32_t count : {3u, 1u, 0u}) put(count);
  for (const float value : {0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.5f, 0.0f, 1.0f, 0.0f})
    put(std::bit_cast<std::uint32_t>(value));
  for (const std::uint32_t index : {3u, 0u, 1u, 2u}) put(index);
  put(3);
  for (const float value : {1.0f, 0.0f, 0.5f}) put(std::bit_cast<std::uint32_t>(value));
  return bytes;
}

/// Two triangle strips in one list, parted by -1.
inline const std::string strips_ply = R"(ply
format ascii 1.0
element vertex 6
property float x
property float y
property float z
comment strips as the Stanford models have them
element tristrips 1
property list int int vertex_indices
end_header
0 0 0
1 0 0
0 1 0
1 1 0
0 2 0
1 2 0
9 0 1 2 3 -1 2 3 5 5
)";

}  // namespace zstep::test
