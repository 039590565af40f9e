#include "traces/file/jsonl.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "traces/error.hpp"
#include "traces/events/fields.hpp"
#include "traces/file/files.hpp"
#include "traces/file/header_json.hpp"
#include "traces/file/written.hpp"
#include "traces/text.hpp"

namespace zstep {

using nlohmann::ordered_json;

namespace {

// Of each field no more than a call, as there are hundreds.
void put(ordered_json& line, std::string_view name, double value) { line[std::string(name)] = real_to_json(value); }
void put(ordered_json& line, std::string_view name, bool value) { line[std::string(name)] = value; }
void put(ordered_json& line, std::string_view name, std::int32_t value) { line[std::string(name)] = value; }
void put(ordered_json& line, std::string_view name, std::string_view value) { line[std::string(name)] = value; }

std::string text_of(const ordered_json& line) {
  return line.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

ordered_json begin_line(const Page& page, std::uint8_t step) {
  const StepInfo* info = find_step(page, step);
  ordered_json line;
  line["step"] = info == nullptr ? fmt::format("#{}", step) : step_label(page, *info);
  return line;
}

}  // namespace

std::string step_label(const Page& page, const StepInfo& step) {
  const auto same_name =
      std::count_if(page.begin(), page.end(), [&](const StepInfo& other) { return other.name == step.name; });
  return same_name > 1 ? step.module + "." + step.name : step.name;
}

std::string jsonl_header(const Header& header, const Scene& scene) {
  const bool as_own = header.written == WrittenAs{};
  Header written = header;
  turn(written, Turned::as_written);
  ordered_json line = header_to_json(written);
  if (as_own) {
    line["scene"] = scene_to_json(scene);
  } else {
    Scene moved = scene;
    turn(moved, header, Turned::as_written);
    line["scene"] = scene_to_json(moved);
  }
  return printable_json(text_of(line));
}

std::string jsonl_event(const Header& header, const Scene& scene, RecordedEvent recorded, std::string_view printed_at) {
  turn(recorded.event, header, scene.camera, scene.raster, Turned::as_written);
  ordered_json line = begin_line(header.page, recorded.step);
  for (const FieldOfKind& field : fields_of_kind(recorded.event.index())) {
    switch (field.type) {
      case FieldOfKind::Type::real:
        put(line, field.name, field.read(recorded.event));
        break;
      case FieldOfKind::Type::whole:
        put(line, field.name, field.whole_in(recorded.event));
        break;
      case FieldOfKind::Type::truth:
        put(line, field.name, field.true_in(recorded.event));
        break;
      case FieldOfKind::Type::word:
        put(line, field.name, field.word_in(recorded.event));
        break;
    }
  }
  if (!printed_at.empty()) put(line, at_key, printed_at);
  return text_of(line);
}

void write_jsonl(const Trace& trace, std::ostream& out) {
  out << jsonl_header(trace.header(), trace.scene()) + '\n';
  trace.each(0, trace.size(), [&](std::int64_t position, const RecordedEvent& recorded) {
    out << jsonl_event(trace.header(), trace.scene(), recorded, trace.printed_at(position, recorded.step)) +
               '\n';  // in one piece: what ends early ends with a line
    return static_cast<bool>(out);
  });
  if (!trace.whole()) out << fmt::format("{{\"{}\":true}}\n", cut_off_key);
}

std::optional<std::string> import_jsonl(InputFile from, const std::filesystem::path& to) {
  const std::string name = from.name();
  InputStream in(std::move(from));
  const OutputPlace place(to, Inputs::kept, Links::replaced);
  if (place.is_device()) throw InputError(to.string(), "is no ordinary file", "write the trace to a file");
  const std::string part = place.path().filename().string() + ".part";
  const std::filesystem::path partial = place.beside(part);
  Scene kept;
  std::optional<TraceRecorder> recorder;
  std::optional<std::string> cut;
  try {
    cut = read_jsonl(in, name, [&](const Header& header, Scene scene) -> TraceRecorder& {
      kept = std::move(scene);
      return recorder.emplace(partial, header, kept);
    });
    recorder->finish(!cut);
    recorder.reset();
    // What only a block as a whole tells is found when its events are read, so read them before anyone relies on them.
    const Trace trace = Trace::open(partial);
    trace.each(0, trace.size(), [](std::int64_t, const RecordedEvent&) { return true; });
    place.take(part);
  } catch (...) {
    recorder.reset();
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
    // What the recorder says of its file is of one that is gone now.
    try {
      throw;
    } catch (const Exhausted&) {
      throw Exhausted(to.string(), "there was no room for all of the trace",
                      "no trace is left, and what had this name before still has it; make room there");
    }
  }
  return cut;
}

Trace open_jsonl(const std::filesystem::path& path, std::string* impossible, GivenRun* given) {
  InputStream in{InputFile(path)};
  return open_jsonl(in, path.string(), impossible, given);
}

Trace open_jsonl(std::istream& in, const std::string& name, std::string* impossible, GivenRun* given) {
  Scene kept;
  StepLines lines;
  std::optional<TraceRecorder> recorder;
  const auto cut = read_jsonl(
      in, name,
      [&](const Header& header, Scene scene) -> TraceRecorder& {
        kept = std::move(scene);
        return recorder.emplace(header, kept);
      },
      impossible, given, &lines);
  recorder->finish(!cut);
  Trace trace = Trace::from_bytes(recorder->take_bytes(), name, cut.value_or(""));
  trace.lines_are(std::move(lines));
  return trace;
}

}  // namespace zstep
