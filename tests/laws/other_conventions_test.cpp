// Laws of conventions that libraries have and the lecture has not: rows that go up, centres at halves, right-handed
// view coordinates. A renderer of the zoo is written after three of them.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "algorithms/scene/save.hpp"
#include "tests/folder.hpp"
#include "tests/golden/golden.hpp"
#include "tests/sparse.hpp"
#include "tests/zoo/programs.hpp"
#include "tests/zoo/runs.hpp"
#include "traces/check/check.hpp"
#include "traces/error.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/formulas/walk.hpp"
#include "traces/oracle/errors.hpp"
#include "traces/record/trace_recorder.hpp"

using namespace zstep;
using namespace zstep::test;

namespace {

std::string causes_of(const Trace& run) {
  std::string text;
  for (const Cause& cause : check(run).causes)
    text += fmt::format("{}{}{}@{} ", cause.first.field, cause.first.impossible,
                        cause.first.rule ? rule_text(*cause.first.rule).name : "", cause.first.step);
  return text;
}

Scene seen(const char* name, double theta, double phi, bool up, bool parallel = false) {
  ViewOptions view;
  view.width = 31, view.height = 23, view.theta = theta, view.phi = phi, view.y_up = up;
  if (parallel) view.orthographic = true;
  return look_at_scene(load_scene(name).scene, view);
}

TEST_CASE("law: where rows go up each method draws the picture that it draws where they go down, upside down") {
  int pictures = 0;
  for (const char* name : {"pyramid-behind", "cyclic", "dodecahedron", "cube"})
    for (const bool parallel : {false, true})
      for (const Method& method : methods()) {
        const Scene down = seen(name, 33, 62, false, parallel), up = seen(name, 33, 62, true, parallel);
        try {
          check_run(method, down, {});
        } catch (const InputError&) {
          continue;
        }
        CAPTURE(name);
        CAPTURE(method.id);
        const Trace run = recorded_by(std::string(method.id), up);
        const Picture one = formulas::end_of(recorded_by(std::string(method.id), down)).picture,
                      other = formulas::end_of(run).picture;
        int differ = 0;
        for (std::int32_t y = 0; y < one.height; ++y)
          for (std::int32_t x = 0; x < one.width; ++x) {
            const std::size_t a = one.at(x, y), b = other.at(x, one.height - 1 - y);
            const bool same_depth = one.depth[a] == other.depth[b] || std::abs(one.depth[a] - other.depth[b]) < 1e-9;
            differ += one.polygon[a] != other.polygon[b] || !same_depth;
          }
        CHECK(differ == 0);
        CHECK(causes_of(run) == "");
        ++pictures;
      }
  CHECK(pictures > 30);
}

TEST_CASE("law: a run whose numbers are written otherwise is the same run") {
  for (const char* method : {"z-buffer", "half-space"})
    for (const auto depth : {Conventions::Depth::pseudodepth, Conventions::Depth::view})
      for (const auto axes : {WrittenAs::Axes::left_handed, WrittenAs::Axes::right_handed}) {
        Conventions conventions;
        conventions.depth = depth;
        const Scene scene = seen("pyramid-behind", 33, 62, true);
        try {
          check_run(zstep::method(method), scene, conventions);
        } catch (const InputError&) {
          continue;
        }
        const Trace run = recorded_by(method, scene, conventions);
        Header header = run.header();
        header.written = {WrittenAs::Centre::half, axes};
        std::string text = jsonl_header(header, scene) + "\n";
        run.each(0, run.size(), [&](std::int64_t, const RecordedEvent& event) {
          text += jsonl_event(header, scene, event) + "\n";
          return true;
        });
        CAPTURE(method);
        CHECK((text.find("\"half\"") != text.npos &&
               (text.find("right_handed") != text.npos) == (axes == WrittenAs::Axes::right_handed)));
        const Trace read = trace_of(text);
        CHECK(read.header() == header);
        CHECK(causes_of(read) == "");
        const Picture one = formulas::end_of(run).picture, other = formulas::end_of(read).picture;
        CHECK(one == other);
      }
}

TEST_CASE("law: a depth range moves depths and nothing else, and is kept, declared and judged") {
  const Camera::DepthRange range{0.25, 2.75};
  for (const char* method : {"z-buffer", "half-space"})
    for (const auto depth : {Conventions::Depth::zero_to_one, Conventions::Depth::reversed})
      for (const bool parallel : {false, true}) {
        CAPTURE(method);
        CAPTURE(parallel);
        Conventions conventions;
        conventions.depth = depth;
        const Scene plain = seen("pyramid-behind", 33, 62, false, parallel);
        Scene ranged = plain;
        ranged.camera.depth_range = range;
        const Trace one = recorded_by(method, plain, conventions), other = recorded_by(method, ranged, conventions);
        CHECK(causes_of(other) == "");
        CHECK(oracle::errors_of(other).wrong_pixels == 0);
        const Picture a = formulas::end_of(one).picture, b = formulas::end_of(other).picture;
        CHECK(a.polygon == b.polygon);
        for (std::size_t pixel = 0; pixel < a.depth.size(); ++pixel) {
          if (a.polygon[pixel] == no_polygon) continue;
          CHECK(b.depth[pixel] == doctest::Approx(range.low + (range.high - range.low) * a.depth[pixel]));
          CHECK(view_depth(ranged.camera, conventions, b.depth[pixel]) ==
                doctest::Approx(view_depth(plain.camera, conventions, a.depth[pixel])));
        }
        std::string text = jsonl_header(other.header(), ranged) + "\n",
                    undeclared = jsonl_header(one.header(), plain) + "\n";
        other.each(0, other.size(), [&](std::int64_t, const RecordedEvent& event) {
          for (std::string* of : {&text, &undeclared}) *of += jsonl_event(other.header(), ranged, event) + "\n";
          return true;
        });
        CHECK(trace_of(text).scene().camera.depth_range == range);
        CHECK(causes_of(trace_of(text)) == "");
        CHECK(causes_of(trace_of(undeclared)) != "");
        CHECK(text_of_scene(ranged, conventions, "ranged.toml").text.find("depth_range = [0.25, 2.75]") !=
              std::string::npos);
      }
}

TEST_CASE("law: a depth buffer that begins at the far plane leaves out what lies on it, and nothing else") {
  const std::string cards =
      "[raster]\nwidth = 24\nheight = 16\n[camera]\neye = [0, 0, 0]\ntarget = [0, 0, -1]\nup = [0, 1, 0]\n"
      "d = 1\nnear = 1\nfar = 8\n[options]\ncull = false\n"
      "[[polygon]]\npoints = [[-6, -4, -8], [6, -4, -8], [0, 5, -8]]\n"
      "[[polygon]]\npoints = [[0, -2, -4], [3, -2, -4], [2, 2, -7]]\n";
  const test::Folder folder;
  const SceneFile file = load_scene(folder.write("cards.toml", cards));
  const Scene scene = look_at_scene(file.scene, {});
  using Depth = Conventions::Depth;
  for (const char* method : {"z-buffer", "half-space"})
    for (const auto& [depth, farthest] : {std::pair(Depth::pseudodepth, 1.0),
                                          {Depth::zero_to_one, 1.0},
                                          {Depth::reversed, 0.0},
                                          {Depth::view, 8.0},
                                          {Depth::corrected, 8.0},
                                          {Depth::reciprocal, 0.125}}) {
      CAPTURE(method);
      const double far = farthest;  // a structured binding cannot be captured
      CAPTURE(far);
      Conventions conventions = file.conventions;
      conventions.depth = depth;
      const Trace whole = recorded_by(method, scene, conventions);
      conventions.options["initial-depth"] = "far";
      const Trace run = recorded_by(method, scene, conventions);
      CHECK(causes_of(run) == "");
      CHECK(get<BuffersClear>(run.event(1).event).z == far);
      const Picture all = formulas::end_of(whole).picture, most = formulas::end_of(run).picture;
      int left_out = 0;
      for (std::size_t pixel = 0; pixel < all.polygon.size(); ++pixel) {
        left_out += all.polygon[pixel] == 0;
        CHECK(most.polygon[pixel] == (all.polygon[pixel] == 0 ? no_polygon : all.polygon[pixel]));
      }
      CHECK(left_out > 30);
    }
}

// ---- A renderer after a library ----------------------------------------------------------------------------------

struct Library {
  const char* name;
  bool y_up;
  WrittenAs written;
  bool is_tiny() const { return std::string_view(name) == "tinyrenderer"; }
};
const std::vector<Library> libraries{
    {"opengl", true, {WrittenAs::Centre::half, WrittenAs::Axes::right_handed}},
    {"vulkan", false, {WrittenAs::Centre::half, WrittenAs::Axes::right_handed}},
    {"direct3d", false, {WrittenAs::Centre::half, WrittenAs::Axes::left_handed}},
    {"tinyrenderer", true, {WrittenAs::Centre::integer, WrittenAs::Axes::right_handed}},
};

/// Triangles before a camera, some of which share vertices or lie on each other's borders.
Scene triangles_before_camera(std::uint64_t seed, const Library& library) {
  std::mt19937_64 random(seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random() % 4096) / 4096;
  };
  Scene scene;
  scene.name = "triangles";
  const int count = 2 + static_cast<int>(random() % 5);
  for (std::int32_t i = 0; i < count; ++i) {
    for (std::int32_t corner = 0; corner < 3; ++corner) {
      const bool shared = i > 0 && corner < static_cast<int>(random() % 3);
      scene.corners.push_back(shared ? scene.corners[static_cast<std::size_t>(3 * (i - 1) + corner)]
                                     : static_cast<std::int32_t>(scene.points.size()));
      if (!shared) scene.points.push_back({between(-2, 2), between(-2, 2), between(-2, 2)});
    }
    scene.polygons.emplace_back().color = {200, 100, static_cast<std::uint8_t>(30 * i)};
    Facet facet;
    facet.polygon = i, facet.first_corner = 3 * i, facet.corner_count = 3;
    scene.facets.push_back(facet);
  }
  ViewOptions view;
  view.width = 17, view.height = 13, view.theta = between(0, 360), view.phi = between(20, 160), view.rho = 7;
  view.near = 3, view.far = 11, view.d = between(1, 3), view.y_up = library.y_up, view.corners = library.is_tiny();
  scene = look_at_scene(std::move(scene), view);
  const double d = scene.camera.d;
  if (library.is_tiny()) scene.camera.depth_range = {d * d / 11 - d, d * d / 3 - d};
  return scene;
}

