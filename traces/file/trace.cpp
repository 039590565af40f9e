// An opened trace: its events by position, the next and the previous of a kind, and whose polygon an event is about.

#include "traces/file/trace.hpp"

#include <algorithm>
#include <bitset>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include "traces/error.hpp"
#include "traces/events/fields.hpp"
#include "traces/file/check_events.hpp"
#include "traces/file/visit.hpp"

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
std::string_view Trace::printed_at(std::int64_t position) const {
  if (!has_places() || position < 1 || position > size()) return "";
  return printed_at(position, event(position).step);
}
std::string_view Trace::printed_at(std::int64_t position, std::uint8_t step) const {
  return impl_->places.of(position, step);
}
bool Trace::has_places() const { return !impl_->places.empty(); }
std::int64_t Trace::line_of(std::int64_t position) const { return impl_->lines.of(position); }
void Trace::lines_are(StepLines lines) { impl_->lines = std::move(lines); }
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
      check(block, decompress(std::span(bytes).subspan(frame), block_limit));
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

Trace::Impl::Packed Trace::Impl::packed(std::size_t block) const {
  if (blocks[block].lost && on_loss) return nullptr;
  for (auto it = packed_at_hand.begin(); it != packed_at_hand.end(); ++it) {
    if (it->first != block) continue;
    packed_at_hand.splice(packed_at_hand.begin(), packed_at_hand, it);
    return it->second;
  }
  const Block& place = blocks[block];
  try {
    if (place.lost) throw MalformedBytes("it is not there");
    const Bytes bytes = read_chunk(*source, place.place);
    if (place.frame_offset > bytes.size()) throw MalformedBytes("its index does not fit it");
    Bytes unpacked = decompress(std::span(bytes).subspan(place.frame_offset), block_limit);
    if (!place.checked) {
      check(block, unpacked);
      place.checked = true;
    }
    if (packed_at_hand.size() >= packed_kept) packed_at_hand.pop_back();
    packed_at_hand.emplace_front(block, std::make_shared<const Bytes>(std::move(unpacked)));
  } catch (const MalformedBytes& error) {
    lose(block, error.what());
    return nullptr;
  }
  return packed_at_hand.front().second;
}

