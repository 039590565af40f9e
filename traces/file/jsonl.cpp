#include "traces/file/jsonl.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iostream>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "traces/error.hpp"
#include "traces/events/slots.hpp"
#include "traces/file/check_events.hpp"
#include "traces/file/header_json.hpp"

namespace zstep {

using nlohmann::json;
using nlohmann::ordered_json;

namespace {

// The header line holds the scene. A parsed line takes up to thirty times its length in memory, more when it is nested
// without end, so both are bounded: what comes from others may be made to fill the machine.
constexpr std::size_t line_limit = std::size_t{24} << 20;

/// The next line, of at most line_limit + 1 characters: what comes from others may have no line end at all.
bool next_line(std::istream& in, std::string& line) {
  line.clear();
  std::streambuf* buffer = in.rdbuf();
  for (;;) {
    const int c = buffer->sbumpc();
    if (c == std::char_traits<char>::eof()) return !line.empty();
    if (c == '\n' || line.size() > line_limit) return true;
    line.push_back(static_cast<char>(c));
  }
}

/// The step's name, with its module where another module has a step of that name.
std::string step_label(const Page& page, const StepInfo& step) {
  const auto same_name =
      std::count_if(page.begin(), page.end(), [&](const StepInfo& other) { return other.name == step.name; });
  return same_name > 1 ? step.module + "." + step.name : step.name;
}

// Of each field no more than a call, as there are hundreds.
void put(ordered_json& line, std::string_view name, double value) { line[std::string(name)] = real_to_json(value); }
void put(ordered_json& line, std::string_view name, bool value) { line[std::string(name)] = value; }
void put(ordered_json& line, std::string_view name, std::int32_t value) { line[std::string(name)] = value; }
void put(ordered_json& line, std::string_view name, std::string_view value) { line[std::string(name)] = value; }

std::string text_of(const ordered_json& line) { return line.dump(-1, ' ', false, ordered_json::error_handler_t::replace); }

ordered_json begin_line(const Page& page, std::uint8_t step) {
  const StepInfo* info = find_step(page, step);
  ordered_json line;
  line["step"] = info == nullptr ? fmt::format("#{}", step) : step_label(page, *info);
  return line;
}

template <class E>
std::string event_line(const Page& page, std::uint8_t step, const E& event) {
  ordered_json line = begin_line(page, step);
  for_each_index<E>([&]<std::size_t I>() {
    using Value = FieldValue<E, I>;
    const Value value = event.*field_at<E, I>.member;
    if constexpr (std::is_enum_v<Value>) put(line, field_at<E, I>.name, words_of<Value>[static_cast<std::size_t>(value)]);
    else put(line, field_at<E, I>.name, value);
  });
  return text_of(line);
}

const json& field_in(const json& line, std::string_view name, std::string_view meaning) {
  const auto found = line.find(std::string(name));
  if (found == line.end()) throw MalformedJson(fmt::format("\"{}\" is missing ({})", name, meaning));
  return *found;
}

bool truth_from(const json& in, std::string_view name) {
  if (in.is_boolean()) return in.get<bool>();
  throw MalformedJson(fmt::format("\"{}\" is neither true nor false", name));
}

std::size_t word_from(const json& in, std::string_view name, std::span<const std::string_view> words) {
  if (in.is_string()) {
    const auto found = std::find(words.begin(), words.end(), in.get<std::string>());
    if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  }
  throw MalformedJson(fmt::format("\"{}\" can only be one of: {}", name, fmt::join(words, ", ")));
}

std::int32_t whole_from(const json& in, std::string_view name) {
  // Programs in languages with one kind of number write 5.0 for 5.
  if (in.is_number()) {
    const double value = in.get<double>();
    if (value == static_cast<double>(static_cast<std::int64_t>(std::clamp(value, -3e9, 3e9))) && value >= INT32_MIN && value <= INT32_MAX)
      return static_cast<std::int32_t>(value);
  }
  throw MalformedJson(fmt::format("\"{}\" is not a whole number", name));
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
  if (line.size() == fields.size() + 1) return;
  for (const auto& item : line.items()) {
    const std::string& key = item.key();
    if (key != "step" && std::find(fields.begin(), fields.end(), key) == fields.end()) throw MalformedJson(fmt::format("\"{}\" is no field of {}", key, kind));
  }
}

template <class E>
E event_from(const json& line) {
  E event{};
  std::array<std::string_view, field_count<E>> names;
  for_each_index<E>([&]<std::size_t I>() {
    constexpr std::string_view name = field_at<E, I>.name;
    names[I] = name;
    event.*field_at<E, I>.member = value_from<FieldValue<E, I>>(field_in(line, name, field_at<E, I>.meaning), name);
  });
  refuse_others(line, names, kind_text<E>.name);
  return event;
}

}  // namespace

std::string jsonl_header(const Header& header, const Scene& scene) {
  ordered_json line = header_to_json(header);
  line["scene"] = scene_to_json(scene);
  return text_of(line);
}

std::string jsonl_event(const Page& page, const RecordedEvent& recorded) {
  return std::visit([&](const auto& event) { return event_line(page, recorded.step, event); }, recorded.event);
}

void write_jsonl(const Trace& trace, std::ostream& out) {
  out << jsonl_header(trace.header(), trace.scene()) << '\n';
  trace.each(0, trace.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    out << jsonl_event(trace.header().page, recorded) << '\n';
    return static_cast<bool>(out);
  });
}

