// The law of replay, on a run long enough to cross check-points, undo windows, blocks and key frames: a state is the
// same however it was reached. (tests/golden holds every step of the small traces to it.)
#include <doctest/doctest.h>

#include <algorithm>
#include <random>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/viewing/camera.hpp"
#include "traces/error.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

/// Triangles at random, some of them behind the eye, beside the window or edge-on.
Scene soup(std::int32_t triangles, std::int32_t side, unsigned seed) {
  Scene scene;
  scene.name = "soup";
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> at(-1.5, 1.5);
  for (std::int32_t i = 0; i < triangles; ++i) {
    const glm::dvec3 centre(at(random), at(random), at(random));
    scene.polygons.push_back({"", {static_cast<std::uint8_t>(random() % 256), 100, 100}, 0});
    scene.facets.push_back({i, 3 * i, 3});
    for (int corner = 0; corner < 3; ++corner) {
      scene.points.push_back(centre + 0.4 * glm::dvec3(at(random), at(random), at(random)));
      scene.corners.push_back(3 * i + corner);
    }
  }
  scene.camera.rho = 1.8;
  scene.camera.view = viewing::eckert_view(1.8, 30, 60);
  scene.camera.eye = viewing::eckert_eye(1.8, 30, 60);
  scene.camera.near = 0.1;
  scene.camera.far = 6;
  scene.raster = {side, side, false};
  return scene;
}

Trace recorded(const Scene& scene, const Conventions& conventions, Picture& picture) {
  const Method& z_buffer = method("z-buffer");
  TraceRecorder recorder(header_for(z_buffer, conventions), scene);
  picture = z_buffer.record(scene, conventions, recorder);
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), "soup");
}

}  // namespace

TEST_CASE("replay: every step of a small run is the same forwards and backwards") {
  Picture picture;
  Conventions conventions;
  conventions.cull = false;
  const Trace trace = recorded(soup(6, 12, 1), conventions, picture);
  std::vector<State> forwards;
  Replay replay(trace);
  forwards.push_back(replay.state());
  while (replay.position() < trace.size()) {
    replay.step_forward();
    forwards.push_back(replay.state());
  }
  CHECK(replay.state().picture == picture);
  while (replay.position() > 0) {
    replay.step_back();
    REQUIRE(replay.state() == forwards[static_cast<std::size_t>(replay.position())]);
  }
  // Marks set so close that this short run crosses them all: every step is sought, from far above and far below.
  Replay tuned(trace, {40, 8, 24, 100});
  for (std::int64_t position = 0; position <= trace.size(); ++position) {
    tuned.go_to(position % 2 == 0 ? trace.size() - position / 3 : position / 3);
    tuned.go_to(position);
    REQUIRE(tuned.state() == forwards[static_cast<std::size_t>(position)]);
  }
}

TEST_CASE("replay: a seek from any key frame to just behind it, with many groups of frames between") {
  Picture picture;
  Conventions conventions;
  conventions.cull = false;
  const Trace trace = recorded(soup(60, 48, 3), conventions, picture);
  REQUIRE(trace.size() > 40 * 100);  // a frame every 100 steps, sixteen to a group
  Replay tuned(trace, {40, 8, 24, 100}), plain(trace);
  tuned.go_to(trace.size());  // leaves the frames
  for (std::int64_t frame = 100; frame < trace.size(); frame += 100) {
    for (const std::int64_t position : {frame - 1, frame, frame + 1, frame + 60}) {
      if (position > trace.size()) break;
      CAPTURE(position);
      tuned.go_to(position < trace.size() / 2 ? trace.size() : 0);  // far off, so that it is sought and not stepped to
      tuned.go_to(position);
      plain.go_to(position);
      REQUIRE(tuned.state() == plain.state());
    }
  }
}

TEST_CASE("replay: a long way that is ended ends at a whole state, from which one can go on") {
  Picture picture;
  const Trace trace = recorded(soup(1500, 96, 2), {}, picture);
  Replay plain(trace);
  for (const double enough : {0.0, 0.3, 0.7, 2.0}) {
    CAPTURE(enough);
    Replay replay(trace);
    double last = -1;
    replay.go_to(trace.size(), [&](double share) {
      CHECK(share >= 0);
      CHECK(share < 1);
      CHECK(share > last);
      last = share;
      return share >= enough;
    });
    CHECK((replay.position() < trace.size()) == (enough < 1));
    CHECK((replay.position() == 0) == (enough == 0));
    plain.go_to(replay.position());
    CHECK(replay.state() == plain.state());
    replay.go_to(trace.size());
    CHECK(replay.state().picture == picture);
  }
}

