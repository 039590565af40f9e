#include "tests/fuzz/trace_mutator.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <sstream>
#include <utility>
#include <vector>

#include "traces/codec/block.hpp"
#include "traces/error.hpp"
#include "traces/events/slots.hpp"
#include "traces/file/check_events.hpp"
#include "traces/file/container.hpp"
#include "traces/file/header_json.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/file/scene_bytes.hpp"
#include "traces/record/trace_recorder.hpp"

namespace zstep::fuzz {

namespace {

constexpr std::uint64_t limit = 1 << 22;  // of a part, unpacked: larger ones are slow and reach nothing more

/// A file's parts, unpacked.
struct Parts {
  Bytes head, scene, places;
  struct Block {
    Bytes info, events;
  };
  std::vector<Block> blocks;
};

Parts take_apart(std::span<const std::uint8_t> bytes) {
  const MemoryView source(bytes);
  Parts parts;
  std::optional<ChunkPlace> place = chunk_at(source, make_signature().size());
  for (; place; place = chunk_at(source, place->end())) {
    const Bytes chunk = read_chunk(source, *place);
    if (place->tag == head_tag) parts.head = decompress(chunk, limit);
    if (place->tag == scene_tag) parts.scene = decompress(chunk, limit);
    if (place->tag == places_tag) parts.places = decompress(chunk, limit);
    if (place->tag != events_tag) continue;
    ByteReader in(chunk);
    const auto info = in.take(in.count());
    parts.blocks.push_back({{info.begin(), info.end()}, decompress(in.take(in.left()), limit)});
  }
  return parts;
}

/// A number in the place of another: near it, or at a limit.
template <class Whole>
void change(Whole& number, Random& random) {
  constexpr auto most = std::numeric_limits<Whole>::max();
  const auto near = static_cast<Whole>(static_cast<std::uint64_t>(number) + random() % 9 - 4);
  const std::array<Whole, 6> choices{0, 1, most, static_cast<Whole>(most / 2 + 1), near, near};
  number = choices[pick(random, choices.size())];
}
void change(double& number, Random& random) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const std::array<double, 10> choices{
      0, -0.0, 1e308, -1e308, 5e-324, inf, -inf, std::numeric_limits<double>::quiet_NaN(), number + 1, -number};
  number = choices[pick(random, choices.size())];
}
void change(bool& truth, Random&) { truth = !truth; }
template <class Enumeration>
requires std::is_enum_v<Enumeration>
void change(Enumeration& word, Random& random) {
  word = static_cast<Enumeration>(pick(random, words_of<Enumeration>.size()));
}

/// What a block, or the index, says of a block.
void change_info(Bytes& bytes, const Raster& raster, Random& random) {
  ByteReader in(bytes);
  BlockInfo info = take_block_info(in, raster);
  switch (pick(random, 7)) {
    case 0:
      change(info.first_position, random);
      break;
    case 1:
      change(info.count, random);
      break;
    case 2:
      info.steps.words()[random() % 2] ^= std::uint64_t{1} << random() % 64;
      break;
    case 3: {
      const auto y = static_cast<std::int32_t>(pick(random, static_cast<std::size_t>(raster.height)));
      info.tiles.clear();
      info.tiles.touch(0, raster.width, y);
      break;
    }
    case 4:
      info.lead = Box{};
      break;
    default:
      if (info.marks.empty()) break;
      const auto mark = info.marks.begin() + static_cast<std::ptrdiff_t>(pick(random, info.marks.size()));
      if (random() % 4 == 0) info.marks.erase(mark);
      else if (random() % 2 == 0) change(mark->polygon, random);
      else if (random() % 2 == 0) mark->box = Box{};
      else change(mark->offset, random);
  }
  bytes.clear();
  put_block_info(bytes, info);
}

Bytes put_together(const Parts& parts, const Raster* raster, bool lie, Random& random) {
  Bytes out = make_signature(), entries;
  put_chunk(out, head_tag, compress(parts.head));
  put_chunk(out, scene_tag, compress(parts.scene));
  const std::size_t liar = lie ? pick(random, parts.blocks.size()) : parts.blocks.size();
  for (const Parts::Block& block : parts.blocks) {
    EventsChunk chunk = make_events_chunk(block.info, block.events);
    std::uint64_t offset = out.size();
    put_chunk(out, events_tag, chunk.bytes);
    Bytes info = block.info;
    if (&block == parts.blocks.data() + liar) {
      if (raster != nullptr && random() % 2 == 0) change_info(info, *raster, random);
      else if (random() % 3 == 0) change(offset, random);
      else if (random() % 2 == 0) change(chunk.frame_begins, random);
      else chunk.bytes.resize(random() % 2 == 0 ? 0 : chunk.bytes.size() + 1);
    }
    put_index_entry(entries, offset, chunk, info);
  }
  std::uint64_t count = parts.blocks.size();
  const Bytes places = parts.places.empty() ? Bytes() : make_chunk(places_tag, compress(parts.places));
  if (lie && random() % 8 == 0) change(count, random);
  if (lie && random() % 8 == 0) mutate_bytes(entries);
  if (!lie || random() % 8 != 0) put_index(out, out.size(), count, entries, places);
  return out;
}

/// Steps with other numbers, dropped, doubled, moved: what a program with a mistake writes, and no check of bytes
/// finds.
Bytes change_events(std::span<const std::uint8_t> bytes, Random& random) {
  const Trace trace = Trace::from_bytes({bytes.begin(), bytes.end()}, "fuzz");
  std::vector<RecordedEvent> events;
  trace.each(0, std::min<std::int64_t>(trace.size(), 50'000), [&](std::int64_t, const RecordedEvent& event) {
    events.push_back(event);
    return true;
  });
  for (std::size_t left = 1 + pick(random, 4); left > 0 && !events.empty(); --left) {
    const auto at = events.begin() + static_cast<std::ptrdiff_t>(pick(random, events.size()));
    const auto other = events.begin() + static_cast<std::ptrdiff_t>(pick(random, events.size()));
    switch (pick(random, 8)) {
      case 0:
        events.erase(at);
        break;
      case 1:
        std::iter_swap(at, other);
        break;
      case 2: {
        const RecordedEvent copy = *other;
        events.insert(at, copy);
        break;
      }
      case 3:
        events.erase(std::min(at, other), std::min(std::max(at, other), std::min(at, other) + 30));
        break;
      default:
        visit_event(
            [&]<class E>(E& event) {
              E changed = event;
              std::size_t field = pick(random, field_count<E>);
              for_each_index<E>([&]<std::size_t I>() {
                if (field-- == 0) change(changed.*field_at<E, I>.member, random);
              });
              EventCheck check(trace.scene());
              if (check(changed).empty()) event = changed;  // others are no recorder's to take
            },
            at->event);
    }
  }
  TraceRecorder recorder(trace.header(), trace.scene());
  for (const RecordedEvent& event : events) record_any(recorder, event.step, event.event);
  recorder.finish();
  return recorder.take_bytes();
}

}  // namespace

