#include "traces/file/event_json.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <simdjson.h>

#include "traces/events/fields.hpp"
#include "traces/events/slots.hpp"
#include "traces/file/header.hpp"
#include "traces/file/json_text.hpp"
#include "traces/file/source_places.hpp"
#include "traces/text.hpp"

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
    if (found != words.end()) return found - words.begin();
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
    if (key == "step" || key == at_key || std::find(fields.begin(), fields.end(), key) != fields.end()) continue;
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
  if (line.size() != names.size() + 1 + line.count(at_key)) refuse_others(line, names, description_of_kind(kind).name);
  return event;
}

namespace {

using simdjson::ondemand::value;

template <class Value>
bool take(value& from, Value& into) {
  if constexpr (std::is_same_v<Value, double>) {
    return from.get_double().get(into) == simdjson::SUCCESS;
  } else if constexpr (std::is_same_v<Value, bool>) {
    return from.get_bool().get(into) == simdjson::SUCCESS;
  } else if constexpr (std::is_enum_v<Value>) {
    std::string_view word;
    if (from.get_string().get(word) != simdjson::SUCCESS) return false;
    const auto value = value_called<Value>(word);
    if (value) into = *value;
    return value.has_value();
  } else {
    std::int64_t whole = 0;
    if (from.get_int64().get(whole) != simdjson::SUCCESS || whole < std::numeric_limits<std::int32_t>::min() ||
        whole > std::numeric_limits<std::int32_t>::max())
      return false;
    into = static_cast<Value>(whole);
    return true;
  }
}

using Members = simdjson::simdjson_result<simdjson::ondemand::object_iterator>;

/// The fields of an event, in any order, each once.
template <class E>
bool take_fields(Members& at, const Members& end, Event& into, std::optional<std::string_view>& printed_at) {
  constexpr std::size_t count = field_count<E>;
  static_assert(count <= 32);
  std::array<std::string_view, count + 1> names{};  // one more: some events have no fields
  for_each_index<E>([&]<std::size_t I>() { names[I] = field_at<E, I>.name; });
  E event{};
  std::uint64_t seen = 0;
  std::size_t next = 0;  // fields mostly come in their order
  for (; at != end; ++at) {
    auto member = *at;
    std::string_view key;
    value found;
    if (member.unescaped_key().get(key) != simdjson::SUCCESS || member.value().get(found) != simdjson::SUCCESS)
      return false;
    std::size_t place = next;
    if (place >= count || names[place] != key)
      for (place = 0; place < count && names[place] != key;) ++place;
    if (place == count && key == at_key && !printed_at) {
      std::string_view text;
      if (found.get_string().get(text) != simdjson::SUCCESS) return false;
      printed_at = text;
      continue;
    }
    if (place == count || (seen >> place & 1u) != 0) return false;
    bool taken = false;
    for_each_index<E>([&]<std::size_t I>() {
      if (I == place) taken = take(found, event.*field_at<E, I>.member);
    });
    if (!taken) return false;
    seen |= std::uint64_t{1} << place;
    next = place + 1;
  }
  into = event;
  return seen == (std::uint64_t{1} << count) - 1;
}

}  // namespace

struct QuickLine::Parser {
  simdjson::ondemand::parser parser;
};

QuickLine::QuickLine(const Page& page) : parser_(std::make_unique<Parser>()) {
  for (const StepInfo& step : page) {
    steps_.emplace(step.name, find_step(page, step.name));  // the first of several of this name
    steps_.emplace(step.module + "." + step.name, &step);
  }
}
QuickLine::~QuickLine() = default;

bool QuickLine::read(std::string& line, RecordedEvent& event) {
  line.reserve(line.size() + simdjson::SIMDJSON_PADDING);
  simdjson::ondemand::document document;
  simdjson::ondemand::object object;
  if (parser_->parser.iterate(line.data(), line.size(), line.capacity()).get(document) != simdjson::SUCCESS ||
      document.get_object().get(object) != simdjson::SUCCESS)
    return false;
  Members at = object.begin();
  const Members end = object.end();
  if (at == end) return false;
  auto first = *at;
  std::string_view key, name;
  if (first.unescaped_key().get(key) != simdjson::SUCCESS || key != "step" ||
      first.value().get_string().get(name) != simdjson::SUCCESS)
    return false;
  const auto step = steps_.find(name);
  if (step == steps_.end()) return false;
  ++at;

  using Take = bool (*)(Members&, const Members&, Event&, std::optional<std::string_view>&);
  static const auto takes = [] {
    std::array<Take, kind_count> all{};
    for_each_kind([&]<class E>() { all[kind_of<E>] = take_fields<E>; });
    return all;
  }();
  event.step = step->second->id;
  place_.reset();
  if (!takes[step->second->kind](at, end, event.event, place_)) return false;
  const char* behind = nullptr;
  return document.current_location().get(behind) == simdjson::OUT_OF_BOUNDS;  // and nothing comes after it
}

}  // namespace zstep
