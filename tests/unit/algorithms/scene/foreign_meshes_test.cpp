// Meshes as other programs write them, loosely: read, or refused with the true reason, and nothing is lost silently.
#include <doctest/doctest.h>

#include <limits>
#include <string>
#include <vector>

#include "algorithms/scene/files/read_mesh.hpp"
#include "algorithms/scene/files/tokens.hpp"
#include "tests/unit/algorithms/scene/input_error.hpp"
#include "tests/unit/algorithms/scene/mesh_texts.hpp"

using namespace zstep;
using namespace zstep::scene;
using namespace zstep::test;

namespace {

std::string error_of(MeshFormat format, const std::string& bytes) {
  return input_error([&] { read_mesh_bytes(format, bytes, "t"); });
}

/// The only note of a mesh; how many there are where it is not one.
std::string note_of(const PolygonSoup& soup) {
  return soup.notes.size() == 1 ? soup.notes[0] : std::to_string(soup.notes.size()) + " notes";
}

const std::string triangle = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

/// A facet of an STL; the words of its ends may be others.
std::string facet(const std::string& end_loop = "endloop", const std::string& end_facet = "endfacet",
                  const std::string& last = "vertex 0 1 0") {
  return "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n" + last + "\n" + end_loop + "\n" + end_facet +
         "\n";
}

/// A binary STL of triangles, with the same two bytes behind each.
std::string binary_stl(std::string head, std::uint32_t declared, int triangles, std::uint16_t attribute = 0,
                       float last = 0) {
  head.resize(80, ' ');
  put(head, declared);
  for (int k = 0; k < triangles; ++k) {
    for (const float number : {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f}) put(head, number);
    put(head, k + 1 == triangles ? last : 0.f);
    put(head, attribute);
  }
  return head;
}

/// An ascii PLY of one triangle; `more` stands before its end_header, `data` at its end.
std::string ply(const std::string& list = "property list uchar int vertex_indices\n", const std::string& more = "",
                const std::string& data = "") {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 1\n" +
         list + more + "end_header\n" + triangle + data;
}

PolygonSoup obj_with(const std::string& materials) {
  return read_obj("mtllib a.mtl\nusemtl r\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "t.obj", [&](std::string_view) {
    return MaterialFile{"a.mtl", materials};
  });
}

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

}  // namespace

