// JSON as people and programs write it by mistake: where in a text a fault is, and what was probably done.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace zstep::json_text {

/// Where the text of a document has one of its values, or that value's member `key`. 0 where that cannot be found.
std::size_t place_of(std::string_view text, const nlohmann::json& document, const nlohmann::json* value,
                     std::string_view key);

/// A key that an object has already, and where it stands again. A parser would take the last of them in silence.
struct RepeatedKey {
  std::size_t place = 0;
  std::string key;
};
/// The first one in the text of a document.
std::optional<RepeatedKey> repeated_key(std::string_view text, const nlohmann::json& document);

/// Why a text is not JSON.
struct Fault {
  std::size_t place = 0;
  bool unfinished = false;  ///< it ends within an object
  std::string what, mend;
};
/// `place`: up to where it could be read.
Fault fault_at(std::string_view text, std::size_t place);

/// Is what follows the text's first line the rest of an object that begins there, and not a new line of JSON Lines?
bool goes_on(std::string_view next_line);

/// How deep in brackets a text ends.
int open_brackets(std::string_view text);

/// Line and column, from 1, of a place in a text that begins at `line`. A column is a character, however many bytes it
/// has.
struct LineColumn {
  std::int64_t line = 1, column = 1;
};
LineColumn line_and_column(std::string_view text, std::size_t place, std::int64_t line);

/// Text of a file as it may be shown, and no more than so many characters of it.
std::string shown(std::string_view text, std::size_t most);

}  // namespace zstep::json_text
