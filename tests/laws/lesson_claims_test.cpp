// What lessons say or ask about other runs than their own ("Try it", a larger picture, another option), held against
// those runs.
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "sim/classroom/lesson.hpp"
#include "tests/where.hpp"
#include "traces/error.hpp"

namespace zstep {
namespace {

namespace fs = std::filesystem;

/// What is changed in a scene's file, as a person would change it.
using Edits = std::vector<std::pair<std::string, std::string>>;

struct Run {
  std::string lesson;  ///< whose claim it is
  std::string scene;   ///< built-in, or of lessons/scenes, or a scene file's text
  std::string method;
  std::string head;    ///< tables of the lesson's head
  std::string claims;  ///< expressions of a lesson, true at the end
  Edits edits = {};
};

class Folder {
 public:
  Folder() : path_(fs::temp_directory_path() / fmt::format("zstep-claims-{}", std::random_device{}())) {
    fs::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }

 private:
  fs::path path_;
};

std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::string edited(std::string text, const Edits& edits) {
  for (const auto& edit : edits) {
    const std::string &old = edit.first, &now = edit.second;
    std::size_t at = text.find(old);
    REQUIRE_MESSAGE(at != std::string::npos, old);
    for (; at != std::string::npos; at = text.find(old, at + now.size())) text.replace(at, old.size(), now);
  }
  return text;
}

void check(const Run& run) {
  CAPTURE(run.lesson);
  CAPTURE(run.head);
  const Folder folder;
  std::string scene = run.scene;
  const bool written_here = scene.find('\n') != std::string::npos;
  if (written_here || fs::path(scene).extension() == ".toml") {
    folder.write("scene.toml",
                 edited(written_here ? scene : text_of(test::in_checkout("lessons/scenes/" + scene)), run.edits));
    scene = "scene.toml";
  }
  const fs::path path = folder.write(
      "1-claims.md",
      fmt::format("+++\ntitle = \"claims\"\nsummary = \"claims\"\nscene = \"{}\"\nmethod = \"{}\"\n{}\n+++\n\n"
                  "## Claims {{at: end}}\n\n{}\n",
                  scene, run.method, run.head, run.claims));
  std::string wrong;
  try {
    Lesson lesson = load_lesson(path);
    run_lesson(lesson);
  } catch (const InputError& error) {
    wrong = error.what();
  }
  CHECK_MESSAGE(wrong == "", wrong);
}

/// The scene of the Warnock lesson with its picture `times` as large.
Edits quarters_enlarged(double times) {
  Edits edits{{"= 16", fmt::format("= {}", 16 * times)}};
  for (const auto& [x, y] : {std::pair{12.0, 1.2},
                             {15.2, 2.0},
                             {13.0, 7.4},
                             {-1.0, 6.3},
                             {17.0, 6.3},
                             {17.0, 16.3},
                             {-1.0, 16.3},
                             {9.0, 9.0},
                             {14.0, 10.0},
                             {11.0, 14.0}})
    edits.push_back(
        {fmt::format("[{}, {}, ", x, y), fmt::format("[ {}, {}, ", (x + 0.5) * times - 0.5, (y + 0.5) * times - 0.5)});
  return edits;
}

/// Polygon `name` moved to the end of a scene's text.
Edits drawn_last(const std::string& scene, const std::string& name) {
  const std::string text = text_of(test::in_checkout("lessons/scenes/" + scene)),
                    mark = "[[polygon]]\nname = \"" + name + "\"";
  const std::size_t at = text.find(mark);
  REQUIRE(at != std::string::npos);
  const std::string lines = text.substr(at, text.find("[[polygon]]", at + 1) - at),
                    tail = text.substr(at + lines.size());
  return {{lines + tail, tail + "\n" + lines}};
}

/// The worked example with its triangles in the other order.
const std::string b_before_a = R"(coordinates = "screen"
raster = { width = 8, height = 8, y_axis = "up" }
options = { coverage = "inclusive" }
polygon = [
  { name = "B", points = [[0, 6, 7], [5, 1, 7], [0, 1, 2]] },
  { name = "A", points = [[0, 7, 5], [6, 7, 5], [0, 1, 5]] },
]
)";

/// A concave polygon with its notch at the second vertex.
const std::string one_notch = R"(points = [[0, -1, -1], [0, 0, -0.5], [0, 1, -1], [0, 0, 1]]
raster = { width = 16, height = 16 }
camera = { rho = 8, theta = 0, phi = 90 }
polygon = [{ name = "N", corners = [0, 1, 2, 3] }]
)";

