#include "traces/file/event_json.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "traces/events/slots.hpp"
#include "traces/file/json_members.hpp"
#include "traces/near_word.hpp"

namespace zstep {

using nlohmann::json;

namespace {

bool truth_from(const json& in, std::string_view name) {
  if (in.is_boolean()) return in.get<bool>();
  throw MalformedJson(in, "", fmt::format("\"{}\" is neither true nor false", name),
                      "write true or false, without quotes");
}

std::size_t word_from(const json& in, std::string_view name, std::span<const std::string_view> words) {
  if (in.is_string()) {
    const auto found = std::find(words.begin(), words.end(), in.get<std::string>());
    if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  }
  const std::string_view near = in.is_string() ? near_word(in.get_ref<const std::string&>(), words) : "";
  throw MalformedJson(in, "", fmt::format("\"{}\" can only be one of: {}", name, fmt::join(words, ", ")),
                      near.empty() ? "" : fmt::format("did you mean \"{}\"?", near));
}

std::int32_t whole_from(const json& in, std::string_view name) {
  // Programs in languages with one kind of number write 5.0 for 5.
  if (in.is_number()) {
    const double value = in.get<double>();
    if (value == static_cast<double>(static_cast<std::int64_t>(std::clamp(value, -3e9, 3e9))) && value >= INT32_MIN &&
        value <= INT32_MAX)
      return static_cast<std::int32_t>(value);
  }
  throw MalformedJson(in, "", fmt::format("\"{}\" is not a whole number", name));
}

template <class Value>
Value value_from(const json& in, std::string_view name) {
  if constexpr (std::is_same_v<Value, double>) return real_from_json(in, std::string(name).c_str());
  else if constexpr (std::is_same_v<Value, bool>) return truth_from(in, name);
  else if constexpr (std::is_enum_v<Value>) return static_cast<Value>(word_from(in, name, words_of<Value>));
  else return whole_from(in, name);
}

/// Throws when a line has other members than its step and these.
void refuse_others(const json& line, std::span<const std::string_view> fields, std::string_view kind) {
  for (const auto& item : line.items()) {
    const std::string& key = item.key();
    if (key == "step" || std::find(fields.begin(), fields.end(), key) != fields.end()) continue;
    throw MalformedJson(line, key, fmt::format("\"{}\" is no field of {}", key, kind),
                        near_word_or_list(key, fields, "its fields are"));
  }
}

template <class E>
void take_event(const json& line, Event& into) {
  E event{};
  std::array<std::string_view, field_count<E>> names;
  for_each_index<E>([&]<std::size_t I>() { names[I] = field_at<E, I>.name; });
  for_each_index<E>([&]<std::size_t I>() {
    const auto found = line.find(std::string(names[I]));
    if (found == line.end()) {
      refuse_others(line, names, kind_text<E>.name);  // it is there under a misspelt name
      throw MalformedJson(line, "", fmt::format("\"{}\" is missing ({})", names[I], field_at<E, I>.meaning));
    }
    event.*field_at<E, I>.member = value_from<FieldValue<E, I>>(*found, names[I]);
  });
  if (line.size() != names.size() + 1) refuse_others(line, names, kind_text<E>.name);
  into = event;
}

}  // namespace

Event event_from_json(std::uint8_t kind, const json& line) {
  Event event;
  for_each_kind([&]<class E>() {
    if (kind_of<E> == kind) take_event<E>(line, event);
  });
  return event;
}

}  // namespace zstep
