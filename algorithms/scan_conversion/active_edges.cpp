#include "algorithms/scan_conversion/active_edges.hpp"

#include <algorithm>

#include "algorithms/scan_conversion/numbers.hpp"
#include "traces/record/all_recorders.hpp"

namespace zstep::scan_conversion {

namespace {

template <class T>
EdgeOf<T>& edge_at(EdgeTableOf<T>& table, std::int32_t number) {
  return table.edges[number];
}

template <class T>
bool left_of(const EdgeOf<T>& one, const EdgeOf<T>& other) {
  const double x = one.x, x_other = other.x, slope = one.dx_dy, slope_other = other.dx_dy;
  return x != x_other ? x < x_other : slope < slope_other;
}

template <class T, Recorder R>
void step_edges(const ActiveEdges& active, EdgeTableOf<T>& table, std::int32_t y, bool direct, R& record) {
  for (const std::int32_t number : active.edges) {
    EdgeOf<T>& edge = edge_at(table, number);
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

template <class T, Recorder R>
void enter_edges(ActiveEdges& active, EdgeTableOf<T>& table, std::int32_t y, R& record) {
  for (; active.waiting < table.buckets.size(); ++active.waiting) {
    const std::int32_t number = table.buckets[active.waiting];
    const EdgeOf<T>& edge = edge_at(table, number);
    if (edge.first_row != y) break;

    auto place = active.edges.begin();
    while (place != active.edges.end() && !left_of(edge, edge_at(table, *place))) ++place;
    record(step::enter_edge, EdgeEnter{number, static_cast<std::int32_t>(place - active.edges.begin())});
    active.edges.insert(place, number);
  }
}

template <class T, Recorder R>
void retire_edges(ActiveEdges& active, EdgeTableOf<T>& table, std::int32_t y, R& record) {
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
template <class T, Recorder R>
void sort_edges(ActiveEdges& active, EdgeTableOf<T>& table, R& record) {
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

template <class T, Recorder R>
void begin_scan_line(ActiveEdges& active, EdgeTableOf<T>& table, std::int32_t y, bool direct, R& record) {
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

#define INSTANTIATE(R, T) template void begin_scan_line<T, R>(ActiveEdges&, EdgeTableOf<T>&, std::int32_t, bool, R&);
ZSTEP_FOR_EACH_NUMBER(INSTANTIATE)
#define INSTANTIATE_END(R) template void end_polygon<R>(ActiveEdges&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE_END)
#undef INSTANTIATE
#undef INSTANTIATE_END

}  // namespace zstep::scan_conversion
