#include "algorithms/transparency/transparency.hpp"

#include <vector>

#include "algorithms/bsp/build.hpp"
#include "algorithms/bsp/traverse.hpp"
#include "algorithms/scan_conversion/spans.hpp"
#include "algorithms/viewing/clip.hpp"
#include "traces/formulas/of_light.hpp"
#include "traces/math/whole.hpp"
#include "traces/record/all_recorders.hpp"
#include "traces/scene.hpp"

namespace zstep::transparency {

Color blended(Color over, double opacity, Color under) {
  const auto mix = [&](std::uint8_t top, std::uint8_t bottom) {
    return nearest_byte(formulas::laid_over<double>(opacity, top, bottom));
  };
  return {mix(over.red, under.red), mix(over.green, under.green), mix(over.blue, under.blue)};
}

namespace {

/// Who goes when: by number, the facets that the Z-buffer draws, in this order, and those that a tree sorts.
struct Turns {
  std::vector<std::int32_t> listed, sorted;
};
Turns turns_of(const Scene& scene, Order order) {
  const auto opaque = [&](std::int32_t facet) {
    const std::size_t polygon = scene.facets[facet].polygon;
    return scene.polygons[polygon].material->opacity >= 1;
  };
  Turns turns;
  std::vector<std::int32_t> transparent;
  for (std::int32_t facet = 0; facet < size32(scene.facets); ++facet)
    (order == Order::file || opaque(facet) ? turns.listed : transparent).push_back(facet);
  if (order == Order::back_to_front) turns.sorted = transparent;
  else turns.listed.insert(turns.listed.end(), transparent.begin(), transparent.end());
  return turns;
}

template <Recorder R>
void fill(const viewing::Vertices& vertices, const clipping::Outline& outline, std::int32_t number, const Scene& scene,
          Order order, Picture& picture, R& record) {
  const Polygon& polygon = scene.polygons[number];
  const double opacity = polygon.material->opacity;
  const bool hides = opacity >= 1 || order == Order::file;
  scan_conversion::for_each_span(number, outline, vertices, scene.raster, record, [&](const SpanBegin& span) {
    for (std::int32_t x = span.first, y = span.y; x <= span.last; ++x) {
      const double z = scan_conversion::depth_on(span, x);
      record(step::interpolate_z, {x, y, z});

      const std::size_t pixel = picture.at(x, y);
      const bool nearer = z < picture.depth[pixel];
      record(step::compare, {x, y, z, nearer});
      if (!nearer) continue;

      const Color color = blended(polygon.color, opacity, color_at(picture, scene, pixel));
      picture.ink[pixel] = ink_of(color);
      record(step::blend, ColorBlend{x, y, number, opacity, color.red, color.green, color.blue});
      if (!hides) continue;

      picture.depth[pixel] = z;
      record(step::write_depth, {x, y, z});

      picture.polygon[pixel] = number;
      record(step::write_pixel, {x, y, number});
    }
  });
}

}  // namespace

template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record) {
  const Order order = choice_of<Order>(options, conventions, "order");
  const bool cull = conventions.cull && scene.camera.kind != Camera::Kind::screen;
  const Turns turns = turns_of(scene, order);

  Picture picture(scene.raster.width, scene.raster.height);
  picture.use_ink();
  record(step::clear, BuffersClear{no_depth});

  const viewing::Lens lens(scene.camera, scene.raster, Conventions::Depth::pseudodepth);
  viewing::Vertices vertices = viewing::view_vertices(scene, lens, record);

  clipping::Outline outline;
  for (const std::int32_t number : turns.listed) {
    const Facet& facet = scene.facets[number];
    record(step::polygon, PolygonBegin{facet.polygon, number});
    vertices.resize(scene.points.size());  // without those that clipping made for the facet before
    const bool visible = clipping::find_outline(scene, facet, cull, lens, vertices, outline, record);
    if (visible) fill(vertices, outline, facet.polygon, scene, order, picture, record);
  }
  if (turns.sorted.empty()) return picture;

  const bsp::Tree tree = bsp::build(scene, turns.sorted, {}, record);
  vertices.resize(scene.points.size());
  viewing::view_points(scene.camera, tree.points, lens, vertices, record);

  const auto draw_piece = [&](std::int32_t number) {
    const bsp::Piece& piece = tree.piece(number);
    record(step::draw, PieceDraw{number, piece.polygon});
    outline = piece.outline;
    const bool visible = clipping::clip_outline(piece.polygon, scene.camera.kind, lens, vertices, outline, record);
    if (visible) fill(vertices, outline, piece.polygon, scene, order, picture, record);
  };
  const bsp::Eye eye = bsp::eye_of(scene.camera, scene.raster, true);
  bsp::visit_pieces(tree, eye, bsp::Order::back_to_front, cull, draw_piece, record);
  return picture;
}

#define INSTANTIATE(R) template Picture run<R>(const Scene&, const Conventions&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

}  // namespace zstep::transparency
