#include "traces/file/event_json.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "traces/events/fields.hpp"
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

double value_from(const json& in, const FieldOfKind& field) {
  switch (field.type) {
    case FieldOfKind::Type::real:
      return real_from_json(in, std::string(field.name).c_str());
    case FieldOfKind::Type::truth:
      return truth_from(in, field.name) ? 1 : 0;
    case FieldOfKind::Type::word:
      return static_cast<double>(word_from(in, field.name, field.words));
    case FieldOfKind::Type::whole:
      break;
  }
  return whole_from(in, field.name);
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

}  // namespace

Event event_from_json(std::uint8_t kind, const json& line) {
  Event event = event_of_kind(kind);
  const std::span<const FieldOfKind> fields = fields_of_kind(kind);
  std::vector<std::string_view> names;
  for (const FieldOfKind& field : fields) names.push_back(field.name);
  for (const FieldOfKind& field : fields) {
    const auto found = line.find(std::string(field.name));
    if (found == line.end()) {
      refuse_others(line, names, description_of_kind(kind).name);  // it is there under a misspelt name
      throw MalformedJson(line, "", fmt::format("\"{}\" is missing ({})", field.name, field.meaning));
    }
    field.write(event, value_from(*found, field));
  }
  if (line.size() != names.size() + 1) refuse_others(line, names, description_of_kind(kind).name);
  return event;
}

}  // namespace zstep
