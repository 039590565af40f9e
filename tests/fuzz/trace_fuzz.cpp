// libFuzzer target: traces. The first byte chooses how the rest reaches the reader: as a file, as JSON Lines behind a
// good header, or as the packed columns of a block inside a file that is otherwise whole (checksums would stop it
// earlier).
#include <algorithm>
#include <cstdint>
#include <memory>
#include <sstream>
#include <string>

#include "tests/unit/traces/some_trace.hpp"
#include "traces/error.hpp"
#include "traces/file/chunk.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/file/visit.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

void read_everything(const Trace& trace) {
  trace.visit(0, trace.size(), [](std::int64_t, std::uint8_t, const auto&) { return true; });
  Replay replay(trace);
  replay.go_to(trace.size());
  replay.go_to(trace.size() / 2);
  for (int i = 0; i < 20; ++i) replay.step_back();
}

void read_lines(const std::string& text) {
  std::istringstream in(text);
  Scene kept;
  std::unique_ptr<TraceRecorder> recorder;
  read_jsonl(in, "fuzz.jsonl", [&](const Header& header, Scene scene) -> TraceRecorder& {
    kept = std::move(scene);
    recorder = std::make_unique<TraceRecorder>(header, kept);
    return *recorder;
  });
  recorder->finish();
  read_everything(Trace::from_bytes(recorder->take_bytes(), "fuzz"));
}

/// Signature, header and scene of a whole trace.
const Bytes& whole_head() {
  static const Bytes head = [] {
    Bytes bytes = recorded_bytes({});
    for (std::size_t at = 0; at + 4 < bytes.size(); ++at) {
      if (bytes[at] == 'I' && bytes[at + 1] == 'N' && bytes[at + 2] == 'D' && bytes[at + 3] == 'X') {
        bytes.resize(at);
        break;
      }
    }
    return bytes;
  }();
  return head;
}

void read_block(std::span<const std::uint8_t> packed) {
  ByteReader in(packed);
  BlockInfo info;
  info.count = 1 + in.u8();
  info.tiles = Tiles(some_scene().raster);
  Bytes block;
  put_varint(block, info.count);
  block.insert(block.end(), packed.begin() + 1, packed.end());
  Bytes info_bytes, chunk;
  put_block_info(info_bytes, info);
  put_varint(chunk, info_bytes.size());
  chunk.insert(chunk.end(), info_bytes.begin(), info_bytes.end());
  const Bytes frame = compress(block);
  chunk.insert(chunk.end(), frame.begin(), frame.end());
  Bytes bytes = whole_head();
  const Bytes made = make_chunk(events_tag, chunk);
  bytes.insert(bytes.end(), made.begin(), made.end());
  read_everything(Trace::from_bytes(std::move(bytes), "fuzz"));
}

/// A whole file but for its scene or its index.
void read_part(const Tag& tag, std::span<const std::uint8_t> part) {
  Bytes bytes = whole_head();
  if (tag == scene_tag) {
    for (std::size_t at = 0; at + 4 < bytes.size(); ++at) {
      if (std::equal(tag.begin(), tag.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at))) {
        bytes.resize(at);
        break;
      }
    }
  }
  const std::uint64_t offset = bytes.size();
  const Bytes made = make_chunk(tag, compress(part));
  bytes.insert(bytes.end(), made.begin(), made.end());
  const Bytes trailer = make_trailer(offset);
  if (tag == index_tag) bytes.insert(bytes.end(), trailer.begin(), trailer.end());
  read_everything(Trace::from_bytes(std::move(bytes), "fuzz"));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const std::span<const std::uint8_t> rest(data + 1, size - 1);
  try {
    switch (data[0] % 6) {
      case 0:
        read_everything(Trace::from_bytes(Bytes(rest.begin(), rest.end()), "fuzz"));
        break;
      case 1:
        read_lines(std::string(rest.begin(), rest.end()));
        break;
      case 2:
        read_lines(jsonl_header(some_header(), some_scene()) + "\n" + std::string(rest.begin(), rest.end()));
        break;
      case 3:
        read_block(rest);
        break;
      case 4:
        read_part(scene_tag, rest);
        break;
      default:
        read_part(index_tag, rest);
        break;
    }
  } catch (const InputError&) {
  } catch (const MalformedBytes&) {  // read_block's own first byte
  }
  return 0;
}
