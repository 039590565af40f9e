#include "algorithms/scan_conversion/active_edges.hpp"

#include <algorithm>

#include "traces/record/all_recorders.hpp"

namespace zstep::scan_conversion {

namespace {

Edge& edge_at(EdgeTable& table, std::int32_t number) { return table.edges[static_cast<std::size_t>(number)]; }

bool left_of(const Edge& one, const Edge& other) {
  return one.x != other.x ? one.x < other.x : one.dx_dy < other.dx_dy;
}

template <Recorder R>
void step_edges(const ActiveEdges& active, EdgeTable& table, std::int32_t y, bool direct, R& record) {
  for (const std::int32_t number : active.edges) {
    Edge& edge = edge_at(table, number);
    if (direct) {
      edge.x = edge.x_at(y);
      edge.z = edge.z_at(y);
    } else {
      edge.x += edge.dx_dy;
      edge.z += edge.dz_dy;
    }
    record(step::step_edge, EdgeStep{number, edge.x, edge.z});
  }
}

template <Recorder R>
void enter_edges(ActiveEdges& active, EdgeTable& table, std::int32_t y, R& record) {
  for (; active.waiting < table.buckets.size(); ++active.waiting) {
    const std::int32_t number = table.buckets[active.waiting];
    const Edge& edge = edge_at(table, number);
    if (edge.first_row != y) break;

    auto place = active.edges.begin();
    while (place != active.edges.end() && !left_of(edge, edge_at(table, *place))) ++place;
    record(step::enter_edge, EdgeEnter{number, static_cast<std::int32_t>(place - active.edges.begin())});
    active.edges.insert(place, number);
  }
}

template <Recorder R>
void retire_edges(ActiveEdges& active, EdgeTable& table, std::int32_t y, R& record) {
  auto kept = active.edges.begin();
  for (const std::int32_t number : active.edges) {
    if (edge_at(table, number).end_row == y) {
      record(step::retire_edge, EdgeRetire{number});
    } else {
      *kept++ = number;
    }
  }
  active.edges.erase(kept, active.edges.end());
}

// Insertion sort: from one scan line to the next few edges change places, and those that do are neighbours.
template <Recorder R>
void sort_edges(ActiveEdges& active, EdgeTable& table, R& record) {
  for (std::size_t i = 1; i < active.edges.size(); ++i) {
    for (std::size_t right = i; right > 0; --right) {
      std::int32_t &one = active.edges[right - 1], &other = active.edges[right];
      if (!left_of(edge_at(table, other), edge_at(table, one))) break;
      record(step::swap_edges, EdgeSwap{static_cast<std::int32_t>(right - 1)});
      std::swap(one, other);
    }
  }
}

}  // namespace

template <Recorder R>
void begin_scan_line(ActiveEdges& active, EdgeTable& table, std::int32_t y, bool direct, R& record) {
  record(step::scan_line, ScanLineBegin{y});
  step_edges(active, table, y, direct, record);
  enter_edges(active, table, y, record);
  retire_edges(active, table, y, record);
  sort_edges(active, table, record);
}

template <Recorder R>
void end_polygon(ActiveEdges& active, R& record) {
  for (const std::int32_t number : active.edges) {
    record(step::retire_edge, EdgeRetire{number});
  }
  active.clear();
}

#define INSTANTIATE(R)                                                                \
  template void begin_scan_line<R>(ActiveEdges&, EdgeTable&, std::int32_t, bool, R&); \
  template void end_polygon<R>(ActiveEdges&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)

}  // namespace zstep::scan_conversion
