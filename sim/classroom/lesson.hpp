// Lessons: a scene, a method, and narration that attaches to steps by name and condition, never by number.
//
// A lesson is one Markdown file with a TOML head (docs/writing-a-lesson.md). Its stops are resolved against the trace
// of its own run, so a change in the algorithm that adds steps moves the narration along with it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "algorithms/scene/load.hpp"
#include "traces/file/trace.hpp"
#include "traces/scene.hpp"

namespace zstep {

/// A prediction asked for before the step that answers it. Wrong answers each stand for a known misconception.
struct Answer {
  std::string text;
  bool right = false;
  std::string reply;  ///< why it is so, or what would have to be true for it to be; never "try again"
  std::int32_t line = 0, reply_line = 0;  ///< of the lesson's file
};
struct Question {
  std::string text;
  std::vector<Answer> answers;
  std::int32_t line = 0;  ///< of its text
};

/// Something to be tried: the run is to be changed until a condition holds at its end.
struct Task {
  std::string text;                   ///< Markdown: what is to be done
  std::string done;                   ///< an expression, true at the end of a run that does it
  std::string now;                    ///< Markdown, said of a run that does not; filled with that run's numbers
  std::vector<std::string> hints;     ///< one after the other, as they are asked for
  std::vector<std::string> solution;  ///< changes that do it together, as "theta = 60"
  std::int32_t line = 0, text_line = 0, done_line = 0, now_line = 0;  ///< of the lesson's file
};

/// Something to be marked by hand before the run does it; the steps after the stop say what is right.
struct Marking {
  enum class Kind : std::uint8_t { pixels, scan_line, order };
  Kind kind = Kind::pixels;
  std::string text;                ///< Markdown: what is to be marked
  std::string value, steps;        ///< as written: "first_row(edge)" of "insert_edge where edge == 2"; pixels: no value
  std::string why;                 ///< Markdown, said when it is right
  std::vector<std::string> hints;  ///< one after the other, as they are asked for
  /// Pixels as y · width + x, from the smallest; the scan line; or polygons in their order. Set by resolve.
  std::vector<std::int32_t> right;
  std::int32_t line = 0, text_line = 0, steps_line = 0, why_line = 0;  ///< of the lesson's file
};

/// What the speaker reads at a stop, and the class does not.
struct SpeakerNotes {
  std::string text;                      ///< Markdown
  double minutes = 0;                    ///< that the stop takes; 0: not said
  std::int32_t line = 0, text_line = 0;  ///< of the lesson's file
};

/// A run whose picture, at its end, a stop shows too: one that was recorded, or one of another scene or changed.
struct RunBeside {
  std::string file;  ///< from the lesson's folder: a recording (.jsonl) or a scene; empty: the lesson's own scene
  std::vector<std::string> changes{};  ///< "depth = pseudodepth", as far as it is not a recording
  std::shared_ptr<const Trace> run{};  ///< set by resolve()

