// Law: no run of zstep's own is doubted, whatever method, scene and conventions, and its formulas give every bit.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "tests/folder.hpp"
#include "tests/laws/agreement/n_gons.hpp"
#include "tests/sparse.hpp"
#include "tests/where.hpp"
#include "traces/check/check.hpp"
#include "traces/error.hpp"
#include "traces/record/trace_recorder.hpp"

namespace zstep {
namespace {

/// A run; `as_computed`: its header does not say in which numbers.
Trace recorded(const Method& method, const Scene& scene, const Conventions& conventions, bool as_computed) {
  Header header = header_for(method, conventions);
  if (as_computed) {
    header.undeclared |= std::uint8_t{1} << static_cast<unsigned>(Convention::number_format);
    header.conventions.number_format = {}, header.conventions.rounding = {};
  }
  TraceRecorder recorder(header, scene);
  method.record(scene, conventions, recorder);
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), scene.name);
}

/// False where the method cannot draw the scene so.
bool is_right(const Method& method, const Scene& scene, const Conventions& conventions, bool as_computed = false) {
  try {
    check_run(method, scene, conventions);
  } catch (const InputError&) {
    return false;
  }
  const Trace trace = recorded(method, scene, conventions, as_computed);
  const CheckReport report = check(trace);
  CAPTURE(method.id);
  CAPTURE(scene.name);
  CAPTURE(as_computed);
  CAPTURE(report.precision.text);
  std::string words;
  for_each_convention([&]<class E>(std::string_view key, E Conventions::*member) {
    words += fmt::format("{}={} ", key, word_of(conventions.*member));
  });
  for (const auto& [name, word] : conventions.options) words += fmt::format("{}={} ", name, word);
  words += fmt::format("cull={}", conventions.cull);
  CAPTURE(words);
  for (const Cause& cause : report.causes) {
    const StepInfo* step = find_step(trace.header().page, cause.first.line);
    FAIL_CHECK(step->name << " at step " << cause.first.step << ": " << cause.first.field << cause.first.impossible
                          << (cause.first.rule ? rule_text(*cause.first.rule).name : ""));
  }
  if (as_computed && conventions.number_format == NumberFormat::float64)
    CHECK(report.precision.text.find("fixed") == std::string::npos);
  // Formulas are evaluated in float64: what a run computes in other numbers they give but for rounding.
  // Where 1/z_v is added to, the trace has the reciprocal alone: the last digit may differ.
  const bool reciprocals = conventions.depth == Conventions::Depth::corrected && adds_slopes(conventions);
  if (conventions.number_format == NumberFormat::float64 && !reciprocals) CHECK(report.exact == report.numbers);
  return true;
}

TEST_CASE("law: check doubts no run of any method") {
  int runs = 0;
  for (const char* name : {"pyramid", "pyramid-behind", "cube", "torus", "teapot:2", "foley", "delhi", "cyclic"}) {
    for (const bool ortho : {false, true}) {
      ViewOptions view;
      view.width = 32, view.height = 24;
      if (ortho) view.orthographic = true;
      Scene scene;
      try {
        scene = look_at_scene(load_scene(name).scene, view);
      } catch (const InputError&) {
        continue;  // a scene in screen coordinates has no camera to choose
      }
      for (const Method& method : methods()) {
        for (int bits = 0; bits < 16; ++bits) {
          Conventions conventions;
          if (bits & 1) conventions.interpolation = Conventions::Interpolation::increments;
          if (bits & 2) conventions.coverage = Conventions::Coverage::inclusive;
          if (bits & 4) conventions.depth = Conventions::Depth::view;
          if (bits & 8) conventions.cull = false;
          runs += is_right(method, scene, conventions);
        }
      }
    }
  }
  CHECK(runs > 400);
  MESSAGE(runs, " runs");
}

