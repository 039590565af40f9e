// The fields of events as numbers of a chain, and the step that last wrote what a formula takes as its operands.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/answers/origin/work.hpp"

namespace zstep::answers {

/// Its value as a number: that of a word is its place among the words, true is 1. Nothing where the event has no such
/// field.
std::optional<double> field_number(const Event& event, std::string_view name);
/// Of a field that is one of several words, the word; else "".
std::string field_word(const Event& event, std::string_view name);
/// What it is called in a chain: "x_L" for x_left, "1/m" for dx_dy. `depth` is what depths are called.
std::string shown_name(const Event& event, std::string_view name, const std::string& depth);
/// Tells where it comes from.
void tell_field(Datum& datum, Work& work, std::int64_t step, const Event& event, std::string_view name);

/// All of an event's fields, by name.
std::vector<std::string> fields_in(const Event& event);
/// Those that are numbers with a point.
std::vector<std::string> real_fields_in(const Event& event);
/// The one that is asked about where none is named; "" where the event has none.
std::string main_field(const Event& event);

}  // namespace zstep::answers
