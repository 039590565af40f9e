// Traces that were cut off, damaged or made to harm: one clear error or fewer events, never anything else.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <random>

#include "tests/unit/traces/some_trace.hpp"
#include "traces/file/container.hpp"
#include "traces/file/visit.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

/// Opens and reads everything. Empty: all of it could be read; else the error, which must be one line.
std::string read_all(Bytes bytes, std::int64_t* events = nullptr) {
  try {
    const Trace trace = Trace::from_bytes(std::move(bytes), "damaged.ztrace");
    std::int64_t count = 0;
    trace.each(0, trace.size(), [&](std::int64_t, const RecordedEvent&) {
      ++count;
      return true;
    });
    if (events != nullptr) *events = count;
    Replay replay(trace);
    replay.go_to(trace.size());
    return "";
  } catch (const InputError& error) {
    const std::string message = error.what();
    CHECK(message.find("damaged.ztrace: ") == 0);
    CHECK(message.find('\n') == std::string::npos);
    return message;
  }
}

}  // namespace

TEST_CASE("damage: a trace opens with the blocks it has wherever it is cut off, or says what it is") {
  auto events = random_events(block_events + 300, 1);
  for (auto& event : events) {
    // Only what a replay accepts in any order.
    if (!holds<DepthWrite>(event.event)) event = {step_of(kind_of<PixelWrite>), PixelWrite{1, 2, 1}};
  }
  const Bytes whole = recorded_bytes(events);
  std::int64_t count = 0;
  REQUIRE(read_all(whole, &count) == "");
  REQUIRE(count == static_cast<std::int64_t>(events.size()));
  const Trace undamaged = Trace::from_bytes(whole, "whole");
  const auto at_end_of_block = [&](std::int64_t position) {
    const auto& blocks = undamaged.impl().blocks;
    return position == 0 || std::any_of(blocks.begin(), blocks.end(), [&](const auto& block) {
             return block.info.first_position + block.info.count == position;
           });
  };
  REQUIRE(undamaged.impl().blocks.size() > 1);
  std::int64_t last = 0;
  bool opened = false;
  // At every byte where the file begins and ends; now and then between, where each try reads a whole block.
  const auto stride = [&](std::size_t size) {
    if (size < 600 || size + 200 > whole.size()) return 1U;
    return size < 3000 ? 5U : size + 3000 > whole.size() ? 31U : 997U;
  };
  for (std::size_t size = 0; size < whole.size(); size += stride(size)) {
    std::int64_t got = -1;
    const std::string error = read_all(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)), &got);
    if (error.empty()) {
      opened = true;
      CHECK(got >= last);
      CHECK(at_end_of_block(got));
      last = got;
    } else {
      CHECK_FALSE(opened);  // once header and scene are whole, a cut costs events, not the file
    }
  }
  CHECK(last == static_cast<std::int64_t>(events.size()));
}

TEST_CASE("damage: no flipped byte goes unnoticed") {
  std::vector<RecordedEvent> events;
  for (int i = 0; i < 40; ++i) events.push_back({step_of(kind_of<DepthWrite>), DepthWrite{i % 16, i % 12, i * 0.1}});
  const Bytes whole = recorded_bytes(events);
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const int mask : {0x01, 0x80, 0xff}) {
      Bytes flipped = whole;
      flipped[at] = static_cast<std::uint8_t>(flipped[at] ^ mask);
      bool noticed = false;
      try {
        const Trace trace = Trace::from_bytes(std::move(flipped), "flipped");
        trace.each(0, trace.size(), [](std::int64_t, const RecordedEvent&) { return true; });
        noticed = !trace.warnings().empty();
      } catch (const InputError&) {
        noticed = true;
      }
      CAPTURE(at);
      REQUIRE(noticed);
    }
  }
}

TEST_CASE("damage: a flipped byte costs its block and no other") {
  std::vector<RecordedEvent> events;
  for (std::uint32_t i = 0; i < 3 * block_events; ++i)
    events.push_back({step_of(kind_of<PixelWrite>),
                      PixelWrite{static_cast<std::int32_t>(i % 16), static_cast<std::int32_t>(i / 16 % 12), 1}});
  const Bytes whole = recorded_bytes(events);
  const Trace undamaged = Trace::from_bytes(whole, "whole");
  const auto& blocks = undamaged.impl().blocks;
  REQUIRE(blocks.size() > 2);
  const ChunkPlace place = blocks[1].place;
  // Every byte of its head, and now and then one of what follows.
  for (std::uint64_t at = place.offset; at < place.end(); at += at < place.offset + chunk_head_size + 40 ? 1 : 7) {
    Bytes flipped = whole;
    flipped[static_cast<std::size_t>(at)] ^= 0x10;
    const Trace trace = Trace::from_bytes(std::move(flipped), "flipped");
    CAPTURE(at);
    REQUIRE(trace.size() == undamaged.size());
    for (std::size_t block = 0; block < blocks.size(); ++block) {
      const BlockInfo& info = blocks[block].info;
      std::int64_t read = 0;
      const auto read_block = [&] {
        trace.each(info.first_position, info.first_position + info.count,
                   [&](std::int64_t, const RecordedEvent&) { return ++read, true; });
      };
      if (block == 1) CHECK_THROWS_AS(read_block(), InputError);
      else read_block();
      REQUIRE(read == (block == 1 ? 0 : static_cast<std::int64_t>(info.count)));
    }
  }
}

