// Trace::next and Trace::previous: block by block, and of a block only what can be meant.
#include <algorithm>
#include <functional>
#include <utility>

#include "traces/file/visit.hpp"

namespace zstep {

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
