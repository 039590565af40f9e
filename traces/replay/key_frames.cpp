#include "traces/replay/key_frames.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "traces/file/header.hpp"
#include "traces/replay/same.hpp"

namespace zstep {

namespace {

/// Foretells bits of depths, and inks: where two before lead. Doubles of like size are as far apart as their bits are.
class Line {
 public:
  std::uint64_t guess() const { return 2 * last_ - before_; }
  void learn(std::uint64_t bits) { before_ = last_, last_ = bits; }

 private:
  std::uint64_t last_ = 0, before_ = 0;
};

std::uint64_t bits_of_depth(double depth) { return std::bit_cast<std::uint64_t>(depth); }
std::uint64_t zigzag_of(std::uint64_t difference) { return (difference << 1) ^ (0 - (difference >> 63)); }
std::uint64_t undo_zigzag(std::uint64_t zigzag) { return (zigzag >> 1) ^ (0 - (zigzag & 1)); }

/// A varint from memory that this file itself has written: nobody else's, so its end is not asked for.
std::uint64_t next_varint(const std::uint8_t*& at) {
  std::uint64_t value = *at & 0x7fu;
  for (unsigned shift = 7; (*at++ & 0x80u) != 0; shift += 7) value |= std::uint64_t{*at & 0x7fu} << shift;
  return value;
}

}  // namespace

PictureChange::PictureChange(const Picture* before, const Picture& after, double empty_depth) {
  const std::size_t size = after.depth.size();
  const bool inked = !after.ink.empty();
  const auto changed = [&](std::size_t pixel) {
    const double depth = before != nullptr ? before->depth[pixel] : empty_depth;
    const std::int32_t polygon = before != nullptr ? before->polygon[pixel] : no_polygon;
    const std::uint32_t ink = !inked ? 0u : before != nullptr ? before->ink[pixel] : no_ink;
    return bits_of_depth(depth) != bits_of_depth(after.depth[pixel]) || polygon != after.polygon[pixel] ||
           (inked && ink != after.ink[pixel]);
  };
  constexpr std::size_t many = 64;
  const auto same = [&](const auto& one, const auto& other, std::size_t first) {
    return std::memcmp(&one[first], &other[first], many * sizeof one[first]) == 0;
  };
  const auto many_unchanged = [&](std::size_t first) {
    return before != nullptr && size - first >= many && same(before->depth, after.depth, first) &&
           same(before->polygon, after.polygon, first) && (!inked || same(before->ink, after.ink, first));
  };
  Line depths, inks;
  std::int32_t last_polygon = no_polygon;
  for (std::size_t pixel = 0, told = 0; pixel < size;) {
    if (pixel % many == 0 && many_unchanged(pixel)) {
      pixel += many;
      continue;
    }
    if (!changed(pixel)) {
      ++pixel;
      continue;
    }
    std::size_t end = pixel + 1;
    while (end < size && after.polygon[end] == after.polygon[pixel] && changed(end)) ++end;
    put_varint(bytes_, end - pixel);
    put_varint(bytes_, pixel - told);
    put_varint(bytes_, zigzag_of(static_cast<std::uint64_t>(std::int64_t{after.polygon[pixel]} - last_polygon)));
    last_polygon = after.polygon[pixel];
    for (; pixel < end; ++pixel) {
      const std::uint64_t bits = bits_of_depth(after.depth[pixel]);
      put_varint(bytes_, zigzag_of(bits - depths.guess()));
      depths.learn(bits);
      if (!inked) continue;
      put_varint(bytes_, zigzag_of(after.ink[pixel] - inks.guess()));
      inks.learn(after.ink[pixel]);
    }
    told = end;
  }
  put_varint(bytes_, 0);
  bytes_.shrink_to_fit();
}

void PictureChange::apply_to(Picture& picture) const {
  if (bytes_.empty()) return;
  const bool inked = !picture.ink.empty();
  Line depths, inks;
  std::int64_t polygon = no_polygon;
  std::size_t pixel = 0;
  const std::uint8_t* at = bytes_.data();
  while (const auto count = static_cast<std::size_t>(next_varint(at))) {
    pixel += static_cast<std::size_t>(next_varint(at));
    polygon += static_cast<std::int64_t>(undo_zigzag(next_varint(at)));
    for (const std::size_t end = pixel + count; pixel < end; ++pixel) {
      const std::uint64_t bits = depths.guess() + undo_zigzag(next_varint(at));
      depths.learn(bits);
      picture.depth[pixel] = std::bit_cast<double>(bits);
      picture.polygon[pixel] = static_cast<std::int32_t>(polygon);
      if (!inked) continue;
      const std::uint64_t ink = inks.guess() + undo_zigzag(next_varint(at));
      inks.learn(ink);
      picture.ink[pixel] = static_cast<std::uint32_t>(ink);
    }
  }
}

namespace {

void begin(Picture& picture, std::int32_t width, std::int32_t height, double depth) {
  const std::size_t size = pixel_count(width, height);
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
  std::vector<double> written(pixel_count(raster.width, raster.height), empty);
  bool right_if_forgotten = true, right_if_written = true;
  trace.each(0, trace.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    if (const auto* clear = get_if<BuffersClear>(&recorded.event)) {
      empty = clear->z;
      std::fill(written.begin(), written.end(), empty);
    }
    visit_event(
        [&]<class E>(const E& e) {
          if constexpr (has(at_pixel<E>, AtPixel::verdict)) {
            double& here = written[pixel_at(e.x, e.y, raster.width)];
            const auto fits = [&](double stored) {
              const bool open = e.z == stored && !header.declares(Convention::ties);
              return open || e.nearer == header.comparison.wins(e.z, stored);
            };
            right_if_forgotten = right_if_forgotten && fits(empty);
            right_if_written = right_if_written && fits(here);
            if (e.nearer) here = e.z;
          }
        },
        recorded.event);
    return right_if_forgotten;
  });
  return right_if_forgotten && !right_if_written;
}

}  // namespace