TEST_SUITE("meshes of other programs") {
  TEST_CASE("numbers: what Microsoft's library writes for no number is one that is not finite, and no comment") {
    for (const char* token : {"-1.#IND", "1.#QNAN0", "1.#INF", "-1.#J", "-nan(ind)", "NaN(snan)"}) {
      REQUIRE_MESSAGE(parse_number(token), token);
      CHECK_MESSAGE(!std::isfinite(*parse_number(token)), token);
    }
    for (const char* token : {"1.#", "#IND", "2.#x", "nan(1"}) CHECK_MESSAGE(!parse_number(token), token);
    Tokens words("1.#IND 2#x\n3.# y", "t", Tokens::Comments::hash);
    for (const char* word : {"1.#IND", "2", "3."}) CHECK(words.next() == word);
    CHECK(words.next().empty());
  }

  TEST_CASE("a mesh's polygons with a vertex that is no number are left out, a vertex that none uses harms nobody") {
    const std::string vertices = "v 5 5 5\nv 1 0 0\nv 0 1 0\nv nan 0 0\n";
    const PolygonSoup unused = read_mesh_bytes(MeshFormat::obj, vertices + "f 1 2 3\n", "t");
    CHECK(unused.notes.empty());
    CHECK(unused.points[3] == glm::dvec3(5));  // where it does not move the scene's bounds
    const PolygonSoup used = read_mesh_bytes(MeshFormat::obj, vertices + "f 1 2 4\nf 1 2 3\nf 2 3 4\n", "t");
    REQUIRE(used.outlines.size() == 1);
    CHECK(used.outlines[0].polygon == 0);
    CHECK(used.outline_lines == std::vector<std::int32_t>{6});
    CHECK(note_of(used) ==
          "t:4: 2 polygons are left out, with a vertex that is no finite number; repair the mesh where it was made");
    CHECK(contains(error_of(MeshFormat::obj, vertices + "f 1 2 4\n"), "t:4: every polygon has a vertex that is no"));
    const PolygonSoup off = read_off("OFF\n4 2 0\n0 0 0\n1 0 0\n0 inf 0\n0 1 0\n3 0 1 2\n3 0 1 3 1 0 0\n", "t");
    REQUIRE(off.colors.size() == 1);
    CHECK(off.colors[0] == Color{1, 0, 0});
    CHECK(contains(note_of(off), "t:5: 1 polygon is left out"));
    CHECK(contains(error_of(MeshFormat::ply,
                            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty "
                            "float y\nproperty float z\nelement face 1\nproperty list uchar int "
                            "vertex_indices\nend_header\nnan 0 0\n3 0 0 0\n"),
                   "t:10: every polygon"));
    CHECK(contains(error_of(MeshFormat::obj, "v 1e31 0 0\nf 1 1 1\n"), "t:1: x is 1e+31, beyond 1e+30"));
  }

  TEST_CASE("OFF: keywords in any case, with prefixes in the orders that programs write") {
    for (const char* word : {"off", "Off", "NCOFF", "CNOFF", "STCNOFF", "ncoff", "OFF"})
      CHECK_MESSAGE(read_off(word + ("\n3 1 0\n" + triangle), "t").outlines.size() == 1, word);
    for (const char* word : {"nOFF", "4nOFF", "CCOFF", "XOFF"})
      CHECK_MESSAGE(contains(error_of(MeshFormat::off, word + ("\n3 1 0\n" + triangle)), "' is not read; only OFF in"),
                    word);
  }

  TEST_CASE("OFF: homogeneous points are divided by their weight, which may not be 0") {
    const PolygonSoup soup = read_off("4OFF\n3 1 0\n0 0 0 1\n2 0 0 2\n0 1 0 0.5\n3 0 1 2\n", "t");
    CHECK(soup.points[1] == glm::dvec3(1, 0, 0));
    CHECK(soup.points[2] == glm::dvec3(0, 2, 0));
    CHECK(contains(error_of(MeshFormat::off, "4OFF\n1 0 0\n0 0 0 0\n"), "t:3: w of a vertex is 0"));
    CHECK(read_off("C4OFF\n1 0 0\n2 0 0 2 255 0 0 255\n", "t").points[0] == glm::dvec3(1, 0, 0));
  }

  TEST_CASE("OFF: colours of vertices are kept, also without the C that announces them") {
    for (const char* color : {" 255 0 0", " 255 0 0 255", " 1.0 0.5 0 1"})
      for (const char* word : {"OFF", "COFF"}) {
        const auto vertex = [&](const char* point) { return point + std::string(color) + "\n"; };
        const PolygonSoup soup = read_off(
            word + std::string("\n3 1 0\n") + vertex("0 0 0") + vertex("1 0 0") + vertex("0 1 0") + "3 0 1 2\n", "t");
        CHECK(soup.points[2] == glm::dvec3(0, 1, 0));
        CHECK(soup.notes.empty());
        REQUIRE(soup.attributes.size() == 1);
        CHECK(soup.attributes[0].name == "color");
        CHECK(soup.attributes[0].values[6] == 1);
        CHECK(soup.attributes[0].lines == std::vector<std::int32_t>{3, 4, 5});
      }
    CHECK(
        contains(error_of(MeshFormat::off, "OFF\n1 0 0\n0 0 0 1\n"), "t:3: after x, y and z of a vertex stand 1 more"));
    // Several vertices in a line are none with colours.
    for (const char* text : {"OFF\n3 1 0\n0 0 0 1 0 0\n0 1 0\n3 0 1 2\n", "OFF\n3 1 0 0 0 0\n1 0 0 0 1 0\n3 0 1 2\n",
                             "OFF 3 1 0\n0 0 0 1 0 0 0 1 0\n3 0 1 2\n"}) {
      CHECK(read_off(text, "t").points[2] == glm::dvec3(0, 1, 0));
      CHECK(read_off(text, "t").notes.empty());
    }
  }

  TEST_CASE("OFF: a colour out of range is clamped, what is not used of it has a note") {
    const PolygonSoup clamped = read_off("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 1.2 0 -0.5\n", "t");
    CHECK(clamped.colors[0] == Color{255, 0, 0});
    CHECK(contains(note_of(clamped), "t:6: 1 colour is out of range and clamped"));
    const std::string head = "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n";
    CHECK(contains(note_of(read_off(head + "3 0 1 2 1.0 0 0 0.5\n3 0 1 2 255 0 0 255\n", "t")),
                   "t:6: 1 polygon has an alpha that is not used"));
    CHECK(contains(note_of(read_off(head + "3 0 1 2 7\n3 0 1 2 8\n", "t")),
                   "t:6: 2 polygons have an index into a colour map"));
    CHECK(read_off(head + "3 0 1 2 1.0 0 0 1\n3 0 1 2 255 0 0 255\n", "t").notes.empty());
  }

  TEST_CASE("STL: words that programs write otherwise, several solids, a line twice") {
    for (const std::string& text :
         {"solid a\n" + facet("end loop", "end facet") + "end solid a\n", "solid a\n" + facet() + "endsolida\n",
          "solid a\n" + facet() + "ENDSOLID_a b\n", "solid\nsolid a\n" + facet() + "endsolid\n",
          "solid a\nsolid a\n" + facet() + "endsolid a\nend solid a\n",
          "Solid a\n" + facet() + "end solid\nsolid b\nendsolid b\n"}) {
      const PolygonSoup soup = read_stl(text, "t");
      CHECK_MESSAGE(soup.outlines.size() == 1, text);
      CHECK_MESSAGE(soup.notes.empty(), text);
    }
    CHECK(read_stl("solid a\n" + facet() + "solid b\n" + facet() + "endsolid\n", "t").outlines.size() == 2);
    CHECK(contains(error_of(MeshFormat::stl, "solid a\n" + facet("end lop")), "t:7: 'lop' stands where loop should"));
    CHECK(contains(error_of(MeshFormat::stl, "solid a\n" + facet() + "end\n"), "the file ends where solid should"));
  }

  TEST_CASE("STL: no endsolid at the end, and a line of colour, have a note") {
    const PolygonSoup open = read_stl("solid a\n" + facet(), "t");
    CHECK(open.outlines.size() == 1);
    CHECK(contains(note_of(open), "the file ends without endsolid"));
    CHECK(contains(error_of(MeshFormat::stl, "solid a\n"), "the file ends where facet or endsolid should stand"));
    const PolygonSoup colored = read_stl("solid a\ncolor 1 0 0\n" + facet() + "color 1 0 0\nendsolid\n", "t");
    CHECK(colored.outlines.size() == 1);
    CHECK(note_of(colored) == "t:2: 2 'color' lines are left out: the colour of a solid is not read");
  }

  TEST_CASE("STL: facets of more than three vertices are polygons, of fewer are refused") {
    const PolygonSoup soup =
        read_stl("solid\n" + facet("endloop", "endfacet", "vertex 1 1 0\nvertex 0 1 0") + "endsolid\n", "t");
    REQUIRE(soup.outlines.size() == 1);
    CHECK(soup.corners == std::vector<std::int32_t>{0, 1, 2, 3});
    CHECK(soup.point_lines == std::vector<std::int32_t>{4, 5, 6, 7});
    CHECK(contains(error_of(MeshFormat::stl, "solid\n" + facet("endloop", "endfacet", "")),
                   "t:7: 'endloop' stands where vertex should"));
  }

  TEST_CASE("STL: a facet with a vertex that is no number is left out, in text and in binary") {
    const PolygonSoup text =
        read_stl("solid\n" + facet("endloop", "endfacet", "vertex 0 -1.#IND 0") + facet() + "endsolid\n", "t");
    CHECK(text.outlines.size() == 1);
    CHECK(contains(note_of(text), "t:2: 1 polygon is left out"));
    const PolygonSoup binary = read_stl(binary_stl("x", 2, 2, 0, not_a_number), "t");
    CHECK(binary.outlines.size() == 1);
    CHECK(binary.points.size() == 3);
    CHECK(contains(note_of(binary), "t:byte 178: 1 polygon is left out"));
    CHECK(contains(error_of(MeshFormat::stl, binary_stl("x", 1, 1, 0, not_a_number)), "every polygon has a vertex"));
  }

  TEST_CASE("STL: text without 'solid' is no binary file that was cut short") {
    CHECK(contains(error_of(MeshFormat::stl, facet() + facet()), "t:1: 'facet' stands where solid should"));
    CHECK(contains(error_of(MeshFormat::stl, "<html>404</html>"), "stands where solid should"));
    CHECK(read_stl("\xEF\xBB\xBFsolid\n" + facet() + "endsolid\n", "t").outlines.size() == 1);
  }

  TEST_CASE(
      "STL: a count of 0 is that of a pipe, one that is too large is refused, bytes behind the last have a note") {
    const PolygonSoup piped = read_stl(binary_stl("x", 0, 2), "t");
    CHECK(piped.outlines.size() == 2);
    CHECK(note_of(piped) == "t:byte 80: no triangles are declared, but 2 follow and are read");
    CHECK(contains(error_of(MeshFormat::stl, binary_stl("x", 0xFFFFFFFF, 2)), "4294967295 triangles are declared"));
    CHECK(read_stl(binary_stl("x", 0, 0), "t").outlines.empty());
    CHECK(note_of(read_stl(binary_stl("x", 1, 2), "t")) ==
          "t:byte 134: 50 bytes after the last of 1 triangles are not read");
  }

  TEST_CASE("STL: colours of triangles, by the conventions of VisCAM and of Magics") {
    CHECK(read_stl(binary_stl("x", 1, 1, 0x8000 | 31 << 10), "t").colors[0] == Color{255, 0, 0});
    const std::string magics = "COLOR=\x10\x20\x30\xff x";
    CHECK(read_stl(binary_stl(magics, 1, 1, 31 << 10), "t").colors[0] == Color{0, 0, 255});
    CHECK(read_stl(binary_stl(magics, 1, 1, 0x8000), "t").colors[0] == Color{16, 32, 48});
    CHECK(read_stl(binary_stl(magics, 1, 1, 0), "t").colors[0] == Color{16, 32, 48});
    const PolygonSoup other = read_stl(binary_stl("x", 2, 2, 7), "t");
    CHECK(other.colors.empty());
    CHECK(contains(note_of(other), "t:byte 132: 2 triangles have attribute bytes that are no colour"));
  }

  TEST_CASE("OBJ: a fault in a material file is a note, and the material keeps what it has") {
    for (const char* line : {"Kd 0.5 0.5", "Kd 1.0,0.5,0.5", "d", "Ni nan", "Tr x"}) {
      const PolygonSoup soup = obj_with(std::string("newmtl r\n") + line + "\n");
      CHECK_MESSAGE(soup.outlines.size() == 1, line);
      CHECK(soup.colors.empty());
      CHECK(soup.materials.empty());
      CHECK_MESSAGE(contains(note_of(soup), "a.mtl:2: "), line);
      CHECK_MESSAGE(contains(note_of(soup), "; this line is left out"), line);
    }
    CHECK(note_of(obj_with("newmtl r\nKd 1 0\nd x\nKd 0 1 0\n")) ==
          "a.mtl:2: blue of Kd is missing; write it as a decimal number; 2 such lines are left out");
    CHECK(obj_with("newmtl r\nKd 1 0\nKd 0 1 0\n").colors[0] == Color{0, 255, 0});
    CHECK(obj_with("newmtl\nKd 1 0 0\n").notes.empty());
  }

  TEST_CASE("OBJ: other textures, and a Tr that hides all, have a note, and colours of vertices are kept") {
    const PolygonSoup textured = obj_with("newmtl r\nmap_Kd a.png\nbump b.png\n");
    CHECK(contains(note_of(textured), "a.mtl:3: 1 texture is not kept"));
    REQUIRE(textured.named_textures.size() == 1);
    CHECK(textured.named_textures[0].named == "a.png");
    CHECK(textured.materials[0].texture == 0);
    CHECK(contains(note_of(obj_with("newmtl r\nTr 1.0\n")), "a.mtl:2: 1 material is invisible by Tr 1"));
    for (const char* text : {"newmtl r\nTr 1\nd 1\n", "newmtl r\nd 1\nTr 1\n"}) {
      CHECK(obj_with(text).materials.empty());
      CHECK(obj_with(text).notes.empty());
    }
    const PolygonSoup soup =
        read_mesh_bytes(MeshFormat::obj, "v 0 0 0 1 0 0\nv 1 0 0 0 0.5 0\nv 0 1 0 1\nf 1 2 3\n", "t");
    REQUIRE(soup.attributes.size() == 1);
    CHECK(soup.attributes[0].values == std::vector<double>{1, 0, 0, 0, 0.5, 0});
    CHECK(soup.attributes[0].of_point == std::vector<std::int32_t>{0, 1, no_value});
  }

  TEST_CASE("OBJ: texture coordinates and normals are those of corners, and have their lines") {
    const PolygonSoup soup = read_mesh_bytes(MeshFormat::obj,
                                             "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvt 0.5 0.5\n"
                                             "vn 0 0 1\nf 1/1/1 2/2/1 3/3/1\nf 2/4 4/-1 3/3\n",
                                             "t");
    CHECK(soup.notes.empty());
    REQUIRE(soup.attributes.size() == 2);
    const VertexAttribute& uv = soup.attributes[0];
    CHECK(uv.name == "uv");
    CHECK(uv.lines == std::vector<std::int32_t>{5, 6, 7, 8});
    CHECK(uv.value_of(0, 1) == 1);
    CHECK(uv.value_of(1, 1) == 3);  // a seam
    CHECK(uv.value_of(1, 2) == 2);
    CHECK(uv.value_of(1, 3) == 3);
    CHECK(soup.attributes[1].value_of(0, 0) == 0);
    CHECK(soup.attributes[1].value_of(1, 3) == no_value);
    const std::string head = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 nan\n";
    for (const char* face : {"f 1/9 2/1 3/1\n", "f 1/0 2/1 3/1\n", "f 1/-7 2/1 3/1\n", "f 1/x 2/1 3/1\n"})
      CHECK(contains(note_of(read_mesh_bytes(MeshFormat::obj, head + face, "t")), "t:4: 2 values of vertices are"));
  }

  TEST_CASE("OBJ: a blank may stand before the slash of a corner") {
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    CHECK(read_mesh_bytes(MeshFormat::obj, vertices + "f 1 /1 2 /2 3 //3\n", "t").corners ==
          std::vector<std::int32_t>{0, 1, 2});
    CHECK(contains(error_of(MeshFormat::obj, vertices + "f /1 2 3\n"), "t:4: the corner '/1' is not an index"));
  }

  TEST_CASE("OBJ: what is refused says why") {
    CHECK(error_of(MeshFormat::obj, "V 0 0 0\nF 1 1 1\n") ==
          "t:1: 'V' is no statement of an OBJ file; write statements in small letters");
    CHECK(error_of(MeshFormat::obj, "v 0,5 0 0\n") ==
          "t:1: x is '0,5', which is not a number; write decimals with a point, and blanks between numbers");
  }

  TEST_CASE("PLY: capitals, other names and types of the list, lists counted by fractions") {
    const std::string text = ply();
    std::string capitals;
    for (const char c : text) capitals += upper_case(c);
    for (const std::string& file :
         {capitals, ply("property list float int vertex_indices\n"), ply("property list uchar int vertex_indexes\n"),
          ply("property list uint8 int64 v\n"), ply("property list uint64 uint64 vertex_index\n")}) {
      const PolygonSoup soup = read_ply(file, "t");
      REQUIRE_MESSAGE(soup.outlines.size() == 1, file);
      CHECK(soup.corners == std::vector<std::int32_t>{0, 1, 2});
      CHECK(soup.notes.empty());
    }
    // Which of two lists are the vertices is no matter of guessing; a list of fractions is none.
    CHECK(contains(error_of(MeshFormat::ply, ply("property list uchar int a\nproperty list uchar int b\n")),
                   "t:7: the faces have no list vertex_indices: the properties are 'a', 'b'"));
    CHECK(contains(error_of(MeshFormat::ply, ply("property list uchar float a\n")), "t:7: the faces have no list"));
    std::string halves = ply("property list float int a\n");
    halves.replace(halves.find("3 0 1 2"), 1, "2.5");
    CHECK(contains(error_of(MeshFormat::ply, halves), "a list of 2.5 'a' is declared"));
  }

  TEST_CASE("PLY: eight-byte indices of a binary file") {
    std::string bytes =
        "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty uchar x\nproperty uchar y\n"
        "property uchar z\nelement face 1\nproperty list int64 uint64 v\nend_header\n";
    bytes += "\1\2\3";
    put(bytes, std::int64_t{3});
    for (int i = 0; i < 3; ++i) put(bytes, std::uint64_t{0});
    CHECK(read_ply(bytes, "t").corners == std::vector<std::int32_t>{0, 0, 0});
    CHECK(contains(note_of(read_ply(bytes + "xx", "t")), ": 2 bytes after the last element are not read"));
    bytes.back() = '\x7f';
    CHECK(contains(error_of(MeshFormat::ply, bytes), "there is no vertex 9.1"));
  }

  TEST_CASE("PLY: comments among the data, elements that are not known, more than is declared") {
    std::string commented = ply("property list uchar int vertex_indices\n", "# c\nobj_info x\ncomment y\n");
    commented.replace(commented.find("3 0 1 2"), 0, "\n# c\ncomment 1 2\n");
    CHECK(read_ply(commented, "t").notes.empty());
    const PolygonSoup more = read_ply(ply("property list uchar int vertex_indices\n", "", "0 0 0\n"), "t");
    CHECK(more.outlines.size() == 1);
    CHECK(contains(note_of(more), "t:14: '0' and what follows it, after the last element, is not read"));
    const std::string unknown = ply("property list uchar int vertex_indices\n",
                                    "element label 1\nproperty list uchar uchar text\n", "\"a name\"\n");
    CHECK(note_of(read_ply(unknown, "t")) == "t:9: 1 of element 'label' are not read");
  }

  TEST_CASE("PLY: colours of vertices are kept, alpha has a note, and a colour out of range is clamped") {
    const std::string colors = "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    std::string vertices =
        "ply\nformat ascii 1.0\ncomment TextureFile a.png\nelement vertex 3\nproperty float x\n"
        "property float y\nproperty float z\n" +
        colors +
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 1 2 3\n"
        "1 0 0 1 2 3\n0 1 0 1 2 3\n3 0 1 2\n";
    const PolygonSoup soup = read_ply(vertices, "t");
    CHECK(soup.notes.empty());
    REQUIRE(soup.named_textures.size() == 1);
    CHECK(soup.named_textures[0].named == "a.png");
    CHECK(soup.named_textures[0].where == "t:3");
    REQUIRE(soup.attributes.size() == 1);
    CHECK(soup.attributes[0].values[1] == 2.0 / 255);
    CHECK(soup.attributes[0].lines == std::vector<std::int32_t>{14, 15, 16});
    std::string faces = ply("property list uchar int vertex_indices\n", colors + "property uchar alpha\n");
    faces.replace(faces.size() - 1, 1, " 300 0 0 128\n");
    const PolygonSoup faded = read_ply(faces, "t");
    CHECK(faded.colors[0] == Color{255, 0, 0});
    REQUIRE(faded.notes.size() == 2);
    CHECK(contains(faded.notes[0], "1 polygon has an alpha that is not used"));
    CHECK(contains(faded.notes[1], "1 colour is out of range"));
  }

  TEST_CASE("PLY: what is refused says what there is in place of it") {
    std::string text = ply();
    for (const char* axis : {" x", " y", " z"}) text.replace(text.find(axis), 1, " p");
    CHECK(error_of(MeshFormat::ply, text) ==
          "t:3: the vertices lack x, y or z: the properties are 'px', 'py', 'pz'; give all three as properties of "
          "element vertex");
    CHECK(contains(error_of(MeshFormat::ply,
                            "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float "
                            "y\nproperty float z\nelement range_grid 1\nproperty list uchar int "
                            "vertex_indices\nend_header\n0 0 0\n1 0\n"),
                   "t:7: a range grid of points is not read, and there are no faces"));
  }
}