Bytes bytes_of_lines(const std::string& text) {
  std::istringstream in(text);
  Scene kept;
  std::unique_ptr<TraceRecorder> recorder;
  const auto cut = read_jsonl(in, "fuzz.jsonl", [&](const Header& header, Scene scene) -> TraceRecorder& {
    kept = std::move(scene);
    recorder = std::make_unique<TraceRecorder>(header, kept);
    return *recorder;
  });
  recorder->finish(!cut);
  return recorder->take_bytes();
}

Trace trace_of_lines(const std::string& text) { return Trace::from_bytes(bytes_of_lines(text), "fuzz.jsonl"); }

Bytes mutate_trace(std::span<const std::uint8_t> bytes, const TextMutator& words, Random& random) {
  try {
    const std::size_t what = pick(random, 12);
    if (what < 4) return change_events(bytes, random);
    Parts parts = take_apart(bytes);
    std::optional<Raster> raster;
    try {
      raster = scene_from_bytes(parts.scene).raster;
    } catch (const MalformedBytes&) {
    } catch (const MalformedJson&) {
    }
    const auto block = parts.blocks.begin() + static_cast<std::ptrdiff_t>(pick(random, parts.blocks.size()));
    if (what == 4)
      parts.head = [&] {
        const std::string text = words({parts.head.begin(), parts.head.end()}, random);
        return Bytes(text.begin(), text.end());
      }();
    else if (what == 5) mutate_bytes(random() % 2 == 0 && !parts.places.empty() ? parts.places : parts.scene);
    else if (what < 9 && block != parts.blocks.end()) mutate_bytes(block->events);
    else if (what == 9 && block != parts.blocks.end() && raster) change_info(block->info, *raster, random);
    else if (what == 10 && block != parts.blocks.end()) {
      const Parts::Block other = parts.blocks[pick(random, parts.blocks.size())];
      if (random() % 2 == 0) parts.blocks.insert(block, other);
      else parts.blocks.erase(block);
    }
    return put_together(parts, raster ? &*raster : nullptr, what == 11, random);
  } catch (const InputError&) {
  } catch (const MalformedBytes&) {
  }
  Bytes raw(bytes.begin(), bytes.end());
  mutate_bytes(raw);
  return raw;
}

}  // namespace zstep::fuzz
