// The module by which SQLite reads a trace: one virtual table for each kind of event, whose rows are read where they
// lie, with what was at work at each.
#pragma once

#include <cstdint>
#include <exception>
#include <limits>
#include <optional>
#include <vector>

#include "sim/query/database.hpp"
#include "traces/file/trace.hpp"

namespace zstep::query {

// The events of one kind in a part of a trace, one after another, with what was at work at each.

/// Which events are wanted at all; what is not excluded may still be walked over.
struct Part {
  std::int64_t first = 1, last = std::numeric_limits<std::int64_t>::max();  ///< steps, both included
  std::optional<std::int32_t> x, y;                                         ///< of the event's pixel
  std::optional<std::int32_t> polygon;                                      ///< at work
};

class Walk {
 public:
  /// `kind` of events; nothing is read yet.
  Walk(const Trace& trace, std::uint8_t kind, const Part& part);

  /// Goes to the next event of the kind. False when there is none. Throws InputError where the trace is damaged.
  bool next();
  const Context& context() const { return at_->context; }
  const Event& event() const { return at_->event; }

 private:
  struct Found {
    Context context;
    Event event;
  };
  bool enter_block();
  void begin_context();
  void read_to(std::int64_t end);

  const Trace& trace_;
  std::uint8_t kind_;
  Part part_;
  std::vector<std::string_view> names_;  ///< by step id
  std::vector<std::uint8_t> steps_;      ///< that record the kind
  bool has_scan_lines_ = false;
  std::int64_t position_;       ///< the last that was looked at
  std::int64_t end_of_turns_;   ///< where no polygon is at work any more
  std::int64_t known_to_ = -1;  ///< the position at which context_ is what is at work
  Context context_;
  std::vector<Found> found_;  ///< of the block at hand
  std::size_t next_ = 0;      ///< of those
  const Found* at_ = nullptr;
};

}  // namespace zstep::query

struct sqlite3;

namespace zstep::query {

/// Makes a table of every kind that the trace can record. The trace must outlive the connection. What goes wrong in the
/// trace while a table is read (damage) is put into `fault` and ends the statement.
void make_tables(sqlite3* connection, const Trace& trace, std::exception_ptr& fault);

}  // namespace zstep::query