Beginning::Beginning(const Trace& trace) : scene_(&trace.scene()), empty_depth_(trace.header().empty_depth()) {
  const Header& header = trace.header();
  colors_ = records<ColorWrite>(header) || records<ColorBlend>(header);
  light_ = records<PassBegin>(header);
  samples_a_pixel_ = size32(formulas::samples_of(header.conventions));
  compares_write_ = trace.has(AtPixel::verdict) && !trace.has(kind_of<DepthWrite>) && !records<ColorBlend>(header) &&
                    !forgets_depths(trace);
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
  machine.width = scene_->raster.width;
  machine.samples_a_pixel = samples_a_pixel_;
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

namespace {

bool same_way(const VertexStages& one, const VertexStages& other) { return same(one, other); }

}  // namespace

KeyFrames::KeyFrames(const Beginning& beginning, std::int64_t end, std::int64_t spacing, std::size_t budget)
    : beginning_(&beginning), end_(end), spacing_(spacing), next_due_(spacing), budget_(budget) {
  if (next_due() <= end_) beginning_->begin_pictures(last_);
}

void KeyFrames::set_pictures(Frame& frame, std::size_t n, const State& before, const State& now) const {
  const bool whole = n % group == 0;
  frame.picture = PictureChange(whole ? nullptr : &before.picture, now.picture, beginning_->empty_depth());
  frame.light = PictureChange(whole ? nullptr : &before.light, now.light, beginning_->empty_depth());
}

void KeyFrames::add(const State& state) {
  Frame frame;
  frame.position = state.position;
  frame.machine = state.machine;
  frame.vertices = state.vertices;
  if (!frames_.empty()) {
    const SharedChunks<VertexStages>& before = frames_.back().vertices;
    frame.vertices.share(before, same_way);  // where the state was stepped to anew
    bytes_ += frames_.back().bytes_beyond(frame);
  }
  set_pictures(frame, frames_.size(), last_, state);
  bytes_ += frame.bytes();
  if (frames_.size() % group == 0) {
    last_.picture = state.picture, last_.light = state.light;
  } else {
    frame.picture.apply_to(last_.picture);
    frame.light.apply_to(last_.light);
  }
  frames_.push_back(std::move(frame));
  if (bytes_ > budget_ && frames_.size() > 2) thin_out();
  next_due_ = state.position + spacing_;
  if (next_due_ > end_) last_ = State();
}

std::size_t KeyFrames::Frame::bytes_beyond(const Frame& later) const {
  return heap_beyond(machine, later.machine) + heap_beyond(vertices, later.vertices);
}

std::size_t KeyFrames::count_before(std::int64_t position) const {
  const auto after = std::upper_bound(frames_.begin(), frames_.end(), position,
                                      [](std::int64_t wanted, const Frame& frame) { return wanted < frame.position; });
  return after - frames_.begin();
}

std::int64_t KeyFrames::before(std::int64_t position) const {
  const std::size_t count = count_before(position);
  return count == 0 ? 0 : frames_[count - 1].position;
}

void KeyFrames::restore_before(std::int64_t position, State& state) {
  const std::size_t count = count_before(position);
  beginning_->begin_pictures(state);
  for (std::size_t i = count == 0 ? 0 : (count - 1) / group * group; i < count; ++i) {
    frames_[i].picture.apply_to(state.picture);
    frames_[i].light.apply_to(state.light);
  }
  if (count == 0) {
    state.position = 0;
    state.machine = beginning_->machine();
    beginning_->begin_vertices(state);
    return;
  }
  const Frame& frame = frames_[count - 1];
  state.position = frame.position;
  state.machine = frame.machine;
  state.vertices = frame.vertices;
}

void KeyFrames::thin_out() {
  State before, now;
  std::vector<Frame> kept;
  bytes_ = 0;
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    Frame& frame = frames_[i];
    if (i % group == 0) beginning_->begin_pictures(now);
    frame.picture.apply_to(now.picture);
    frame.light.apply_to(now.light);
    if (i % 2 == 0 && i + 1 < frames_.size()) continue;
    set_pictures(frame, kept.size(), before, now);
    if (!kept.empty()) bytes_ += kept.back().bytes_beyond(frame);
    bytes_ += frame.bytes();
    before.picture = now.picture, before.light = now.light;
    kept.push_back(std::move(frame));
  }
  frames_ = std::move(kept);
  spacing_ *= 2;
}

}  // namespace zstep
