#include "traces/record/trace_recorder.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "traces/codec/block.hpp"
#include "traces/error.hpp"
#include "traces/file/container.hpp"
#include "traces/file/files.hpp"
#include "traces/file/header_json.hpp"
#include "traces/file/scene_bytes.hpp"
#include "traces/record/journal.hpp"

namespace zstep {

namespace {
constexpr std::size_t logs_at_work = 9;
}  // namespace

/// The file of a recording. It has its name once its head is written, so that whatever has that name can be opened,
/// whenever the recording is killed; what had the name before is there until then. What is no ordinary file is written
/// as it stands.
class TraceRecorder::Output {
 public:
  explicit Output(const std::filesystem::path& path) : place_(path, Inputs::kept, Links::replaced) {
    if (place_.is_device()) {
      file_ = place_.open_device();
    } else {
      begun_ = place_.path().filename().string() + ".begun";
      file_ = place_.make_own(begun_);
    }
    std::setvbuf(file_.get(), nullptr, _IONBF, 0);  // what is written is written whole
  }
  ~Output() {
    std::error_code ignored;
    if (!begun_.empty()) std::filesystem::remove(place_.beside(begun_), ignored);
  }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  void write(const Bytes& bytes) {
    errno = 0;
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) == bytes.size() && std::fflush(file_.get()) == 0)
      return;
    failed("cannot be written any further");
  }
  void head_is_written() {
    if (begun_.empty()) return;
    place_.take(begun_);
    begun_.clear();
  }
  void close() {
    errno = 0;
    if (std::fclose(file_.release()) != 0) failed("cannot be written to its end");
  }

 private:
  [[noreturn]] void failed(std::string_view what) const {
    const char* left = place_.is_device() ? ""
                       : begun_.empty()   ? "what was written so far can be opened; "
                                          : "no trace is left, and what had this name before still has it; ";
    throw Exhausted(place_.path().string(), fmt::format("{}: {}", what, std::strerror(errno != 0 ? errno : EIO)),
                    fmt::format("{}make room there, or record to another place", left));
  }

  OutputPlace place_;
  std::string begun_;  ///< the name that it has beside its place until then
  OpenFile file_;
};

/// Where the bytes go, and the index that grows as they do. Logs are packed and written by another thread while the
/// next ones are recorded; nothing else here is touched meanwhile.
struct TraceRecorder::Sink {
  std::unique_ptr<Output> file;  ///< none: to memory
  Bytes memory;
  std::uint64_t written = 0;
  Bytes index;
  std::uint64_t blocks = 0;
  BlockEncoder encoder;
  Journal journal;                ///< the memory of the logs at work and, after them, of the one that is recorded into
  std::vector<EventLog> at_work;  ///< in turn
  std::size_t next_log = 0;
  BackgroundWorker worker{logs_at_work};  // ends first

  Sink(const Header& header, const Scene& scene, const std::filesystem::path& to)
      : file(to.empty() ? nullptr : std::make_unique<Output>(to)),
        encoder(scene, header),
        journal(to, logs_at_work + 1, EventLog::most_bytes),
        at_work(logs_in(journal)) {}
  Sink(const Sink&) = delete;
  Sink& operator=(const Sink&) = delete;
  ~Sink() {
    try {
      worker.wait();
    } catch (...) {  // a recording that ends without finish() ends where it got to
    }
  }

  static std::vector<EventLog> logs_in(const Journal& journal) {
    std::vector<EventLog> logs;
    for (std::size_t number = 0; number < logs_at_work; ++number) logs.emplace_back(journal.log(number));
    return logs;
  }

  void write(const Bytes& bytes) {
    if (file) file->write(bytes);
    else memory.insert(memory.end(), bytes.begin(), bytes.end());
    written += bytes.size();
  }

  /// All at once, so that a file that was begun is one that can be opened.
  void write_head(const Header& header, const Scene& scene) {
    const std::string json = header_to_json(header).dump();
    Bytes bytes = make_signature();
    put_chunk(bytes, head_tag, compress({reinterpret_cast<const std::uint8_t*>(json.data()), json.size()}));
    put_chunk(bytes, scene_tag, compress(scene_to_bytes(scene)));
    journal.belongs_to(checksum_of(head_tag, bytes));
    write(bytes);
    if (file) file->head_is_written();
  }

  void write_block(const EventLog& log) {
    const BlockEncoder::Packed& block = encoder.pack(log);
    Bytes info;
    put_block_info(info, block.info);
    const EventsChunk chunk = make_events_chunk(info, block.bytes);
    put_index_entry(index, written, chunk, info);
    ++blocks;
    write(make_chunk(events_tag, chunk.bytes));
  }
};

TraceRecorder::TraceRecorder(const std::filesystem::path& path, const Header& header, const Scene& scene)
    : sink_(std::make_unique<Sink>(header, scene, path)), log_(sink_->journal.log(logs_at_work)) {
  sink_->journal.holds(log_.memory(), 1);
  // At once, so that what is killed can be opened; beside the run where that takes longer than the run's first blocks.
  if (scene.points.size() + scene.corners.size() < 100'000) sink_->write_head(header, scene);
  else sink_->worker.begin([sink = sink_.get(), header, &scene] { sink->write_head(header, scene); });
}

TraceRecorder::TraceRecorder(const Header& header, const Scene& scene)
    : TraceRecorder(std::filesystem::path(), header, scene) {}

TraceRecorder::~TraceRecorder() = default;

void TraceRecorder::write_block() {
  log_.close();
  before_ += log_.count();
  sink_->worker.wait_for_room();
  EventLog& log = sink_->at_work[sink_->next_log++ % logs_at_work];  // its block is written, or there were no room
  log.swap(log_);
  log_.clear();
  sink_->journal.holds(log_.memory(), sink_->next_log + 1);
  const auto pack = [sink = sink_.get(), &log] { sink->write_block(log); };
  // What only memory holds is written as soon as can be.
  if (sink_->journal.outlives()) sink_->worker.begin_with_others(pack);
  else sink_->worker.begin(pack);
  if (on_block_) on_block_(size());
}

void TraceRecorder::finish(bool whole) {
  log_.close();
  if (log_.count() > 0) write_block();
  sink_->worker.wait();
  Bytes end;
  put_places(end, places_);
  if (whole) {
    const Bytes places = std::exchange(end, {});
    put_index(end, sink_->written, sink_->blocks, sink_->index, places);
  }
  sink_->write(end);
  if (sink_->file) sink_->file->close();
}

std::vector<std::uint8_t> TraceRecorder::take_bytes() { return std::move(sink_->memory); }

void record_any(TraceRecorder& recorder, std::uint8_t step, const Event& event) {
  visit_event([&]<class E>(const E& known) { recorder(Step<E>{step}, known); }, event);
}

}  // namespace zstep
