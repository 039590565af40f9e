#include "algorithms/bsp/bsp.hpp"

#include "algorithms/pieces/pieces.hpp"
#include "algorithms/scan_conversion/spans.hpp"
#include "traces/record/all_recorders.hpp"

namespace zstep::bsp {

namespace {

// Front to back: what is painted already is nearer and stays.
template <Recorder R>
void fill_gaps(const viewing::Vertices& vertices, const clipping::Outline& outline, std::int32_t polygon,
               const Raster& raster, Picture& picture, R& record) {
  scan_conversion::for_each_span(polygon, outline, vertices, raster, record, [&](const SpanBegin& span) {
    std::int32_t taken = 0;
    for (std::int32_t x = span.first, y = span.y; x <= span.last; ++x) {
      const std::size_t pixel = picture.at(x, y);
      if (picture.polygon[pixel] != no_polygon) {
        ++taken;
        continue;
      }
      const double z = scan_conversion::depth_on(span, x);
      picture.polygon[pixel] = polygon;
      picture.depth[pixel] = z;
      record(painting::step::paint, PixelPaint{x, y, z, polygon});
    }
    if (taken > 0) {
      record(step::taken, Saved{Coherence::order, taken});
    }
  });
}

}  // namespace

BuildOptions build_options(const Conventions& conventions) {
  return {choice_of<Root>(options, conventions, "root"), whole_number(options, conventions, "candidates"),
          static_cast<std::uint64_t>(whole_number(options, conventions, "seed"))};
}

template <Recorder R>
Picture draw(const Tree& tree, const Scene& scene, const Conventions& conventions, R& record) {
  const Camera& camera = scene.camera;
  const bool cull = conventions.cull && camera.kind != Camera::Kind::screen;
  const Order order = choice_of<Order>(options, conventions, "order");
  const Eye eye = eye_of(camera, scene.raster, is_on(options, conventions, "discard"));

  Picture picture(scene.raster.width, scene.raster.height);
  record(step::clear, BuffersClear{no_depth});

  const viewing::Lens lens(camera, scene.raster, Conventions::Depth::pseudodepth);
  viewing::Vertices vertices;
  viewing::view_points(camera, tree.points, lens, vertices, record);

  const auto draw_piece = [&](std::int32_t number) {
    const Piece& piece = tree.piece(number);
    record(step::draw, PieceDraw{number, piece.polygon});
    clipping::Outline outline = piece.outline;
    if (!clipping::clip_outline(piece.polygon, camera.kind, lens, vertices, outline, record)) return;
    if (order == Order::back_to_front) pieces::paint(vertices, outline, piece.polygon, scene.raster, picture, record);
    else fill_gaps(vertices, outline, piece.polygon, scene.raster, picture, record);
  };
  visit_pieces(tree, eye, order, cull, draw_piece, record);
  return picture;
}

template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record) {
  const Tree tree = build(scene, build_options(conventions), record);
  return draw(tree, scene, conventions, record);
}

#define INSTANTIATE(R)                                                         \
  template Picture draw<R>(const Tree&, const Scene&, const Conventions&, R&); \
  template Picture run<R>(const Scene&, const Conventions&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

}  // namespace zstep::bsp
