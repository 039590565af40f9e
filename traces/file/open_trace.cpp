// Opening a trace: signature, header, scene, and the index, rebuilt where it is missing.
#include <algorithm>

#include <fmt/format.h>

#include "traces/codec/block.hpp"
#include "traces/error.hpp"
#include "traces/file/files.hpp"
#include "traces/file/header_json.hpp"
#include "traces/file/scene_bytes.hpp"
#include "traces/file/visit.hpp"
#include "traces/record/journal.hpp"
#include "traces/text.hpp"

namespace zstep {

namespace {

constexpr std::uint64_t head_limit = std::uint64_t{4} << 20;
constexpr std::uint64_t scene_limit = std::uint64_t{256} << 20;
constexpr std::uint64_t index_limit = std::uint64_t{256} << 20;

class FileSource : public ByteSource {
 public:
  explicit FileSource(const std::filesystem::path& path) : file_(path) {}
  std::uint64_t size() const override { return file_.size(); }
  Bytes read(std::uint64_t offset, std::uint64_t size) const override {
    if (offset > file_.size() || size > file_.size() - offset) throw MalformedBytes("it ends too early");
    Bytes bytes(static_cast<std::size_t>(size));
    file_.seek(offset);
    if (file_.read(bytes.data(), bytes.size()) != bytes.size()) throw MalformedBytes("it ends too early");
    return bytes;
  }

 private:
  mutable InputFile file_;
};

class MemorySource : public ByteSource {
 public:
  explicit MemorySource(Bytes bytes) : bytes_(std::move(bytes)) {}
  std::uint64_t size() const override { return bytes_.size(); }
  Bytes read(std::uint64_t offset, std::uint64_t size) const override { return MemoryView(bytes_).read(offset, size); }

