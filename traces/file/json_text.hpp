// Reading JSON with complaints that help: where in a text a fault is and what was probably done, and members of
// objects, taken by name.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "traces/file/header_json.hpp"
#include "traces/text.hpp"

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

namespace zstep::json_members {

// Members of JSON objects, taken with a complaint that names them. Only for the readers of this folder.

using nlohmann::json;

inline const json& member(const json& object, const char* key) {
  if (!object.is_object() || !object.contains(key))
    throw MalformedJson(object, "", fmt::format("\"{}\" is missing", key));
  return object.at(key);
}

inline std::string text(const json& object, const char* key) {
  const json& value = member(object, key);
  if (!value.is_string()) throw MalformedJson(object, key, fmt::format("\"{}\" is not a text", key));
  return value.get<std::string>();
}

inline std::string text_or(const json& object, const char* key, const std::string& otherwise) {
  return object.is_object() && object.contains(key) ? text(object, key) : otherwise;
}

inline double real(const json& object, const char* key) { return real_from_json(member(object, key), key); }
inline double real_or(const json& object, const char* key, double otherwise) {
  return object.is_object() && object.contains(key) ? real(object, key) : otherwise;
}

inline std::int32_t whole_from(const json& value, const char* key) {
  if (!value.is_number_integer()) throw MalformedJson(value, "", fmt::format("\"{}\" is not a whole number", key));
  const auto wide = value.get<std::int64_t>();
  if (wide < INT32_MIN || wide > INT32_MAX || (value.is_number_unsigned() && value.get<std::uint64_t>() > INT32_MAX)) {
    throw MalformedJson(value, "", fmt::format("\"{}\" is out of range", key));
  }
  return static_cast<std::int32_t>(wide);
}
inline std::int32_t whole(const json& object, const char* key) { return whole_from(member(object, key), key); }
inline std::int32_t whole_or(const json& object, const char* key, std::int32_t otherwise) {
  return object.is_object() && object.contains(key) ? whole(object, key) : otherwise;
}

inline bool truth_or(const json& object, const char* key, bool otherwise) {
  if (!object.is_object() || !object.contains(key)) return otherwise;
  if (!object.at(key).is_boolean())
    throw MalformedJson(object, key, fmt::format("\"{}\" is neither true nor false", key));
  return object.at(key).get<bool>();
}

template <class Enumeration, std::size_t N>
Enumeration word_or(const json& object, const char* key, const std::array<std::string_view, N>& words,
                    Enumeration otherwise) {
  if (!object.is_object() || !object.contains(key)) return otherwise;
  const std::string word = text(object, key);
  for (std::size_t i = 0; i < N; ++i) {
    if (words[i] == word) return static_cast<Enumeration>(i);
  }
  const std::string_view near = near_word(word, words);
  throw MalformedJson(object, key,
                      fmt::format("\"{}\" is \"{}\", but can only be one of: {}", key, word, fmt::join(words, ", ")),
                      near.empty() ? "write one of these, or leave it out" : fmt::format("did you mean \"{}\"?", near));
}

template <class Enumeration, std::size_t N>
inline std::string word(Enumeration value, const std::array<std::string_view, N>& words) {
  return std::string(words[static_cast<std::size_t>(value)]);
}

inline const json& list(const json& object, const char* key) {
  const json& value = member(object, key);
  if (!value.is_array()) throw MalformedJson(object, key, fmt::format("\"{}\" is not a list", key));
  return value;
}

/// Throws when an object has a member that is none of these: what is passed over in silence is believed to be obeyed.
/// `owner`: "the scene", of whom they are the keys.
inline void known_keys(const json& object, std::string_view owner, std::initializer_list<std::string_view> known) {
  if (!object.is_object()) throw MalformedJson(object, "", fmt::format("{} is not an object", owner));
  for (const auto& item : object.items()) {
    if (std::find(known.begin(), known.end(), item.key()) != known.end()) continue;
    throw MalformedJson(object, item.key(), fmt::format("\"{}\" is no key of {}", item.key(), owner),
                        near_word_or_list(item.key(), {known.begin(), known.size()}, "it can have"));
  }
}

/// Reads a document part by part, so that all its faults are found, and not the first alone.
class Parts {
 public:
  template <class Read>
  void read(const Read& part) {
    try {
      part();
    } catch (const MalformedParts& faults) {
      faults_.insert(faults_.end(), faults.all.begin(), faults.all.end());
    } catch (const MalformedJson& fault) {
      faults_.push_back(fault);
    }
  }
  bool any() const { return !faults_.empty(); }
  void done() const {
    if (!faults_.empty()) throw MalformedParts(faults_);
  }

 private:
  std::vector<MalformedJson> faults_;
};

}  // namespace zstep::json_members