/// One way to draw, of all those that the method has.
Conventions any_way(const Method& method, std::mt19937_64& random) {
  Conventions conventions;
  const auto one_of = [&](std::size_t count) { return random() % count; };
  conventions.cull = one_of(3) > 0;
  if (method.interpolates && one_of(2)) conventions.interpolation = Conventions::Interpolation::increments;
  if (method.interpolates && one_of(2)) conventions.coverage = Conventions::Coverage::inclusive;
  if (method.in_any_way)
    for_each_convention([&]<class E>(std::string_view key, E Conventions::*member) {
      if (key != "rounding") conventions.*member = static_cast<E>(one_of(words_of<E>.size()));
    });
  for (const Option& option : method.options) {
    if (one_of(2)) continue;
    std::vector<std::string> words;
    for (std::size_t at = 0; at <= option.words.size();) {
      const std::size_t end = std::min(option.words.find('|', at), option.words.size());
      words.emplace_back(option.words.substr(at, end - at));
      at = end + 1;
    }
    conventions.options[std::string(option.name)] =
        option.words.empty() ? std::to_string(option.least + static_cast<std::int64_t>(one_of(3)))
                             : words[one_of(words.size())];
  }
  return conventions;
}

TEST_CASE("check: a scan line's pair of polygons that touch along an edge, or in a vertex, lie apart") {
  ViewOptions view;
  view.width = 24, view.height = 20;
  Conventions conventions;
  conventions.cull = false, conventions.options["coherence"] = "on";
  const Scene scene = look_at_scene(load_scene("pyramid").scene, view);
  CHECK(is_right(method("scan-line"), scene, conventions));
}

TEST_CASE("law: check doubts no run with any options, on random meshes and all that are built in") {
  // Half-space has numbers of its own: the other methods' runs are those that they were before it was there.
  std::mt19937_64 random(200), of_half_space(201);
  int scenes = 0, runs = 0;
  const auto draw = [&](const Scene& scene) {
    ++scenes;
    for (const Method& method : methods())
      runs += is_right(method, scene, any_way(method, method.id == "half-space" ? of_half_space : random));
  };
  // N-gons that are bent, concave, thin, or pass through each other.
  for (const test::NGonKind& kind : test::n_gon_kinds())
    for (std::uint64_t seed = 1; seed <= 13; seed += test::sparse)
      for (const Scene& scene : test::two_views(kind.make(seed), seed)) draw(scene);
  for (const BuiltIn& built_in : built_in_scenes()) {
    ViewOptions view;
    view.width = 24, view.height = 20;
    draw(look_at_scene(load_scene(std::string(built_in.name)).scene, view));
  }
  MESSAGE(runs, " runs on ", scenes, " scenes");
  CHECK(scenes >= 200 / test::sparse);
  CHECK(runs >= 5 * scenes);
}

TEST_CASE(
    "law: check doubts no run of polygons that bend a little, are thin, or touch themselves once they are rounded") {
  using Depth = Conventions::Depth;
  using Interpolation = Conventions::Interpolation;
  using Coverage = Conventions::Coverage;
  using Positions = Conventions::Positions;
  struct Drawn {
    Depth depth;
    Interpolation interpolation;
    Coverage coverage;
    NumberFormat format;
    Positions positions;
  };
  constexpr Drawn ways[] = {
      {Depth::corrected, Interpolation::plane, Coverage::round, NumberFormat::float64, Positions::exact},
      {Depth::view, Interpolation::plane_increments, Coverage::top_left, NumberFormat::float32, Positions::integer},
      {Depth::reversed, Interpolation::plane, Coverage::round, NumberFormat::float32, Positions::integer},
      {Depth::foley, Interpolation::increments, Coverage::round, NumberFormat::float32, Positions::integer},
      {Depth::zero_to_one, Interpolation::direct, Coverage::inclusive, NumberFormat::float32, Positions::exact}};
  const Method& method = zstep::method("z-buffer");
  int runs = 0;
  for (const std::uint64_t seed : {1, 5, 9, 24, 25, 33, 49})
    for (const test::NGonKind& kind : test::n_gon_kinds())
      for (const Scene& scene : test::two_views(kind.make(seed), seed))
        for (const Drawn& way : ways) {
          Conventions conventions;
          conventions.cull = false, conventions.depth = way.depth, conventions.interpolation = way.interpolation;
          conventions.coverage = way.coverage, conventions.number_format = way.format;
          conventions.positions = way.positions;
          CAPTURE(seed);
          runs += is_right(method, scene, conventions);
        }
  CHECK(runs > 300);
  // An edge that faces hide to the middle and from there on: what is between them is less than can be drawn.
  for (const test::NGonKind& kind : test::n_gon_kinds())
    for (const Scene& scene : test::two_views(kind.make(46), 46)) {
      Conventions conventions;
      conventions.cull = false;
      CHECK(is_right(zstep::method("hidden-line"), scene, conventions));
    }
}

