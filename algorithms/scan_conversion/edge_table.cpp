
#include "algorithms/scan_conversion/edge_table.hpp"

#include <algorithm>

#include "algorithms/scan_conversion/numbers.hpp"
#include "traces/formulas/coverage.hpp"
#include "traces/record/all_recorders.hpp"
#include "traces/scene.hpp"

namespace zstep::scan_conversion {

namespace {

using Outline = std::span<const std::int32_t>;

// The nearest neighbour of outline[i] in the given direction that is not on the same height.
double height_beside(Outline outline, const viewing::Vertices& vertices, std::size_t i, std::size_t direction) {
  const auto y_of = [&](std::size_t n) { return vertices[outline[n]].raster.y; };
  std::size_t n = i;
  do n = (n + direction) % outline.size();
  while (n != i && y_of(n) == y_of(i));
  return y_of(n);
}

bool local_maximum(Outline outline, const viewing::Vertices& vertices, std::size_t i) {
  const double y = vertices[outline[i]].raster.y;
  return height_beside(outline, vertices, i, 1) < y && height_beside(outline, vertices, i, outline.size() - 1) < y;
}

}  // namespace

template <class T, Recorder R>
void add_edges(EdgeTableOf<T>& table, std::int32_t polygon, Outline outline, const viewing::Vertices& vertices,
               const Raster& raster, Conventions::Coverage coverage, R& record) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    std::size_t from = i, to = i + 1 < outline.size() ? i + 1 : 0;
    const auto point = [&](std::size_t n) { return vertices[outline[n]].raster; };
    if (point(from).y > point(to).y) std::swap(from, to);

    const glm::dvec3 start = point(from), end = point(to);
    const NumbersOf<T>& numbers = table.numbers;
    EdgeOf<T> edge{outline[from],
                   outline[to],
                   numbers.position(start.x),
                   numbers.position(start.y),
                   numbers.depth(start.z),
                   numbers.position(end.x),
                   numbers.position(end.y),
                   numbers.depth(end.z),
                   0,
                   0,
                   T(0),
                   T(0),
                   T(0),
                   T(0),
                   from == i ? 1 : -1};
    const double y_0 = edge.y_0, y_1 = edge.y_1;
    edge.first_row = formulas::row_from(y_0, raster.height);
    edge.end_row = formulas::row_from(y_1, raster.height);
    const bool horizontal = y_0 == y_1;
    const bool ends_on_row = edge.end_row == y_1 && edge.end_row < raster.height;
    if (coverage == Conventions::Coverage::inclusive && !horizontal && ends_on_row &&
        local_maximum(outline, vertices, to)) {
      ++edge.end_row;
    }
    if (horizontal || edge.first_row >= edge.end_row) {
      const EdgeSkip why = horizontal ? EdgeSkip::horizontal : EdgeSkip::between_rows;
      record(step::skip_edge, EdgeTableSkip{outline[i], outline[i + 1 < outline.size() ? i + 1 : 0], why});
      continue;
    }

    edge.x = edge.x_at(edge.first_row);
    edge.z = edge.z_at(edge.first_row);
    edge.dx_dy = formulas::slope(edge.x_0, edge.x_1, edge.y_0, edge.y_1);
    edge.dz_dy = formulas::slope(edge.z_0, edge.z_1, edge.y_0, edge.y_1);
    const auto number = size32(table.edges);
    const EdgeTableInsert row{number,       polygon, edge.vertex_0, edge.vertex_1, edge.first_row,
                              edge.end_row, edge.x,  edge.dx_dy,    edge.z,        edge.dz_dy};
    record(step::insert_edge, row);

    const bool first = table.edges.empty();
    table.first_row = first ? edge.first_row : std::min(table.first_row, edge.first_row);
    table.end_row = first ? edge.end_row : std::max(table.end_row, edge.end_row);
    table.edges.push_back(edge);
  }
}

template <class T>
void fill_buckets(EdgeTableOf<T>& table) {
  table.buckets.resize(table.edges.size());
  for (std::size_t i = 0; i < table.buckets.size(); ++i) table.buckets[i] = index32(i);
  const auto row = [&](std::int32_t number) { return table.edges[number].first_row; };
  std::sort(table.buckets.begin(), table.buckets.end(), [&](std::int32_t one, std::int32_t other) {
    return row(one) != row(other) ? row(one) < row(other) : one < other;
  });
}

template <class T, Recorder R>
void build_edge_table(EdgeTableOf<T>& table, std::int32_t polygon, Outline outline, const viewing::Vertices& vertices,
                      const Raster& raster, Conventions::Coverage coverage, R& record) {
  table.edges.clear();
  table.first_row = table.end_row = 0;
  add_edges(table, polygon, outline, vertices, raster, coverage, record);
  fill_buckets(table);
}

#define INSTANTIATE(R, T)                                                                                        \
  template void add_edges<T, R>(EdgeTableOf<T>&, std::int32_t, Outline, const viewing::Vertices&, const Raster&, \
                                Conventions::Coverage, R&);                                                      \
  template void build_edge_table<T, R>(EdgeTableOf<T>&, std::int32_t, Outline, const viewing::Vertices&,         \
                                       const Raster&, Conventions::Coverage, R&);
ZSTEP_FOR_EACH_NUMBER(INSTANTIATE)
#undef INSTANTIATE
template void fill_buckets<double>(EdgeTable&);

}  // namespace zstep::scan_conversion