TEST_CASE("damage: another version says so") {
  Bytes bytes = recorded_bytes({});
  bytes[8] = 9;
  CHECK(read_all(bytes).find("is a trace of version 9; this zstep " ZSTEP_VERSION " reads version 6") !=
        std::string::npos);
  CHECK(read_all({'P', 'K', 3, 4, 0, 0, 0, 0, 0, 0, 0, 0, 0}).find("is not a zstep trace") != std::string::npos);
  CHECK(read_all({}).find("is not a zstep trace") != std::string::npos);
}

TEST_CASE("damage: a compression bomb is refused before it unpacks") {
  const Bytes zeros(std::size_t{300} << 20);
  Bytes bytes = make_signature();
  const Bytes bomb = make_chunk(head_tag, compress(zeros));
  REQUIRE(bomb.size() < 100000);
  bytes.insert(bytes.end(), bomb.begin(), bomb.end());
  CHECK(read_all(bytes).find("would unpack to 314572800 bytes") != std::string::npos);
}

namespace {

/// A trace whose parts are as given, each behind a good checksum.
Bytes made_of(const Bytes& scene, const std::optional<Bytes>& index) {
  const Bytes good = recorded_bytes({});
  const auto part = [&](const char* tag) {
    for (std::size_t at = 12; at + 20 < good.size(); ++at) {
      if (std::memcmp(good.data() + at, tag, 4) != 0) continue;
      ByteReader in(std::span<const std::uint8_t>(good).subspan(at + 4));
      const std::size_t size = static_cast<std::size_t>(in.u64()) + chunk_head_size;
      return Bytes(good.begin() + static_cast<std::ptrdiff_t>(at),
                   good.begin() + static_cast<std::ptrdiff_t>(at + size));
    }
    return Bytes();
  };
  Bytes bytes = make_signature();
  const auto add = [&](const Bytes& more) { bytes.insert(bytes.end(), more.begin(), more.end()); };
  add(part("HEAD"));
  add(scene.empty() ? part("SCEN") : make_chunk(scene_tag, compress(scene)));
  if (index) {
    const std::uint64_t offset = bytes.size();
    add(make_chunk(index_tag, compress(*index)));
    add(make_trailer(offset));
  }
  return bytes;
}

/// A scene's bytes up to its counts.
Bytes scene_head(const std::string& camera) {
  Bytes scene;
  for (const std::string& text : {std::string("bomb"), std::string(), camera, std::string(R"({"width":8,"height":8})")})
    put_text(scene, text);
  scene.insert(scene.end(), {255, 255, 255});
  return scene;
}

}  // namespace

TEST_CASE("damage: small files that ask for gigabytes are refused") {
  Bytes polygons = scene_head(R"({"kind":"screen"})");
  for (const std::uint64_t count : {0u, 0u, 40'000'000u}) put_varint(polygons, count);
  polygons.resize(polygons.size() + 200'000'000);
  CHECK(read_all(made_of(polygons, {})).find("more of a kind than a scene can have") != std::string::npos);

  CHECK(read_all(made_of(scene_head(std::string(60'000'000, '[')), {})).find("more than 4 KiB") != std::string::npos);

  Bytes info, index;
  put_u64(info, 0);
  put_u32(info, 5);
  info.resize(info.size() + 16);  // no steps
  Tiles(some_scene().raster).put(info);
  put_varint(info, 0);  // no box before the first mark
  put_varint(info, 30'000'000);
  info.resize(info.size() + 60'000'000);
  put_varint(index, 1);
  put_varint(index, 12);  // offset
  put_varint(index, 20);  // size
  put_varint(index, 0);   // of which the frame is the whole
  index.insert(index.end(), info.begin(), info.end());
  std::int64_t events = -1;
  CHECK(read_all(made_of({}, index), &events) == "");  // an index that lies is an index that is missing
  CHECK(events == 0);

  Scene large = some_scene();
  large.raster = {16384, 16384, false};
  TraceRecorder recorder(some_header(), large);
  recorder.finish();
  CHECK(read_all(recorder.take_bytes()).find("a raster of 16384x16384 pixels") != std::string::npos);
}

