// The options of a method: what of it can be switched. Given as text on the command line and in lessons, checked
// against the catalog, and written into the trace's conventions.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "traces/scene.hpp"

namespace zstep {

struct Option {
  std::string_view name;             ///< "root"
  std::string_view words;            ///< "first|fewest-splits|random"; empty for a whole number
  std::string_view standard;         ///< the value where none is given: "fewest-splits", "1"
  std::string_view meaning;          ///< one phrase for the command line's help
  bool same_picture = true;          ///< whatever its value, the picture stays the same
  std::int64_t least = 0, most = 0;  ///< of a whole number
};

/// The place of the option's value among its words, from 0. For an option that has words and is in the table.
std::size_t choice(std::span<const Option> table, const Conventions& conventions, std::string_view name);
/// The value of a whole number. For an option that has no words and is in the table.
std::int64_t whole_number(std::span<const Option> table, const Conventions& conventions, std::string_view name);

/// One of an enumeration whose values stand in the order of the option's words.
template <class Enumeration>
Enumeration choice_of(std::span<const Option> table, const Conventions& conventions, std::string_view name) {
  return static_cast<Enumeration>(choice(table, conventions, name));
}
/// Is an option with the words "off|on" on?
inline bool is_on(std::span<const Option> table, const Conventions& conventions, std::string_view name) {
  return choice(table, conventions, name) == 1;
}

/// Throws InputError where an option is not in the table or its value is none that it can have. `who` begins the line:
/// "--option", or a lesson's file and line.
void check_options(std::span<const Option> table, std::string_view method, const Conventions& conventions,
                   const std::string& who);

/// For methods that work with planes, whose depths are pseudodepths, directly computed at pixel centres: what must be
/// given on the command line in place of conventions that mean something else, "--coverage top-left"; empty if there
/// are none.
std::string options_for_planes(const Conventions& conventions);

}  // namespace zstep
