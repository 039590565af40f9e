// Opening a trace: signature, header, scene, and the index, rebuilt where it is missing.
#include <algorithm>
#include <fstream>

#include <fmt/format.h>

#include "traces/codec/block_encoder.hpp"
#include "traces/error.hpp"
#include "traces/file/header_json.hpp"
#include "traces/file/scene_bytes.hpp"
#include "traces/file/trace_impl.hpp"
#include "traces/record/journal.hpp"
#include "traces/text.hpp"

namespace zstep {

namespace {

constexpr std::uint64_t head_limit = std::uint64_t{4} << 20;
constexpr std::uint64_t scene_limit = std::uint64_t{256} << 20;
constexpr std::uint64_t index_limit = std::uint64_t{256} << 20;

class FileSource : public ByteSource {
 public:
  explicit FileSource(const std::filesystem::path& path) {
    // A pipe could be waited for for ever, and has no end to begin at.
    if (std::filesystem::exists(path) && !std::filesystem::is_regular_file(path))
      throw InputError(path.string(), "is not a file that can be read at any place", "name a .ztrace file; of a pipe, make one first");
    file_.open(path, std::ios::binary);
    if (!file_) throw InputError(path.string(), "cannot be opened", "check the name and that you may read it");
    file_.seekg(0, std::ios::end);
    size_ = static_cast<std::uint64_t>(file_.tellg());
  }
  std::uint64_t size() const override { return size_; }
  Bytes read(std::uint64_t offset, std::uint64_t size) const override {
    if (offset > size_ || size > size_ - offset) throw MalformedBytes("it ends too early");
    Bytes bytes(static_cast<std::size_t>(size));
    file_.clear();
    file_.seekg(static_cast<std::streamoff>(offset));
    file_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
    if (static_cast<std::uint64_t>(file_.gcount()) != size) throw MalformedBytes("it ends too early");
    return bytes;
  }

 private:
  mutable std::ifstream file_;
  std::uint64_t size_ = 0;
};

class MemorySource : public ByteSource {
 public:
  explicit MemorySource(Bytes bytes) : bytes_(std::move(bytes)) {}
  std::uint64_t size() const override { return bytes_.size(); }
  Bytes read(std::uint64_t offset, std::uint64_t size) const override {
    if (offset > bytes_.size() || size > bytes_.size() - offset) throw MalformedBytes("it ends too early");
    const auto begin = bytes_.begin() + static_cast<std::ptrdiff_t>(offset);
    return {begin, begin + static_cast<std::ptrdiff_t>(size)};
  }

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
  for (const BlockInfo::Mark& mark : info.marks) {
    if (mark.polygon < 0 || static_cast<std::size_t>(mark.polygon) >= trace.scene.polygons.size())
      throw MalformedBytes("its index names a polygon that does not exist");
    trace.polygons.push_back({info.first_position + mark.offset + 1, mark.polygon});
    trace.boxes.push_back(mark.box);
  }
  trace.size += info.count;
  trace.steps.add(info.steps);
  info.marks = {};  // they stand in trace.polygons now
  trace.blocks.push_back({std::move(info), first_mark, place, frame_offset});
}

/// True when the file has an index and it is intact.
bool read_index(Trace::Impl& trace) {
  const auto offset = index_offset(*trace.source);
  if (!offset) return false;
  const auto place = chunk_at(*trace.source, *offset);
  if (!place || place->tag != index_tag) return false;
  try {
    const Bytes bytes = decompress(read_chunk(*trace.source, *place), index_limit);
    ByteReader in(bytes);
    const std::size_t count = in.count();
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint64_t block_offset = in.varint(), size = in.varint(), frame_offset = in.varint();
      if (block_offset > *offset || size > *offset - block_offset) return false;
      add_block(trace, {events_tag, block_offset, size}, take_block_info(in, trace.scene.raster), frame_offset);
    }
    return true;
  } catch (const MalformedBytes&) {
    return false;
  }
}

/// Walks the chunks as far as they are whole, from this offset on; false when one is not as it was written.
bool walk_blocks(Trace::Impl& trace, std::uint64_t& offset) {
  while (const auto place = chunk_at(*trace.source, offset)) {
    if (place->tag != events_tag) break;
    try {
      const Bytes bytes = read_chunk(*trace.source, *place);
      ByteReader in(bytes);
      ByteReader info_in(in.take(in.count()));
      add_block(trace, *place, take_block_info(info_in, trace.scene.raster), bytes.size() - in.left());
    } catch (const MalformedBytes&) {
      return false;
    }
    offset = place->end();
  }
  return true;
}

/// A file up to some byte, and then other bytes.
class ContinuedSource : public ByteSource {
 public:
  ContinuedSource(std::unique_ptr<ByteSource> source, std::uint64_t end, Bytes more) : source_(std::move(source)), end_(end), more_(std::move(more)) {}
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
  const std::vector<Bytes> logs = logs_in_journal(trace.name, checksum_of(head_tag, trace.source->read(0, head_end)), trace.blocks.size() + 1);
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

/// Without an index: from the blocks themselves, those of the file and then those of its journal.
void rebuild_index(Trace::Impl& trace, std::uint64_t head_end) {
  trace.blocks.clear();
  trace.polygons.clear();
  trace.boxes.clear();
  trace.size = 0;
  trace.steps = {};
  std::uint64_t offset = head_end;
  const bool damaged = !walk_blocks(trace, offset);
  if (trace.of_file && !damaged) {
    trace.source = std::make_unique<ContinuedSource>(std::move(trace.source), offset, blocks_in_journal(trace, head_end));
    walk_blocks(trace, offset);
  }
  trace.warnings.push_back(fmt::format("{}: the recording {}; {} events could be read", trace.name,
                                       damaged ? "is damaged" : "was cut off before its end", trace.size));
}

}  // namespace

Trace::Trace(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {
  try {
    const std::uint64_t offset = read_head(*impl_);
    if (!read_index(*impl_)) rebuild_index(*impl_, offset);
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
