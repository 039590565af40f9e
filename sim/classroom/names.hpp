// What names mean at a moment of a run: the fields of the step that is spoken of, and what the run knows there.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "traces/events/fields.hpp"
#include "traces/replay/replay.hpp"

namespace zstep::classroom {

/// What an expression yields.
struct Quantity {
  enum class Type : std::uint8_t {
    number,
    truth,    ///< number is 0 or 1
    word,     ///< of an enumeration
    polygon,  ///< number is its index; shown by its name where it has one
  };
  Type type = Type::number;
  double number = 0;
  std::string word;

  static Quantity of(double number) { return {Type::number, number, {}}; }
  static Quantity of_truth(bool truth) { return {Type::truth, truth ? 1.0 : 0.0, {}}; }
  static Quantity of_polygon(std::int32_t polygon) { return {Type::polygon, static_cast<double>(polygon), {}}; }
  static Quantity of_word(std::string_view word) { return {Type::word, 0, std::string(word)}; }
};

/// A moment: a step, and the state it is looked at in. The state is only rebuilt when a name asks for it.
class Moment {
 public:
  /// `at` may be null (no step is spoken of). `position` is where the state is taken.
  Moment(Replay& replay, const RecordedEvent* at, std::int64_t position, std::string_view file_line)
      : event(at ? std::optional(*at) : std::nullopt), where(file_line), replay_(&replay), position_(position) {}

  const State& state() const {
    replay_->go_to(position_);
    return replay_->state();
  }
  const Trace& trace() const { return replay_->trace(); }
  Replay& replay() const { return *replay_; }

  std::optional<RecordedEvent> event;
  std::string_view where;  ///< FILE:LINE, for complaints

 private:
  Replay* replay_;
  std::int64_t position_;
};

/// What a field holds in an expression.
Quantity::Type type_of(const FieldOfKind& field);
/// What the event holds in a field of this name, if it has one.
std::optional<Quantity> field_value(const Event& event, std::string_view name);

/// What the run knows: `stored`, `scan_line`, `x_left`, `rho`.
struct KnownName {
  std::string_view name;
  Quantity::Type type;
  Quantity (*value)(const Moment&);  ///< throws InputError when there is no such thing at that moment
  std::string_view meaning;
};
std::span<const KnownName> known_names();
const KnownName* find_known_name(std::string_view name);

/// What can be asked of it: `depth(x, y)`, `x_s(vertex)`, `end_row(edge)`.
struct KnownFunction {
  std::string_view name;
  std::size_t arguments;
  Quantity::Type type;
  Quantity (*value)(const Moment&, std::span<const double>);
  std::string_view meaning;
};
std::span<const KnownFunction> known_functions();
const KnownFunction* find_known_function(std::string_view name);

}  // namespace zstep::classroom
