// What lessons say or ask about other runs than their own ("Try it", a larger picture, another option), held against
// those runs.
#include <filesystem>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "sim/classroom/lesson.hpp"
#include "tests/folder.hpp"
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
  const test::Folder folder;
  std::string scene = run.scene;
  const bool written_here = scene.find('\n') != std::string::npos;
  if (written_here || fs::path(scene).extension() == ".toml") {
    folder.write("scene.toml",
                 edited(written_here ? scene : test::text_of(test::in_checkout("lessons/scenes/" + scene)), run.edits));
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
  const std::string text = test::text_of(test::in_checkout("lessons/scenes/" + scene)),
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

/// The mesh of the last lesson, its lines as they are in the file.
const std::string tent = R"(keep_points = true
points = [[-25, -25, -15], [25, -25, -15], [25, 25, -15], [-25, 25, -15], [-25, 0, 15], [25, 0, 20], [-37.5, -37.5, -15], [37.5, -37.5, -15], [37.5, 37.5, -15], [-37.5, 37.5, -15]]
raster = { width = 24, height = 24 }
camera = { rho = 60, theta = 36.86989764584402, phi = 53.13010235415598, d = 20, window = 12, near = 20, far = 120 }
polygon = [
  { name = "A", corners = [6, 7, 8, 9] },
  { name = "B", corners = [2, 3, 4, 5] },
  { name = "C", corners = [1, 2, 5] },
  { name = "D", corners = [0, 1, 5, 4] },
  { name = "E", corners = [3, 0, 4] },
]
)";

/// A cube whose faces are two triangles each.
const std::string cube_of_triangles =
    R"(points = [[1, -1, -1], [1, 1, -1], [-1, 1, -1], [-1, -1, -1], [1, -1, 1], [1, 1, 1], [-1, 1, 1], [-1, -1, 1]]
