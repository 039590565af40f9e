// How a trace lies in its file: little-endian numbers, chunks with their checksums, the index, and a copy without the
// paths of the computer that it was recorded on. No reader reads past the end.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace zstep {

/// The bytes end too early or hold an impossible number. Readers of files turn it into an InputError that says where.
struct MalformedBytes : std::runtime_error {
  using std::runtime_error::runtime_error;
};

using Bytes = std::vector<std::uint8_t>;

inline void put_u8(Bytes& out, std::uint8_t value) { out.push_back(value); }

template <class Unsigned>
void put_fixed(Bytes& out, Unsigned value) {
  std::array<std::uint8_t, sizeof(Unsigned)> bytes;
  for (std::size_t i = 0; i < sizeof value; ++i) bytes[i] = static_cast<std::uint8_t>(value >> (8 * i));
  out.insert(out.end(), bytes.begin(), bytes.end());
}
inline void put_u32(Bytes& out, std::uint32_t value) { put_fixed(out, value); }
inline void put_u64(Bytes& out, std::uint64_t value) { put_fixed(out, value); }

/// Seven bits a byte, the lowest first.
inline void put_varint(Bytes& out, std::uint64_t value) {
  while (value >= 0x80) {
    out.push_back(static_cast<std::uint8_t>(value | 0x80));
    value >>= 7;
  }
  out.push_back(static_cast<std::uint8_t>(value));
}

/// Small numbers of either sign become small numbers: 0, -1, 1, -2 … → 0, 1, 2, 3 …
inline std::uint32_t zigzag(std::int32_t value) {
  return (static_cast<std::uint32_t>(value) << 1) ^ static_cast<std::uint32_t>(value >> 31);
}
inline std::int32_t unzigzag(std::uint32_t value) {
  return static_cast<std::int32_t>((value >> 1) ^ (0u - (value & 1u)));
}

/// How far a float64's bits are from the guess's, small for numbers that are close: their difference as whole numbers,
/// zigzag.
inline std::uint64_t difference(std::uint64_t bits, std::uint64_t guess) {
  const std::uint64_t apart = bits - guess;
  return (apart << 1) ^ (0 - (apart >> 63));
}
inline std::uint64_t undo_difference(std::uint64_t difference, std::uint64_t guess) {
  return guess + ((difference >> 1) ^ (0 - (difference & 1u)));
}

inline void put_text(Bytes& out, const std::string& text) {
  put_varint(out, text.size());
  out.insert(out.end(), text.begin(), text.end());
}

/// Reads what the functions above wrote. Throws MalformedBytes instead of reading past the end.
class ByteReader {
 public:
  ByteReader() = default;
  explicit ByteReader(std::span<const std::uint8_t> bytes) : at_(bytes.data()), end_(bytes.data() + bytes.size()) {}

  std::size_t left() const { return end_ - at_; }
  bool empty() const { return at_ == end_; }

  std::uint8_t u8() {
    need(1);
    return *at_++;
  }
  std::uint32_t u32() { return static_cast<std::uint32_t>(low_bytes(sizeof(std::uint32_t))); }
  std::uint64_t u64() { return low_bytes(sizeof(std::uint64_t)); }

  std::uint64_t varint() {
    if (at_ != end_ && *at_ < 0x80) return *at_++;  // most numbers are small
    return long_varint();
  }
  /// A count of things that take at least `bytes_each` bytes: never more than the bytes left could hold.
  std::size_t count(std::size_t bytes_each = 1) {
    const std::uint64_t value = varint();
    if (value > left() / bytes_each) throw MalformedBytes("a count larger than the data");
    return value;
  }
  std::span<const std::uint8_t> take(std::size_t size) {
    need(size);
    const std::span<const std::uint8_t> taken(at_, size);
    at_ += size;
    return taken;
  }
  /// The number that the next `size` bytes are, at most eight, the lowest first.
  std::uint64_t low_bytes(std::size_t size) {
    need(size);
    std::uint64_t value = 0;
    if (std::endian::native == std::endian::little && left() >= sizeof value) {
      std::memcpy(&value, at_, sizeof value);
      value = size == 0 ? 0 : value & (~std::uint64_t{0} >> (8 * (sizeof value - size)));
    } else {
      for (std::size_t i = 0; i < size; ++i) value |= std::uint64_t{at_[i]} << (8 * i);
    }
    at_ += size;
    return value;
  }
  std::string text() {
    const auto taken = take(count());
    return {taken.begin(), taken.end()};
  }

