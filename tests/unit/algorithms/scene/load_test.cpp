// Scenes by path.
#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "algorithms/scene/mesh.hpp"
#include "algorithms/scene/load.hpp"
#include "tests/folder.hpp"
#include "tests/unit/algorithms/scene/input_error.hpp"
#include "tests/where.hpp"

using namespace zstep;
using namespace zstep::test;
namespace fs = std::filesystem;

namespace {

const std::string meshes = test::in_checkout("tests/data/meshes/");

}  // namespace

TEST_SUITE("load a scene") {
  TEST_CASE("a mesh file: colours of its own, open below") {
    const SceneFile file = load_scene(meshes + "house.off");
    CHECK(file.scene.name == "house");
    CHECK(file.scene.source == meshes + "house.off");
    CHECK(file.scene.raster == Raster{640, 480, false});
    CHECK(file.scene.polygons.size() == 6);
    CHECK(file.scene.facets.size() == 6);
    CHECK(file.scene.facets[0].corner_count == 5);
    CHECK(file.scene.polygons[2].color == Color{86, 180, 233});
    CHECK(file.scene.polygons[0] == Polygon{"A", {230, 159, 0}, 14});
    CHECK(file.scene.point_lines[0] == 4);
  }

  TEST_CASE("an OBJ file with its materials and concave polygons") {
    const Scene scene = load_scene(meshes + "arrow.obj").scene;
    CHECK(scene.facets.size() == 9);
    CHECK(scene.facets[0].corner_count == 7);
    CHECK(scene.polygons[0].color == Color{230, 153, 0});
    CHECK(scene.polygons[1].color == Color{0, 115, 179});
    CHECK(scene.polygons[8].color == Color{153, 153, 153});
  }

  TEST_CASE("colours where a file has none: the palette for a few polygons, shaded clay for many") {
    const Folder folder;
    std::string off = "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
    const Scene few = load_scene(folder.write("few.OFF", off)).scene;
    CHECK(few.polygons[3].color == scene::palette[3]);
    std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (int i = 0; i < 5; ++i) obj += "f 1 2 3\nf 3 2 1\n";
    const SceneFile many = load_scene(folder.write("many.obj", obj));
    CHECK(many.scene.polygons[0].color == scene::shaded(scene::clay, {0, 0, 1}));
    CHECK(many.scene.polygons[1].color == scene::shaded(scene::clay, {0, 0, -1}));
    CHECK(many.scene.polygons[0].color.red > many.scene.polygons[1].color.red);
    CHECK(many.notes.empty());  // each pair closes
  }

  TEST_CASE("notes: open, inside out, cut loose") {
    const Folder folder;
    const std::string solid = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
    const std::string twice = solid + "v 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\n";
    const auto notes = [&](const std::string& text) { return load_scene(folder.write("m.obj", text)).notes; };
    const std::string outwards = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\nf 5 7 6\nf 5 6 8\nf 5 8 7\nf 6 7 8\nf 1 1 1\n";
    const std::string inwards = "f 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\nf 5 6 7\nf 5 8 6\nf 5 7 8\nf 6 8 7\nf 1 1 1\n";
    REQUIRE(notes(twice + outwards).size() == 1);
    CHECK(contains(notes(twice + outwards)[0], "1 polygon is not drawn, having fewer than three different corners"));
    REQUIRE(notes(twice + inwards).size() == 2);
    CHECK(contains(notes(twice + inwards)[1], "clockwise seen from outside"));
    CHECK(contains(notes(solid + inwards.substr(0, 32))[0], "clockwise seen from outside"));  // also of few polygons
    CHECK(notes(solid + "f 1 2 3\nf 3 2 1\n").empty());                                       // no volume
    CHECK(notes(twice + outwards.substr(8)).size() == 1);  // open, but of eight polygons only: nobody needs to be told
    const auto loose = notes(twice + outwards + "f 1 2 7\nf 1 2 8\nf 1 2 7\n");
    REQUIRE(loose.size() == 3);
    CHECK(contains(loose[1], "2 polygons are cut loose"));
    CHECK(contains(loose[2], "open at 3 edges"));
  }

  TEST_CASE("notes: a mirrored mesh is inside out where its file is") {
    const Folder folder;
    folder.write("out.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    folder.write("in.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n");
    const auto notes = [&](const std::string& mesh) {
      return load_scene(folder.write("s.toml", "[[mesh]]\nfile = \"" + mesh + "\"\nscale = [-1, 1, 1]\n")).notes;
    };
    CHECK(notes("out.obj").empty());
    REQUIRE(notes("in.obj").size() == 1);
    CHECK(contains(notes("in.obj")[0], "clockwise seen from outside"));
  }

  TEST_CASE("an OBJ's material files are found as programs write their names, in the mesh's folder and below only") {
    const Folder folder;
    fs::create_directories(folder.path() / "inner/sub");
    folder.write("secret.mtl", "newmtl r\nKd 0 1 0\n");
    folder.write("inner/my.mtl", "newmtl r\nKd 1 0 0\n");
    folder.write("inner/a b.mtl", "newmtl r\nKd 1 1 1\n");
    folder.write("inner/sub/Deep.mtl", "newmtl r\nKd 0 0 1\n");
    const auto color_by = [&](const std::string& name) {
      const std::string mesh = "mtllib " + name + "\nusemtl r\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
      return load_scene(folder.write("inner/m.obj", mesh)).scene.polygons[0].color;
    };
    for (const char* name : {"my.mtl", "./my.mtl", "\"my.mtl\"", "My.MTL", ".\\my.mtl", "C:\\models\\my.mtl",
                             "/home/who/my.mtl", "other/my.mtl", "sub/../my.mtl", "none.mtl my.mtl"})
      CHECK_MESSAGE((color_by(name) == Color{255, 0, 0}), name);
    for (const char* name : {"sub/Deep.mtl", "SUB\\deep.mtl"})
      CHECK_MESSAGE((color_by(name) == Color{0, 0, 255}), name);
    for (const char* name : {"a b.mtl", "\"a b.mtl\""}) CHECK_MESSAGE((color_by(name) == Color{255, 255, 255}), name);
    // Neither a name nor a link leads out of the folder.
    std::error_code error;
    fs::create_directory_symlink(folder.path(), folder.path() / "inner/link", error);
    for (const std::string& name : {std::string("link/secret.mtl"), std::string("../secret.mtl"),
                                    std::string("sub/../../secret.mtl"), (folder.path() / "secret.mtl").string()})
      CHECK_MESSAGE(color_by(name) == scene::palette[0], name);
    folder.write("inner/bad.mtl", "newmtl r\nKd 1 x 0\n");
    const std::string bad = folder.write("inner/bad.obj", "mtllib BAD.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    CHECK(contains(load_scene(bad).notes.at(0), "bad.mtl:2: green of Kd is 'x', which is not a number"));
  }

  TEST_CASE("a scene file and meshes relative to it") {
    const Folder folder;
    folder.write("inner/m.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    const std::string path =
        folder.write("s.toml", "[[mesh]]\nfile = \"inner/m.off\"\n[[mesh]]\nfile = \"inner/../inner/m.off\"\n");
    CHECK(load_scene(path).scene.polygons.size() == 2);
    const std::string bad = folder.write("bad.toml", "[[mesh]]\nfile = \"inner/bad.off\"\n");
    folder.write("inner/bad.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n");
    CHECK(contains(input_error([&] { load_scene(bad); }), "bad.off:5: there is no vertex 3"));
  }

  TEST_CASE("no file, a folder, a device, an unknown kind, no polygons") {
    const Folder folder;
    const auto error_of = [](const std::string& path) { return input_error([&] { load_scene(path); }); };
    CHECK(contains(error_of(folder.path().string() + "/none.obj"), "none.obj: there is no such file"));
    fs::create_directories(folder.path() / "folder.obj");
    CHECK(contains(error_of((folder.path() / "folder.obj").string()), "is a folder"));
    CHECK(contains(error_of("mesh.3ds"), "there is no such scene; name a .toml, .obj, .off, .ply or .stl file"));
    CHECK(contains(error_of(folder.write("empty.obj", "v 0 0 0\n")), "the mesh has no polygons"));
    CHECK(contains(error_of(folder.write("empty.toml", "")), "the scene has no polygons"));
    CHECK(
        contains(error_of(folder.write("m.glb", "glTF")), "a file of this kind is not read as a scene; name a .toml"));
    const std::string device = folder.write("device.toml", "[[mesh]]\nfile = \"zero.obj\"\n");
    std::error_code error;
    fs::create_symlink("/dev/zero", folder.path() / "zero.obj", error);
    if (!error) CHECK(contains(error_of(device), "is no ordinary file"));
    // A material file elsewhere is never opened.
    folder.write("secret.mtl", "newmtl a\nKd 1 0 0\n");
    const SceneFile file =
        load_scene(folder.write("inner/m.obj", "mtllib ../secret.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    CHECK(file.scene.polygons[0].color == scene::palette[0]);
    CHECK(contains(file.notes.at(0), "is not in the mesh's folder"));
  }
}