const Trace::Impl::Events& Trace::Impl::events(std::size_t block) const {
  for (auto it = events_at_hand.begin(); it != events_at_hand.end(); ++it) {
    if (it->first != block) continue;
    events_at_hand.splice(events_at_hand.begin(), events_at_hand, it);
    return it->second;
  }
  auto unpacked = std::make_shared<std::vector<RecordedEvent>>();
  unpacked->reserve(blocks[block].info.count);
  const Packed bytes = packed(block);
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
  return (*impl_->events(block))[position - 1 - impl_->blocks[block].info.first_position];
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

namespace {

using Kinds = std::bitset<kind_count>;

/// Those that occur.
Kinds kinds_in(const Trace& trace) {
  Kinds kinds;
  for (std::size_t kind = 0; kind < kind_count; ++kind) kinds[kind] = trace.has(static_cast<std::uint8_t>(kind));
  return kinds;
}

/// What is about all polygons at once, after the work on each of them.
Kinds about_all(const Kinds& recorded) {
  Kinds kinds;
  for (std::size_t kind = 0; kind < kind_count; ++kind) kinds[kind] = description_of_kind(kind).after_polygons;
  if (recorded[kind_of<TablesBegin>]) kinds.set(kind_of<ScanLineBegin>);
  return kinds & recorded;
}

}  // namespace

const Trace::Impl::Turns& Trace::Impl::turns(const Trace& trace) const {
  if (known_turns) return *known_turns;
  Turns& turns = known_turns.emplace(Turns{0, size + 1});
  const Kinds recorded = kinds_in(trace), ends = about_all(recorded);
  if (polygons.empty() || ends.none()) return turns;
  auto after_last = polygons.end();
  if (recorded[kind_of<PieceDraw>])
    after_last = std::partition_point(polygons.begin(), polygons.end(), [&](const PolygonMark& mark) {
      return holds<PolygonBegin>(trace.event(mark.position).event);
    });
  if (after_last == polygons.begin()) return turns;
  turns.last = static_cast<std::size_t>(after_last - polygons.begin()) - 1;
  const std::int64_t drawn =
      after_last == polygons.end() ? size + 1 : after_last->position;  // from there on pieces take turns
  const auto end = trace.next(
      polygons[turns.last].position,
      [&](const RecordedEvent& recorded_event) { return ends[recorded_event.event.index()]; },
      Trace::Among({}, {}, drawn - 1));
  turns.end = end.value_or(size + 1);
  return turns;
}

std::int64_t Trace::end_of_turns() const { return impl_->turns(*this).end; }

std::int32_t Trace::polygon_at_work(std::int64_t position) const {
  const auto marks = polygons();
  const auto after = std::upper_bound(marks.begin(), marks.end(), position,
                                      [](std::int64_t p, const PolygonMark& mark) { return p < mark.position; });
  if (after == marks.begin()) return no_polygon;
  const Impl::Turns& turns = impl_->turns(*this);
  const bool is_last = static_cast<std::size_t>(after - marks.begin()) - 1 == turns.last;
  return is_last && position >= turns.end ? no_polygon : (after - 1)->polygon;
}

namespace {

bool is_pixel(const Event& event) { return has(at_pixel_of(event), AtPixel::depth); }
/// The span that this is, where it has pixels.
const SpanBegin* as_span(const Event& event) {
  const auto* span = get_if<SpanBegin>(&event);
  return span && span->first <= span->last ? span : nullptr;
}

/// Are there spans of several polygons before any pixel?
bool begins_with_spans(const Trace& trace, std::int64_t first_span) {
  bool another = false, pixels = false;  // a polygon began after the last span
  int polygons = 1;
  trace.each(first_span, trace.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    const Event& event = recorded.event;
    another = another || holds<PolygonBegin>(event) || holds<PieceDraw>(event);
    if (as_span(event) && another) ++polygons, another = false;
    pixels = is_pixel(event);
    return !pixels;
  });
  return pixels && polygons > 1;
}

/// Do some of the first spans come one after another, on a scan line?
bool begins_with_lines(const Trace& trace, std::int64_t first_span) {
  constexpr int enough = 256;
  int spans = 0, open = 0;  // since the last pixel
  trace.each(first_span - 1, trace.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    if (as_span(recorded.event)) ++spans, ++open;
    if (is_pixel(recorded.event)) open = 0;
    return open < 2 && spans < enough;
  });
  return open > 1;
}

Trace::SpansAtOnce first_spans_of(const Trace& trace) {
  using enum Trace::SpansAtOnce;
  if (!trace.has(kind_of<SpanBegin>)) return of_polygon;
  const auto first = trace.next<SpanBegin>(0, [](const SpanBegin& span) { return span.first <= span.last; });
  if (!first) return of_polygon;
  // Pieces have a table each, whatever tree or list they come from.
  const bool one_table = trace.has(kind_of<TablesBegin>) && !trace.has(kind_of<PieceDraw>);
  if (one_table) return begins_with_lines(trace, *first) ? of_line : of_polygon;
  return begins_with_spans(trace, *first) ? of_all : of_polygon;
}

}  // namespace

Trace::SpansAtOnce Trace::spans_at_once() const {
  if (!impl_->known_spans_at_once) impl_->known_spans_at_once = first_spans_of(*this);
  return *impl_->known_spans_at_once;
}

bool Trace::has(AtPixel any) const {
  for (std::size_t kind = 0; kind < kind_count; ++kind)
    if (zstep::has(at_pixel_of(kind), any) && has(static_cast<std::uint8_t>(kind))) return true;
  return false;
}

std::int32_t Trace::polygon_of_piece(std::int32_t piece) const {
  if (!impl_->polygon_by_piece) {
    std::vector<std::int32_t>& made = impl_->polygon_by_piece.emplace();
    scan(Among({}, kind_of<PieceMake>), [&](std::int64_t, const RecordedEvent& recorded) {
      const auto& event = get<PieceMake>(recorded.event);
      if (static_cast<std::size_t>(event.piece) == made.size()) made.push_back(event.polygon);
      return true;
    });
  }
  const std::vector<std::int32_t>& made = *impl_->polygon_by_piece;
  return piece >= 0 && piece < std::ssize(made) ? made[piece] : no_polygon;
}

