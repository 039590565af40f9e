// Traces as JSON Lines: one header line, then one line an event. Loss-free both ways; what students' programs write.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

#include "traces/file/files.hpp"
#include "traces/file/trace.hpp"
#include "traces/record/trace_recorder.hpp"

namespace zstep {

/// The header line: {"ztrace":1, …, "steps":[…], "scene":{…}}.
std::string jsonl_header(const Header& header, const Scene& scene);
/// How a run names a step: with its module where another module has a step of that name.
std::string step_label(const Page& page, const StepInfo& step);
/// One event, its numbers as the run's program writes them: {"step":"compare","x":3,"y":2,"z":4.25,"nearer":true}. The
/// step's name is short where it is unique. `printed_at`: the place in the program's source, where that is known.
std::string jsonl_event(const Header& header, const Scene& scene, RecordedEvent event,
                        std::string_view printed_at = {});
/// The only key of the last line of a recording that was cut off: {"cut_off":true}.
inline constexpr const char* cut_off_key = "cut_off";
/// The whole trace.
void write_jsonl(const Trace& trace, std::ostream& out);

/// For who judges a run of a scene of their own: the scene that the run brings along is not looked at, and its header
/// is what `review` lets through of it. A header may leave out method and steps, which are then these; or there is
/// none, which declares nothing.
struct GivenRun {
  const Header* header = nullptr;
  const Scene* scene = nullptr;
  std::function<Header(const Header& declared)> review;
  bool without_header = false;  ///< what was found
};

/// Reads JSONL and hands header and scene to `begin`, which returns the recorder that takes the events. It keeps the
/// scene for as long as the recorder lives.
/// What the file of a program that crashed ends with, a line that was torn off or a message, is quoted in what is
/// returned, or that its last line is the mark of a recording that was cut off; nothing where the file is whole. Throws
/// InputError for what is wrong elsewhere, the first ten mistakes, each as NAME:LINE:COLUMN.
/// `impossible`: for who judges a run. Then a step that no run on this scene can have, at a pixel outside the raster or
/// of a polygon that there is not, ends the reading without an error and is reported there, as NAME:LINE:COLUMN.
/// `lines`: at which line each step stands.
std::optional<std::string> read_jsonl(std::istream& in, const std::string& name,
                                      const std::function<TraceRecorder&(const Header&, Scene)>& begin,
                                      std::string* impossible = nullptr, GivenRun* given = nullptr,
                                      StepLines* lines = nullptr);

/// JSONL file to trace file. Nothing is left behind when it fails. Returns what read_jsonl() does; such a trace has no
/// end, as that of a recording that was killed.
std::optional<std::string> import_jsonl(InputFile from, const std::filesystem::path& to);
/// JSONL file to a trace in memory. Of a file that was cut off the trace warns. `impossible`, `given`: as in
/// read_jsonl().
Trace open_jsonl(const std::filesystem::path& path, std::string* impossible = nullptr, GivenRun* given = nullptr);
Trace open_jsonl(std::istream& in, const std::string& name, std::string* impossible = nullptr,
                 GivenRun* given = nullptr);

}  // namespace zstep