camera = { eye = [4, 3, 2] }
polygon = [
  { corners = [0, 1, 5] }, { corners = [0, 5, 4] }, { corners = [1, 2, 6] }, { corners = [1, 6, 5] },
  { corners = [4, 5, 6] }, { corners = [4, 6, 7] }, { corners = [2, 3, 7] }, { corners = [2, 7, 6] },
  { corners = [3, 0, 4] }, { corners = [3, 4, 7] }, { corners = [3, 2, 1] }, { corners = [3, 1, 0] },
]
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
      {"shadow-buffer: the wall with another bias, against rays", "foot.toml", "shadow-buffer",
       "[options]\nbias = \"0\"\nslope-bias = \"0\"\npcf = \"1\"", "{wrongly_dark = 409} {wrongly_lit = 3}"},
      {"shadow-buffer: the wall with another bias, against rays", "foot.toml", "shadow-buffer",
       "[options]\nbias = \"10\"\nslope-bias = \"0\"\npcf = \"1\"", "{wrongly_dark = 240} {wrongly_lit = 4}"},
      {"shadow-buffer: the wall with another bias, against rays", "foot.toml", "shadow-buffer",
       "[options]\nbias = \"40\"\nslope-bias = \"0\"\npcf = \"1\"", "{wrongly_dark = 10} {wrongly_lit = 6}"},
      {"shadow-buffer: the wall with another bias, against rays", "foot.toml", "shadow-buffer",
       "[options]\nbias = \"150\"\nslope-bias = \"0\"\npcf = \"1\"", "{wrongly_dark = 6} {wrongly_lit = 15}"},
      {"shadow-buffer: the wall with another bias, against rays", "foot.toml", "shadow-buffer",
       "[options]\nbias = \"0\"\nslope-bias = \"1\"\npcf = \"1\"", "{wrongly_dark = 9} {wrongly_lit = 8}"},
      {"shadow-buffer: the wall with another bias, against rays", "foot.toml", "shadow-buffer",
       "[options]\nbias = \"0\"\nslope-bias = \"1\"\npcf = \"3\"", "{wrongly_dark = 13} {wrongly_lit = 8}"},
      {"shadow-buffer: the wall with another bias, against rays", "foot.toml", "shadow-buffer",
       "[options]\nbias = \"0\"\nslope-bias = \"2\"\npcf = \"3\"", "{wrongly_dark = 4} {wrongly_lit = 15}"},
      {"shadow-buffer: the wall with another bias, against rays", "foot.toml", "shadow-buffer",
       "[options]\nbias = \"0\"\nslope-bias = \"3\"\npcf = \"3\"", "{wrongly_dark = 1} {wrongly_lit = 27}"},
      {"shadow-buffer: for S a constant of 10 is enough", "lamp.toml", "shadow-buffer", "",
       "{wrongly_dark = 2} {wrongly_lit = 3} {count(darken) = 36}"},
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
      {"light-at-vertices: by normals, there is a highlight in the middle of A", "dome.toml", "z-buffer",
       "[conventions]\nattribute = \"perspective\"\n[options]\nshade = \"phong\"",
       "{count(attribute) = 1083} {count(shade) = 361} {count(compare where not nearer) = 162} "
       "{count(attribute where x == 12 and y == 10 and abs(attribute - 4/15) < 0.0000001) = 1} "
       "{count(shade where x == 12 and y == 10 and r8 == 255 and g8 == 223 and b8 == 175) = 1} "
       "{count(shade where polygon == \"A\" and g8 > 200) = 1}"},
      {"coherence: rays ask every polygon at every pixel", "two-objects.toml", "ray-casting", "",
       "{count(plane) = 2048} {count(box_test) = 0}"},
      {"coherence: a box around each polygon", "two-objects.toml", "ray-casting", "[options]\nboxes = \"facet\"",
       "{count(plane) = 510} {count(box_test) = 2048}"},
      {"coherence: a hierarchy of boxes", "two-objects.toml", "ray-casting", "[options]\nboxes = \"hierarchy\"",
       "{count(plane) = 754} {count(box_test) = 1292}"},
      {"coherence: depth complexity", "two-objects.toml", "z-buffer", "",
       "{count(compare) = 323} {count(write_pixel) = 303} {count(compare where stored == infinity) = 239}"},
      {"coherence: areas", "two-objects.toml", "warnock", "", "{count(area) = 249} {count(pixel) = 78}"},
      {"coherence: edges against polygons", "two-objects.toml", "hidden-line", "",
       "{count(edge)*polygons = 64} {count(own) + count(in_front) + count(beside) + count(covered) = 14}"},
      {"coherence: without it each depth is computed", "two-objects.toml", "scan-line", "",
       "{count(depth) = 64} {count(saved) = 0}"},
      {"many-eyes: roots in the order of the file", "many-eyes.toml", "bsp", "[options]\nroot = \"first\"",
       "{count(side where side == crossing) = 4} {count(node) = 11} {count(node where node == 1 and parent == 0 or "
       "node == 2 and parent == 1 or node == 3 and parent == 2 or node == 4 and parent == 3 or node == 5 and parent == "
       "1 or node == 6 and parent == 0 or node == 7 and parent == 6 or node == 8 and parent == 6 or node == 9 and "
       "parent == 8 or node == 10 and parent == 9) = 10}"},
      {"many-eyes: random roots", "many-eyes.toml", "bsp", "[options]\nroot = \"random\"",
       "{count(side where side == crossing) = 6} {count(node) = 12} {count(node where node == 1 and parent == 0 or "
       "node == 2 and parent == 1 or node == 3 and parent == 1 or node == 4 and parent == 3 or node == 5 and parent == "
       "0 or node == 6 and parent == 5 or node == 7 and parent == 5 or node == 8 and parent == 7 or node == 9 and "
       "parent == 7 or node == 10 and parent == 9 or node == 11 and parent == 10) = 11}"},
      {"many-eyes: other random roots", "many-eyes.toml", "bsp", "[options]\nroot = \"random\"\nseed = \"2\"",
       "{count(side where side == crossing) = 2} {count(node) = 10} {count(node where node == 1 and parent == 0 or "
       "node == 2 and parent == 1 or node == 3 and parent == 2 or node == 4 and parent == 1 or node == 5 and parent == "
       "4 or node == 6 and parent == 0 or node == 7 and parent == 6 or node == 8 and parent == 6 or node == 9 and "
       "parent == 8) = 9}"},
      {"many-eyes: fewest splits", "many-eyes.toml", "bsp", "",
       "{count(side where side == crossing) = 2} {count(node) = 10} {count(node where node == 1 and parent == 0 or "
       "node == 2 and parent == 1 or node == 3 and parent == 2 or node == 4 and parent == 3 or node == 5 and parent == "
       "2 or node == 6 and parent == 1 or node == 7 and parent == 6 or node == 8 and parent == 7 or node == 9 and "
       "parent == 8) = 9}"},
      {"many-eyes: the largest first",
       "many-eyes.toml",
       "bsp",
       "[options]\nroot = \"first\"",
       "{count(side where side == crossing) = 2} {count(node) = 10} {count(node where node == 1 and parent == 0 or "
       "node == 2 and parent == 1 or node == 3 and parent == 2 or node == 4 and parent == 1 or node == 5 and parent == "
       "4 or node == 6 and parent == 0 or node == 7 and parent == 6 or node == 8 and parent == 7 or node == 9 and "
       "parent == 8) = 9}",
       {{"name = \"many eyes\"",
         "name = \"many eyes\"\norder = [\"R\", \"W\", \"V\", \"H\", \"F\", \"G\", \"K\", \"L\", \"M\", \"J\", \"I\", "
         "\"S\"]"}}},
      {"many-eyes: a second eye, the same tree", "many-eyes.toml", "bsp",
       "[camera]\ntheta = 126.86989764584402\n[options]\nroot = \"first\"",
       "{eye_x ~ -6.000} {eye_y ~ 8.000} {count(node) = 11} {count(side) = 30} {count(side where side == crossing) = "
       "4} {count(eye_side) = 11} {count(back_face) = 8} {count(draw) = 8} {count(skip) = 0} {count(paint) = 639}"},
      {"many-eyes: depth sort", "many-eyes.toml", "depth-sort", "",
       "{count(test_1) + count(test_2) + count(test_3) + count(test_4) + count(test_5) + count(test_3_swapped) + "
       "count(test_4_swapped) = 40} {count(split) = 1} {count(draw) = 6} {count(paint) = 539}"},
      {"many-eyes: depth sort for the second eye", "many-eyes.toml", "depth-sort",
       "[camera]\ntheta = 126.86989764584402",
       "{count(test_1) + count(test_2) + count(test_3) + count(test_4) + count(test_5) + count(test_3_swapped) + "
       "count(test_4_swapped) = 29} {count(split) = 1} {count(draw) = 7} {count(paint) = 639}"},
      {"many-eyes: 16 bits lose S", "many-eyes.toml", "z-buffer", "[conventions]\nnumber_format = \"fixed16\"",
       "{count(compare where polygon == \"S\" and nearer) = 0} {count(compare where polygon == \"S\") = 24} {frame(15, "
       "9) = W}"},
      {"many-eyes: nothing is discarded", "many-eyes.toml", "bsp", "[options]\nroot = \"first\"\ndiscard = \"off\"",
       "{count(eye_side) = 11} {count(skip) = 0} {count(draw) = 10} {count(paint) = 539}"},
      {"many-eyes: a hundred triangles, roots in the order of the file", "hundred.toml", "bsp",
       "[options]\nroot = \"first\"", "{count(node) = 454}"},
      {"many-eyes: a hundred triangles, fewest splits", "hundred.toml", "bsp", "", "{count(node) = 345}"},
      {"wireframe: all lines", "two-cubes.toml", "wireframe", "",
       "{count(edge) = 41} {count(whole) = 41} {count(draw) = 568}"},
      {"wireframe: solid", "two-cubes.toml", "z-buffer", "",
       "{count(write_depth where stored == infinity) = 1060} {count(reject) = 9}"},
      {"wireframe: culling alone draws the cubes", "two-cubes.toml", "wireframe", "[options]\nedges = \"front\"",
       "{count(edge where line < 24) - count(back where line < 24) = 18}"},
      {"wireframe: without culling edges of the open box come to be seen", "two-cubes.toml", "hidden-line",
       "[conventions]\ncull = false",
       "{count(reject) = 0} {count(visible where line == 32) = 2} {count(visible where line == 33 and t_0 == 0 and t_1 "
       "== 1) = 1} {count(visible where line == 34 and t_0 == 0 and t_1 == 1) = 1} {count(visible where line == 36 and "
       "t_0 == 0 and t_1 == 1) = 1} {count(visible where line == 35) = 0} {count(visible where line < 24) = 18} "
       "{count(hidden where line < 24 and t_0 == 0 and t_1 == 1) = 6}"},
      {"wireframe: of a cube three faces are seen", "camera = { eye = [4, 3, 2] }\nmesh = [{ builtin = \"cube\" }]\n",
       "hidden-line", "",
       "{count(facing where facing == front) = 3} {count(facing where facing == back) = 3} {count(edge where kind == "
       "contour) = 6}"},
      {"wireframe: of a cube two faces are seen", "camera = { eye = [4, 3, 0.5] }\nmesh = [{ builtin = \"cube\" }]\n",
       "hidden-line", "",
       "{count(facing where facing == front) = 2} {count(facing where facing == back) = 4} {count(edge where kind == "
       "contour) = 6}"},
      {"wireframe: of a cube one face is seen", "camera = { eye = [4, 0.5, 0.5] }\nmesh = [{ builtin = \"cube\" }]\n",
       "hidden-line", "",
       "{count(facing where facing == front) = 1} {count(facing where facing == back) = 5} {count(edge where kind == "
       "contour) = 4}"},
      {"wireframe: a cube of triangles has six more lines", cube_of_triangles, "hidden-line", "",
       "{polygons = 12} {count(edge) = 18} {count(edge where kind == contour) = 6} {count(edge where kind == inner) = "
       "6} {count(edge where kind == back) = 6} {count(visible) = 12}"},
      {"coherence: a frame later L has moved",
       "two-objects.toml",
       "scan-line",
       "[options]\ncoherence = \"on\"",
       "{frame(6, 3) = K} {frame(13, 3) = L} {frame(8, 10) = K} {frame(15, 10) = L} {count(paint) = 247}",
       {{"[[6, 3, 2], [13, 3, 2], [15, 11, 2], [8, 11, 2]]", "[[7, 3, 2], [14, 3, 2], [16, 11, 2], [9, 11, 2]]"}}},
      {"mesh-to-page: as the mesh has it", tent, "z-buffer", "[conventions]\nnumber_format = \"float32\"",
       "{depth(12, 15) = 0.295625031} {steps = 2665} {count(facing where polygon == \"B\") = 2} {count(reject) = 3} "
       "{frame(12, 15) = B}"},
      {"mesh-to-page: the other winding",
       tent,
       "z-buffer",
       "[conventions]\nnumber_format = \"float32\"",
       "{count(facing where polygon == \"B\" and facing == back) = 2} {count(write_pixel where polygon == \"B\") = 0} "
       "{frame(12, 15) = A} {depth(12, 15) ~ 0.7035}",
       {{"[2, 3, 4, 5]", "[5, 4, 3, 2]"}}},
      {"mesh-to-page: line 3 raised",
       tent,
       "z-buffer",
       "[conventions]\nnumber_format = \"float32\"",
       "{depth(12, 15) ~ 0.2694} {view_depth(0.703529418) - view_depth(depth(12, 15)) ~ 26.46}",
       {{"[25, 25, -15]", "[25, 25, -10]"}}},
      {"mesh-to-page: line 4 raised",
       tent,
       "z-buffer",
       "[conventions]\nnumber_format = \"float32\"",
       "{depth(12, 15) ~ 0.2738} {view_depth(0.703529418) - view_depth(depth(12, 15)) ~ 26.30}",
       {{"[-25, 25, -15]", "[-25, 25, -10]"}}},
      {"mesh-to-page: line 5 raised, and B is not cut",
       tent,
       "z-buffer",
       "[conventions]\nnumber_format = \"float32\"",
       "{depth(12, 15) = 0.295625031} {count(facing where polygon == \"B\") = 1} {view_depth(0.703529418) - "
       "view_depth(depth(12, 15)) ~ 25.46}",
       {{"[-25, 0, 15]", "[-25, 0, 20]"}}},
      {"mesh-to-page: line 6 raised",
       tent,
       "z-buffer",
       "[conventions]\nnumber_format = \"float32\"",
       "{depth(12, 15) ~ 0.2436} {view_depth(0.703529418) - view_depth(depth(12, 15)) ~ 27.41}",
       {{"[25, 0, 20]", "[25, 0, 25]"}}},
      {"mesh-to-page: B begun at another vertex",
       tent,
       "z-buffer",
       "[conventions]\nnumber_format = \"float32\"",
       "{depth(12, 15) ~ 0.3186} {view_depth(depth(12, 15)) - view_depth(0.295625031) ~ 0.92} {count(facing where "
       "polygon == \"B\") = 2}",
       {{"[2, 3, 4, 5]", "[3, 4, 5, 2]"}}},
      {"mesh-to-page: lifted to 15",
       tent,
       "z-buffer",
       "[conventions]\nnumber_format = \"float32\"",
       "{frame(12, 15) = B}",
       {{"[25, 25, -15]", "[25, 25, 15]"}}},
      {"mesh-to-page: lifted to 20",
       tent,
       "z-buffer",
       "[conventions]\nnumber_format = \"float32\"",
       "{frame(12, 15) = C}",
       {{"[25, 25, -15]", "[25, 25, 20]"}}},
      {"mesh-to-page: lifted to 25",
       tent,
       "z-buffer",
       "[conventions]\nnumber_format = \"float32\"",
       "{frame(12, 15) = A} {count(write_pixel where polygon == \"B\") = 77}",
       {{"[25, 25, -15]", "[25, 25, 25]"}}},
  };
  for (const Run& run : runs) check(run);
}

}  // namespace
}  // namespace zstep