std::optional<std::int32_t> Trace::polygon_named(const Event& event) const {
  return visit_event(
      [&]<class E>(const E& known) -> std::optional<std::int32_t> {
        if constexpr (names_polygon<E> == Names::polygon) return known.polygon;
        else if constexpr (names_polygon<E> == Names::facet) {
          const std::vector<Facet>& facets = scene().facets;
          return known.facet >= 0 && known.facet < std::ssize(facets) ? facets[known.facet].polygon : no_polygon;
        } else if constexpr (names_polygon<E> == Names::piece) return polygon_of_piece(known.piece);
        else return std::nullopt;
      },
      event);
}

// Trace::next and Trace::previous: block by block, and of a block only what can be meant.

namespace {

/// Gives each event of a range that is meant to `each`, until it returns false.
using Each =
    std::function<bool(std::int64_t, const RecordedEvent&)>;  // one type, so that reading a block is compiled once

struct Search {
  const Trace::Among& among;
  Each each;
  bool stopped = false;

  template <class E>
  bool operator()(std::int64_t position, std::uint8_t step, const E& event) {
    if (among.kind && *among.kind != kind_of<E>) return true;
    if (among.pixel) {
      if constexpr (requires { event.x, event.y; }) {
        if (event.x != among.pixel->x || event.y != among.pixel->y) return true;
      } else {
        return true;
      }
    }
    stopped = !each(position, RecordedEvent{step, event});
    return !stopped;
  }
  bool operator()(std::int64_t before, const codec::Row& row) { return among.pixel || expand(before, row); }
  bool operator()(std::int64_t before, const codec::FragmentRun& run) { return beside(run) || expand(before, run); }
  bool operator()(std::int64_t before, const codec::PaintRun& run) { return beside(run) || expand(before, run); }

 private:
  template <class Run>
  bool beside(const Run& run) const {
    return among.pixel && (among.pixel->y != run.y || among.pixel->x < run.x || among.pixel->x >= run.end());
  }
  template <class Run>
  bool expand(std::int64_t before, const Run& run) {
    if (among.kind && !run.has(*among.kind)) return true;
    std::int64_t position = before;
    return run.expand([&](std::uint8_t step, const auto& event) { return (*this)(++position, step, event); });
  }
};

Search search_for(const Trace::Among& among, Each each) { return {among, std::move(each)}; }

/// The steps that record a kind; all where none is asked for.
StepSet steps_of(const Page& page, std::optional<std::uint8_t> kind) {
  StepSet steps;
  for (const StepInfo& step : page)
    if (!kind || step.kind == *kind) steps.add(step.id);
  return steps;
}

/// The last position of a block that can be meant; 0 if none can.
std::int64_t last_meant(const Trace::Impl& trace, std::size_t block, const StepSet& steps,
                        const std::optional<Trace::Pixel>& pixel) {
  const BlockInfo& info = trace.blocks[block].info;
  if (!info.steps.meets(steps)) return 0;
  return pixel ? trace.last_touch(block, *pixel) : info.first_position + info.count;
}

}  // namespace

std::int64_t Trace::Impl::last_touch(std::size_t block, Trace::Pixel pixel) const {
  const Block& touched = blocks[block];
  if (!touched.info.tiles.touched(pixel.x, pixel.y)) return 0;
  const bool is_last = block + 1 == blocks.size();
  std::size_t mark = is_last ? polygons.size() : blocks[block + 1].first_mark;
  std::int64_t end = touched.info.first_position + touched.info.count;
  for (; mark > touched.first_mark; --mark) {
    if (boxes[mark - 1].holds(pixel.x, pixel.y)) return end;
    end = polygons[mark - 1].position - 1;
  }
  return touched.info.lead.holds(pixel.x, pixel.y) ? end : 0;
}

bool Trace::may_be_of(std::int32_t polygon, Pixel pixel) const {
  const std::vector<PolygonMark>& marks = impl_->polygons;
  for (std::size_t block = 0; block < impl_->blocks.size(); ++block) {
    const auto& [info, first_mark, place, frame, checked, lost] = impl_->blocks[block];
    if (!info.tiles.touched(pixel.x, pixel.y)) continue;
    if (!info.keeps_to_marks) return true;
    const std::size_t end = block + 1 < impl_->blocks.size() ? impl_->blocks[block + 1].first_mark : marks.size();
    for (std::size_t mark = first_mark; mark < end; ++mark)
      if (marks[mark].polygon == polygon && impl_->boxes[mark].holds(pixel.x, pixel.y)) return true;
    if (!info.lead.holds(pixel.x, pixel.y)) continue;
    if (first_mark > 0 && marks[first_mark - 1].polygon == polygon) return true;
    bool named = false;
    visit(info.first_position, first_mark < end ? marks[first_mark].position - 1 : info.first_position + info.count,
          search_for(pixel, [&](std::int64_t, const RecordedEvent& recorded) {
            named = polygon_named(recorded.event) == polygon;
            return !named;
          }));
    if (named) return true;
  }
  return false;
}