 private:
  Bytes bytes_;
};

/// Reads signature, header and scene; returns the offset after them.
std::uint64_t read_head(Trace::Impl& trace) {
  const ByteSource& source = *trace.source;
  const std::uint64_t signature_size = trace_signature.size() + 4;
  const Bytes signature = source.read(0, std::min<std::uint64_t>(signature_size, source.size()));
  if (signature.size() < signature_size ||
      !std::equal(trace_signature.begin(), trace_signature.end(), signature.begin())) {
    throw InputError(trace.name, "is not a zstep trace",
                     "give a .ztrace file; a scene or mesh is recorded with `zstep record`");
  }
  ByteReader version_in(std::span<const std::uint8_t>(signature).subspan(trace_signature.size()));
  const std::uint32_t version = version_in.u32();
  if (version != trace_version) {
    throw InputError(
        trace.name,
        fmt::format("is a trace of version {}; this zstep {} reads version {}", version, ZSTEP_VERSION, trace_version),
        "open it with the zstep that wrote it");
  }
  const auto head = chunk_at(source, signature_size);
  if (!head || head->tag != head_tag) throw MalformedBytes("its header is missing");
  const Bytes json = decompress(read_chunk(source, *head), head_limit);
  trace.header = header_from_json(parse_bounded({json.begin(), json.end()}));
  const auto scene = chunk_at(source, head->end());
  if (!scene || scene->tag != scene_tag) throw MalformedBytes("its scene is missing");
  trace.scene = scene_from_bytes(decompress(read_chunk(source, *scene), scene_limit));
  make_printable(trace.header);
  make_printable(trace.scene);
  trace.meanings.emplace(trace.header.page);
  trace.facts.emplace(trace.scene, trace.header);
  return scene->end();
}

void add_block(Trace::Impl& trace, const ChunkPlace& place, BlockInfo info, std::uint64_t frame_offset) {
  if (info.first_position != trace.size || info.count == 0)
    throw MalformedBytes("its blocks do not follow one another");
  // So no more blocks than the file has room for.
  if (!trace.blocks.empty() && place.offset < trace.blocks.back().place.end())
    throw MalformedBytes("its blocks overlap");
  const std::size_t first_mark = trace.polygons.size();
  for (const BlockInfo::Mark& mark : info.marks)
    if (mark.polygon < 0 || mark.polygon >= std::ssize(trace.scene.polygons))
      throw MalformedBytes("its index names a polygon that does not exist");
  for (const BlockInfo::Mark& mark : info.marks) {
    trace.polygons.push_back({info.first_position + mark.offset + 1, mark.polygon});
    trace.boxes.push_back(mark.box);
  }
  trace.size += info.count;
  trace.steps.add(info.steps);
  info.marks = {};  // they stand in trace.polygons now
  trace.blocks.push_back({std::move(info), first_mark, place, frame_offset});
}

bool is_whole(const ByteSource& source, const ChunkPlace& place) {
  try {
    read_chunk(source, place);
    return true;
  } catch (const MalformedBytes&) {
    return false;
  }
}

/// Does the block begin as the index says? One that is damaged says nothing, and is lost once it is asked for.
bool block_agrees(const ByteSource& source, const ChunkPlace& place, std::span<const std::uint8_t> info,
                  std::uint64_t frame_offset) {
  Bytes told;
  put_varint(told, info.size());
  told.insert(told.end(), info.begin(), info.end());
  if (frame_offset != told.size() || place.size < told.size()) return !is_whole(source, place);
  const Bytes bytes = source.read(place.offset, chunk_head_size + told.size());
  return std::equal(told.begin(), told.end(), bytes.begin() + chunk_head_size) || !is_whole(source, place);
}

/// True when the file has an index, it is intact, and the blocks agree with it: they stand one after the other, as
/// many, and begin so.
bool read_index(Trace::Impl& trace, std::uint64_t head_end) {
  const auto offset = index_offset(*trace.source);
  if (!offset) return false;
  const auto place = chunk_at(*trace.source, *offset);
  if (!place || place->tag != index_tag) return false;
  try {
    // What it says of a block stands in the block, too, and takes no more room there.
    const std::uint64_t limit = std::min(index_limit, 64 + 2 * (*offset - std::min(*offset, head_end)));
    const Bytes bytes = decompress(read_chunk(*trace.source, *place), limit);
    ByteReader in(bytes);
    const std::size_t count = in.count();
    std::uint64_t end = head_end;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint64_t block_offset = in.varint(), size = in.varint(), frame_offset = in.varint();
      if (block_offset != end || block_offset > *offset || size > *offset - block_offset) return false;
      const std::span<const std::uint8_t> rest = std::span(bytes).last(in.left());
      BlockInfo info = take_block_info(in, trace.scene.raster);
      const ChunkPlace block{events_tag, block_offset, size};
      end = block.end();
      if (end > *offset || !block_agrees(*trace.source, block, rest.first(rest.size() - in.left()), frame_offset))
        return false;
      add_block(trace, block, std::move(info), frame_offset);
    }
    return end == *offset;
  } catch (const MalformedBytes&) {
    return false;
  }
}

/// The next block that is as it was written, from this offset on. No more is read for it than a few times the file.
std::optional<std::uint64_t> find_block(const ByteSource& source, std::uint64_t offset, std::uint64_t& left_to_read) {
  constexpr std::uint64_t window = 1 << 16;
  while (offset + chunk_head_size <= source.size()) {
    const Bytes bytes = source.read(offset, std::min(window, source.size() - offset));
    for (auto at = bytes.begin();
         (at = std::search(at, bytes.end(), events_tag.begin(), events_tag.end())) != bytes.end(); ++at) {
      const auto place = chunk_at(source, offset + static_cast<std::uint64_t>(at - bytes.begin()));
      if (!place) continue;
      if (place->size > left_to_read) return std::nullopt;
      left_to_read -= place->size;
      if (is_whole(source, *place)) return place->offset;
    }
    if (bytes.size() < window) break;
    offset += window - events_tag.size();
  }
  return std::nullopt;
}

/// Room for steps that are known to have been there: whoever reads them finds that they are lost.
void add_lost(Trace::Impl& trace, std::int64_t steps, std::uint64_t offset) {
  while (steps > 0) {
    Trace::Impl::Block block;
    block.info.first_position = trace.size;
    block.info.count = static_cast<std::uint32_t>(std::min<std::int64_t>(steps, block_events));
    block.info.steps.words().fill(~std::uint64_t{0});
    block.info.tiles = Tiles(trace.scene.raster);
    block.info.keeps_to_marks = false;
    for (std::int32_t y = 0; y < trace.scene.raster.height; ++y) block.info.touch(0, trace.scene.raster.width, y);
    block.first_mark = trace.polygons.size();
    block.place = {events_tag, offset, 0};
    block.lost = true;
    trace.any_lost = true;
    trace.size += block.info.count;
    steps -= block.info.count;
    trace.blocks.push_back(std::move(block));
  }
}

/// Takes the blocks from this offset on, which becomes where they end. What is damaged between them is passed over.
void walk_blocks(Trace::Impl& trace, std::uint64_t& offset) {
  const ByteSource& source = *trace.source;
  std::uint64_t left_to_read = 4 * source.size(), begin = offset;
  const auto take = [&](const ChunkPlace& place) {
    try {
      const Bytes bytes = read_chunk(source, place);
      ByteReader in(bytes);
      ByteReader info_in(in.take(in.count()));
      BlockInfo info = take_block_info(info_in, trace.scene.raster);
      // No more steps are missing than the bytes between could have held.
      const std::int64_t most = static_cast<std::int64_t>((place.offset - offset) / chunk_head_size) * block_events;
      const std::int64_t missing = info.first_position - trace.size;
      if (missing > most || missing < 0) return false;
      if (missing > 0) {
        trace.whole = false;
        trace.warnings.push_back(fmt::format("{}: steps {} to {} are lost: the file is damaged there", trace.name,
                                             trace.size + 1, trace.size + missing));
        add_lost(trace, missing, offset);
      }
      add_block(trace, place, std::move(info), bytes.size() - in.left());
      return true;
    } catch (const MalformedBytes&) {
      return false;
    }
  };
  while (true) {
    const auto place = chunk_at(source, begin);
    if (place && place->tag == events_tag && take(*place)) {
      begin = offset = place->end();
      continue;
    }
    if (place && place->tag == index_tag && place->end() + trailer_size >= source.size()) return;
    const auto next = find_block(source, begin + 1, left_to_read);
    if (!next) return;
    begin = *next;
  }
}

/// A file up to some byte, and then other bytes.
class ContinuedSource : public ByteSource {
 public:
  ContinuedSource(std::unique_ptr<ByteSource> source, std::uint64_t end, Bytes more)
      : source_(std::move(source)), end_(end), more_(std::move(more)) {}
  std::uint64_t size() const override { return end_ + more_.size(); }
  Bytes read(std::uint64_t offset, std::uint64_t size) const override {
    const std::uint64_t of_file = offset < end_ ? std::min(size, end_ - offset) : 0;
    Bytes bytes = of_file > 0 ? source_->read(offset, of_file) : Bytes();
    if (of_file == size) return bytes;
    const Bytes rest = more_.read(offset + of_file - end_, size - of_file);
    bytes.insert(bytes.end(), rest.begin(), rest.end());
    return bytes;
  }

