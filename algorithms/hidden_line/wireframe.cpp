
#include "algorithms/hidden_line/wireframe.hpp"

#include "algorithms/hidden_line/lines.hpp"
#include "traces/record/all_recorders.hpp"

namespace zstep::wireframe {

namespace {

enum class Edges : std::uint8_t { all, front };

}  // namespace

template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record) {
  const bool front_only = choice_of<Edges>(options, conventions, "edges") == Edges::front;
  Picture picture(scene.raster.width, scene.raster.height);
  picture.use_ink();
  record(step::clear, BuffersClear{no_depth});

  const viewing::Lens lens(scene.camera, scene.raster, Conventions::Depth::pseudodepth);
  viewing::Vertices vertices = viewing::view_vertices(scene, lens, record);
  std::int32_t number = 0;
  for (lines::Edge edge : lines::find_edges(scene, vertices)) {
    if (!lines::bring_into_view(edge, scene, lens, vertices, record)) continue;
    const LineBegin begin{number, edge.vertex_0, edge.vertex_1, edge.left_facet, edge.right_facet, edge.kind};
    record(lines::step::edge, begin);
    if (front_only && edge.kind == LineKind::back) {
      record(step::back, LinePiece{number, 0, 1, false});
    } else {
      record(step::whole, LinePiece{number, 0, 1, true});
      const auto corner = [&](std::int32_t vertex) { return vertices[vertex].raster; };
      const lines::Line line{corner(edge.vertex_0), corner(edge.vertex_1)};
      lines::draw(line, 0, 1, lines::visible_ink(scene), false, picture, record);
    }
    ++number;
  }
  return picture;
}

#define INSTANTIATE(R) template Picture run<R>(const Scene&, const Conventions&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

}  // namespace zstep::wireframe