 private:
  void need(std::size_t size) const {
    if (left() < size) throw MalformedBytes("the data ends too early");
  }
  std::uint64_t long_varint() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      const std::uint8_t byte = u8();
      value |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
      if (byte < 0x80) return value;
    }
    throw MalformedBytes("a number of more than 64 bits");
  }

  const std::uint8_t* at_ = nullptr;
  const std::uint8_t* end_ = nullptr;
};

// The container: a signature, then chunks, each with its length and checksum, so that a file that was cut off or
// damaged is noticed and read as far as it is whole.
//
//     "ztrace\r\n" version:u32
//     chunk*:  tag[4] size:u64 checksum:u64 bytes[size]       checksum = XXH3-64 of tag and bytes
//     trailer: "ZEND" offset of the INDX chunk:u64 checksum:u64 of the 12 bytes before
//
// HEAD, SCEN and INDX are zstd frames; EVTS is the info of a block with its length first, then a zstd frame of its
// events (docs/trace-format.md).

inline constexpr std::uint32_t trace_version = 6;
inline constexpr std::array<std::uint8_t, 8> trace_signature{'z', 't', 'r', 'a', 'c', 'e', '\r', '\n'};
inline constexpr std::size_t chunk_head_size = 20;
inline constexpr std::size_t trailer_size = 20;

using Tag = std::array<char, 4>;
inline constexpr Tag head_tag{'H', 'E', 'A', 'D'}, scene_tag{'S', 'C', 'E', 'N'}, events_tag{'E', 'V', 'T', 'S'},
    index_tag{'I', 'N', 'D', 'X'}, places_tag{'P', 'L', 'A', 'C'}, end_tag{'Z', 'E', 'N', 'D'};

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
    const auto part = bytes_.subspan(offset, size);
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

// The index of a trace: what stands at the head of each block, once more and together (docs/trace-format.md).

/// One block's entry: its chunk, where its frame begins, and its info.
inline void put_index_entry(Bytes& out, std::uint64_t offset, const EventsChunk& chunk,
                            std::span<const std::uint8_t> info) {
  put_varint(out, offset);
  put_varint(out, chunk.bytes.size());
  put_varint(out, chunk.frame_begins);
  out.insert(out.end(), info.begin(), info.end());
}

/// The index and the end of a file that is `offset` bytes long so far. `behind`: a chunk between the two, or nothing.
inline void put_index(Bytes& out, std::uint64_t offset, std::uint64_t blocks, std::span<const std::uint8_t> entries,
                      std::span<const std::uint8_t> behind) {
  Bytes index;
  put_varint(index, blocks);
  index.insert(index.end(), entries.begin(), entries.end());
  put_chunk(out, index_tag, compress(index));
  out.insert(out.end(), behind.begin(), behind.end());
  const Bytes trailer = make_trailer(offset);
  out.insert(out.end(), trailer.begin(), trailer.end());
}

// A trace as others may have it: without where files lay on the computer that it was recorded on.

/// The bytes of a .ztrace file with nothing but the names left of the files that its scene came from, and of those of
/// the program's source. Its events stay as they are, and so does what was cut off or damaged of them. Throws
/// MalformedBytes for what is no trace.
Bytes without_paths(const Bytes& trace);
/// The same of JSON Lines, whose first line is a header. Throws nlohmann::json::exception where it is none.
std::string without_paths_of_jsonl(std::string lines);

/// "pyramid.toml" of "/home/ada/pyramid.toml" or "C:\\ada\\pyramid.toml".
std::string last_part(const std::string& path);

}  // namespace zstep