 private:
  std::unique_ptr<ByteSource> source_;
  std::uint64_t end_;
  MemorySource more_;
};

/// The blocks that a recording had in memory when it was killed, as they would have followed.
Bytes blocks_in_journal(const Trace::Impl& trace, std::uint64_t head_end) {
  Bytes chunks;
  const std::vector<Bytes> logs =
      logs_in_journal(trace.name, checksum_of(head_tag, trace.source->read(0, head_end)), trace.blocks.size() + 1);
  BlockEncoder encoder(trace.scene, trace.header, trace.size);
  for (const Bytes& bytes : logs) {
    const EventLog log(bytes, trace.meanings->kind);
    if (log.count() == 0) break;
    const BlockEncoder::Packed& block = encoder.pack(log);
    Bytes info;
    put_block_info(info, block.info);
    put_chunk(chunks, events_tag, make_events_chunk(info, block.bytes).bytes);
  }
  return chunks;
}

/// Is what stands behind the blocks an index and the file's end, though not as they were written?
bool has_end(const ByteSource& source, std::uint64_t offset) {
  if (index_offset(source) == offset) return true;
  const auto place = chunk_at(source, offset);
  return place && (place->tag == index_tag || place->end() + trailer_size == source.size());
}

/// Without an index that can be believed: from the blocks themselves, those of the file and then those of its journal.
void rebuild_index(Trace::Impl& trace, std::uint64_t head_end) {
  trace.blocks.clear();
  trace.polygons.clear();
  trace.boxes.clear();
  trace.size = 0;
  trace.steps = {};
  std::uint64_t offset = head_end;
  walk_blocks(trace, offset);
  if (has_end(*trace.source, offset)) {
    const std::string kept = trace.whole ? fmt::format("all {} events are there", trace.size)
                                         : fmt::format("{} events are there or known to be lost", trace.size);
    trace.warnings.push_back(
        fmt::format("{}: its index is damaged and was made anew from its blocks; {}", trace.name, kept));
    return;
  }
  trace.whole = false;
  const std::uint64_t file_end = offset;
  const auto places = chunk_at(*trace.source, offset);
  const bool more =
      places && places->tag == places_tag ? places->end() < trace.source->size() : offset < trace.source->size();
  if (trace.of_file && !trace.any_lost) {
    trace.source =
        std::make_unique<ContinuedSource>(std::move(trace.source), offset, blocks_in_journal(trace, head_end));
    walk_blocks(trace, offset);
  }
  const std::string journal =
      offset > file_end ? fmt::format(", the last of them in {}", journal_of(trace.name).string()) : "";
  trace.warnings.push_back(
      fmt::format("{}: the recording {}; {} events could be read{}", trace.name,
                  more && journal.empty() ? "was cut off or is damaged before its end" : "was cut off before its end",
                  trace.size, journal));
}

/// Where the program printed its steps, if the file says so. Who cannot read that has the steps all the same.
void read_places(Trace::Impl& trace, std::uint64_t head_end) {
  const auto chunk = find_places(*trace.source, index_offset(*trace.source).value_or(head_end));
  if (!chunk) return;
  try {
    trace.places = take_places(*trace.source, *chunk);
  } catch (const MalformedBytes& error) {
    trace.warnings.push_back(fmt::format(
        "{}: where its program printed its steps cannot be read: {}; they are told without", trace.name, error.what()));
  }
}

constexpr std::size_t few_blocks = 8;  // that are read whole at once, so that nothing in them is taken on trust

}  // namespace

