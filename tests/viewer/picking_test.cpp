// Vertices and edges of the scene: picked by the mouse where it is seen from outside and by keys, shown in every pane.
#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>

#include "sim/viewer/panes/happened.hpp"
#include "sim/viewer/panes/scene_in_space.hpp"
#include "sim/viewer/panes/scene_outside.hpp"
#include "sim/viewer/panes/viewing_steps.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/words/some_runs.hpp"

using namespace zstep;
using namespace zstep::viewer;

namespace {

/// In the middle of an edge.
Outside::Spot middle_of(const Outside& outside, const Room& room, const EdgeEnds& edge) {
  const auto ends = outside.line(room.polygons().points[static_cast<std::size_t>(edge.first)],
                                 room.polygons().points[static_cast<std::size_t>(edge.second)]);
  REQUIRE(ends);
  const Outside::Spot &a = (*ends)[0], &b = (*ends)[1];
  return {(a.x + b.x) / 2, (a.y + b.y) / 2, (a.depth + b.depth) / 2};
}

}  // namespace

TEST_CASE(
    "law: the mouse on a vertex picks it, on the middle of an edge the edge, and what is seen before what is not") {
  for (const char* scene : {"pyramid", "pyramid-behind"}) {
    CAPTURE(scene);
    const Trace trace = test::record_run(scene);
    App app(trace, nullptr, {}, 1280, 720);
    app.settle();
    const Room room(trace.scene());
    const Outside outside(room, {}, 900, 600);
    const Picture seen = polygons_seen(outside, room.polygons());
    const auto under = [&](double x, double y) {
      return part_under(app.ui(), outside, room, seen, {static_cast<float>(x), static_cast<float>(y)}, {0, 0});
    };
    int vertices = 0, edges = 0;
    std::set<std::int32_t> numbers;
    for (const EdgeEnds& edge : edges_of(trace.scene())) {
      numbers.insert({edge.first, edge.second});
      const Outside::Spot middle = middle_of(outside, room, edge);
      const ScenePart found = under(middle.x, middle.y);
      CHECK(found.any());
      edges += found.edge == edge;
    }
    for (const std::int32_t vertex : numbers) {
      const auto spot = outside.spot(room.polygons().points[static_cast<std::size_t>(vertex)]);
      REQUIRE(spot);
      vertices += under(spot->x, spot->y).vertex == vertex;
      CHECK(under(spot->x + 0.8 * static_cast<double>(app.ui().em), spot->y).any());
    }
    CHECK(vertices >= static_cast<int>(numbers.size()) - 2);  // a hidden one may lie behind an edge that is seen
    CHECK(edges >= static_cast<int>(numbers.size()) - 1);
    CHECK_FALSE(under(2, 2).any());
  }
}

TEST_CASE("an edge that is picked is lit in its polygons' edge tables, and a row that is lit in the scene") {
  const Trace trace = test::record_run("pyramid");
  Session s(trace, nullptr);
  const EdgeEnds edge = edges_of(trace.scene()).front();
  s.pick({{}, edge});
  CHECK(s.message.find("Edge ") == 0);
  int lit = 0;
  while (s.position() < s.size()) {
    s.move(Unit::event, 1);
    const auto& table = s.state().machine.edge_table;
    bool has = false;
    for (const EdgeTableInsert& entry : table) {
      const bool same = EdgeEnds(std::minmax(entry.vertex_0, entry.vertex_1)) == edge;
      has = has || same;
      if (same) CHECK(s.lit_edge() == entry.edge);
    }
    if (!has) CHECK_FALSE(s.lit_edge());
    lit += has;
    CHECK(s.lit_part() == ScenePart{{}, edge});
    if (lit > 200) break;
  }
  CHECK(lit > 10);
  s.pick({});
  s.hovered_edge = 0;
  REQUIRE(s.lit_part().edge);
  const EdgeTableInsert& first = s.state().machine.edge_table[0];
  CHECK(*s.lit_part().edge == EdgeEnds(std::minmax(first.vertex_0, first.vertex_1)));
}

TEST_CASE("keys go through vertices, and through edges where no table has any, what is picked is told and marked") {
  const Trace trace = test::record_run_by("bsp", "pyramid");
  App app(trace, nullptr, {}, 1280, 720);
  app.settle();
  const test::Bytes plain = test::picture(app);
  std::set<std::int32_t> found;
  for (std::size_t k = 0; k < trace.scene().points.size(); ++k) {
    test::press(app, SDLK_u, KMOD_LSHIFT);
    REQUIRE(app.session().picked_part.vertex);
    found.insert(*app.session().picked_part.vertex);
    CHECK(app.session().message.find("Vertex ") == 0);
    CHECK(vertices_shown(app.session()).front() == *app.session().picked_part.vertex);
  }
  CHECK(found.size() == trace.scene().points.size());
  CHECK(test::picture(app) != plain);
  test::press(app, SDLK_u, KMOD_LSHIFT);  // after the last one: none
  CHECK_FALSE(app.session().picked_part.any());
  test::press(app, SDLK_e);
  CHECK(app.session().picked_part.edge == edges_of(trace.scene()).front());
  test::press(app, SDLK_ESCAPE);
  CHECK_FALSE(app.session().picked_part.any());
  CHECK(test::picture(app) == plain);
}

TEST_CASE("a vertex or edge offers the steps that are about it, and the line of its file") {
  const Trace trace = test::record_run("pyramid");
  Session s(trace, nullptr);
  for (const ScenePart& part : {ScenePart{1, {}}, ScenePart{{}, edges_of(trace.scene()).front()}}) {
    s.go_to(0);
    const auto lines = lines_of_part(s, part);
    REQUIRE(!lines.empty());
    CHECK(lines[0].text == "On to the next step about " + name_of(s.scene(), part));
    lines[0].first(s);
    REQUIRE(s.event());
    CHECK(is_about(s.event()->event, part));
    const std::int64_t first = s.position();
    lines[0].first(s);
    const bool once = s.position() == first;
    CHECK(once == (s.message.find("No later step is about") == 0));
    if (!once) lines[1].first(s);
    CHECK(s.position() == first);
    lines[1].first(s);
    CHECK(s.position() == first);
    CHECK(s.message.find("No earlier step is about") == 0);
    CHECK(s.picked_part == part);
    const bool has_line =
        std::any_of(lines.begin(), lines.end(), [](const HereLine& line) { return line.text.find("Copy where") == 0; });
    CHECK(has_line == !place_in_file(s.scene(), part).empty());
  }
}