TEST_CASE("what lessons say about other runs than their own is so") {
  const Edits first_hides_all{
      {"[[37, 15.1, 71.9], [40.6, 24.6, 69.2], [45.7, 27.1, 77.2]]", "[[-60, -5, 1], [100, -5, 1], [20, 110, 1]]"}};
  const std::vector<Run> runs{
      {"viewing: nearer, a vertex of A leaves the window and A is cut to four vertices", "pyramid.toml", "z-buffer",
       "[camera]\nrho = 40", "{y_p(2) = -35} {count(outline where polygon == 0) = 4}"},
      {"back-faces: without culling the same picture takes more compares", "dart.toml", "z-buffer",
       "[conventions]\ncull = false", "{count(compare) = 370} {frame(12, 12) = A}"},
      {"back-faces: three consecutive vertices can say the opposite of the sum over the fan", one_notch, "z-buffer", "",
       "{triple_product(0, 1, 2) = -8} {triple_product(0, 2, 3) = 32} {count(facing where determinant == 24 and facing "
       "== front) = 1}"},
      {"z-buffer: W last, compares stay and no write is replaced", "wall.toml", "z-buffer", "",
       "{count(compare) = 224} {count(compare where not nearer) = 16} {count(compare where nearer and stored < "
       "infinity) = 0} {frame(12, 12) = A}",
       drawn_last("wall.toml", "W")},
      {"worked-example: the half-open rule leaves out right and top borders", "delhi", "z-buffer",
       "[conventions]\ncoverage = \"top_left\"",
       "{count(write_depth where polygon == \"A\") = 15} {count(write_depth where y == 7) = 0} {depth(0, 2) = 3} "
       "{count(compare where z == stored) = 2}"},
      {"worked-example: B first, and both ties go to B", b_before_a, "z-buffer", "",
       "{frame(1, 3) = B} {frame(0, 4) = B} {count(compare where z == stored) = 2}"},
      {"scan-line: a line buffer compares at each pixel", "abc-def.toml", "scan-line",
       "[options]\nresolve = \"line-buffer\"", "{count(scan_line.compare) = 221}"},
      {"depth-sort: cyclic needs two splits and no mark", "cyclic", "depth-sort", "",
       "{count(mark) = 0} {count(split) = 2} {count(draw) = 5}"},
      {"bsp: roots that cut no wall", "six-walls.toml", "bsp", "[options]\nroot = \"fewest-splits\"",
       "{count(cut) = 0}"},
      {"bsp: another eye, as many signs, other pixels",
       "six-walls.toml",
       "bsp",
       "[options]\nroot = \"first\"",
       "{count(eye_side) = 8} {count(paint) = 500}",
       {{"[-3, -8, 3]", "[3, 8, 3]"}}},
      {"warnock: twice as large", "quarters.toml", "warnock", "", "{count(area) = 33}", quarters_enlarged(2)},
      {"warnock: four times as large", "quarters.toml", "warnock", "", "{count(area) = 61}", quarters_enlarged(4)},
      {"warnock: C in front",
       "quarters.toml",
       "warnock",
       "",
       "{count(area) = 81} {frame(11, 10) = C}",
       {{", 6]", ", 1]"}}},
      {"ray-casting: a wider post",
       "six-rays.toml",
       "ray-casting",
       "",
       "{frame(0, 1) = P} {frame(0, 2) = P} {count(paint where polygon == \"P\") = 2}",
       {{"-4.55", "-5.1"}}},
      {"ray-casting: a box for each polygon", "six-rays.toml", "ray-casting", "[options]\nboxes = \"facet\"",
       "{count(plane) = 26} {count(box_test) = 216}"},
      {"ray-casting: a grid", "six-rays.toml", "ray-casting", "[options]\nboxes = \"grid\"",
       "{count(plane) = 42} {count(meeting.cell) = 30}"},
      {"ray-casting: teapot, hierarchy", "teapot", "ray-casting",
       "[raster]\nwidth = 32\nheight = 24\n[options]\nboxes = \"hierarchy\"",
       "{count(plane) = 1201} {count(box_test) = 14954} {count(ray) = 768}"},
      {"ray-casting: teapot, grid", "teapot", "ray-casting",
       "[raster]\nwidth = 32\nheight = 24\n[options]\nboxes = \"grid\"",
       "{count(plane) = 7231} {count(meeting.cell) = 3792}"},
      {"floating-horizon: one horizon loses ink", "ridge-valley.toml", "floating-horizon",
       "[options]\nhorizons = \"one\"", "{count(draw) = 79}"},
      {"hidden-line: five of the box's edges have hidden pieces", "hidden-lines.toml", "hidden-line", "",
       "{count(back where line < 12) + count(hidden where line < 12) = 5}"},
      {"shadow-buffer: specks without a bias", "lamp.toml", "shadow-buffer", "[options]\nbias = \"0\"",
       "{count(darken) = 269}"},
      {"shadow-buffer: a higher square has a larger shadow",
       "lamp.toml",
       "shadow-buffer",
       "",
       "{count(darken) = 65}",
       {{"0.5, 1]", "0.5, 1.5]"}}},
      {"transparency: in the order of the file the wall loses behind glass", "panes.toml", "transparency",
       "[options]\norder = \"file\"", "{depth(13, 5) ~ 3.5}"},
      {"transparency: opaque first, the wall is behind both panes", "panes.toml", "transparency",
       "[options]\norder = \"opaque-first\"", "{depth(13, 5) = 8}"},
      {"comparison: depth sort paints what the Z-buffer compares", "hundred.toml", "depth-sort", "",
       "{count(paint) = 2950}"},
      {"comparison: of the four Warnock takes the most steps", "hundred.toml", "scan-line", "", "{steps = 14715}"},
      {"comparison: and the fewest where one hides all", "hundred.toml", "scan-line", "", "{steps = 17540}",
       first_hides_all},
      {"comparison: of the four Warnock takes the most steps", "hundred.toml", "depth-sort", "", "{steps = 24675}"},
      {"comparison: and the fewest where one hides all", "hundred.toml", "depth-sort", "", "{steps = 26318}",
       first_hides_all},
      {"comparison: of the four Warnock takes the most steps", "hundred.toml", "warnock", "", "{steps = 25713}"},
      {"comparison: and the fewest where one hides all", "hundred.toml", "warnock", "", "{steps = 15650}",
       first_hides_all},
      {"comparison: of the four Warnock takes the most steps", "hundred.toml", "z-buffer", "", "{steps = 14935}"},
      {"comparison: and the fewest where one hides all", "hundred.toml", "z-buffer", "", "{steps = 17265}",
       first_hides_all},
      {"which-z: with pseudodepth R is in front of C in the middle", "receding.toml", "z-buffer", "",
       "{frame(10, 8) = R} {depth(10, 8) = 0.125} {frame(12, 8) = R} {frame(13, 8) = C}"},
      {"which-z: and with z_v by way of its reciprocal", "receding.toml", "z-buffer",
       "[conventions]\ndepth = \"corrected\"", "{frame(10, 8) = R} {depth(10, 8) = 16} {frame(13, 8) = C}"},
      {"how-many-bits: rounding down, S is lost and R is seen", "pairs.toml", "z-buffer",
       "[conventions]\nnumber_format = \"fixed16\"\nrounding = \"down\"", "{frame(18, 5) = R} {frame(25, 5) = D}"},
      {"how-many-bits: C last, and R stays", "pairs.toml", "z-buffer", "[conventions]\nnumber_format = \"fixed16\"",
       "{frame(18, 5) = R}", drawn_last("pairs.toml", "C")},
      {"how-many-bits: with 18 bits, or with z_v, all four are seen", "pairs.toml", "z-buffer",
       "[conventions]\nnumber_format = \"fixed18\"",
       "{frame(3, 5) = P} {frame(10, 5) = Q} {frame(18, 5) = R} {frame(25, 5) = S}"},
      {"how-many-bits: with 18 bits, or with z_v, all four are seen", "pairs.toml", "z-buffer",
       "[conventions]\nnumber_format = \"fixed16\"\ndepth = \"view\"",
       "{frame(3, 5) = P} {frame(10, 5) = Q} {frame(18, 5) = R} {frame(25, 5) = S}"},
      {"near-and-far: P first, and all of it is seen", "poster.toml", "z-buffer",
       "[conventions]\nnumber_format = \"fixed16\"",
       "{count(compare where polygon == \"W\" and nearer and stored < infinity) = 0} {frame(33, 24) = P}",
       drawn_last("poster.toml", "W")},
      {"near-and-far: near = 1, and all of P is seen", "poster.toml", "z-buffer",
       "[conventions]\nnumber_format = \"fixed16\"\n[camera]\nnear = 1",
       "{count(compare where polygon == \"P\" and not nearer) = 0}"},
      {"near-and-far: far = 31 changes nothing", "poster.toml", "z-buffer",
       "[conventions]\nnumber_format = \"fixed16\"\n[camera]\nfar = 31",
       "{count(compare where polygon == \"P\" and not nearer) = 368}"},
      {"near-and-far: near = 0.7, and some of P is lost", "poster.toml", "z-buffer",
       "[conventions]\nnumber_format = \"fixed16\"\n[camera]\nnear = 0.7",
       "{count(compare where polygon == \"P\" and not nearer) = 36}"},
      {"near-and-far: near = 25 cuts nothing off", "poster.toml", "z-buffer",
       "[conventions]\nnumber_format = \"fixed16\"\n[camera]\nnear = 25",
       "{count(compare) = 3074} {count(compare where polygon == \"P\" and not nearer) = 0}"},
      {"near-and-far: 24 bits are enough", "poster.toml", "z-buffer", "[conventions]\nnumber_format = \"fixed24\"",
       "{count(compare where polygon == \"P\" and not nearer) = 0}"},
      {"near-and-far: stripes are elsewhere when the eye moves",
       "poster.toml",
       "z-buffer",
       "[conventions]\nnumber_format = \"fixed16\"",
       "{frame(32, 24) = W}",
       {{"eye = [0, 0, 0]", "eye = [0, 0.1, 0]"}}},
      {"edge-functions: boxes alone", "fan.toml", "half-space", "",
       "{count(test) = 367} {count(test where not inside) = 207}"},
      {"edge-functions: tiles without their depths", "fan.toml", "half-space", "[options]\ntiles = \"8\"",
       "{count(test) = 259} {count(test where not inside) = 163}"},
      {"edge-functions: spans ask no pixel outside", "fan.toml", "z-buffer", "", "{count(interpolate_z) = 160}"},
      {"perspective-correct: linearly, the middle of the floor is halfway up, and each stripe has eight scan lines",
       "long-floor.toml", "z-buffer", "[conventions]\nattribute = \"linear\"",
       "{count(attribute where x == 30 and y == 22 and attribute == 0.875) = 1} "
       "{count(attribute where x == 30 and y == 10 and attribute == 1.25) = 1} "
       "{count(attribute where x == 30 and polygon == \"F\" and attribute > 0.51 and attribute < 0.76) = 8} "
       "{count(attribute where x == 8 and y == 11 and attribute == 1.45) = 1}"},
  };
  for (const Run& run : runs) check(run);
}

}  // namespace
}  // namespace zstep