std::optional<std::int64_t> Trace::next(std::int64_t from, const Predicate& predicate, const Among& among) const {
  return next_at(
      from, [&](std::int64_t, const RecordedEvent& recorded) { return predicate(recorded); }, among);
}
std::optional<std::int64_t> Trace::previous(std::int64_t from, const Predicate& predicate, const Among& among) const {
  return previous_at(
      from, [&](std::int64_t, const RecordedEvent& recorded) { return predicate(recorded); }, among);
}

std::optional<std::int64_t> Trace::next_at(std::int64_t from, const PredicateAt& predicate, const Among& among) const {
  const StepSet steps = steps_of(header().page, among.kind);
  const std::int64_t end = std::min(size(), among.until.value_or(size()));
  for (std::int64_t position = std::max<std::int64_t>(from, 0); position < end;) {
    const std::size_t block = impl_->block_of(position + 1);
    const BlockInfo& info = impl_->blocks[block].info;
    std::optional<std::int64_t> found;
    visit(position, std::min(end, last_meant(*impl_, block, steps, among.pixel)),
          search_for(among, [&](std::int64_t at, const RecordedEvent& recorded) {
            if (predicate(at, recorded)) found = at;
            return !found;
          }));
    if (found) return found;
    position = info.first_position + info.count;
  }
  return std::nullopt;
}

std::optional<std::int64_t> Trace::previous_at(std::int64_t from, const PredicateAt& predicate,
                                               const Among& among) const {
  const StepSet steps = steps_of(header().page, among.kind);
  const std::int64_t begin = std::max<std::int64_t>(0, among.until.value_or(1) - 1);
  for (std::int64_t position = std::min(from - 1, size()); position > begin;) {
    const std::size_t block = impl_->block_of(position);
    const std::int64_t block_begin = std::max(begin, impl_->blocks[block].info.first_position);
    std::optional<std::int64_t> found;
    visit(block_begin, std::min(position, last_meant(*impl_, block, steps, among.pixel)),
          search_for(among, [&](std::int64_t at, const RecordedEvent& recorded) {
            if (predicate(at, recorded)) found = at;
            return true;
          }));
    if (found) return found;
    position = block_begin;
  }
  return std::nullopt;
}

void Trace::each(std::int64_t first, std::int64_t last,
                 const std::function<bool(std::int64_t, const RecordedEvent&)>& visitor) const {
  RecordedEvent recorded;
  visit(first, last, [&](std::int64_t position, std::uint8_t step, const auto& event) {
    recorded.step = step;
    recorded.event = event;
    return visitor(position, recorded);
  });
}

void Trace::each_back(std::int64_t position,
                      const std::function<bool(std::int64_t, const RecordedEvent&)>& visitor) const {
  for (position = std::min(position, size()); position > 0;) {
    const std::size_t block = impl_->block_of(position);
    const std::int64_t begin = impl_->blocks[block].info.first_position;
    if (impl_->readable(position)) {
      const Impl::Events held = impl_->events(block);
      for (; position > begin; --position)
        if (!visitor(position, (*held)[position - 1 - begin])) return;
    }
    position = begin;
  }
}

void Trace::scan(const Among& among, const std::function<bool(std::int64_t, const RecordedEvent&)>& each) const {
  const StepSet steps = steps_of(header().page, among.kind);
  const std::int64_t end = std::min(size(), among.until.value_or(size()));
  for (std::size_t block = 0; block < impl_->blocks.size(); ++block) {
    const std::int64_t begin = impl_->blocks[block].info.first_position;
    if (begin >= end) return;
    auto search = search_for(among, each);
    visit(begin, std::min(end, last_meant(*impl_, block, steps, among.pixel)), search);
    if (search.stopped) return;
  }
}

}  // namespace zstep