Header header_like(const Library& library, bool float32) {
  Conventions conventions;
  conventions.depth = Conventions::Depth::zero_to_one, conventions.cull = false;
  if (library.is_tiny())
    conventions.depth = Conventions::Depth::reversed, conventions.coverage = Conventions::Coverage::inclusive;
  if (float32) conventions.number_format = NumberFormat::float32;
  Header header = header_for(method("z-buffer"), conventions);
  header.written = library.written;
  return header;
}

std::string printed(const Library& library, const Scene& scene, bool float32, bool quiet, const char* mistake = "") {
  zoo::Task task = task_of(scene);
  task.style = fmt::format("{} {} {}", library.name, float32 ? "float32" : "float64", quiet ? "quiet" : "");
  task.mistake = mistake;
  return zoo::gl(task);
}

TEST_CASE(
    "zoo: right renderers after OpenGL, Vulkan, Direct3D and tinyrenderer are not doubted under their conventions") {
  int runs = 0;
  for (const Library& library : libraries)
    for (std::uint64_t seed = 1; seed <= 200 / test::sparse; ++seed) {
      const Scene scene = triangles_before_camera(seed, library);
      const bool float32 = seed % 2 == 0, quiet = seed % 3 == 0;
      CAPTURE(library.name);
      CAPTURE(seed);
      Header header = header_like(library, float32);
      const Trace run = trace_of(jsonl_header(header, scene) + "\n" + printed(library, scene, float32, quiet));
      CHECK(causes_of(run) == "");
      ++runs;
    }
  MESSAGE(runs, " runs");
}

