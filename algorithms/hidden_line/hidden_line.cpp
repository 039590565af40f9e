
#include "algorithms/hidden_line/hidden_line.hpp"

#include "algorithms/hidden_line/cover.hpp"
#include "algorithms/pieces/pieces.hpp"
#include "traces/record/all_recorders.hpp"

namespace zstep::hidden_line {

namespace {

using lines::Edge;
using lines::Line;

enum class Hidden : std::uint8_t { none, dashed };

// Holds one edge against one face that is not its own.
template <Recorder R>
Cover hold(std::int32_t number, const Line& line, const pieces::Pieces& faces, const pieces::Piece& face, R& record) {
  const std::vector<glm::dvec3> corners = faces.corners(face.outline);
  Cover cover = find_cover(line, corners, face.plane);
  const Step<LineAgainst> outcome = cover.outcome == LineFace::in_front ? step::in_front
                                    : cover.outcome == LineFace::behind ? step::beside
                                                                        : step::covered;
  record(outcome, LineAgainst{number, face.facet, cover.outcome});
  for (const Crossing& crossing : cover.crossings) {
    const glm::dvec3 at = line.from + crossing.t * (line.to - line.from);
    const Step<LineCross> kind = crossing.in_space ? step::plane_cross : step::edge_cross;
    record(kind, LineCross{number, face.facet, crossing.t, at.x, at.y, crossing.in_space});
  }
  for (const Interval& interval : cover.hidden) {
    record(step::hide, LineHide{number, face.facet, interval.t_0, interval.t_1});
  }
  return cover;
}

// The intervals of an edge that faces hide.
template <Recorder R>
std::vector<Interval> find_hidden(std::int32_t number, const Edge& edge, const Line& line, const pieces::Pieces& faces,
                                  Grid& grid, R& record) {
  const std::vector<std::int32_t> near = grid.near(line);
  const auto apart = static_cast<std::int32_t>(faces.pieces.size() - near.size());
  if (apart > 0) {
    record(step::apart, Saved{Coherence::extent, apart});
  }
  std::vector<Interval> hidden;
  for (const std::int32_t piece : near) {
    const pieces::Piece& face = faces[piece];
    if (face.facet == edge.left_facet || face.facet == edge.right_facet) {
      record(step::own, LineAgainst{number, face.facet, LineFace::own});
      continue;
    }
    const Cover cover = hold(number, line, faces, face, record);
    hidden.insert(hidden.end(), cover.hidden.begin(), cover.hidden.end());
  }
  return hidden;
}

}  // namespace

template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record) {
  const bool dashed = choice_of<Hidden>(options, conventions, "hidden") == Hidden::dashed;
  const Color visible_ink = lines::visible_ink(scene), hidden_ink = lines::hidden_ink(scene);
  Picture picture(scene.raster.width, scene.raster.height);
  picture.use_ink();
  record(step::clear, BuffersClear{no_depth});

  const viewing::Lens lens(scene.camera, scene.raster, Conventions::Depth::pseudodepth);
  pieces::Pieces faces = pieces::gather(scene, conventions, record);
  Grid grid(faces, scene.raster);
  std::int32_t number = 0;
  for (Edge edge : lines::find_edges(scene, faces.vertices)) {
    if (!lines::bring_into_view(edge, scene, lens, faces.vertices, record)) continue;
    const LineBegin begin{number, edge.vertex_0, edge.vertex_1, edge.left_facet, edge.right_facet, edge.kind};
    record(lines::step::edge, begin);
    const Line line{faces.corner(edge.vertex_0), faces.corner(edge.vertex_1)};

    if (edge.kind == LineKind::back && conventions.cull) {
      record(step::back, LinePiece{number, 0, 1, false});
      if (dashed) lines::draw(line, 0, 1, hidden_ink, true, picture, record);
    } else {
      for (const Part& part : cut(find_hidden(number, edge, line, faces, grid, record), line.length())) {
        const Step<LinePiece> seen = part.visible ? step::visible : step::hidden;
        record(seen, LinePiece{number, part.t_0, part.t_1, part.visible});
        if (part.visible) lines::draw(line, part.t_0, part.t_1, visible_ink, false, picture, record);
        else if (dashed) lines::draw(line, part.t_0, part.t_1, hidden_ink, true, picture, record);
      }
    }
    ++number;
  }
  return picture;
}

#define INSTANTIATE(R) template Picture run<R>(const Scene&, const Conventions&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

}  // namespace zstep::hidden_line
