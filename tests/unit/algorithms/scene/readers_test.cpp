// The mesh readers on good files.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "algorithms/scene/files/tokens.hpp"
#include "algorithms/scene/files/read_mesh.hpp"
#include "tests/unit/algorithms/scene/mesh_texts.hpp"

using namespace zstep;
using namespace zstep::scene;
using namespace zstep::test;

namespace {

std::vector<std::int32_t> corners(const PolygonSoup& soup, std::size_t polygon) {
  const auto span = soup.corners_of(soup.outlines[polygon]);
  return {span.begin(), span.end()};
}

using Ring = std::vector<std::int32_t>;

}  // namespace

TEST_SUITE("mesh readers") {
  TEST_CASE("numbers are read as the nearest double, however they are written") {
    CHECK(parse_number("0.1") == 0.1);
    CHECK(parse_number("-.5") == -0.5);
    CHECK(parse_number("+3.") == 3.0);
    CHECK(parse_number("1e3") == 1000.0);
    CHECK(parse_number("2.5E-3") == 0.0025);
    CHECK(parse_number("123456789012345678901234567890") == 123456789012345678901234567890.0);
    CHECK(parse_number("0.30000000000000004440892098500626") == 0.1 + 0.2);
    CHECK(parse_number("9007199254740993") == 9007199254740992.0);
    CHECK(parse_number("1e400") == std::numeric_limits<double>::infinity());
    CHECK(parse_number("1e-999999999999") == 0.0);
    CHECK(parse_number("5e-324") == 5e-324);
    CHECK(std::isnan(*parse_number("NaN")));
    CHECK(parse_number("-inf") == -std::numeric_limits<double>::infinity());
    for (const char* token :
         {"", "-", ".", "e5", "1e", "1e+", "0x10", "1.2.3", "1,5", "1.0f", "--1", "infinit", "nan1"})
      CHECK_MESSAGE(!parse_number(token), token);
    CHECK(parse_integer("-12") == -12);
    CHECK(parse_integer("9223372036854775807") == 9223372036854775807LL);
    for (const char* token : {"", "-", "1.0", "1e3", "9223372036854775808", "12a"})
      CHECK_MESSAGE(!parse_integer(token), token);
  }

  TEST_CASE("OFF: polygons, colours and lines, whatever ends the lines") {
    for (const char* end : {"\n", "\r\n", "\r"}) {
      const PolygonSoup soup = read_off(with_line_ends(cube_off, end), "cube.off");
      REQUIRE(soup.points.size() == 8);
      REQUIRE(soup.outlines.size() == 6);
      CHECK(soup.points[1] == glm::dvec3(1, -1, -1));
      CHECK(soup.point_lines[0] == 4);
      CHECK(soup.point_lines[4] == 9);
      CHECK(soup.outline_lines[0] == 13);
      CHECK(corners(soup, 0) == Ring{0, 1, 5, 4});
      CHECK(corners(soup, 5) == Ring{3, 2, 1, 0});
      REQUIRE(soup.colors.size() == 6);
      CHECK(soup.colors[0] == Color{255, 0, 0});
      CHECK(soup.colors[1] == Color{0, 255, 0});
      CHECK(soup.colors[2] == Color{0, 0, 255});
      CHECK(!soup.colors[3]);
    }
  }

  TEST_CASE("OFF: prefixes, a missing keyword, counts beside it, colours of vertices, colour indices") {
    const std::string body = "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 7\n";
    for (const std::string& text : {body, "OFF " + body, "OFF\n" + body, "\xEF\xBB\xBFOFF # x\n\n# y\n" + body}) {
      const PolygonSoup soup = read_off(text, "t.off");
      CHECK(soup.points.size() == 3);
      CHECK(corners(soup, 0) == Ring{0, 1, 2});
      CHECK(soup.colors.empty());
    }
    const PolygonSoup colored =
        read_off("COFF\n3 1 0\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n0 1 0 1 0 0 1\n3 0 1 2\n", "t.off");
    CHECK(colored.points[2] == glm::dvec3(0, 1, 0));
    const PolygonSoup all = read_off("STCNOFF\n1 0 0\n0 0 5 9 9 9 9 9 9 9 9 9\n", "t.off");
    CHECK(all.points[0] == glm::dvec3(0, 0, 5));
  }

  TEST_CASE("OBJ: negative indices, texture indices, materials of the same folder, joined lines") {
    const auto materials = [](std::string_view file) -> std::optional<MaterialFile> {
      if (file != "paint.mtl") return std::nullopt;
      return MaterialFile{"paint.mtl",
                          "newmtl red paint\nKa 0 0 0\nKd 1 0.25 0\n# x\nnewmtl blue\nKd 0 0 1\nillum 2\n"};
    };
    for (const char* end : {"\n", "\r\n", "\r"}) {
      const PolygonSoup soup = read_obj(with_line_ends(pyramid_obj, end), "pyramid.obj", materials);
      REQUIRE(soup.points.size() == 5);
      REQUIRE(soup.outlines.size() == 5);
      CHECK(soup.points[2] == glm::dvec3(-1, -1, 0));
      CHECK(soup.points[4] == glm::dvec3(0, 0, 1.5));
      CHECK(corners(soup, 0) == Ring{0, 1, 4});
      CHECK(corners(soup, 2) == Ring{2, 3, 4});
      CHECK(corners(soup, 3) == Ring{3, 0, 4});
      CHECK(corners(soup, 4) == Ring{3, 2, 1, 0});
      CHECK(soup.colors[0] == Color{255, 64, 0});
      CHECK(!soup.colors[2]);
      CHECK(soup.colors[4] == Color{0, 0, 255});
      CHECK(soup.point_lines[4] == 8);
      CHECK(soup.outline_lines[3] == 16);
      CHECK(soup.outline_lines[4] == 19);
      CHECK(soup.notes.empty());
    }
    const PolygonSoup bare = read_mesh_bytes(MeshFormat::obj, pyramid_obj, "pyramid.obj");
    CHECK(bare.colors.empty());
    CHECK(bare.notes.size() == 1);
  }

  TEST_CASE("OFF: the first count may follow the keyword without a blank, as some programs write it") {
    CHECK(corners(read_off("OFF3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "t.off"), 0) == Ring{0, 1, 2});
    CHECK(read_off("COFF3 1 0\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n0 1 0 1 0 0 1\n3 0 1 2\n", "t.off").points.size() == 3);
  }

  TEST_CASE("OFF: binary, with and without colours, whatever ends the first line") {
    for (const std::string& bytes : {binary_triangle_off(), "OFF BINARY\r" + binary_triangle_off().substr(10)}) {
      const PolygonSoup soup = read_off(bytes, "t.off");
      REQUIRE(soup.points.size() == 3);
      CHECK(soup.points[1] == glm::dvec3(1, 0, 0.5));
      REQUIRE(soup.outlines.size() == 1);
      CHECK(corners(soup, 0) == Ring{0, 1, 2});
      CHECK(soup.colors[0] == Color{255, 0, 128});
      CHECK(soup.outline_lines.empty());
    }
  }

  TEST_CASE("OBJ: beside polygons, what is not known and what is free-form is left out, with a note that says so") {
    const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const PolygonSoup unknown = read_mesh_bytes(MeshFormat::obj, mesh + "weight 1\nweight 2\n", "t.obj");
    CHECK(unknown.outlines.size() == 1);
    CHECK(unknown.notes ==
          std::vector<std::string>{"t.obj:5: 'weight' is no statement of an OBJ file; 2 such lines were left out"});
    const PolygonSoup curves =
        read_mesh_bytes(MeshFormat::obj, mesh + "cstype bezier\nsurf 0 1 0 1 1 2\nend\n", "t.obj");
    CHECK(curves.outlines.size() == 1);
    CHECK(curves.notes ==
          std::vector<std::string>{"t.obj:6: 1 free-form curve or surface (curv, curv2, surf) is left out"});
  }

  TEST_CASE("PLY: triangle strips become triangles that all turn the same way") {
    const PolygonSoup soup = read_ply(strips_ply, "t.ply");
    REQUIRE(soup.outlines.size() == 3);
    CHECK(corners(soup, 0) == Ring{0, 1, 2});
    CHECK(corners(soup, 1) == Ring{2, 1, 3});
    CHECK(corners(soup, 2) == Ring{2, 3, 5});  // after -1 a new strip begins; a vertex twice in a row makes no triangle
    CHECK(soup.outline_lines[2] == 17);
  }

  TEST_CASE("OBJ: a face may stand before its vertices, points and lines are passed over") {
    const PolygonSoup soup =
        read_mesh_bytes(MeshFormat::obj, "f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\np 1\n", "t.obj");
    CHECK(corners(soup, 0) == Ring{0, 1, 2});
    CHECK(soup.notes.size() == 1);
  }

  TEST_CASE("PLY: ascii, colours of faces, other elements passed over") {
    for (const char* end : {"\n", "\r\n", "\r"}) {
      const PolygonSoup soup = read_ply(with_line_ends(square_ply, end), "square.ply");
      REQUIRE(soup.points.size() == 4);
      REQUIRE(soup.outlines.size() == 2);
      CHECK(soup.points[2] == glm::dvec3(1, 1, 0));
      CHECK(corners(soup, 1) == Ring{0, 2, 3});
      CHECK(soup.colors[0] == Color{255, 128, 0});
      CHECK(soup.colors[1] == Color{0, 0, 7});
      CHECK(soup.point_lines[0] == 19);
      CHECK(soup.outline_lines[1] == 24);
    }
  }

  TEST_CASE("PLY: binary of both byte orders, whatever ends the lines of the head") {
    for (const bool big : {false, true})
      for (const char* end : {"\n", "\r\n", "\r"}) {
        const PolygonSoup soup = read_ply(binary_square_ply(big, end), "square.ply");
        REQUIRE(soup.points.size() == 4);
        REQUIRE(soup.outlines.size() == 2);
        CHECK(soup.points[1] == glm::dvec3(1, 0, 0));
        CHECK(soup.points[2] == glm::dvec3(1, 1, 0));
        CHECK(corners(soup, 1) == Ring{0, 2, 3});
        CHECK(soup.colors[1] == Color{255, 128, 0});
        CHECK(soup.point_lines.empty());
        CHECK(soup.outline_lines.empty());
      }
    // After CR alone, a byte 0x0A is the first of the data.
    std::string bytes =
        "ply\rformat binary_little_endian 1.0\relement vertex 1\rproperty uchar x\rproperty uchar y\rproperty uchar "
        "z\rend_header\r";
    bytes += "\n\r\n";
    CHECK(read_ply(bytes, "t.ply").points[0] == glm::dvec3(10, 13, 10));
  }

  TEST_CASE("STL: ascii and binary, equal points become one") {
    for (const std::string& bytes : {tetrahedron_stl, with_line_ends(tetrahedron_stl, "\r\n"),
                                     with_line_ends(tetrahedron_stl, "\r"), binary_tetrahedron_stl()}) {
      const PolygonSoup soup = read_stl(bytes, "t.stl");
      REQUIRE(soup.points.size() == 4);
      REQUIRE(soup.outlines.size() == 4);
      CHECK(corners(soup, 0) == Ring{0, 1, 2});
      CHECK(soup.points[1] == glm::dvec3(0, 1, 0));
      CHECK(corners(soup, 3) == Ring{2, 1, 3});
    }
    CHECK(read_stl(tetrahedron_stl, "t.stl").outline_lines[1] == 9);
    CHECK(read_stl(tetrahedron_stl, "t.stl").point_lines[1] == 5);
    CHECK(read_stl("solid a\nendsolid a\nsolid b\nendsolid\n", "t.stl").outlines.empty());
  }
}
