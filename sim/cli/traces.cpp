#include "sim/cli/traces.hpp"

#include <array>
#include <cstdio>
#include <filesystem>
#include <new>
#include <utility>

#include <fmt/format.h>

#include "sim/cli/describe.hpp"
#include "sim/cli/long_work.hpp"
#include "sim/cli/messages.hpp"
#include "sim/cost/allocation_peak.hpp"
#include "sim/places/bookmarks.hpp"
#include "traces/error.hpp"
#include "traces/file/files.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/file/visit.hpp"
#include "traces/record/journal.hpp"
#include "traces/record/trace_recorder.hpp"

namespace zstep::cli {
namespace {

namespace fs = std::filesystem;

bool has_extension(const std::string& path, std::string_view extension) {
  return fs::path(path).extension().string() == extension;
}

/// Reads all of it; throws what is doubtful.
void check_strictly(const Trace& trace) {
  if (!trace.warnings().empty())
    throw Incomplete("--strict", trace.warnings().front(), "leave out --strict, or record it again");
  trace.each(0, trace.size(), [](std::int64_t, const RecordedEvent&) { return true; });
}

}  // namespace

void check_reads_once(const std::string& one, const std::string& other) {
  if (is_standard_input(one) && is_standard_input(other))
    throw InputError("-", "standard input can be read once", "write one of the two runs to a file");
}

bool is_trace(const std::string& path) {
  return is_standard_input(path) || has_extension(path, ".ztrace") || has_extension(path, ".jsonl");
}

namespace {

/// As much of standard input as a trace may be that is kept in memory.
constexpr std::size_t most_from_input = std::size_t{1} << 30;

Trace read_standard_input(std::string* impossible) {
  InputStream in(InputFile::standard_input());
  const std::string name = "standard input";
  if (in.peek() != trace_signature[0]) return open_jsonl(in, name, impossible);
  Bytes bytes;
  for (std::array<char, 1 << 16> piece; in.read(piece.data(), piece.size()) || in.gcount() > 0;) {
    bytes.insert(bytes.end(), piece.begin(), piece.begin() + in.gcount());
    if (bytes.size() > most_from_input)
      throw InputError(name, "has more than a GiB of a trace", "write it to a file, and name that");
  }
  return Trace::from_bytes(std::move(bytes), name);
}

Trace open(const std::string& path, Cost cost, std::string* impossible) {
  std::error_code ignored;
  const bool from_input = is_standard_input(path);
  if (!from_input && !fs::exists(path, ignored))
    throw InputError(path, "there is no such file",
                     is_trace(path) ? "check its name, or make one: zstep record SCENE -o run.ztrace"
                                    : "give a trace: zstep record SCENE -o run.ztrace makes one");
  for (const fs::path& own : {fs::path(path), journal_of(path), places::marks_file(path)})
    if (!from_input) note_input(own);
  const std::uintmax_t bytes = from_input ? most_from_input : fs::file_size(path, ignored);
  if (cost == Cost::limited) begin_budget(ignored ? 0 : bytes);
  try {
    Trace trace = from_input                      ? read_standard_input(impossible)
                  : has_extension(path, ".jsonl") ? open_jsonl(path, impossible)
                                                  : Trace::open(path);
    if (is_strict()) check_strictly(trace);
    if (const WrittenAs& written = trace.header().written; written != WrittenAs{})
      complain(fmt::format("note: {}: {}", path, written_text(written)));
    for (const std::string& warning : trace.warnings())
      trace.whole() ? complain(warning) : complain_incomplete(warning);
    trace.impl().on_loss = [](const std::string& loss) {
      complain_incomplete(loss + "; what is said leaves them out");
    };
    return trace;
  } catch (const std::bad_alloc&) {
    if (compare::met_heap_limit()) throw;
    throw Exhausted(path, "there is not enough memory to open it",
                    "close other programs, or record with a smaller --size");
  }
}

}  // namespace

Trace open_trace(const std::string& path, Cost cost) { return open(path, cost, nullptr); }
Trace open_to_judge(const std::string& path, std::string& impossible, Cost cost) {
  return open(path, cost, &impossible);
}

Trace record_to_memory(const Run& run) {
  TraceRecorder recorder(header_of(run), run.scene);
  {
    Watch watch;
    watch.attach(recorder);
    run.method->record(run.scene, run.conventions, recorder);
  }
  recorder.on_block(nullptr);
  recorder.finish();
  return Trace::from_bytes(recorder.take_bytes(), run.scene.name);
}

namespace {

constexpr std::int64_t patience = 4'000'000;        // events: a second or two
constexpr std::int64_t most_watched = 100'000'000;  // in memory some 400 MB
struct TooLong {};

}  // namespace

namespace {

OtherRun record_watched(const Method& method, const Scene& scene, const Conventions& conventions, std::int64_t most,
                        const RunWatch& watch) {
  check_run(method, scene, conventions);
  TraceRecorder recorder(header_for(method, conventions, scene.camera.kind), scene);
  recorder.on_block([&](std::int64_t events) {
    if (events > most || (watch && !watch(events))) throw TooLong{};
  });
  bool whole = true;
  try {
    method.record(scene, conventions, recorder);
  } catch (const TooLong&) {
    whole = false;
  }
  recorder.on_block(nullptr);
  recorder.finish();
  return OtherRun{Trace::from_bytes(recorder.take_bytes(), scene.name), whole};
}

}  // namespace

OtherRun record_patiently(const Method& method, const Scene& scene, const Conventions& conventions) {
  return record_watched(method, scene, conventions, patience, nullptr);
}

OtherRun record_by(const Method& method, const Trace& trace) {
  return record_patiently(method, trace.scene(), conventions_for(method, trace.header().conventions));
}

namespace {

OtherRun run_changed_watched(const Trace& opened, const std::string& method_id, const std::vector<Change>& changes,
                             std::int64_t most, const RunWatch& watch) {
  const Method& by = method(method_id);
  const Conventions& given = opened.header().conventions;
  Conventions conventions = method_id == opened.header().algorithm ? given : conventions_for(by, given);
  Scene scene = opened.scene();
  for (const Change& change : changes) {
    // What another method had and this one has not is left out; the last change is the one that is asked for.
    const bool before = &change != &changes.back() && method_id != opened.header().algorithm;
    if (!before || can_change(by, scene, conventions, change.name)) make_change(by, change, scene, conventions, "");
  }
  return record_watched(by, scene, conventions, most, watch);
}

}  // namespace

OtherRun run_changed(const Trace& opened, const std::string& method_id, const std::vector<Change>& changes) {
  return run_changed_watched(opened, method_id, changes, patience, nullptr);
}

OtherRun run_watched(const Trace& opened, const std::string& method_id, const std::vector<Change>& changes,
                     const RunWatch& watch) {
  return run_changed_watched(opened, method_id, changes, most_watched, watch);
}

std::optional<OtherRun> record_other_method(const Trace& trace, int direction) {
  const std::span<const Method> all = methods();
  const std::int64_t count = all.size();
  std::int64_t place = 0;
  while (place < count && all[place].id != trace.header().algorithm) ++place;
  for (std::int64_t away = 1; away < count; ++away) {
    const Method& other = all[((place + direction * away) % count + count) % count];
    if (can_draw(other, trace.scene(), conventions_for(other, trace.header().conventions)))
      return record_by(other, trace);
  }
  return std::nullopt;
}

}  // namespace zstep::cli
