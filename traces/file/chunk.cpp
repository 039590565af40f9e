#include "traces/file/chunk.hpp"

#include <algorithm>
#include <memory>

#include <xxhash.h>
#include <zstd.h>

namespace zstep {

namespace {

void put_tag(Bytes& out, const Tag& tag) {
  for (const char letter : tag) out.push_back(static_cast<std::uint8_t>(letter));
}

Tag take_tag(ByteReader& in) {
  Tag tag;
  for (char& letter : tag) letter = static_cast<char>(in.u8());
  return tag;
}

}  // namespace

std::uint64_t checksum_of(const Tag& tag, std::span<const std::uint8_t> bytes) {
  std::uint64_t seed = 0;
  for (const char letter : tag) seed = seed << 8 | static_cast<std::uint8_t>(letter);
  return XXH3_64bits_withSeed(bytes.data(), bytes.size(), seed);
}

void put_chunk(Bytes& out, const Tag& tag, std::span<const std::uint8_t> bytes) {
  put_tag(out, tag);
  put_u64(out, bytes.size());
  put_u64(out, checksum_of(tag, bytes));
  out.insert(out.end(), bytes.begin(), bytes.end());
}

Bytes make_chunk(const Tag& tag, std::span<const std::uint8_t> bytes) {
  Bytes chunk;
  chunk.reserve(chunk_head_size + bytes.size());
  put_chunk(chunk, tag, bytes);
  return chunk;
}

Bytes make_signature() {
  Bytes out(trace_signature.begin(), trace_signature.end());
  put_u32(out, trace_version);
  return out;
}

Bytes make_trailer(std::uint64_t offset) {
  Bytes out;
  out.reserve(trailer_size);
  put_tag(out, end_tag);
  put_u64(out, offset);
  put_u64(out, checksum_of(end_tag, out));
  return out;
}

std::optional<ChunkPlace> chunk_at(const ByteSource& source, std::uint64_t offset) {
  if (offset > source.size() || source.size() - offset < chunk_head_size) return std::nullopt;
  const Bytes head = source.read(offset, chunk_head_size);
  ByteReader in(head);
  ChunkPlace place;
  place.tag = take_tag(in);
  place.offset = offset;
  place.size = in.u64();
  if (place.size > source.size() - offset - chunk_head_size) return std::nullopt;
  return place;
}

Bytes read_chunk(const ByteSource& source, const ChunkPlace& place) {
  Bytes bytes = source.read(place.offset, chunk_head_size + place.size);
  ByteReader head{std::span<const std::uint8_t>(bytes).first(chunk_head_size)};
  const bool same_head = take_tag(head) == place.tag && head.u64() == place.size;
  if (!same_head || head.u64() != checksum_of(place.tag, std::span(bytes).subspan(chunk_head_size))) {
    throw MalformedBytes("the checksum of its part " + std::string(place.tag.begin(), place.tag.end()) + " at byte " +
                         std::to_string(place.offset) + " is wrong");
  }
  bytes.erase(bytes.begin(), bytes.begin() + chunk_head_size);
  return bytes;
}

std::optional<std::uint64_t> index_offset(const ByteSource& source) {
  if (source.size() < trailer_size) return std::nullopt;
  const Bytes trailer = source.read(source.size() - trailer_size, trailer_size);
  ByteReader in(trailer);
  if (take_tag(in) != end_tag) return std::nullopt;
  const std::uint64_t offset = in.u64();
  if (in.u64() != checksum_of(end_tag, std::span(trailer).first(12))) return std::nullopt;
  return offset;
}

Bytes compress(std::span<const std::uint8_t> bytes, Compression how) {
  // Kept from block to block: to make one takes longer than to use it.
  thread_local const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(), &ZSTD_freeCCtx);
  const std::size_t most = ZSTD_compressBound(bytes.size());
  const std::unique_ptr<std::uint8_t[]> frame(new std::uint8_t[most]);  // memory that is not touched costs nothing
  const std::size_t size = ZSTD_compressCCtx(context.get(), frame.get(), most, bytes.data(), bytes.size(),
                                             how == Compression::fast ? -3 : 1);
  if (ZSTD_isError(size)) throw std::runtime_error(ZSTD_getErrorName(size));
  return Bytes(frame.get(), frame.get() + size);
}

EventsChunk make_events_chunk(std::span<const std::uint8_t> info, std::span<const std::uint8_t> events) {
  const Bytes frame = compress(events, Compression::fast);
  EventsChunk chunk;
  put_varint(chunk.bytes, info.size());
  chunk.bytes.insert(chunk.bytes.end(), info.begin(), info.end());
  chunk.frame_begins = chunk.bytes.size();
  chunk.bytes.insert(chunk.bytes.end(), frame.begin(), frame.end());
  return chunk;
}

Bytes decompress(std::span<const std::uint8_t> frame, std::uint64_t limit) {
  const unsigned long long stated = ZSTD_getFrameContentSize(frame.data(), frame.size());
  if (stated == ZSTD_CONTENTSIZE_ERROR || stated == ZSTD_CONTENTSIZE_UNKNOWN)
    throw MalformedBytes("a part that is not compressed as it should be");
  if (stated > limit) throw MalformedBytes("a part that would unpack to " + std::to_string(stated) + " bytes");
  thread_local const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(), &ZSTD_freeDCtx);
  Bytes out(static_cast<std::size_t>(stated));
  const std::size_t size = ZSTD_decompressDCtx(context.get(), out.data(), out.size(), frame.data(), frame.size());
  if (ZSTD_isError(size) || size != out.size()) throw MalformedBytes("a part that does not unpack");
  return out;
}

}  // namespace zstep
