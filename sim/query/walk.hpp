// The events of one kind in a part of a trace, one after another, with what was at work at each.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "sim/query/columns.hpp"

namespace zstep::query {

/// Which events are wanted at all; what is not excluded may still be walked over.
struct Part {
  std::int64_t first = 1, last = std::numeric_limits<std::int64_t>::max();  ///< steps, both included
  std::optional<std::int32_t> x, y;     ///< of the event's pixel
  std::optional<std::int32_t> polygon;  ///< at work
};

class Walk {
 public:
  /// `kind` of events; nothing is read yet.
  Walk(const Trace& trace, std::uint8_t kind, const Part& part);

  /// Goes to the next event of the kind. False when there is none. Throws InputError where the trace is damaged.
  bool next();
  const Context& context() const { return context_; }
  const Event& event() const { return *event_; }

 private:
  bool enter_block();
  void begin_context();
  void follow(const Event& event);

  const Trace& trace_;
  std::uint8_t kind_;
  Part part_;
  std::vector<std::string_view> names_;  ///< by step id
  bool has_scan_lines_ = false;
  std::int64_t position_;                ///< the last that was looked at
  std::int64_t block_end_ = 0;           ///< the last position of the block at hand
  std::shared_ptr<const std::vector<RecordedEvent>> events_;  ///< of that block
  std::int64_t block_first_ = 0;         ///< the position before its first event
  std::size_t mark_ = 0;  ///< how many polygons have begun
  Context context_;
  const Event* event_ = nullptr;
};

}  // namespace zstep::query