/// Meshes of every kind as files, and all that the tests and the lessons have.
std::vector<Scene> meshes_from_files() {
  namespace fs = std::filesystem;
  std::vector<std::string> files;
  const test::Folder folder;
  for (const test::NGonKind& kind : test::n_gon_kinds())
    for (std::uint64_t seed = 100; seed < 103; ++seed)
      files.push_back(folder.write(fmt::format("{} {}.off", kind.name, seed), kind.file(seed)));
  // By hand: a folder of other meshes.
  const char* more = std::getenv("ZSTEP_CHECK_MESHES");
  for (const std::string& of :
       {test::in_checkout("tests/data"), test::in_checkout("lessons/scenes"), std::string(more ? more : "")})
    if (!of.empty())
      for (const auto& entry : fs::recursive_directory_iterator(of))
        for (const char* ending : {".obj", ".off", ".ply", ".stl", ".toml"})
          if (entry.path().extension() == ending) files.push_back(entry.path().string());
  std::sort(files.begin(), files.end(), [](const std::string& one, const std::string& other) {  // wherever they are
    return fs::path(one).filename() < fs::path(other).filename();
  });
  std::vector<Scene> scenes;
  for (const std::string& file : files) {
    ViewOptions view;
    view.width = 24, view.height = 20;
    view.fit = !file.ends_with(".toml");
    try {
      scenes.push_back(look_at_scene(load_scene(file).scene, view));
    } catch (const InputError&) {
      CHECK(file.find("hostile") != std::string::npos);
    }
  }
  return scenes;
}

TEST_CASE("law: check doubts no run on meshes from files, in any numbers, however they are interpolated") {
  // By hand: every way, and not one in many.
  const bool all = std::getenv("ZSTEP_CHECK_ALL") != nullptr;
  std::mt19937_64 random(20);
  int runs = 0;
  const std::vector<Scene> scenes = meshes_from_files();
  CHECK(scenes.size() >= 48);
  for (const Scene& scene : scenes)
    for (const Method& method : methods()) {
      runs += is_right(method, scene, any_way(method, random));
      if (!method.in_any_way) continue;
      for (std::size_t number = 0; number < 2 * words_of<NumberFormat>.size(); ++number)
        for (std::size_t how = 0; how < words_of<Conventions::Interpolation>.size(); ++how)
          for (std::size_t coverage = 0; coverage < words_of<Conventions::Coverage>.size(); ++coverage) {
            const auto any = random();
            Conventions c;
            c.number_format = static_cast<NumberFormat>(number / 2);
            c.rounding = static_cast<Conventions::Rounding>(number % 2);
            c.interpolation = static_cast<Conventions::Interpolation>(how);
            c.coverage = static_cast<Conventions::Coverage>(coverage);
            if (!all && any % (8 * test::sparse) != 0) continue;
            for (std::size_t depth = 0; depth < words_of<Conventions::Depth>.size(); ++depth) {
              if (!all && depth != (any >> 8) % words_of<Conventions::Depth>.size()) continue;
              c.depth = static_cast<Conventions::Depth>(depth);
              c.positions = static_cast<Conventions::Positions>(any >> 16 & 1);
              runs += is_right(method, scene, c, (any >> 20) % 4 == 0);
            }
          }
    }
  MESSAGE(runs, " runs on ", scenes.size(), " meshes and scenes from files");
  CHECK(runs > static_cast<int>(scenes.size()) * 10);
}

