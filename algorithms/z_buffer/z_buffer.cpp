
#include "algorithms/z_buffer/z_buffer.hpp"

#include "algorithms/scan_conversion/spans.hpp"
#include "algorithms/viewing/clip.hpp"
#include "traces/record/all_recorders.hpp"

namespace zstep::z_buffer {

namespace {

using clipping::find_outline;
using scan_conversion::begin_scan_line;
using scan_conversion::begin_span;
using scan_conversion::build_edge_table;
using scan_conversion::depth_on;
using scan_conversion::end_polygon;
using scan_conversion::Span;

template <Recorder R>
void fill_span(const Span& span, std::int32_t polygon, bool direct, Picture& picture, R& record) {
  const std::size_t row = picture.at(0, span.y);
  double z = 0;
  for (std::int32_t x = span.first, y = span.y; x <= span.last; ++x) {
    z = direct || x == span.first ? depth_on(span, x) : z + span.dz_dx;  // 000, "Speeding up the Algorithm"
    record(step::interpolate_z, DepthInterpolate{x, y, z});

    const std::size_t pixel = row + static_cast<std::size_t>(x);
    const bool nearer = z < picture.depth[pixel];
    record(step::compare, DepthCompare{x, y, z, nearer});
    if (!nearer) continue;

    picture.depth[pixel] = z;
    record(step::write_depth, DepthWrite{x, y, z});

    picture.polygon[pixel] = polygon;
    record(step::write_pixel, PixelWrite{x, y, polygon});
  }
}

}  // namespace

template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record) {
  const Raster& raster = scene.raster;
  const bool direct = conventions.interpolation == Conventions::Interpolation::direct;

  Picture picture(raster.width, raster.height);
  record(step::clear, BuffersClear{no_depth});

  const viewing::Lens lens(scene.camera, raster, conventions.depth);
  viewing::Vertices vertices = viewing::view_vertices(scene, lens, record);

  clipping::Outline outline;
  scan_conversion::EdgeTable edges;
  scan_conversion::ActiveEdges active;
  std::int32_t number = 0;
  for (const Facet& facet : scene.facets) {
    const std::int32_t polygon = facet.polygon;
    record(step::polygon, PolygonBegin{polygon, number});
    ++number;

    vertices.resize(scene.points.size());  // without those that clipping made for the facet before
    const bool visible = find_outline(scene, facet, conventions.cull, lens, vertices, outline, record);
    if (!visible) continue;

    build_edge_table(edges, polygon, outline, vertices, raster, conventions.coverage, record);
    for (std::int32_t y = edges.first_row; y < edges.end_row; ++y) {
      begin_scan_line(active, edges, y, direct, record);

      for (std::size_t i = 0; i + 1 < active.edges.size(); i += 2) {  // even-odd: inside between each pair
        const std::int32_t left = active.edges[i], right = active.edges[i + 1];
        const Span span = begin_span(edges, left, right, y, raster, conventions.coverage, record);
        fill_span(span, polygon, direct, picture, record);
      }
    }
    end_polygon(active, record);
  }
  return picture;
}

#define INSTANTIATE(R) template Picture run<R>(const Scene&, const Conventions&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

}  // namespace zstep::z_buffer
