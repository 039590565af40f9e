// Members of JSON objects, taken with a complaint that names them. Only for the readers beside it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "traces/file/header_json.hpp"

namespace zstep::json_members {

using nlohmann::json;

inline const json& member(const json& object, const char* key) {
  if (!object.is_object() || !object.contains(key)) throw MalformedJson(fmt::format("\"{}\" is missing", key));
  return object.at(key);
}

inline std::string text(const json& object, const char* key) {
  const json& value = member(object, key);
  if (!value.is_string()) throw MalformedJson(fmt::format("\"{}\" is not a text", key));
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
  if (!value.is_number_integer()) throw MalformedJson(fmt::format("\"{}\" is not a whole number", key));
  const auto wide = value.get<std::int64_t>();
  if (wide < INT32_MIN || wide > INT32_MAX || (value.is_number_unsigned() && value.get<std::uint64_t>() > INT32_MAX)) {
    throw MalformedJson(fmt::format("\"{}\" is out of range", key));
  }
  return static_cast<std::int32_t>(wide);
}
inline std::int32_t whole(const json& object, const char* key) { return whole_from(member(object, key), key); }
inline std::int32_t whole_or(const json& object, const char* key, std::int32_t otherwise) {
  return object.is_object() && object.contains(key) ? whole(object, key) : otherwise;
}

inline bool truth_or(const json& object, const char* key, bool otherwise) {
  if (!object.is_object() || !object.contains(key)) return otherwise;
  if (!object.at(key).is_boolean()) throw MalformedJson(fmt::format("\"{}\" is neither true nor false", key));
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
  throw MalformedJson(fmt::format("\"{}\" is \"{}\", but can only be one of: {}", key, word, fmt::join(words, ", ")));
}

template <class Enumeration, std::size_t N>
inline std::string word(Enumeration value, const std::array<std::string_view, N>& words) {
  return std::string(words[static_cast<std::size_t>(value)]);
}

inline const json& list(const json& object, const char* key) {
  const json& value = member(object, key);
  if (!value.is_array()) throw MalformedJson(fmt::format("\"{}\" is not a list", key));
  return value;
}

}  // namespace zstep::json_members
