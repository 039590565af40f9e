// The fields of events as a table, for what asks for them by name or number while it runs, and as a document for
// people. Where the kind is known when it is compiled, slots.hpp has them as constants; that costs code for every kind
// and every use, so only what is done for millions of events takes it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "traces/events/vocabulary.hpp"

namespace zstep {

struct FieldOfKind {
  enum class Type : std::uint8_t { whole, real, truth, word };
  std::string_view name, unit, meaning;  ///< as in Field
  Thing thing;
  As as;
  Guess guess;
  Type type;
  std::span<const std::string_view> words;  ///< that it may be, in value order, where it is one
  /// The value in an event of this kind and no other: truths are 0 and 1, words their place among the words.
  double (*read)(const Event&);
  void (*write)(Event&, double);

  std::string_view word_in(const Event& event) const { return words[static_cast<std::size_t>(read(event))]; }
  bool true_in(const Event& event) const { return read(event) != 0; }
  std::int32_t whole_in(const Event& event) const { return static_cast<std::int32_t>(read(event)); }
};

/// The fields of a kind, in file order.
std::span<const FieldOfKind> fields_of_kind(std::size_t kind);
/// The one of this name; nullptr where the kind has none.
const FieldOfKind* field_of_kind(std::size_t kind, std::string_view name);

const Description& description_of_kind(std::size_t kind);
/// The names of all kinds, by number.
std::span<const std::string_view, kind_count> kind_names();

/// A default event of the kind.
Event event_of_kind(std::size_t kind);

// The vocabulary as a table for people, generated from its description.

/// Markdown: a heading and a table of fields for every kind of event, in the vocabulary's order. It is the last section
/// of docs/trace-format.md; a test holds the two together.
std::string vocabulary_markdown();

}  // namespace zstep
