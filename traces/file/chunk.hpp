// The container: a signature, then chunks, each with its length and checksum, so that a file that was cut off or
// damaged is noticed and read as far as it is whole.
//
//     "ztrace\r\n" version:u32
//     chunk*:  tag[4] size:u64 checksum:u64 bytes[size]       checksum = XXH3-64 of tag and bytes
//     trailer: "ZEND" offset of the INDX chunk:u64 checksum:u64 of the 12 bytes before
//
// HEAD, SCEN and INDX are zstd frames; EVTS is the info of a block with its length first, then a zstd frame of its
// events (docs/trace-format.md).
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "traces/file/bytes.hpp"

namespace zstep {

inline constexpr std::uint32_t trace_version = 6;
inline constexpr std::array<std::uint8_t, 8> trace_signature{'z', 't', 'r', 'a', 'c', 'e', '\r', '\n'};
inline constexpr std::size_t chunk_head_size = 20;
inline constexpr std::size_t trailer_size = 20;

using Tag = std::array<char, 4>;
inline constexpr Tag head_tag{'H', 'E', 'A', 'D'}, scene_tag{'S', 'C', 'E', 'N'}, events_tag{'E', 'V', 'T', 'S'},
    index_tag{'I', 'N', 'D', 'X'}, end_tag{'Z', 'E', 'N', 'D'};

/// Bytes that can be read at any offset: a file, or memory.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  virtual std::uint64_t size() const = 0;
  /// Exactly `size` bytes from `offset`; throws MalformedBytes when they are not there.
  virtual Bytes read(std::uint64_t offset, std::uint64_t size) const = 0;
};

/// Of bytes that somebody else keeps.
class MemoryView : public ByteSource {
 public:
  explicit MemoryView(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  std::uint64_t size() const override { return bytes_.size(); }
  Bytes read(std::uint64_t offset, std::uint64_t size) const override {
    if (offset > bytes_.size() || size > bytes_.size() - offset) throw MalformedBytes("it ends too early");
    const auto part = bytes_.subspan(static_cast<std::size_t>(offset), static_cast<std::size_t>(size));
    return {part.begin(), part.end()};
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

struct ChunkPlace {
  Tag tag{};
  std::uint64_t offset = 0;  ///< of the chunk's first byte
  std::uint64_t size = 0;    ///< of its bytes, without the head
  std::uint64_t end() const { return offset + chunk_head_size + size; }
};

/// Of a chunk's bytes.
std::uint64_t checksum_of(const Tag& tag, std::span<const std::uint8_t> bytes);

/// A chunk, head and all, ready to be written.
void put_chunk(Bytes& out, const Tag& tag, std::span<const std::uint8_t> bytes);
Bytes make_chunk(const Tag& tag, std::span<const std::uint8_t> bytes);
Bytes make_signature();
Bytes make_trailer(std::uint64_t index_offset);

/// The head of the chunk at this offset, or nothing when the file ends before the chunk does.
std::optional<ChunkPlace> chunk_at(const ByteSource& source, std::uint64_t offset);
/// A chunk's bytes, checked; throws MalformedBytes when head or checksum say otherwise.
Bytes read_chunk(const ByteSource& source, const ChunkPlace& place);
/// Where the trailer says the index is, if the file has an intact one.
std::optional<std::uint64_t> index_offset(const ByteSource& source);

/// One zstd frame: at level 1, or for what is written while a run goes on at -3, which takes half the time.
enum class Compression : std::uint8_t { normal, fast };
Bytes compress(std::span<const std::uint8_t> bytes, Compression how = Compression::normal);
/// The chunk of a block, of its info and its events as they are packed.
struct EventsChunk {
  Bytes bytes;                   ///< without the chunk's head
  std::size_t frame_begins = 0;  ///< in them
};
EventsChunk make_events_chunk(std::span<const std::uint8_t> info, std::span<const std::uint8_t> events);

/// One zstd frame that states its size, at most `limit`; throws MalformedBytes otherwise (a bomb states its size, or
/// lies).
Bytes decompress(std::span<const std::uint8_t> frame, std::uint64_t limit);

}  // namespace zstep