TEST_CASE("check: a pixel that is missing in a tile rejected by its depths is not missed") {
  ViewOptions view;
  view.width = 320, view.height = 240;
  const Scene scene = look_at_scene(load_scene("teapot:8").scene, view);
  Conventions conventions;
  conventions.cull = false;
  for (const char* tiles : {"off", "8"}) {
    conventions.options = {{"hierarchical-z", "on"}, {"tiles", tiles}};
    CHECK(is_right(method("half-space"), scene, conventions));
  }
}

TEST_CASE("check: of corrected depths in fixed point, what edges have is cut to units of 1/z_v") {
  ViewOptions view;
  view.width = 24, view.height = 20;
  const Scene scene = look_at_scene(load_scene(test::in_checkout("lessons/scenes/long-floor.toml")).scene, view);
  Conventions conventions;
  conventions.depth = Conventions::Depth::corrected, conventions.number_format = NumberFormat::fixed18;
  conventions.rounding = Conventions::Rounding::down, conventions.positions = Conventions::Positions::integer;
  conventions.interpolation = Conventions::Interpolation::increments;
  CHECK(is_right(method("z-buffer"), scene, conventions));
}

TEST_CASE("check: where the header does not say in which numbers a run computes, the numbers do") {
  ViewOptions view;
  view.width = 32, view.height = 24;
  const Scene scene = look_at_scene(load_scene("pyramid-behind").scene, view);
  for (std::size_t k = 0; k < words_of<NumberFormat>.size(); ++k) {
    Conventions conventions;
    conventions.number_format = static_cast<NumberFormat>(k);
    const Trace trace = recorded(method("z-buffer"), scene, conventions, true);
    CHECK(check(trace).precision.text == fmt::format("{}, as the numbers look", words_of<NumberFormat>[k]));
  }
}

TEST_CASE("check: whole depths show no number format, and the report says so") {
  Scene scene;
  scene.camera.kind = Camera::Kind::screen, scene.raster = {8, 8, false};
  scene.points = {{0.25, 1, 3}, {7, 1, 3}, {5, 6.5, 3}};
  scene.corners = {0, 1, 2}, scene.polygons.resize(1), scene.facets = {{0, 0, 3}};
  CHECK(check(recorded(method("z-buffer"), scene, Conventions{}, true)).precision.text ==
        "float64, as nothing shows otherwise: all depths are whole numbers");
}

TEST_CASE("check: a program that counts 2^N units from 0 for the range of depths computes in fixed point, too") {
  const Scene scene = load_scene(test::in_checkout("lessons/scenes/ramp.toml")).scene;
  Conventions conventions;
  conventions.number_format = NumberFormat::fixed16;
  Header header = header_for(method("z-buffer"), Conventions{});
  header.undeclared |= std::uint8_t{1} << static_cast<unsigned>(Convention::number_format);
  Scene wider = scene;
  wider.point_lines.clear();
  wider.points.emplace_back(0, 0, 65536);  // of no polygon: the depths count ones, as they did
  TraceRecorder recorder(header, wider);
  method("z-buffer").record(scene, conventions, recorder);
  recorder.finish();
  CHECK(check(Trace::from_bytes(recorder.take_bytes(), "wider")).precision.text == "fixed16, as the numbers look");
}

TEST_CASE("check: short fractions, which fixed point has as well, do not make fixed point of float64") {
  for (const int parts : {5, 15, 17, 51, 255}) {  // all of them divide 2^16 - 1
    Scene scene;
    scene.camera.kind = Camera::Kind::screen, scene.raster = {64, 16, false};
    scene.points = {{0, 1, 0}, {parts, 1, 1}, {parts, 9, 1}, {0, 9, 0}};
    scene.corners = {0, 1, 2, 3}, scene.polygons.resize(1), scene.facets = {{0, 0, 4}};
    CAPTURE(parts);
    CHECK(check(recorded(method("z-buffer"), scene, Conventions{}, true)).precision.format == NumberFormat::float64);
  }
}

}  // namespace
}  // namespace zstep
