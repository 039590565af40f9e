#include "traces/record/trace_recorder.hpp"

#include <array>
#include <cstdio>
#include <utility>
#include <variant>

#include "traces/codec/block_encoder.hpp"
#include "traces/error.hpp"
#include "traces/file/chunk.hpp"
#include "traces/file/header_json.hpp"
#include "traces/file/scene_bytes.hpp"
#include "traces/record/beside.hpp"

namespace zstep {

namespace {
constexpr std::size_t logs_at_work = 3;
}

/// Where the bytes go, and the index that grows as they do. Logs are packed and written by another thread while the next ones are
/// recorded; nothing else here is touched meanwhile.
struct TraceRecorder::Sink {
  std::filesystem::path path;
  std::FILE* file = nullptr;
  Bytes memory;
  std::uint64_t written = 0;
  Bytes index;
  std::uint64_t blocks = 0;
  BlockEncoder encoder;
  std::array<EventLog, logs_at_work> at_work;  ///< in turn
  std::size_t next_log = 0;
  Beside beside{logs_at_work};  // ends first

  Sink(const Header& header, const Scene& scene) : encoder(scene, header) {}
  Sink(const Sink&) = delete;
  Sink& operator=(const Sink&) = delete;
  ~Sink() {
    try {
      beside.wait();
    } catch (...) {  // a recording that ends without finish() ends where it got to
    }
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

  /// All at once, so that a file that was begun is one that can be opened.
  void write_head(const Header& header, const Scene& scene) {
    const std::string json = header_to_json(header).dump();
    Bytes bytes = make_signature();
    put_chunk(bytes, head_tag, compress({reinterpret_cast<const std::uint8_t*>(json.data()), json.size()}));
    put_chunk(bytes, scene_tag, compress(scene_to_bytes(scene)));
    write(bytes);
  }

  void write_block(const EventLog& log) {
    const BlockEncoder::Packed& block = encoder.pack(log);
    Bytes info;
    put_block_info(info, block.info);
    const Bytes frame = compress(block.bytes, Compression::fast);
    Bytes bytes;
    put_varint(bytes, info.size());
    bytes.insert(bytes.end(), info.begin(), info.end());

    const std::size_t frame_begins = bytes.size();
    bytes.insert(bytes.end(), frame.begin(), frame.end());
    put_varint(index, written);
    put_varint(index, bytes.size());
    put_varint(index, frame_begins);
    index.insert(index.end(), info.begin(), info.end());
    ++blocks;
    write(make_chunk(events_tag, bytes));
  }
};

TraceRecorder::TraceRecorder(const std::filesystem::path& path, const Header& header, const Scene& scene)
    : sink_(std::make_unique<Sink>(header, scene)) {
  sink_->path = path;
  sink_->file = std::fopen(path.string().c_str(), "wb");
  if (sink_->file == nullptr)
    throw InputError(path.string(), "cannot be written", "name a file in a folder that exists and is yours");
  std::setvbuf(sink_->file, nullptr, _IONBF, 0);  // what is written is written whole
  sink_->beside.begin([sink = sink_.get(), header, &scene] { sink->write_head(header, scene); });
}

TraceRecorder::TraceRecorder(const Header& header, const Scene& scene)
    : sink_(std::make_unique<Sink>(header, scene)) {
  sink_->beside.begin([sink = sink_.get(), header, &scene] { sink->write_head(header, scene); });
}

TraceRecorder::~TraceRecorder() = default;

void TraceRecorder::write_block() {
  log_.close();
  before_ += log_.count();
  sink_->beside.wait_for_room();
  EventLog& log = sink_->at_work[sink_->next_log++ % logs_at_work];  // its block is written, or there were no room
  log.swap(log_);
  log_.clear();
  sink_->beside.begin([sink = sink_.get(), &log] { sink->write_block(log); });
  if (on_block_) on_block_(size());
}

void TraceRecorder::finish() {
  log_.close();
  if (log_.count() > 0) write_block();
  sink_->beside.wait();
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
