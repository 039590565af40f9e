// The fields of events as numbers, read fast: one look-up when a condition is bound, one call an event after that.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "sim/classroom/names.hpp"
#include "traces/events/vocabulary.hpp"

namespace zstep::places {

struct Field {
  std::string_view name;
  classroom::FieldType type;      ///< truths are 0 and 1, words their place among the words
  double (*read)(const Event&) = nullptr;  ///< of an event of this kind and no other
  std::string_view unit;          ///< "px", "row", "depth", "world" …
};

/// The fields of a kind, in the order of the vocabulary.
std::span<const Field> fields_of_kind(std::uint8_t kind);
/// The one of this name; nullptr where the kind has none.
const Field* field_of_kind(std::uint8_t kind, std::string_view name);

}  // namespace zstep::places
