// Colours, texture coordinates, normals, numbers and images of scene files and meshes: read with their lines, refused
// where they cannot be, and written again.
#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include "algorithms/scene/files/read_mesh.hpp"
#include "algorithms/scene/load.hpp"
#include "algorithms/scene/save.hpp"
#include "tests/folder.hpp"
#include "tests/unit/algorithms/scene/input_error.hpp"
#include "tests/where.hpp"

using namespace zstep;
using namespace zstep::test;

namespace {

namespace fs = std::filesystem;

const std::string triangle = "[[polygon]]\npoints = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\n";

std::string error_of(const std::string& more) {
  return input_error([&] { read_scene_text(triangle + more, in_checkout("tests/golden/s.toml")); });
}
SceneFile scene_of(const std::string& more) {
  return read_scene_text(triangle + more, in_checkout("tests/golden/s.toml"));
}
std::vector<double> value_at(const Scene& scene, const char* name, std::int32_t polygon, std::int32_t point) {
  const VertexAttribute* attribute = attribute_named(scene, name);
  REQUIRE(attribute != nullptr);
  const std::int32_t value = attribute->value_of(polygon, point);
  if (value == no_value) return {};
  const auto first = attribute->values.begin() + std::ptrdiff_t{value} * attribute->components;
  return {first, first + attribute->components};
}

const std::string two_texels = "P3\n2 1\n255\n255 0 0  0 0 255\n";

}  // namespace