TEST_CASE("replay: a long run, sought and stepped at random, agrees with a plain run ahead") {
  Picture picture;
  Conventions conventions;
  conventions.cull = false;
  SUBCASE("direct") {}
  SUBCASE("increments") { conventions.interpolation = Conventions::Interpolation::increments; }
  const Trace trace = recorded(soup(1500, 96, 2), conventions, picture);
  REQUIRE(trace.size() > 400000);  // several blocks, windows and key frames
  Replay wanderer(trace);
  wanderer.go_to(trace.size());
  CHECK(wanderer.state().picture == picture);
  std::mt19937 random(9);
  std::vector<std::int64_t> places;
  for (int i = 0; i < 40; ++i)
    places.push_back(static_cast<std::int64_t>(random() % static_cast<unsigned>(trace.size())));
  std::sort(places.begin(), places.end());
  std::vector<State> plain;
  {
    Replay ahead(trace);
    for (const std::int64_t place : places) {
      ahead.go_to(place);
      plain.push_back(ahead.state());
    }
  }
  for (int i = 0; i < 60; ++i) {
    const std::size_t which = random() % places.size();
    switch (random() % 3) {
      case 0:
        wanderer.go_to(places[which] + 1 + static_cast<std::int64_t>(random() % 3000));
        break;  // arrive from above
      case 1:
        wanderer.go_to(places[which] - 1 - static_cast<std::int64_t>(random() % 3000));
        break;  // or from below
      default:
        break;  // or from anywhere
    }
    wanderer.go_to(places[which]);
    REQUIRE(wanderer.state() == plain[which]);
  }
  // A long way back, step by step, past everything that can be undone.
  wanderer.go_to(places.back());
  for (int i = 0; i < 60000 && wanderer.position() > 0; ++i) wanderer.step_back();
  Replay fresh(trace);
  fresh.go_to(wanderer.position());
  CHECK(fresh.state() == wanderer.state());
}

TEST_CASE("replay: recording changes no bit of the picture") {
  for (const bool increments : {false, true}) {
    Conventions conventions;
    conventions.cull = false;
    if (increments) conventions.interpolation = Conventions::Interpolation::increments;
    const Scene scene = soup(200, 64, 5);
    Picture picture;
    const Trace trace = recorded(scene, conventions, picture);
    NullRecorder none;
    CHECK(method("z-buffer").render(scene, conventions, none) == picture);
    CountRecorder counts;
    CHECK(method("z-buffer").count(scene, conventions, counts) == picture);
    std::int64_t counted = 0;
    for (const std::int64_t count : counts.count) counted += count;
    CHECK(counted == trace.size());
  }
}

TEST_CASE("replay: a step that cannot be is refused, and the state before it stands") {
  Picture picture;
  const Trace good = recorded(soup(3, 8, 4), Conventions{}, picture);
  TraceRecorder recorder(good.header(), good.scene());
  recorder(Step<PolygonBegin>{65}, PolygonBegin{0, 0});
  recorder(Step<EdgeTableInsert>{24}, EdgeTableInsert{0, 0, 0, 1, 0, 5, 0, 0, 0, 0});
  recorder(Step<EdgeEnter>{28}, EdgeEnter{0, 0});
  recorder(Step<EdgeRetire>{29}, EdgeRetire{7});
  recorder.finish();
  const Trace bad = Trace::from_bytes(recorder.take_bytes(), "bad.ztrace");
  Replay replay(bad);
  CHECK_THROWS_WITH_AS(replay.go_to(4),
                       "bad.ztrace: step 4 cannot be: edge 7 is not in the active edge list; correct the program that "
                       "wrote the trace, or open it at an earlier step",
                       InputError);
  CHECK(replay.position() == 3);
  CHECK(replay.state().machine.polygon == 0);
}
