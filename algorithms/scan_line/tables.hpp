// What the scan-line method keeps of all polygons at once.
#pragma once

#include <vector>

#include "algorithms/pieces/pieces.hpp"
#include "algorithms/scan_conversion/active_edges.hpp"

namespace zstep::scan_line {

struct Tables {
  pieces::Pieces polygons;           ///< the polygon table: a piece is a polygon as far as it is in view
  scan_conversion::EdgeTable edges;  ///< the global edge table
  std::vector<std::int32_t> owner;   ///< of each edge, by number: the row of the polygon table

  std::int32_t owner_of(std::int32_t edge) const { return owner[static_cast<std::size_t>(edge)]; }
  double x_of(std::int32_t edge) const { return edges.edges[static_cast<std::size_t>(edge)].x; }
};

/// Fills the edge table and its owners from the polygon table.
template <Recorder R>
void fill_edge_table(Tables& tables, const viewing::Vertices& vertices, const Raster& raster,
                     Conventions::Coverage coverage, R& record) {
  for (std::size_t piece = 0; piece < tables.polygons.pieces.size(); ++piece) {
    const pieces::Piece& row = tables.polygons.pieces[piece];
    scan_conversion::add_edges(tables.edges, row.polygon, row.outline, vertices, raster, coverage, record);
    tables.owner.resize(tables.edges.edges.size(), static_cast<std::int32_t>(piece));
  }
  fill_buckets(tables.edges);
}

}  // namespace zstep::scan_line