TEST_SUITE("scene/attributes of files") {
  TEST_CASE("a polygon's at_vertices: by name, with lines, one value for neighbours that agree") {
    const Scene scene = load_scene(in_checkout("tests/golden/textured.toml")).scene;
    CHECK(scene.attributes.size() == 4);
    CHECK(value_at(scene, "color", 0, 1) == std::vector<double>{1, 1, 0});
    CHECK(value_at(scene, "color", 1, 2) == std::vector<double>{0, 0.5, 0});
    CHECK(value_at(scene, "heat", 1, 2) == std::vector<double>{0.6});
    CHECK(value_at(scene, "uv", 0, 2) == std::vector<double>{1, 1});
    CHECK(value_at(scene, "uv", 1, 2) == std::vector<double>{2, 0});  // its own
    CHECK(attribute_named(scene, "color")->own.empty());
    CHECK(attribute_named(scene, "uv")->own.size() == 2);
    CHECK(attribute_named(scene, "heat")->lines.front() == 23);
    CHECK(scene.polygons[1].material->texture == 0);
  }

  TEST_CASE("what is wrong in at_vertices has its line and a way to mend it") {
    CHECK(error_of("at_vertices = { uv = [[0, 0], [1, 0]] }").find("s.toml:3: 'uv' is no list of 3 values") !=
          std::string::npos);
    CHECK(error_of("at_vertices = { uv = 1 }").find("no list of 3") != std::string::npos);
    CHECK(error_of("at_vertices = { uv = [[0, 0, 0], [1, 0, 0], [1, 1, 1]] }").find("has 3 numbers") !=
          std::string::npos);
    CHECK(error_of("at_vertices = { color = [\"red\", \"rad\", \"red\"] }").find("'rad' is no colour") !=
          std::string::npos);
    CHECK(error_of("at_vertices = { heat = [1, [2, 3], 4] }").find("others have 1") != std::string::npos);
    CHECK(error_of("at_vertices = { heat = [[1, 2, 3, 4, 5], [], []] }").find("give 1 to 4") != std::string::npos);
    CHECK(error_of("at_vertices = { heat = [1, nan, 3] }").find("heat") != std::string::npos);
    std::string many;
    for (int k = 0; k < 9; ++k) many += (k > 0 ? ", a" : "a") + std::to_string(k) + " = [1, 2, 3]";
    CHECK(error_of("at_vertices = { " + many + " }").find("more than 8 names") != std::string::npos);
    CHECK(error_of("at_vertex = { heat = [1, 2, 3] }").find("at_vertices") != std::string::npos);
  }

  TEST_CASE("a texture that cannot be had is a note, and nothing is looked for outside the folder") {
    const auto note_of = [](const std::string& named) {
      const SceneFile file = scene_of("texture = \"" + named + "\"\n");
      CHECK(file.scene.textures.empty());
      CHECK(file.scene.polygons[0].material->texture == no_texture);
      REQUIRE(!file.notes.empty());
      return file.notes[0];
    };
    CHECK(note_of("nowhere.png").find("s.toml:3: there is no image 'nowhere.png' in this folder or below") !=
          std::string::npos);
    CHECK(note_of("/etc/passwd").find("there is no image") != std::string::npos);
    CHECK(note_of("../../README.md").find("there is no image") != std::string::npos);
    CHECK(note_of("bsp.toml").find("is no picture that zstep reads") != std::string::npos);
  }

  TEST_CASE("OBJ: the image of a material is found, each once, and those that are too large have a note") {
    const Folder folder;
    folder.write("images/a b.ppm", two_texels), folder.write("large.ppm", "P2\n2000 2000\n255\n");
    folder.write("m.mtl",
                 "newmtl r\nmap_Kd -s 1 1 1 images/none.ppm\nnewmtl q\nmap_Kd images/a b.ppm\n"
                 "newmtl s\nmap_kd images/a b.ppm\nmap_Ks images/a b.ppm\n");
    const Scene scene =
        load_scene(folder.write("t.obj",
                                "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                                "usemtl q\nf 1/1 2/2 3/3\nusemtl s\nf 1/1 2/2 3/3\nusemtl r\nf 1 2 3\n"))
            .scene;
    REQUIRE(scene.textures.size() == 1);
    CHECK(scene.textures[0].texels == std::vector<Color>{{255, 0, 0}, {0, 0, 255}});
    CHECK(scene.polygons[0].material->texture == 0);
    CHECK(scene.polygons[1].material->texture == 0);
    CHECK(scene.polygons[2].material->texture == no_texture);
  }

  TEST_CASE("PLY: the image of its head, and coordinates in lists of faces") {
    const Folder folder;
    folder.write("two.ppm", two_texels);
    const std::string head =
        "ply\nformat ascii 1.0\ncomment TextureFile two.ppm\nelement vertex 4\nproperty float x\nproperty float y\n"
        "property float z\nelement face 2\nproperty list uchar int vertex_indices\nproperty list uchar float "
        "texcoord\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    const Scene scene =
        load_scene(folder.write("t.ply", head + "3 0 1 2 6 0 0 1 0 1 1\n3 0 2 3 6 0.5 0 1 1 0 1\n")).scene;
    REQUIRE(scene.textures.size() == 1);
    CHECK(scene.polygons[1].material->texture == 0);
    CHECK(value_at(scene, "uv", 0, 1) == std::vector<double>{1, 0});
    CHECK(value_at(scene, "uv", 1, 0) == std::vector<double>{0.5, 0});
    const SceneFile odd = load_scene(folder.write("odd.ply", head + "3 0 1 2 5 0 0 1 0 1\n3 0 2 3 0\n"));
    CHECK(odd.scene.attributes.empty());
    CHECK(std::any_of(odd.notes.begin(), odd.notes.end(),
                      [](const std::string& note) { return note.find("1 value of a vertex") != std::string::npos; }));
  }

  TEST_CASE("a mesh's normals go with the planes that they stand on where a scene places it") {
    const Folder folder;
    folder.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 1\nvn 0 -1 1\nf 1//1 2//1 3//1\n");
    const Scene scene =
        load_scene(folder.write("s.toml", "[[mesh]]\nfile = \"t.obj\"\nscale = [1, 1, 3]\nrotate = [0, 0, 90]\n"))
            .scene;
    const auto n = value_at(scene, "normal", 0, 0);
    const glm::dvec3 normal(n[0], n[1], n[2]), p = scene.points[1] - scene.points[0],
                                               q = scene.points[2] - scene.points[0];
    CHECK(glm::dot(normal, p) == doctest::Approx(0));
    CHECK(glm::dot(normal, q) == doctest::Approx(0));
    CHECK(glm::length(normal) > 0.1);
  }

  TEST_CASE("law: a scene with attributes and textures that was changed is saved with them, and shaded alike") {
    const Folder folder;
    const std::string source = in_checkout("tests/golden/textured.toml");
    fs::copy_file(in_checkout("tests/golden/texture.ppm"), folder.path() / "texture.ppm");
    fs::copy_file(source, folder.path() / "textured.toml");
    for (const char* shade : {"bilinear", "phong", "colors"}) {
      Conventions conventions;
      conventions.options["shade"] = shade;
      SceneFile file = load_scene((folder.path() / "textured.toml").string());
      prepare_for_shade(file, conventions);
      Scene scene = look_at_scene(file.scene, {});
      scene.points[2].z += 0.25, scene.points[3].z += 0.25;  // the fold
      const SceneText saved = text_of_scene(scene, file.conventions, folder.path() / "saved.toml");
      CHECK(saved.in_place);
      scene.source.clear();  // all is written out
      const SceneText written = text_of_scene(scene, file.conventions, folder.path() / "saved.toml");
      const Scene again = look_at_scene(read_scene_text(written.text, folder.path() / "saved.toml").scene, {});
      CHECK(runs_alike(scene, again));
      CHECK(value_at(again, "uv", 1, 2) == std::vector<double>{2, 0});
    }
  }

  TEST_CASE("law: a mesh without normals that light shades is saved as it was read") {
    Conventions phong;
    phong.options["shade"] = "phong";
    SceneFile file = load_scene("teapot:2");
    prepare_for_shade(file, phong);
    const Scene scene = look_at_scene(file.scene, {});
    Conventions as_run = file.conventions;
    as_run.options = phong.options;
    const SceneText saved = text_of_scene(scene, as_run, in_checkout("tests/golden/saved.toml"));
    CHECK(saved.text.find("[[polygon]]") == std::string::npos);
  }
}
