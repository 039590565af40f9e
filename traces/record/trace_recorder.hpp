// Records a run as a trace: the Recorder that writes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "traces/record/event_log.hpp"
#include "traces/file/header.hpp"
#include "traces/file/source_places.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

namespace zstep {

class TraceRecorder {
 public:
  /// To a file, written block by block under its own name; what is not written yet stands in a journal beside it, so
  /// that a recording that is killed or falls keeps all but the pixels of its last span. Throws InputError when the
  /// file cannot be written. The scene must live as long as the recorder does: it foretells events.
  TraceRecorder(const std::filesystem::path& path, const Header& header, const Scene& scene);
  TraceRecorder(const std::filesystem::path& path, const Header& header, Scene&& scene) = delete;
  /// To memory.
  TraceRecorder(const Header& header, const Scene& scene);
  TraceRecorder(const Header& header, Scene&& scene) = delete;
  ~TraceRecorder();
  TraceRecorder(const TraceRecorder&) = delete;
  TraceRecorder& operator=(const TraceRecorder&) = delete;

  template <class E>
  void operator()(Step<E> step, const E& event) {
    if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, PieceDraw> || std::is_same_v<E, RayBegin>) {
      if (log_.may_end()) write_block();
    }
    if (log_.put(step.id, event)) [[unlikely]]
      write_block();
  }

  /// Events recorded so far, without those of a span that is at work.
  std::int64_t size() const { return before_ + log_.count(); }

  /// Called after every block with the number of events so far: for progress, or to stop the run by throwing. finish()
  /// may still be called after that.
  void on_block(std::function<void(std::int64_t)> callback) { on_block_ = std::move(callback); }

  /// Where in the program's source the steps were printed, which a run may say; it is written when the run is over.
  SourcePlaces& places() { return places_; }

  /// Writes the last block and the index. Call it when the run is over: without it the file is as a killed run leaves
  /// it; so is that of a run which is not `whole`, but for its last block.
  void finish(bool whole = true);

  /// After finish(), of a recording to memory: the file's bytes.
  std::vector<std::uint8_t> take_bytes();

 private:
  class Output;
  struct Sink;
  void write_block();

  std::unique_ptr<Sink> sink_;
  EventLog log_;
  std::int64_t before_ = 0;  ///< events of the blocks before
  SourcePlaces places_;
  std::function<void(std::int64_t)> on_block_;
};

/// Records an event whose kind is known only at run time (JSONL in, tests).
void record_any(TraceRecorder& recorder, std::uint8_t step, const Event& event);

}  // namespace zstep