Trace::Trace(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {
  try {
    const std::uint64_t offset = read_head(*impl_);
    read_places(*impl_, offset);
    if (!read_index(*impl_, offset)) rebuild_index(*impl_, offset);
    if (impl_->blocks.size() <= few_blocks) impl_->refuse_lies();
  } catch (const MalformedBytes& error) {
    throw InputError(impl_->name, fmt::format("is damaged: {}", error.what()), mend_trace);
  } catch (const MalformedJson& error) {
    throw InputError(impl_->name, fmt::format("has a header that cannot be used: {}", error.what()), mend_trace);
  } catch (const nlohmann::json::exception&) {
    throw InputError(impl_->name, "is damaged: its header is not JSON", mend_trace);
  }
}

Trace Trace::open(const std::filesystem::path& path) {
  auto impl = std::make_unique<Impl>();
  impl->name = path.string();
  impl->source = std::make_unique<FileSource>(path);
  impl->of_file = true;
  return Trace(std::move(impl));
}

Trace Trace::from_bytes(std::vector<std::uint8_t> bytes, const std::string& name, const std::string& cut) {
  auto impl = std::make_unique<Impl>();
  impl->name = name;
  impl->source = std::make_unique<MemorySource>(std::move(bytes));
  Trace trace(std::move(impl));
  if (!cut.empty() && !trace.impl_->warnings.empty()) trace.impl_->warnings = {cut};
  return trace;
}

}  // namespace zstep
