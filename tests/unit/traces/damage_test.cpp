// Traces that were cut off, damaged or made to harm: one clear error or fewer events, never anything else.
#include <doctest/doctest.h>

#include <cstring>
#include <random>

#include "tests/unit/traces/some_trace.hpp"
#include "traces/file/chunk.hpp"
#include "traces/file/visit.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

/// Opens and reads everything. Empty: all of it could be read; else the error, which must be one line.
std::string read_all(Bytes bytes, std::int64_t* events = nullptr) {
  try {
    const Trace trace = Trace::from_bytes(std::move(bytes), "damaged.ztrace");
    std::int64_t count = 0;
    trace.visit(0, trace.size(), [&](std::int64_t, std::uint8_t, const auto&) {
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

TEST_CASE("damage: a trace cut off at any byte opens with the blocks it has, or says what it is") {
  auto events = random_events(block_events + 300, 1);
  for (auto& event : events) {
    // Only what a replay accepts in any order.
    if (!std::holds_alternative<DepthWrite>(event.event)) event = {step_of(kind_of<PixelWrite>), PixelWrite{1, 2, 1}};
  }
  const Bytes whole = recorded_bytes(events);
  std::int64_t count = 0;
  REQUIRE(read_all(whole, &count) == "");
  REQUIRE(count == static_cast<std::int64_t>(events.size()));
  std::int64_t last = 0;
  bool opened = false;
  for (std::size_t size = 0; size < whole.size(); size += size < 3000 || size + 3000 > whole.size() ? 1 : 997) {
    std::int64_t got = -1;
    const std::string error = read_all(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)), &got);
    if (error.empty()) {
      opened = true;
      CHECK(got >= last);
      CHECK((got == 0 || got == block_events || got == static_cast<std::int64_t>(events.size())));
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
        trace.visit(0, trace.size(), [](std::int64_t, std::uint8_t, const auto&) { return true; });
        noticed = !trace.warnings().empty();
      } catch (const InputError&) {
        noticed = true;
      }
      CAPTURE(at);
      REQUIRE(noticed);
    }
  }
}

TEST_CASE("damage: another version says so") {
  Bytes bytes = recorded_bytes({});
  bytes[8] = 9;
  CHECK(read_all(bytes).find("is a trace of version 9; this zstep " ZSTEP_VERSION " reads version 1") !=
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
  for (int round = 0; round < 3000; ++round) {
    Bytes packed;
    const auto count = static_cast<std::uint32_t>(1 + random() % 40);
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
    Bytes info_bytes, chunk;
    put_block_info(info_bytes, info);
    put_varint(chunk, info_bytes.size());
    chunk.insert(chunk.end(), info_bytes.begin(), info_bytes.end());
    const Bytes frame = compress(packed);
    chunk.insert(chunk.end(), frame.begin(), frame.end());
    const Bytes made = make_chunk(events_tag, chunk);
    Bytes bytes(good.begin(), good.begin() + static_cast<std::ptrdiff_t>(begin_of_blocks));
    bytes.insert(bytes.end(), made.begin(), made.end());
    read_all(std::move(bytes));
  }
}
