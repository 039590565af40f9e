#include "traces/file/container.hpp"

#include <algorithm>
#include <memory>
#include <span>
#include <utility>

#include <nlohmann/json.hpp>
#include <xxhash.h>
#include <zstd.h>

#include "traces/file/scene_bytes.hpp"
#include "traces/file/source_places.hpp"

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

namespace {

constexpr std::uint64_t most_scene_bytes = std::uint64_t{256} << 20;

void append(Bytes& out, std::span<const std::uint8_t> bytes) { out.insert(out.end(), bytes.begin(), bytes.end()); }

/// The chunks after the scene, and an index of where they stand now; false where they are not as they were written.
bool put_blocks(Bytes& out, const ByteSource& source, std::uint64_t offset, const Bytes& places) {
  const auto index = index_offset(source);
  Bytes entries;
  std::uint64_t blocks = 0;
  while (true) {
    const auto place = chunk_at(source, offset);
    if (!place || (place->tag == index_tag) != (offset == index)) return false;
    if (place->tag == index_tag) break;
    EventsChunk chunk{read_chunk(source, *place), 0};
    ByteReader in(chunk.bytes);
    const std::span<const std::uint8_t> info = in.take(in.count());
    chunk.frame_begins = chunk.bytes.size() - in.left();
    put_index_entry(entries, out.size(), chunk, info);
    put_chunk(out, events_tag, chunk.bytes);
    ++blocks;
    offset = place->end();
  }
  put_index(out, out.size(), blocks, entries, places);
  return true;
}

/// Their chunk, shortened; nothing of one that is damaged.
Bytes places_without_paths(const ByteSource& source, const ChunkPlace& chunk) {
  Bytes out;
  try {
    put_places(out, take_places(source, chunk).without_paths());
  } catch (const MalformedBytes&) {
  }
  return out;
}

/// Behind the text in quotes that begins there; the end where it does not end.
std::size_t end_of_text(std::string_view lines, std::size_t from) {
  for (std::size_t at = from + 1; at < lines.size(); ++at) {
    if (lines[at] == '"') return at + 1;
    at += lines[at] == '\\';
  }
  return lines.size();
}

/// Where the last part of a path begins in a text of JSON, in which a backslash is written as two.
std::size_t begin_of_last_part(std::string_view text) {
  std::size_t begin = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const bool escape = text[at] == '\\';
    if (escape) ++at;
    if (at < text.size() && (text[at] == '/' || (escape && text[at] == '\\'))) begin = at + 1;
  }
  return begin;
}

/// With nothing but the name left of the file in each "at", whole line or not.
std::string steps_without_paths(std::string_view lines) {
  const std::string key = '"' + std::string(at_key) + '"';
  std::string out;
  std::size_t done = 0;
  for (std::size_t at = lines.find(key); at != std::string_view::npos; at = lines.find(key, at + 1)) {
    const std::size_t colon = lines.find_first_not_of(" \t", at + key.size());
    if (colon == std::string_view::npos || lines[colon] != ':') continue;
    const std::size_t from = lines.find_first_not_of(" \t", colon + 1);
    if (from == std::string_view::npos || lines[from] != '"') continue;
    const std::size_t end = end_of_text(lines, from);
    const std::string_view place = lines.substr(from + 1, end - from - 1);  // and the quote that ends it
    out.append(lines.substr(done, from + 1 - done)).append(place.substr(begin_of_last_part(place)));
    done = end;
  }
  return out.append(lines.substr(done));
}

}  // namespace

std::string last_part(const std::string& path) { return path.substr(path.find_last_of("/\\") + 1); }

Bytes without_paths(const Bytes& trace) {
  const MemoryView source(trace);
  const auto head = chunk_at(source, trace_signature.size() + 4);
  const auto place = head ? chunk_at(source, head->end()) : std::nullopt;
  if (!place || place->tag != scene_tag) throw MalformedBytes("its scene is missing");
  Scene scene = scene_from_bytes(decompress(read_chunk(source, *place), most_scene_bytes));
  const Scene as_it_was = scene;
  scene.source = last_part(scene.source);
  for (Placement& placement : scene.placements) placement.source = last_part(placement.source);
  const auto places_chunk = find_places(source, place->end());
  const Bytes places = places_chunk ? places_without_paths(source, *places_chunk) : Bytes();
  if (scene == as_it_was && !places_chunk) return trace;

  const std::span<const std::uint8_t> whole(trace);
  Bytes out;
  append(out, whole.first(place->offset));
  put_chunk(out, scene_tag, compress(scene_to_bytes(scene)));
  const std::size_t begin = out.size();
  try {
    if (put_blocks(out, source, place->end(), places)) return out;
  } catch (const MalformedBytes&) {
    // A damaged run is kept as it is; the viewer says what is wrong with it.
  }
  out.resize(begin);
  const std::uint64_t end = places_chunk ? places_chunk->offset : whole.size();
  append(out, whole.subspan(place->end(), end - place->end()));
  append(out, places);
  if (places_chunk) append(out, whole.subspan(places_chunk->end()));
  return out;
}

std::string without_paths_of_jsonl(std::string lines) {
  const std::size_t end = std::min(lines.find('\n'), lines.size());
  auto header = nlohmann::ordered_json::parse(lines.begin(), lines.begin() + end);
  bool changed = false;
  const auto shorten = [&](nlohmann::ordered_json& of) {
    if (!of.is_object() || !of.contains("source") || !of["source"].is_string()) return;
    const std::string path = of["source"];
    of["source"] = last_part(path);
    changed = changed || of["source"] != path;
  };
  if (header.is_object() && header.contains("scene") && header["scene"].is_object()) {
    shorten(header["scene"]);
    if (header["scene"].contains("placements") && header["scene"]["placements"].is_array())
      for (auto& placement : header["scene"]["placements"]) shorten(placement);
  }
  return (changed ? header.dump() : lines.substr(0, end)) + steps_without_paths(std::string_view(lines).substr(end));
}

}  // namespace zstep
