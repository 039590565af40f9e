// Records a run as a trace: the Recorder that writes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "traces/file/header.hpp"
#include "traces/record/recorder.hpp"
#include "traces/scene.hpp"

namespace zstep {

class TraceRecorder {
 public:
  /// To a file: written block by block under its own name, so that a killed recording keeps all but its last block.
  TraceRecorder(const std::filesystem::path& path, const Header& header, const Scene& scene);
  /// To memory.
  TraceRecorder(const Header& header, const Scene& scene);
  ~TraceRecorder();
  TraceRecorder(const TraceRecorder&) = delete;
  TraceRecorder& operator=(const TraceRecorder&) = delete;

  template <class E>
  void operator()(Step<E> step, const E& event);

  std::int64_t size() const;  ///< events recorded so far

  /// Writes the last block and the index. Must be called; throws InputError when the disk is full.
  void finish();
  /// After finish(), for a recording to memory: the file's bytes.
  std::vector<std::uint8_t> take_bytes();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace zstep