void read_jsonl(std::istream& in, const std::string& name,
                const std::function<TraceRecorder&(const Header&, Scene)>& begin) {
  std::int64_t number = 0;
  const auto fail = [&](const std::string& what, const std::string& mend) {
    throw InputError(fmt::format("{}:{}", name, number), what, mend);
  };
  std::string line;
  TraceRecorder* recorder = nullptr;
  Header header;
  std::optional<EventCheck> check;
  while (next_line(in, line)) {
    ++number;
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    if (line.size() > line_limit)
      fail("the line is longer than 24 MiB", "write one event a line; large scenes are recorded straight to a .ztrace");
    json document;
    try {
      document = parse_bounded(line);
    } catch (const json::exception&) {
      fail("is not JSON", "write one JSON object a line");
    } catch (const MalformedJson& error) {
      fail(error.what(), "write one event a line, as docs/trace-format.md shows it");
    }
    if (!document.is_object()) fail("is not a JSON object", "write one JSON object a line");
    try {
      if (recorder == nullptr) {
        header = header_from_json(document);
        if (!document.contains("scene")) throw MalformedJson("\"scene\" is missing");
        Scene scene = scene_from_json(document.at("scene"));
        check.emplace(scene);
        recorder = &begin(header, std::move(scene));
        continue;
      }
      if (!document.contains("step") || !document.at("step").is_string()) throw MalformedJson("\"step\" is missing");
      const std::string step_name = document.at("step").get<std::string>();
      const StepInfo* step = find_step(header.page, std::string_view(step_name));
      if (step == nullptr) throw MalformedJson(fmt::format("there is no step \"{}\" in the header's list", step_name));
      for_each_kind([&]<class E>() {
        if (kind_of<E> != step->kind) return;
        const E event = event_from<E>(document);
        EventCheck of_one = *check;  // how often buffers are cleared is held against a block, once it is read
        if (const std::string fault = of_one(event); !fault.empty()) throw MalformedJson(fault);
        record_any(*recorder, step->id, event);
      });
    } catch (const MalformedJson& error) {
      fail(error.what(), recorder == nullptr
                             ? "the first line must be a trace's header, as docs/trace-format.md shows it"
                             : "see the fields of each event in docs/trace-format.md");
    }
  }
  if (recorder == nullptr)
    fail("there is no header line", "the first line must be a trace's header, as docs/trace-format.md shows it");
}

namespace {

std::ifstream opened(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in || std::filesystem::is_directory(path))
    throw InputError(path.string(), "cannot be opened", "check the name and that you may read it");
  return in;
}

}  // namespace

void import_jsonl(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::ifstream in = opened(from);
  const std::filesystem::path partial = to.string() + ".part";
  Scene kept;
  std::optional<TraceRecorder> recorder;
  try {
    read_jsonl(in, from.string(), [&](const Header& header, Scene scene) -> TraceRecorder& {
      kept = std::move(scene);
      return recorder.emplace(partial, header, kept);
    });
    recorder->finish();
    // What only a block as a whole tells is found when its events are read, so read them before anyone relies on them.
    const Trace trace = Trace::open(partial);
    trace.each(0, trace.size(), [](std::int64_t, const RecordedEvent&) { return true; });
  } catch (...) {
    recorder.reset();
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
    throw;
  }
  recorder.reset();
  std::filesystem::rename(partial, to);
}

Trace open_jsonl(const std::filesystem::path& path) {
  std::ifstream in = opened(path);
  Scene kept;
  std::optional<TraceRecorder> recorder;
  read_jsonl(in, path.string(), [&](const Header& header, Scene scene) -> TraceRecorder& {
    kept = std::move(scene);
    return recorder.emplace(header, kept);
  });
  recorder->finish();
  return Trace::from_bytes(recorder->take_bytes(), path.string());
}

}  // namespace zstep
