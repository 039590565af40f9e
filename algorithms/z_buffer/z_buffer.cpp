#include "algorithms/z_buffer/z_buffer.hpp"

#include "algorithms/scan_conversion/spans.hpp"
#include "algorithms/viewing/clip.hpp"
#include "traces/record/all_recorders.hpp"

namespace zstep::z_buffer {

namespace {

using scan_conversion::Span;

template <Recorder R>
void fill_span(const Span& span, std::int32_t polygon, Conventions::Interpolation interpolation, Picture& picture,
               R& record) {
  const bool direct = interpolation == Conventions::Interpolation::direct;
  double z = 0;
  for (std::int32_t x = span.first, y = span.y; x <= span.last; ++x) {
    z = direct || x == span.first ? scan_conversion::depth_on(span, x) : z + span.dz_dx;
    record(step::interpolate_z, DepthInterpolate{x, y, z});

    double& depth = picture.depth[picture.at(x, y)];
    const bool nearer = z < depth;
    record(step::compare, DepthCompare{x, y, z, nearer});
    if (!nearer) continue;

    depth = z;
    record(step::write_depth, DepthWrite{x, y, z});

    picture.polygon[picture.at(x, y)] = polygon;
    record(step::write_pixel, PixelWrite{x, y, polygon});
  }
}

}  // namespace

template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record) {
  Picture picture(scene.raster.width, scene.raster.height);
  record(step::clear, BuffersClear{no_depth});

  const viewing::Lens lens(scene.camera, scene.raster, conventions.depth);
  viewing::Vertices vertices = viewing::view_vertices(scene, lens, record);

  clipping::Outline outline;
  scan_conversion::EdgeTable edges;
  scan_conversion::ActiveEdges active;
  std::int32_t number = 0;
  for (const Facet& facet : scene.facets) {
    record(step::polygon, PolygonBegin{facet.polygon, number});
    ++number;
    if (!clipping::find_outline(scene, facet, conventions, lens, vertices, outline, record)) continue;

    scan_conversion::build_edge_table(edges, facet.polygon, outline, vertices, scene.raster, conventions.coverage,
                                      record);
    for (std::int32_t y = edges.first_row; y < edges.end_row; ++y) {
      scan_conversion::begin_scan_line(active, edges, y, conventions.interpolation, record);

      for (std::size_t i = 0; i + 1 < active.edges.size(); i += 2) {
        const std::int32_t left = active.edges[i], right = active.edges[i + 1];
        const Span span =
            scan_conversion::begin_span(edges, left, right, y, scene.raster, conventions.coverage, record);
        fill_span(span, facet.polygon, conventions.interpolation, picture, record);
      }
    }
    scan_conversion::end_polygon(active, record);
  }
  return picture;
}

#define INSTANTIATE(R) template Picture run<R>(const Scene&, const Conventions&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)

}  // namespace zstep::z_buffer