TEST_CASE("zoo: a convention that such a renderer has and its header has not is named, and two together") {
  struct Case {
    std::string library;
    std::vector<const char*> left_out;
    std::string named;
  };
  for (const Case& one_case : std::vector<Case>{
           {"direct3d", {"centre"}, "pixel_centre half "},
           {"vulkan", {"axes"}, "view_coordinates right_handed "},
           {"opengl", {"y"}, "y_axis up "},
           {"opengl", {"depth"}, "depth zero_to_one "},
           {"vulkan", {"centre", "axes"}, "pixel_centre half view_coordinates right_handed "},
           {"opengl", {"y", "depth"}, "depth zero_to_one y_axis up "},
           {"opengl", {"y", "centre"}, "pixel_centre half y_axis up "},
       }) {
    const std::string &name = one_case.library, &named = one_case.named;
    const std::vector<const char*>& left_out = one_case.left_out;
    const auto is_left_out = [&](std::string_view one) {
      return std::find(left_out.begin(), left_out.end(), one) != left_out.end();
    };
    int found = 0, wrong = 0;
    std::string others;
    for (std::uint64_t seed = 1; seed <= 12 / test::sparse; ++seed) {
      const Library& library =
          *std::find_if(libraries.begin(), libraries.end(), [&](const Library& one) { return one.name == name; });
      const Scene scene = triangles_before_camera(seed, library);
      Scene declared = scene;
      Header header = header_like(library, false);
      if (is_left_out("y")) declared.raster.y_up = false;
      if (is_left_out("axes")) header.written.axes = WrittenAs::Axes::left_handed;
      if (is_left_out("centre")) header.written.centre = WrittenAs::Centre::integer;
      if (is_left_out("depth")) header.conventions.depth = Conventions::Depth::pseudodepth;
      const Trace run = trace_of(jsonl_header(header, declared) + "\n" + printed(library, scene, false, false));
      const CheckReport report = check(run);
      if (report.causes.empty()) continue;
      ++wrong;
      std::string said;
      if (const auto other = convention_it_follows(run, report)) {
        std::vector<std::string> all;
        for (const OtherConvention::Declared& one : other->declared) all.push_back(one.key + " " + one.word + " ");
        std::sort(all.begin(), all.end());
        for (const std::string& one : all) said += one;
        CHECK(other->wrong_steps == 0);
      }
      found += said == named;
      if (said != named) others += said + "; ";
    }
    CAPTURE(name);
    CAPTURE(named);
    CAPTURE(others);
    CAPTURE(left_out.size());
    CHECK(wrong >= 12 / test::sparse - 1);
    CHECK(found == wrong);
  }
}

