#include "traces/record/trace_recorder.hpp"

#include <cstdio>
#include <future>
#include <system_error>
#include <utility>
#include <variant>

#include "traces/error.hpp"
#include "traces/file/chunk.hpp"
#include "traces/file/header_json.hpp"
#include "traces/file/scene_bytes.hpp"

namespace zstep {

/// Where the bytes go, and the index that grows as they do. A block is compressed and written by another thread while the next
/// one is recorded; nothing here is touched meanwhile.
struct TraceRecorder::Sink {
  std::filesystem::path path;
  std::FILE* file = nullptr;
  Bytes memory;
  std::uint64_t written = 0;
  Bytes index;
  std::uint64_t blocks = 0;
  Bytes info_at_work, packed_at_work;
  std::future<void> writing;

  Sink() = default;
  Sink(const Sink&) = delete;
  Sink& operator=(const Sink&) = delete;
  ~Sink() {
    if (writing.valid()) writing.wait();
    if (file != nullptr) std::fclose(file);
  }

  void write(const Bytes& bytes) {
    if (file == nullptr) {
      memory.insert(memory.end(), bytes.begin(), bytes.end());
    } else if (std::fwrite(bytes.data(), 1, bytes.size(), file) != bytes.size() || std::fflush(file) != 0) {
      throw InputError(path.string(), "the trace could not be written any further (is the disk full?)",
                       "what was written so far can be opened; free some space or record to another place");
    }
    written += bytes.size();
  }

  void write_block() {
    const Bytes& info = info_at_work;
    Bytes bytes;
    put_varint(bytes, info.size());
    bytes.insert(bytes.end(), info.begin(), info.end());
    const Bytes frame = compress(packed_at_work);
    bytes.insert(bytes.end(), frame.begin(), frame.end());

    put_varint(index, written);
    put_varint(index, info.size());
    index.insert(index.end(), info.begin(), info.end());
    ++blocks;
    write(make_chunk(events_tag, bytes));
  }

  /// Waits for the block before and throws what went wrong with it; then begins to write this one.
  void begin_block(Bytes info, Bytes packed) {
    wait();
    info_at_work = std::move(info), packed_at_work = std::move(packed);
    try {
      writing = std::async(std::launch::async, [this] { write_block(); });
    } catch (const std::system_error&) {  // no thread is to be had
      write_block();
    }
  }
  void wait() {
    if (writing.valid()) writing.get();
  }
};

TraceRecorder::TraceRecorder(const std::filesystem::path& path, const Header& header, const Scene& scene)
    : sink_(std::make_unique<Sink>()),
      encoder_(header.conventions.interpolation == Conventions::Interpolation::increments) {
  sink_->path = path;
  sink_->file = std::fopen(path.string().c_str(), "wb");
  if (sink_->file == nullptr)
    throw InputError(path.string(), "cannot be written", "name a file in a folder that exists and is yours");
  begin(header, scene);
}

TraceRecorder::TraceRecorder(const Header& header, const Scene& scene)
    : sink_(std::make_unique<Sink>()),
      encoder_(header.conventions.interpolation == Conventions::Interpolation::increments) {
  begin(header, scene);
}

TraceRecorder::~TraceRecorder() = default;

void TraceRecorder::begin(const Header& header, const Scene& scene) {
  sink_->write(make_signature());
  const std::string head = header_to_json(header).dump();
  sink_->write(make_chunk(head_tag, compress({reinterpret_cast<const std::uint8_t*>(head.data()), head.size()})));
  sink_->write(make_chunk(scene_tag, compress(scene_to_bytes(scene))));
}

void TraceRecorder::write_block() {
  Bytes info;
  put_block_info(info, encoder_.info());
  sink_->begin_block(std::move(info), encoder_.take());
  if (on_block_) on_block_(size());
}

void TraceRecorder::finish() {
  if (encoder_.size() > 0) write_block();
  sink_->wait();
  const std::uint64_t offset = sink_->written;
  Bytes index;
  put_varint(index, sink_->blocks);
  index.insert(index.end(), sink_->index.begin(), sink_->index.end());
  sink_->write(make_chunk(index_tag, compress(index)));
  sink_->write(make_trailer(offset));
  if (sink_->file != nullptr) {
    std::FILE* file = std::exchange(sink_->file, nullptr);
    if (std::fclose(file) != 0)
      throw InputError(sink_->path.string(), "the end of the trace could not be written", "is the disk full?");
  }
}

std::vector<std::uint8_t> TraceRecorder::take_bytes() { return std::move(sink_->memory); }

void record_any(TraceRecorder& recorder, std::uint8_t step, const Event& event) {
  std::visit([&]<class E>(const E& known) { recorder(Step<E>{step}, known); }, event);
}

}  // namespace zstep
