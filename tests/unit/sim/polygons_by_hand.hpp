// Whose polygon each event of a trace is about, by going through all of it once.
#pragma once

#include <cstdint>
#include <vector>

#include "traces/file/trace.hpp"

namespace zstep::test {

/// By position, from 1: the polygon that the event names by its number, its facet or its piece, or else the one at
/// work.
inline std::vector<std::int32_t> polygons_by_hand(const Trace& trace) {
  std::int64_t last_begin = 0;
  bool one_table = false;
  for (std::int64_t p = 1; p <= trace.size(); ++p)
    if (holds<PolygonBegin>(trace.event(p).event)) last_begin = p;
  std::vector<std::int32_t> all{no_polygon}, of_piece;
  std::int32_t at_work = no_polygon;
  bool drawn = false;
  for (std::int64_t p = 1; p <= trace.size(); ++p) {
    all.push_back(visit_event(
        [&]<class E>(const E& event) -> std::int32_t {
          if constexpr (std::is_same_v<E, TablesBegin>) one_table = true;
          if constexpr (std::is_same_v<E, PieceMake>) of_piece.push_back(event.polygon);
          if constexpr (std::is_same_v<E, PieceDraw>) drawn = true;
          if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, PieceDraw>) at_work = event.polygon;
          constexpr bool of_all =
              std::is_same_v<E, VertexSide> || std::is_same_v<E, SideTest> || std::is_same_v<E, RootCandidate> ||
              std::is_same_v<E, NodeMake> || std::is_same_v<E, ListInsert> || std::is_same_v<E, PairBegin> ||
              std::is_same_v<E, AreaBegin> || std::is_same_v<E, BoxMake> || std::is_same_v<E, GridMake> ||
              std::is_same_v<E, RayBegin> || std::is_same_v<E, CurveBegin> || std::is_same_v<E, LineBegin>;
          if (p > last_begin && !drawn && (of_all || (one_table && std::is_same_v<E, ScanLineBegin>)))
            at_work = no_polygon;
          if constexpr (requires { event.polygon; }) return event.polygon;
          else if constexpr (requires { event.facet; })
            return trace.scene().facets[static_cast<std::size_t>(event.facet)].polygon;
          else if constexpr (requires { event.piece; })
            return event.piece < 0 ? no_polygon : of_piece[static_cast<std::size_t>(event.piece)];
          else return at_work;
        },
        trace.event(p).event));
  }
  return all;
}

}  // namespace zstep::test