/// What a check proposes for a run whose file says these words in place of others.
std::string proposed_for(const Trace& run, const std::vector<std::pair<std::string, std::string>>& words,
                         const std::string& step_left_out = "") {
  std::string text = jsonl_header(run.header(), run.scene()) + "\n";
  for (const auto& [declared, other] : words) {
    const std::size_t at = text.find(declared);
    REQUIRE(at != std::string::npos);
    text.replace(at, declared.size(), other);
  }
  run.each(0, run.size(), [&](std::int64_t, const RecordedEvent& event) {
    const std::string line = jsonl_event(run.header(), run.scene(), event);
    if (step_left_out.empty() || line.find("\"" + step_left_out + "\"") == line.npos) text += line + "\n";
    return true;
  });
  const Trace read = trace_of(text);
  const auto other = convention_it_follows(read, check(read));
  std::string said;
  if (other)
    for (const OtherConvention::Declared& one : other->declared) said += one.key + " " + one.word + " ";
  return said;
}

TEST_CASE("left-handed view coordinates are proposed for a run that prints facing tests") {
  const Scene scene = seen("pyramid-behind", 33, 62, false);
  const auto run_of = [&](Conventions::Depth depth, WrittenAs::Axes axes) {
    Conventions conventions;
    conventions.depth = depth;
    Header header = header_for(method("z-buffer"), conventions);
    header.written.axes = axes;
    TraceRecorder recorder(header, scene);
    method("z-buffer").record(scene, conventions, recorder);
    recorder.finish();
    return Trace::from_bytes(recorder.take_bytes(), "run");
  };
  using Depth = Conventions::Depth;
  using Axes = WrittenAs::Axes;
  // A left-handed run that is declared right-handed.
  const std::string centre = "\"pixel_centre\"", right_handed = "\"view_coordinates\":\"right_handed\",";
  const Trace left = run_of(Depth::zero_to_one, Axes::left_handed);
  CHECK(proposed_for(left, {{centre, right_handed + centre}}) == "view_coordinates left_handed ");
}

