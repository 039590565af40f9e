// Lessons: a scene, a method, and narration that attaches to steps by name and condition, never by number.
//
// A lesson is one Markdown file with a TOML head (docs/writing-a-lesson.md). Its stops are resolved against the trace of its
// own run, so a change in the algorithm that adds steps moves the narration along with it.
#pragma once

#include <cstdint>
#include <filesystem>
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
};
struct Question {
  std::string text;
  std::vector<Answer> answers;
};

/// One stop of the narration.
struct Stop {
  std::string heading;
  std::string text;                  ///< Markdown; its {…} are filled with the trace's numbers when resolved
  std::optional<Question> question;  ///< asked here, answered by the steps that follow
  std::string anchor;                ///< as written in the file: step name and condition
  std::int32_t line = 0;             ///< of the lesson's file
  std::int64_t position = 0;         ///< where the trace is when it speaks; set by resolve()
};

struct Lesson {
  std::string id;       ///< "z-buffer"
  std::string title;
  std::string summary;  ///< one line for `zstep list`
  std::filesystem::path path;
  std::string scene;    ///< a name or a path, as load_scene takes it (relative to the lesson's folder)
  std::string method;   ///< a method's id
  ViewOptions view;
  Conventions conventions;
  std::vector<Stop> stops;
};

/// Loads a lesson. Throws InputError with FILE:LINE for what is wrong with it.
Lesson load_lesson(const std::filesystem::path& path);

/// Runs the lesson's method on its scene and returns the trace, its stops resolved against it, in order of position.
/// Throws InputError with the lesson's FILE:LINE when a stop names a step that does not exist or never happens.
Trace run_lesson(Lesson& lesson);

/// All lessons, in teaching order. Looks in $ZSTEP_LESSONS, then beside the program, then in the source tree.
std::vector<Lesson> all_lessons();
/// By id, or by path; throws InputError naming the lessons there are.
Lesson find_lesson(const std::string& id_or_path);

}  // namespace zstep
