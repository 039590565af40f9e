// An event from its line of JSON Lines: fast where programs write it as they mostly do, and by a parser that can say
// what is wrong with it.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "traces/events/vocabulary.hpp"
#include "traces/file/trace.hpp"
#include "traces/record/recorder.hpp"

namespace zstep {

/// Throws MalformedJson where the line's members are not the fields of this kind; besides them it may have the step
/// and the place in the program's source.
Event event_from_json(std::uint8_t kind, const nlohmann::json& line);

// A line of JSON Lines as programs mostly write it: one object, the step first, each field of its event once, nothing
// else. Such lines are read by simdjson, ten times as fast as by a parser that can say what is wrong with one.

class QuickLine {
 public:
  explicit QuickLine(const Page& page);
  ~QuickLine();

  /// False where the line is anything else: then it has to be looked at more closely. May lengthen the text's storage,
  /// not the text.
  bool read(std::string& line, RecordedEvent& event);
  /// The place that the line which was read last names, as it stands there; until the next one is read.
  const std::optional<std::string_view>& place() const { return place_; }

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
  std::optional<std::string_view> place_;
  std::map<std::string, const StepInfo*, std::less<>> steps_;  ///< by name, and by module and name
};

}  // namespace zstep