TEST_CASE("damage: clearing a large raster without end is refused, clearing it often costs no memory") {
  Scene scene = some_scene();
  scene.raster = {2048, 2048, false};
  TraceRecorder few(some_header(), scene), many(some_header(), scene);
  for (int i = 0; i < 30; ++i) few(Step<BuffersClear>{step_of(kind_of<BuffersClear>)}, BuffersClear{1.0 * i});
  for (int i = 0; i < 3000; ++i) many(Step<BuffersClear>{step_of(kind_of<BuffersClear>)}, BuffersClear{1.0 * i});
  few.finish();
  many.finish();
  CHECK(read_all(few.take_bytes()) == "");
  CHECK(read_all(many.take_bytes()).find("cleared too often") != std::string::npos);
}

TEST_CASE("damage: random rubbish behind valid checksums is an error, not a crash") {
  std::mt19937 random(17);
  const Bytes good = recorded_bytes({});
  // Keep header and scene, then a block of our own making.
  const auto begin_of_blocks = [&] {
    for (std::size_t at = 0; at + 4 < good.size(); ++at) {
      if (std::memcmp(good.data() + at, "INDX", 4) == 0) return at;
    }
    return good.size();
  }();
  constexpr int rounds = 1500;
  int reached = 0;
  for (int round = 0; round < rounds; ++round) {
    Bytes packed;
    const auto count = static_cast<std::uint32_t>(1 + random() % 40);
    put_varint(packed, count);
    put_varint(packed, count);
    for (std::uint32_t i = 0; i < count; ++i)
      packed.push_back(static_cast<std::uint8_t>((1 + random() % kind_count) | (random() % 3 == 0 ? 0x80 : 0)));
    put_text(packed, "*");
    Bytes misses;
    for (int i = 0; i < 40; ++i) put_varint(misses, random() % 16);
    put_varint(packed, misses.size());
    packed.insert(packed.end(), misses.begin(), misses.end());
    for (std::size_t slot = 0; slot < slot_count; ++slot) {
      put_text(packed, std::string(slot_name(slot)));
      Bytes column;
      for (std::uint32_t i = 0; i < random() % 60; ++i) column.push_back(static_cast<std::uint8_t>(random()));
      put_varint(packed, column.size());
      packed.insert(packed.end(), column.begin(), column.end());
    }
    BlockInfo info;
    info.count = count;
    info.tiles = Tiles(some_scene().raster);
    Bytes info_bytes, chunk;
    put_block_info(info_bytes, info);
    put_varint(chunk, info_bytes.size());
    chunk.insert(chunk.end(), info_bytes.begin(), info_bytes.end());
    const Bytes frame = compress(packed);
    chunk.insert(chunk.end(), frame.begin(), frame.end());
    const Bytes made = make_chunk(events_tag, chunk);
    Bytes bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(begin_of_blocks));
    bytes.insert(bytes.end(), made.begin(), made.end());
    const std::string error = read_all(std::move(bytes));
    reached += error.empty() || error.find("steps 1 to ") != std::string::npos ||
               error.find(": step ") != std::string::npos ||
               error.find("what a block says of itself") != std::string::npos;
  }
  CHECK(reached == rounds);  // none was refused for anything but its block
}

TEST_CASE("damage: a block that denies that other polygons than the one at work are named in it is refused") {
  std::vector<RecordedEvent> events{{step_of(kind_of<PolygonBegin>), PolygonBegin{0, 0}}};
  for (std::int32_t x = 0; x < 8; ++x)
    events.push_back({step_of(kind_of<PixelWrite>), PixelWrite{x, 0, x == 5 ? 1 : 0}});
  const Bytes good = recorded_bytes(events);
  const auto place_of = [&](const char* tag) {
    return static_cast<std::size_t>(std::search(good.begin(), good.end(), tag, tag + 4) - good.begin());
  };
  const std::size_t block = place_of("EVTS"), index = place_of("INDX");
  REQUIRE(index < good.size());
  for (const bool lies : {false, true}) {
    // Without an index, what a block says of itself stands before its steps: their place, then their number.
    Bytes chunk = read_chunk(MemoryView(good), chunk_at(MemoryView(good), block).value());
    ByteReader in(chunk);
    in.count();
    const std::size_t count = chunk.size() - in.left() + sizeof(std::uint64_t);
    CHECK((chunk[count + 3] & 0x80) == 0);
    if (lies) chunk[count + 3] |= 0x80;
    const Bytes made = make_chunk(events_tag, chunk);
    Bytes bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(block));
    bytes.insert(bytes.end(), made.begin(), made.end());
    const std::string error = read_all(std::move(bytes));
    if (lies) CHECK(error.find("what a block says of itself") != std::string::npos);
    else CHECK(error == "");
  }
}
