#include "traces/file/trace.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "traces/error.hpp"
#include "traces/file/check_events.hpp"
#include "traces/file/visit.hpp"
#include "traces/outcome.hpp"

namespace zstep {

namespace {

constexpr std::size_t packed_kept = 8, events_kept = 2;
// What a block can unpack to: every field of every event missed, and some.
constexpr std::uint64_t block_limit = std::uint64_t{block_events} * 128;

}  // namespace

Trace::Trace(Trace&&) noexcept = default;
Trace& Trace::operator=(Trace&&) noexcept = default;
Trace::~Trace() = default;

const Header& Trace::header() const { return impl_->header; }
const Scene& Trace::scene() const { return impl_->scene; }
const std::string& Trace::name() const { return impl_->name; }
std::int64_t Trace::size() const { return impl_->size; }
bool Trace::whole() const { return impl_->whole; }
const std::vector<std::string>& Trace::warnings() const { return impl_->warnings; }
std::span<const PolygonMark> Trace::polygons() const { return impl_->polygons; }

std::span<const RejectMark> Trace::rejects() const {
  if (!impl_->rejects) {
    std::vector<RejectMark> found;
    scan(Among({}, kind_of<PolygonReject>), [&](std::int64_t position, const RecordedEvent& recorded) {
      const auto& event = get<PolygonReject>(recorded.event);
      found.push_back({position, event.polygon, event.reason});
      return true;
    });
    impl_->rejects = std::move(found);
  }
  return *impl_->rejects;
}

std::span<const std::int64_t> Trace::clears() const {
  if (!impl_->clears) {
    std::vector<std::int64_t> found;
    scan(Among({}, kind_of<BuffersClear>), [&](std::int64_t position, const RecordedEvent&) {
      found.push_back(position);
      return true;
    });
    impl_->clears = std::move(found);
  }
  return *impl_->clears;
}

bool Trace::has(std::uint8_t kind) const {
  return std::any_of(impl_->header.page.begin(), impl_->header.page.end(),
                     [&](const StepInfo& step) { return step.kind == kind && impl_->steps.has(step.id); });
}

std::size_t Trace::Impl::block_of(std::int64_t position) const {
  const auto after =
      std::upper_bound(blocks.begin(), blocks.end(), position - 1,
                       [](std::int64_t before, const Block& block) { return before < block.info.first_position; });
  return static_cast<std::size_t>(after - blocks.begin()) - 1;
}

void Trace::Impl::damaged(std::size_t block, const std::string& what) const {
  const BlockInfo& info = blocks[block].info;
  throw InputError(
      name,
      fmt::format("is damaged in steps {} to {}: {}", info.first_position + 1, info.first_position + info.count, what),
      mend_trace);
}

namespace {

struct DeniedEvents : MalformedBytes {
  DeniedEvents() : MalformedBytes("what a block says of itself is not what is in it") {}
};

/// Holds events against the scene, a run by its first and its last pixel, and gathers what an info says of them.
struct CheckBlock {
  EventCheck check;
  std::int64_t position;
  BlockInfo seen;

  template <class E>
  bool operator()(std::uint8_t step, const E& event) {
    ++position;
    sound(check(event));
    seen.steps.add(step);
    if constexpr (requires { event.x, event.y, event.polygon; }) seen.name(event.polygon);
    if constexpr (requires { event.x, event.y; })
      seen.touch(static_cast<std::int32_t>(event.x), static_cast<std::int32_t>(event.x) + 1, event.y);
    else if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, PieceDraw>)
      seen.marks.push_back({static_cast<std::uint32_t>(position - 1 - seen.first_position), event.polygon, {}});
    return true;
  }
  bool operator()(const codec::FragmentRun& run) {
    position += run.events();
    for (std::size_t i = 0; i < (run.nearer != 0 ? 4u : 2u); ++i) seen.steps.add(run.steps[i]);
    seen.touch(run.x, run.end(), run.y);
    if (run.nearer != 0) seen.name(run.polygon);
    return sound(check(PixelWrite{run.x, run.y, run.nearer != 0 ? run.polygon : 0})) &&
           sound(check(PixelWrite{run.end() - 1, run.y, 0}));
  }
  bool operator()(const codec::PaintRun& run) {
    position += run.events();
    seen.steps.add(run.step);
    seen.touch(run.x, run.end(), run.y);
    seen.name(run.polygon);
    return sound(check(PixelWrite{run.x, run.y, run.polygon})) &&
           sound(check(PixelWrite{run.end() - 1, run.y, run.polygon}));
  }
  bool sound(const std::string& fault) const {
    if (!fault.empty()) throw MalformedBytes(fmt::format("step {}: {}", position, fault));
    return true;
  }
};

}  // namespace

void Trace::Impl::check(std::size_t block, const Bytes& packed) const {
  const BlockInfo& info = blocks[block].info;
  BlockDecoder decoder(packed, info.count, *meanings, *facts);
  CheckBlock checking{EventCheck(scene), info.first_position, {}};
  checking.seen.first_position = info.first_position;
  checking.seen.tiles = Tiles(scene.raster);
  decoder.visit_all(checking);
  // An info may say of more than there is, which costs time; of less, and what it denies would not be found.
  const BlockInfo& seen = checking.seen;
  const std::size_t first = blocks[block].first_mark,
                    end = block + 1 < blocks.size() ? blocks[block + 1].first_mark : polygons.size();
  bool true_info = seen.steps.within(info.steps) && seen.tiles.within(info.tiles) && seen.lead.within(info.lead) &&
                   seen.marks.size() == end - first && (seen.keeps_to_marks || !info.keeps_to_marks);
  for (std::size_t i = 0; true_info && i < seen.marks.size(); ++i)
    true_info = info.first_position + seen.marks[i].offset + 1 == polygons[first + i].position &&
                seen.marks[i].polygon == polygons[first + i].polygon && seen.marks[i].box.within(boxes[first + i]);
  if (!true_info) throw DeniedEvents();
}