TEST_CASE("another depth is proposed for a right-handed run, also where the one declared would have another sign") {
  const Scene scene = seen("pyramid-behind", 33, 62, false);
  using Depth = Conventions::Depth;
  int proposed = 0;
  for (const Depth of_run : values_of<Depth>)
    for (const Depth declared : values_of<Depth>) {
      if (of_run == declared) continue;
      Conventions conventions;
      conventions.depth = of_run;
      Header header = header_for(method("z-buffer"), conventions);
      header.written.axes = WrittenAs::Axes::right_handed;
      TraceRecorder recorder(header, scene);
      method("z-buffer").record(scene, conventions, recorder);
      recorder.finish();
      const Trace run = Trace::from_bytes(recorder.take_bytes(), "run");
      const auto in_header = [](Depth depth) { return fmt::format("\"depth\":\"{}\"", word_of(depth)); };
      CAPTURE(word_of(of_run));
      CAPTURE(word_of(declared));
      const std::string said = proposed_for(run, {{in_header(of_run), in_header(declared)}});
      CHECK(said.starts_with(fmt::format("depth {} ", word_of(of_run))));
      ++proposed;
    }
  CHECK(proposed == 42);
}

TEST_CASE("zoo: a wrong renderer after a library is found") {
  int seen = 0, found = 0, at_first = 0;
  std::string table;
  for (const char* mistake :
       {"handedness_changes", "aspect_upside_down", "aspect_left_out", "near_left_out", "depth_not_divided",
        "y_upside_down", "picture_mirrored", "viewport_less_one", "depth_range_left_out", "depth_range_twice",
        "z_v_for_depth", "centres_at_corners", "border_for_both", "weights_exchanged", "depth_corrected_twice",
        "compare_reversed", "cleared_to_0", "w_of_wrong_sign"}) {
    int of_this = 0, found_of_this = 0;
    for (std::uint64_t seed = 1; seed <= 30 / test::sparse; ++seed) {
      const Library& library = libraries[seed % libraries.size()];
      const Scene scene = triangles_before_camera(seed, library);
      const bool quiet = seed % 3 == 0;
      const std::string right = printed(library, scene, false, quiet),
                        wrong = printed(library, scene, false, quiet, mistake);
      const std::int64_t step = first_difference(right, wrong);
      if (step == 0) continue;
      std::string impossible;
      const Trace run = trace_of(jsonl_header(header_like(library, false), scene) + "\n" + wrong, &impossible);
      const CheckReport report = check(run);
      ++of_this;
      if (report.causes.empty() && impossible.empty()) continue;
      ++found_of_this;
      const auto shows = run.next<PolygonBegin>(step, [](const PolygonBegin&) { return true; }).value_or(run.size());
      at_first +=
          report.causes.empty() || (step <= report.causes[0].first.step && report.causes[0].first.step <= shows);
    }
    table += fmt::format("{:<24}{:>4}{:>4}\n", mistake, of_this, found_of_this);
    seen += of_this, found += found_of_this;
  }
  MESSAGE("mistake, runs that it changes, found\n", table, found, " of ", seen, ", ", at_first, " at the first step");
  CHECK(found >= 0.98 * seen);
  CHECK(at_first >= 0.95 * found);
}

}  // namespace
