// Memory for what a recording has not written yet, kept so that it outlives the recording: a process that is killed, or
// falls, takes its own memory with it, but not that of a file which it has mapped.
//
// The file stands beside the trace, as "run.ztrace.journal", while it is recorded. Whoever opens a trace without an end
// finds in it the blocks that come next (file/open_trace.cpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "traces/file/bytes.hpp"

namespace zstep {

class Journal {
 public:
  /// Room for `logs` logs of `log_size` bytes. Where the trace will be no ordinary file (an empty path: none at
  /// all), or the system gives no such memory, it is memory as any other.
  Journal(const std::filesystem::path& trace, std::size_t logs, std::size_t log_size);
  /// Whatever is not written by now was lost for another reason: the file goes.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// What the logs hold can be read after the recording was killed.
  bool outlives() const { return mapped_ != nullptr; }
  std::uint8_t* log(std::size_t number) const { return logs_ + number * log_size_; }
  /// From now on this memory holds the block of this number, the first being 1; call it when the log in it is empty.
  void holds(const std::uint8_t* log, std::uint64_t block);
  /// That is the trace it belongs to, by the checksum of its head.
  void belongs_to(std::uint64_t head_checksum);

 private:
  std::size_t log_size_;
  std::filesystem::path path_;
  std::uint8_t* mapped_ = nullptr;  ///< the file, if there is one
  std::size_t mapped_size_ = 0;
  std::unique_ptr<std::uint8_t[]> own_;
  std::uint8_t* logs_ = nullptr;
};

std::filesystem::path journal_of(const std::filesystem::path& trace);

/// The logs of blocks `first`, `first + 1` and so on that the journal of a trace holds, as they stood in memory; none
/// where there is no journal, or it is another trace's or another zstep's. They are hostile until checked.
std::vector<Bytes> logs_in_journal(const std::filesystem::path& trace, std::uint64_t head_checksum,
                                   std::uint64_t first);

}  // namespace zstep
