#include "traces/file/records.hpp"
#include "traces/replay/beginning.hpp"

#include <algorithm>
#include <vector>

namespace zstep {

namespace {

void begin(Picture& picture, std::int32_t width, std::int32_t height, double depth) {
  const auto size = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  picture.width = width, picture.height = height;
  picture.polygon.assign(size, no_polygon);
  picture.depth.assign(size, depth);
}

/// A run that could record writes of depths, and has none, either does not print them or does not write them. It does
/// not where its compares would be right against a buffer that is never written, and only against that one.
bool forgets_depths(const Trace& trace) {
  const Header& header = trace.header();
  if (!records<DepthWrite>(header) || !trace.has(kind_of<PixelWrite>)) return false;
  const Raster& raster = trace.scene().raster;
  double empty = header.empty_depth();
  std::vector<double> written(static_cast<std::size_t>(raster.width) * static_cast<std::size_t>(raster.height), empty);
  bool right_if_forgotten = true, right_if_written = true;
  trace.each(0, trace.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    if (const auto* clear = get_if<BuffersClear>(&recorded.event)) {
      empty = clear->z;
      std::fill(written.begin(), written.end(), empty);
    }
    const auto* compare = get_if<DepthCompare>(&recorded.event);
    if (!compare) return true;
    const auto pixel = static_cast<std::size_t>(compare->y) * static_cast<std::size_t>(raster.width) +
                       static_cast<std::size_t>(compare->x);
    const auto fits = [&](double stored) {
      const bool open = compare->z == stored && !header.declares(Convention::ties);
      return open || compare->nearer == header.comparison.wins(compare->z, stored);
    };
    right_if_forgotten = right_if_forgotten && fits(empty);
    right_if_written = right_if_written && fits(written[pixel]);
    if (compare->nearer) written[pixel] = compare->z;
    return right_if_forgotten;
  });
  return right_if_forgotten && !right_if_written;
}

}  // namespace

Beginning::Beginning(const Trace& trace) : scene_(&trace.scene()), empty_depth_(trace.header().empty_depth()) {
  const Header& header = trace.header();
  colors_ = records<ColorWrite>(header) || records<ColorBlend>(header);
  light_ = records<PassBegin>(header);
  compares_write_ = trace.has(kind_of<DepthCompare>) && !trace.has(kind_of<DepthWrite>) &&
                    !records<ColorBlend>(header) && !forgets_depths(trace);
  edges_told_ = trace.has(kind_of<EdgeTableInsert>);
  // Glass is drawn after what is opaque, and only then a table is made of all.
  tables_not_told_ = records<TablesBegin>(header) && !trace.has(kind_of<TablesBegin>) && !records<ColorBlend>(header);
  enters_told_ = edges_told_ && trace.has(kind_of<EdgeEnter>);
  const bool begin = trace.has(kind_of<PolygonBegin>), draw = trace.has(kind_of<PieceDraw>);
  const bool all_begin = begin || !records<PolygonBegin>(header), all_drawn = draw || !records<PieceDraw>(header);
  polygons_told_ = (begin || draw) && (!draw || trace.has(kind_of<PieceMake>)) && all_begin && all_drawn;
  rays_told_ = trace.has(kind_of<RayBegin>);
}

State Beginning::state() const {
  State state;
  state.machine = machine();
  begin_pictures(state);
  begin_vertices(state);
  return state;
}

MethodState Beginning::machine() const {
  MethodState machine;
  machine.compares_write = compares_write_;
  machine.edges_told = edges_told_;
  machine.keeps_all = tables_not_told_;
  machine.enters_told = enters_told_;
  machine.polygons_told = polygons_told_;
  machine.rays_told = rays_told_;
  return machine;
}

void Beginning::begin_pictures(State& state) const {
  const Raster& raster = scene_->raster;
  begin(state.picture, raster.width, raster.height, empty_depth_);
  if (colors_) state.picture.use_ink();
  if (light_) begin(state.light, raster.width, raster.height, empty_depth_);
}

void Beginning::begin_vertices(State& state) const {
  const std::size_t points = scene_->points.size();
  state.vertices = {};
  state.vertices.resize(points);
  if (scene_->camera.kind != Camera::Kind::screen) return;
  for (std::size_t i = 0; i < points; ++i) {
    const glm::dvec3& point = scene_->points[i];
    VertexStages& way = state.vertices.edit(i);
    way.stage = VertexStages::on_raster;
    way.plane = point;
    way.raster = {point.x, point.y};
  }
}

}  // namespace zstep
