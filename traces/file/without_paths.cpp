#include "traces/file/without_paths.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include <nlohmann/json.hpp>

#include "traces/file/chunk.hpp"
#include "traces/file/index.hpp"
#include "traces/file/scene_bytes.hpp"

namespace zstep {
namespace {

constexpr std::uint64_t most_scene_bytes = std::uint64_t{256} << 20;

void append(Bytes& out, std::span<const std::uint8_t> bytes) { out.insert(out.end(), bytes.begin(), bytes.end()); }

/// The chunks after the scene, and an index of where they stand now; false where they are not as they were written.
bool put_blocks(Bytes& out, const ByteSource& source, std::uint64_t offset) {
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
  put_index(out, out.size(), blocks, entries);
  return true;
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
  if (scene == as_it_was) return trace;

  const std::span<const std::uint8_t> whole(trace);
  Bytes out;
  append(out, whole.first(static_cast<std::size_t>(place->offset)));
  put_chunk(out, scene_tag, compress(scene_to_bytes(scene)));
  const std::size_t begin = out.size();
  try {
    if (put_blocks(out, source, place->end())) return out;
  } catch (const MalformedBytes&) {
    // A damaged run is kept as it is; the viewer says what is wrong with it.
  }
  out.resize(begin);
  append(out, whole.subspan(static_cast<std::size_t>(place->end())));
  return out;
}

std::string without_paths_of_jsonl(std::string lines) {
  const std::size_t end = std::min(lines.find('\n'), lines.size());
  auto header = nlohmann::ordered_json::parse(lines.begin(), lines.begin() + static_cast<std::ptrdiff_t>(end));
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
  return changed ? header.dump() + lines.substr(end) : std::move(lines);
}

}  // namespace zstep
