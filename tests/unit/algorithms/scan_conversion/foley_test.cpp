// The polygon of Foley, van Dam, Feiner and Hughes, section 3.6: its edge table and its active edge tables as printed.
#include <doctest/doctest.h>

#include <map>
#include <utility>
#include <vector>

#include "algorithms/z_buffer/z_buffer.hpp"
#include "tests/unit/algorithms/scenes.hpp"
#include "traces/record/recorder.hpp"

using namespace zstep;

namespace {

enum : std::int32_t { A, B, C, D, E, F };

CollectRecorder fill_foleys_polygon(Conventions::Interpolation interpolation) {
  const Scene scene =
      test::screen_scene(16, 16, {{{2, 3, 0}, {7, 1, 0}, {13, 5, 0}, {13, 11, 0}, {7, 7, 0}, {2, 9, 0}}});
  Conventions conventions;
  conventions.interpolation = interpolation;
  CollectRecorder record;
  z_buffer::run(scene, conventions, record);
  return record;
}

struct Row {
  std::int32_t vertex_0, vertex_1;  // the edge's name
  std::int32_t y_max;
  double x, dx_dy;
  bool operator==(const Row&) const = default;
};

// What the book calls the active edge table on a scan line: after edges moved and entered, before those that end leave.
std::map<std::int32_t, std::vector<Row>> active_edge_tables(const CollectRecorder& record) {
  std::map<std::int32_t, std::vector<Row>> tables;
  std::vector<EdgeTableInsert> edges;
  std::vector<std::int32_t> active;
  std::map<std::int32_t, double> x;
  std::int32_t y = -1;
  bool read = true;

  const auto read_table = [&] {
    if (read) return;
    for (const std::int32_t number : active) {
      const EdgeTableInsert& edge = edges.at(static_cast<std::size_t>(number));
      tables[y].push_back({edge.vertex_0, edge.vertex_1, edge.end_row, x.at(number), edge.dx_dy});
    }
    read = true;
  };
  for (const CollectedEvent& collected : record.events) {
    const Event& event = collected.event;
    if (const auto* insert = get_if<EdgeTableInsert>(&event)) {
      edges.push_back(*insert);
      x[insert->edge] = insert->x_edge;
    } else if (const auto* line = get_if<ScanLineBegin>(&event)) {
      y = line->y;
      read = false;
    } else if (const auto* step = get_if<EdgeStep>(&event)) {
      x[step->edge] = step->x_edge;
    } else if (const auto* enter = get_if<EdgeEnter>(&event)) {
      active.insert(active.begin() + enter->place, enter->edge);
    } else if (const auto* retire = get_if<EdgeRetire>(&event)) {
      read_table();
      std::erase(active, retire->edge);
    } else if (const auto* swap = get_if<EdgeSwap>(&event)) {
      const auto place = static_cast<std::size_t>(swap->place);
      read_table();
      std::swap(active.at(place), active.at(place + 1));
    } else if (holds<SpanBegin>(event)) {
      read_table();
    }
  }
  CHECK(active.empty());  // at the end all edges have left
  return tables;
}

}  // namespace

TEST_SUITE("scan_conversion/foley") {
  TEST_CASE("the edge table, bucket by bucket") {
    const CollectRecorder record = fill_foleys_polygon(Conventions::Interpolation::direct);
    std::map<std::int32_t, std::vector<Row>> buckets;
    for (const EdgeTableInsert& edge : record.all<EdgeTableInsert>()) {
      buckets[edge.first_row].push_back({edge.vertex_0, edge.vertex_1, edge.end_row, edge.x_edge, edge.dx_dy});
    }
    const std::map<std::int32_t, std::vector<Row>> printed{
        {1, {{B, A, 3, 7, -5.0 / 2}, {B, C, 5, 7, 6.0 / 4}}},
        {3, {{A, F, 9, 2, 0}}},
        {5, {{C, D, 11, 13, 0}}},
        {7, {{E, D, 11, 7, 6.0 / 4}, {E, F, 9, 7, -5.0 / 2}}},
    };
    CHECK(buckets == printed);
    CHECK(record.all<EdgeTableSkip>().empty());
  }

  TEST_CASE("the active edge tables") {
    for (const auto interpolation : {Conventions::Interpolation::direct, Conventions::Interpolation::increments}) {
      const auto tables = active_edge_tables(fill_foleys_polygon(interpolation));
      REQUIRE(tables.size() == 10);  // scan lines 1 … 10
      CHECK(tables.at(1) == std::vector<Row>{{B, A, 3, 7, -5.0 / 2}, {B, C, 5, 7, 6.0 / 4}});
      // Printed for scan lines 9 and 10.
      CHECK(tables.at(9) ==
            std::vector<Row>{{A, F, 9, 2, 0}, {E, F, 9, 2, -5.0 / 2}, {E, D, 11, 10, 6.0 / 4}, {C, D, 11, 13, 0}});
      CHECK(tables.at(10) == std::vector<Row>{{E, D, 11, 11.5, 6.0 / 4}, {C, D, 11, 13, 0}});
    }
  }

  TEST_CASE("spans: two on the scan lines where the polygon is concave") {
    const CollectRecorder record = fill_foleys_polygon(Conventions::Interpolation::direct);
    std::vector<std::vector<std::pair<std::int32_t, std::int32_t>>> spans(16);
    for (const SpanBegin& span : record.all<SpanBegin>()) {
      spans.at(static_cast<std::size_t>(span.y)).push_back({span.first, span.last});
    }
    CHECK(spans[0].empty());
    CHECK(spans[1] == std::vector<std::pair<std::int32_t, std::int32_t>>{{7, 6}});  // a point: no pixel
    CHECK(spans[5] == std::vector<std::pair<std::int32_t, std::int32_t>>{{2, 12}});
    CHECK(spans[8] == std::vector<std::pair<std::int32_t, std::int32_t>>{{2, 4}, {9, 12}});
    CHECK(spans[9] == std::vector<std::pair<std::int32_t, std::int32_t>>{{10, 12}});
    CHECK(spans[11].empty());
  }
}