  /// What it is called, in a few words: its changes, else its file.
  std::string name() const;
};

/// What a stop's words name and its pictures name, too: "V_5", "V_0 = 5" where the words have another name for it,
/// "V_4-V_5" (a line), "V_01 = V_0>V_1" (an arrow with its name), a polygon, "U", a polygon's plane, "plane = C", or
/// "scan line 8".
struct StopLabel {
  std::string name;  ///< of a line empty where its ends alone are named
  std::int32_t vertex = -1, to = -1;
  std::int32_t scan_line = -1;
  bool arrow = false;
  std::string plane_of;
};

/// A window of which a stop speaks, as seen from the run's eye: in view coordinates, at z_v = distance.
struct StopWindow {
  double left = 0, right = 0, bottom = 0, top = 0, distance = 0;
  double far = 0;      ///< z_v of a second plane, up to which the view volume is drawn; 0: none
  bool angle = false;  ///< from its bottom to its top as the eye sees it, α, is drawn
  bool operator==(const StopWindow&) const = default;
};

/// One stop of the narration.
struct Stop {
  std::string heading;
  std::string text;                  ///< Markdown; its {…} are filled with the trace's numbers when resolved
  std::optional<Question> question;  ///< asked here, answered by the steps that follow
  std::optional<Task> task;
  std::optional<Marking> marking;  ///< at most one of the three
  std::optional<SpeakerNotes> notes;
  std::vector<std::string> names;        ///< that stand alone in braces of its text, fields of its step among them
  std::string anchor;                    ///< as written in the file: step name and condition
  std::string focus;                     ///< the pane that leads meanwhile, as the viewer calls it; mostly none
  std::vector<RunBeside> beside;         ///< one, shown beside the lesson's own, or two, shown instead of it
  int viewing_step = 0;                  ///< 1 … 4: T_1 … T_4, 5: T_v, shown in the scene meanwhile; 0: none
  std::vector<std::vector<int>> orders;  ///< of T_1 … T_4, as written: where each takes the eye, from right to left
  std::string depths;                    ///< as written: z_v that are marked where depths are drawn over z_v
  std::vector<double> marked_depths;     ///< these; set by resolve()
  std::optional<Trace::Pixel> pixel;     ///< that it follows: marked, with its line of sight, at whatever step
  Marking pixels;                        ///< those of its steps in the whole run are framed meanwhile
  std::vector<StopLabel> labels;
  std::string close;  ///< a polygon that the scene shows large, with the eye; mostly none
  std::optional<StopWindow> window;
  std::int32_t line = 0, text_line = 0;  ///< of the lesson's file
  std::int64_t position = 0;             ///< where the trace is when it speaks; set by resolve()
  std::int64_t event = 0;                ///< of the step that it is about, before which it may speak; 0: of none
};

/// What a lesson may change about its scene's conventions. Unset: as the scene has them.
struct ConventionOptions {
  ConventionChoices choices;
  std::optional<bool> cull;
  std::map<std::string, std::string> options;  ///< of the method
};

struct Lesson {
  std::string id;  ///< "z-buffer", from the file's name: "4-z-buffer.md"
  std::string title;
  std::string summary;  ///< one line for `zstep list`
  std::string theme;    ///< what lessons beside it in the order have, too; may be empty
  std::filesystem::path path;
  std::string scene;   ///< a name or a path, as load_scene takes it (relative to the lesson's folder)
  std::string method;  ///< a method's id
  ViewOptions view;
  ConventionOptions conventions;
  std::vector<Stop> stops;
};

/// How long it takes to read it and to look at its pictures, in minutes, as zstep reckons: 200 words a minute, 12
/// seconds a stop, and half a minute for each question, task and marking.
double reading_minutes(const Lesson& lesson);

/// Loads a lesson. Throws InputError with FILE:LINE for what is wrong with it.
Lesson load_lesson(const std::filesystem::path& path);

/// Runs the lesson's method on its scene and returns the trace, its stops resolved against it, in order of position.
/// To be called once for a loaded lesson: it fills the text's braces. Throws InputError with the lesson's FILE:LINE
/// when a stop names a step that does not exist or never happens.
Trace run_lesson(Lesson& lesson);
/// Resolves a loaded lesson against a trace that exists already (a student's, say). run_lesson does it against its own.
void resolve_lesson(Lesson& lesson, const Trace& trace);

/// How a run stands to a task of a lesson: whether it does it, and what is to be said where it does not, as far as the
/// run has what that speaks of.
struct TaskState {
  bool done = false;
  std::string now;
};
TaskState state_of(const Task& task, const Trace& trace);

/// Where lessons, and what homework is made from, may lie: $ZSTEP_LESSONS, beside the program, in the source tree.
std::vector<std::filesystem::path> lesson_folders();
/// All lessons, in teaching order. Looks in $ZSTEP_LESSONS, then beside the program, then in the source tree.
std::vector<Lesson> all_lessons();
/// By id, or by path; throws InputError naming the lessons there are.
Lesson find_lesson(const std::string& id_or_path);

}  // namespace zstep
