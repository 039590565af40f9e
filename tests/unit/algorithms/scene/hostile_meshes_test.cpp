// The mesh readers on bad files: a mesh or an InputError, never anything else.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "algorithms/scene/builder.hpp"
#include "algorithms/scene/mesh.hpp"
#include "algorithms/scene/files/read_mesh.hpp"
#include "tests/unit/algorithms/scene/input_error.hpp"
#include "tests/unit/algorithms/scene/mesh_texts.hpp"

using namespace zstep;
using namespace zstep::scene;
using namespace zstep::test;
using namespace std::string_literals;

namespace {

/// All of what follows reading, too.
void load(MeshFormat format, const std::string& bytes) {
  PolygonSoup soup = read_mesh_bytes(format, bytes, "t");
  for (const Facet& outline : soup.outlines)
    for (const std::int32_t corner : soup.corners_of(outline)) {
      REQUIRE(corner >= 0);
      REQUIRE(static_cast<std::size_t>(corner) < soup.points.size());
    }
  SceneBuilder builder({});
  builder.add(std::move(soup), "t", {{}, SceneBuilder::Bare::shaded, clay, 0});
  builder.finish();
}

struct Sample {
  MeshFormat format;
  std::string bytes;
};

std::vector<Sample> samples() {
  return {{MeshFormat::off, cube_off},
          {MeshFormat::obj, pyramid_obj},
          {MeshFormat::off, binary_triangle_off()},
          {MeshFormat::ply, strips_ply},
          {MeshFormat::ply, square_ply},
          {MeshFormat::ply, binary_square_ply(false)},
          {MeshFormat::ply, binary_square_ply(true, "\r\n")},
          {MeshFormat::stl, tetrahedron_stl},
          {MeshFormat::stl, binary_tetrahedron_stl()}};
}

std::string error_of(MeshFormat format, const std::string& bytes) {
  return input_error([&] { load(format, bytes); });
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace

TEST_SUITE("hostile meshes") {
  TEST_CASE("cut short after every byte") {
    for (const auto& [format, bytes] : samples()) {
      CHECK(error_of(format, bytes) == "no error");
      for (std::size_t size = 0; size < bytes.size(); ++size) error_of(format, bytes.substr(0, size));
    }
    // Every cut that loses data is noticed where the format allows it: OBJ does not, nor does the name after endsolid.
    for (const auto& [format, bytes] : {samples()[0], samples()[2], samples()[3], samples()[5], samples()[6]})
      for (std::size_t size = 1; size + 20 < bytes.size(); ++size)
        CHECK_MESSAGE(error_of(format, bytes.substr(0, size)) != "no error", size);
  }

  TEST_CASE("every byte changed in several ways") {
    for (const auto& [format, bytes] : samples())
      for (std::size_t at = 0; at < bytes.size(); ++at)
        for (const int change : {0x01, 0x10, 0x80, 0xFF}) {
          std::string changed = bytes;
          changed[at] = static_cast<char>(changed[at] ^ change);
          error_of(format, changed);
        }
  }

  TEST_CASE("errors name the line, what is wrong there, and the way out") {
    const std::string index = error_of(MeshFormat::off, replaced(cube_off, "4 3 2 1 0", "4 3 2 1 2000000000"));
    CHECK(index == "t:18: there is no vertex 2000000000; the indices are 0 to 7");
    CHECK(contains(error_of(MeshFormat::off, replaced(cube_off, "1 1 1", "1 nan. 1")),
                   "t:11: y of a vertex is 'nan.', which is not a number"));
    CHECK(
        contains(error_of(MeshFormat::off, replaced(cube_off, "1 1 1", "1 x\x01y 1")), "'x?y', which is not a number"));
    CHECK(contains(error_of(MeshFormat::off, replaced(cube_off, "1 1 1", "1 1e31 1")),
                   "beyond 1e+30; scale the mesh down"));
    CHECK(contains(error_of(MeshFormat::off, replaced(cube_off, "4 0 1 5 4  255 0 0", "4 0 1 5 4  255 0")),
                   "t:13: two numbers follow the corners; a colour"));
    CHECK(contains(error_of(MeshFormat::off, cube_off + "4 0 1 2 3\n"), "t:19: '4' follows after the last face"));
    CHECK(contains(error_of(MeshFormat::off, "5OFF\n"), "'5OFF' is not read"));
    CHECK(contains(error_of(MeshFormat::off, "OFFx8 6 12\n"), "'OFFx8' is not read"));
    CHECK(contains(error_of(MeshFormat::off, "OFF BINARY"), "t:1: the file ends after BINARY"));
    CHECK(contains(error_of(MeshFormat::off, "OFF BINARY\n"), "t:byte 11: the file ends before the last element"));
    CHECK(
        contains(error_of(MeshFormat::off, replaced(binary_triangle_off(), "\0\0\0\1\0\0\0\0"s, "\x7f\0\0\1\0\0\0\0"s)),
                 "t:byte 15: 2130706433 faces are declared, which"));
    CHECK(contains(error_of(MeshFormat::off, replaced(binary_triangle_off(), "\0\0\0\2\0\0\0\3"s, "\0\0\0\3\0\0\0\3"s)),
                   "t:byte 71: there is no vertex 3; the indices are 0 to 2"));
    CHECK(contains(error_of(MeshFormat::obj, pyramid_obj + "f 1 2 9\n"), "t:20: there is no vertex 9: the file has 5"));
    CHECK(contains(error_of(MeshFormat::obj, pyramid_obj + "f 1 2 0\n"),
                   "t:20: a corner has the index 0; indices count from 1"));
    CHECK(contains(error_of(MeshFormat::obj, pyramid_obj + "f 1 2 -6\n"), "t:20: the index -6 goes back beyond"));
    CHECK(contains(error_of(MeshFormat::obj, pyramid_obj + "f 1 2 99999999999999999999\n"), "t:20: the corner"));
    CHECK(contains(error_of(MeshFormat::obj, "v 1 2\n"), "t:1: z is missing"));
    CHECK(contains(error_of(MeshFormat::obj, "hello\n"), "t:1: 'hello' is no statement of an OBJ file"));
    CHECK(contains(error_of(MeshFormat::obj, "v 0 0 0\nsurf 0 1 0 1 1 2\n"), "t:2: free-form"));
    CHECK(contains(error_of(MeshFormat::ply, replaced(strips_ply, "0 1 2 3 -1", "0 1 2 6 -1")),
                   "t:17: there is no vertex 6"));
    CHECK(contains(error_of(MeshFormat::ply, replaced(strips_ply, "list int int vertex_indices", "int vertex_indices")),
                   "t:8: the triangle strips have no list vertex_indices"));
    CHECK(
        contains(error_of(MeshFormat::ply, replaced(square_ply, "3 0 2 3", "3 0 2 4")), "t:24: there is no vertex 4"));
    CHECK(contains(error_of(MeshFormat::ply, replaced(square_ply, "3 0 2 3", "3 0 2 0.5")),
                   "t:24: there is no vertex 0.5"));
    CHECK(contains(error_of(MeshFormat::ply, replaced(square_ply, "1.0", "2.0")), "t:2: version '2.0'"));
    CHECK(contains(error_of(MeshFormat::ply, replaced(square_ply, "property float z\n", "")),
                   "t:5: the vertices lack x, y or z"));
    CHECK(contains(error_of(MeshFormat::ply, replaced(square_ply, "list uchar int vertex_indices", "int n")),
                   "no list vertex_indices"));
    std::string ply = binary_square_ply(false);
    ply.resize(ply.size() - 1);
    CHECK(contains(error_of(MeshFormat::ply, ply), ":byte "));
    CHECK(contains(error_of(MeshFormat::stl, replaced(tetrahedron_stl, "endloop", "endlop")),
                   "t:7: 'endlop' stands where endloop should"));
    std::string stl = binary_tetrahedron_stl();
    const float huge = 1e31F;
    std::memcpy(stl.data() + 84 + 12, &huge, sizeof huge);
    CHECK(contains(error_of(MeshFormat::stl, stl), "t:byte 96: a coordinate is 9.999999848243207e+30, beyond"));
  }

  TEST_CASE("a declared count is never believed") {
    for (const char* count : {"1000000000 6 12", "8 1000000000 12", "999999999999999999 6 12", "8 6 x", "-8 6 12"})
      CHECK(contains(error_of(MeshFormat::off, replaced(cube_off, "8 6 12", count)), "t:3: "));
    CHECK(contains(error_of(MeshFormat::off, replaced(cube_off, "4 3 2 1 0", "1000000000 3 2 1 0")), "t:18: "));
    CHECK(contains(error_of(MeshFormat::ply, replaced(square_ply, "vertex 4", "vertex 1000000000")),
                   "t:5: 1000000000 of element 'vertex'"));
    CHECK(contains(error_of(MeshFormat::ply, replaced(square_ply, "face 2", "face 1000000000")),
                   "t:10: 1000000000 of element 'face'"));
    CHECK(contains(error_of(MeshFormat::ply, replaced(square_ply, "edge 1", "edge 1000000000")), "t:15: "));
    CHECK(contains(error_of(MeshFormat::ply, replaced(square_ply, "3 0 1 2 255", "1000000000 0 1 2 255")),
                   "t:23: a list of"));
    CHECK(
        contains(error_of(MeshFormat::ply, replaced(square_ply, "3 0 1 2 255", "-3 0 1 2 255")), "t:23: a list of -3"));
    std::string stl = binary_tetrahedron_stl();
    const std::uint32_t many = 1000000000;
    std::memcpy(stl.data() + 80, &many, sizeof many);
    stl[0] = 'x';
    CHECK(
        contains(error_of(MeshFormat::stl, stl), "t:byte 80: 1000000000 triangles are declared, but the file holds 4"));
    // An element without properties takes no bytes, however many there are.
    CHECK(error_of(MeshFormat::ply, replaced(square_ply, "element vertex 4",
                                             "element nothing 1000000000000\nelement vertex 4")) == "no error");
  }

  TEST_CASE("a mesh without polygons, and text that is no mesh at all") {
    for (const MeshFormat format : {MeshFormat::obj, MeshFormat::off, MeshFormat::ply, MeshFormat::stl})
      for (const std::string& bytes :
           {std::string(), std::string("\n\n"), std::string(200, '\0'), std::string(200, '\xFF'),
            std::string("<html><body>404</body></html>"), std::string(100000, '\r'), std::string(100000, '\\'),
            std::string("\xEF\xBB\xBF")})
        error_of(format, bytes);
  }
}