void Trace::Impl::refuse_lies() const {
  for (std::size_t block = 0; block < blocks.size(); ++block) {
    try {
      if (blocks[block].lost) continue;
      const Bytes bytes = read_chunk(*source, blocks[block].place);
      const std::uint64_t frame = std::min<std::uint64_t>(blocks[block].frame_offset, bytes.size());
      check(block, decompress(std::span(bytes).subspan(static_cast<std::size_t>(frame)), block_limit));
      blocks[block].checked = true;
    } catch (const DeniedEvents&) {
      throw;
    } catch (const MalformedBytes&) {  // it is lost once somebody asks for it
    }
  }
}

void Trace::Impl::lose(std::size_t block, const std::string& what) const {
  const BlockInfo& info = blocks[block].info;
  if (!on_loss) damaged(block, what);
  blocks[block].lost = any_lost = true;
  on_loss(fmt::format("{}: steps {} to {} are lost: {}", name, info.first_position + 1,
                      info.first_position + info.count, what));
}

const Bytes* Trace::Impl::packed(std::size_t block) const {
  if (blocks[block].lost && on_loss) return nullptr;
  for (auto it = packed_at_hand.begin(); it != packed_at_hand.end(); ++it) {
    if (it->first != block) continue;
    packed_at_hand.splice(packed_at_hand.begin(), packed_at_hand, it);
    return &it->second;
  }
  const Block& place = blocks[block];
  try {
    if (place.lost) throw MalformedBytes("it is not there");
    const Bytes bytes = read_chunk(*source, place.place);
    if (place.frame_offset > bytes.size()) throw MalformedBytes("its index does not fit it");
    Bytes unpacked = decompress(std::span(bytes).subspan(static_cast<std::size_t>(place.frame_offset)), block_limit);
    if (!place.checked) {
      check(block, unpacked);
      place.checked = true;
    }
    if (packed_at_hand.size() >= packed_kept) packed_at_hand.pop_back();
    packed_at_hand.emplace_front(block, std::move(unpacked));
  } catch (const MalformedBytes& error) {
    lose(block, error.what());
    return nullptr;
  }
  return &packed_at_hand.front().second;
}

const Trace::Impl::Events& Trace::Impl::events(std::size_t block) const {
  for (auto it = events_at_hand.begin(); it != events_at_hand.end(); ++it) {
    if (it->first != block) continue;
    events_at_hand.splice(events_at_hand.begin(), events_at_hand, it);
    return it->second;
  }
  auto unpacked = std::make_shared<std::vector<RecordedEvent>>();
  unpacked->reserve(blocks[block].info.count);
  const Bytes* bytes = packed(block);
  if (bytes == nullptr)
    throw Incomplete(name,
                     fmt::format("steps {} to {} are lost", blocks[block].info.first_position + 1,
                                 blocks[block].info.first_position + blocks[block].info.count),
                     "ask about another step");
  try {
    BlockDecoder decoder(*bytes, blocks[block].info.count, *meanings, *facts);
    decoder.visit_all([&](std::uint8_t step, const auto& event) {
      unpacked->push_back({step, event});
      return true;
    });
  } catch (const MalformedBytes& error) {
    damaged(block, error.what());
  }
  if (events_at_hand.size() >= events_kept) events_at_hand.pop_back();
  events_at_hand.emplace_front(block, std::move(unpacked));
  return events_at_hand.front().second;
}

const RecordedEvent& Trace::event(std::int64_t position) const {
  if (position < 1 || position > size()) throw std::out_of_range("Trace::event: no such position");
  const std::size_t block = impl_->block_of(position);
  // Who asks once for a block is given the one event; who asks again will ask for more.
  const auto& at_hand = impl_->events_at_hand;
  const bool unpacked =
      std::any_of(at_hand.begin(), at_hand.end(), [&](const auto& other) { return other.first == block; });
  if (!unpacked && impl_->asked_once != block && impl_->packed(block) != nullptr) {
    visit(position - 1, position, [&](std::int64_t, std::uint8_t step, const auto& event) {
      impl_->one_event = {step, event};
      return true;
    });
    impl_->asked_once = block;
    return impl_->one_event;
  }
  return (*impl_->events(block))[static_cast<std::size_t>(position - 1 - impl_->blocks[block].info.first_position)];
}

std::int64_t Trace::begin_of_block(std::int64_t position) const {
  return impl_->blocks[impl_->block_of(position)].info.first_position;
}

std::optional<Trace::Pixel> pixel_of(const Event& event) {
  return visit_event(
      []<class E>(const E& known) -> std::optional<Trace::Pixel> {
        if constexpr (requires {
                        known.x;
                        known.y;
                      })
          return Trace::Pixel{known.x, known.y};
        else return std::nullopt;
      },
      event);
}

}  // namespace zstep
