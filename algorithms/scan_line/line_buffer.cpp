#include "algorithms/scan_line/line_buffer.hpp"

#include <algorithm>

#include "algorithms/scan_conversion/spans.hpp"
#include "traces/record/all_recorders.hpp"

namespace zstep::scan_line {

namespace {

template <Recorder R>
void fill_span(const scan_conversion::Span& span, std::int32_t polygon, bool direct, std::vector<double>& line,
               Picture& picture, R& record) {
  double z = 0;
  for (std::int32_t x = span.first, y = span.y; x <= span.last; ++x) {
    z = direct || x == span.first ? scan_conversion::depth_on(span, x) : z + span.dz_dx;
    record(step::interpolate_z, DepthInterpolate{x, y, z});

    double& stored = line[static_cast<std::size_t>(x)];
    const bool is_nearer = z < stored;
    record(step::compare, DepthCompare{x, y, z, is_nearer});
    if (!is_nearer) continue;

    stored = z;
    picture.depth[picture.at(x, y)] = z;
    record(step::write_depth, DepthWrite{x, y, z});

    picture.polygon[picture.at(x, y)] = polygon;
    record(step::write_pixel, PixelWrite{x, y, polygon});
  }
}

}  // namespace

template <Recorder R>
void draw_line(const Tables& tables, const std::vector<std::int32_t>& active, std::int32_t y, const Raster& raster,
               const Conventions& conventions, std::vector<double>& line, Picture& picture, R& record) {
  const bool direct = conventions.interpolation == Conventions::Interpolation::direct;
  std::fill(line.begin(), line.end(), no_depth);

  std::vector<std::int32_t> edges = active;  // those of one polygon side by side, from left to right
  std::stable_sort(edges.begin(), edges.end(),
                   [&](std::int32_t one, std::int32_t other) { return tables.owner_of(one) < tables.owner_of(other); });
  for (std::size_t i = 0; i + 1 < edges.size(); i += 2) {  // an even number each: inside between each pair
    const std::int32_t polygon = tables.polygons[tables.owner_of(edges[i])].polygon;
    const auto span =
        scan_conversion::begin_span(tables.edges, edges[i], edges[i + 1], y, raster, conventions.coverage, record);
    fill_span(span, polygon, direct, line, picture, record);
  }
}

#define INSTANTIATE(R)                                                                                     \
  template void draw_line<R>(const Tables&, const std::vector<std::int32_t>&, std::int32_t, const Raster&, \
                             const Conventions&, std::vector<double>&, Picture&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

}  // namespace zstep::scan_line
