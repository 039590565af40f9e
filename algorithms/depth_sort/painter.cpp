
#include "algorithms/depth_sort/painter.hpp"

#include "algorithms/depth_sort/depth_sort.hpp"
#include "traces/record/all_recorders.hpp"
#include "traces/scene.hpp"

namespace zstep::painter {

template <Recorder R>
Picture run(const Scene& scene, const Conventions& conventions, R& record) {
  Picture picture(scene.raster.width, scene.raster.height);
  record(step::clear, BuffersClear{no_depth});

  const pieces::Pieces all = pieces::gather(scene, conventions, record);
  depth_sort::DrawingList list;
  for (std::int32_t piece = 0; piece < size32(all.pieces); ++piece) {
    const std::int32_t place = list.place_for(all, piece);
    list.insert(piece, place);
    record(step::insert, ListInsert{piece, place});
  }

  for (const std::int32_t piece : list.pieces) {
    const std::int32_t polygon = all[piece].polygon;
    record(step::draw, PieceDraw{piece, polygon});
    pieces::paint(all, all[piece].outline, polygon, scene, picture, record);
    record(step::drawn, ListRemove{piece});
  }
  return picture;
}

#define INSTANTIATE(R) template Picture run<R>(const Scene&, const Conventions&, R&);
ZSTEP_FOR_EACH_RECORDER(INSTANTIATE)
#undef INSTANTIATE

}  // namespace zstep::painter
