// What a submission earns, and where each of its runs first goes wrong.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/homework/homework.hpp"
#include "sim/homework/own_scenes.hpp"
#include "sim/words/judged.hpp"
#include "traces/file/lenient.hpp"
#include "traces/grade/grade.hpp"

namespace zstep::homework {

/// The first step of a run that is wrong, in words.
struct FirstWrong {
  std::int64_t at = 0;                     ///< the step of the run, for a viewer
  std::string step, subject;               ///< "insert_edge", "edge e1 (1–2)"
  bool missing = false;                    ///< the run lacks the step
  std::string where;                       ///< "one.jsonl:12"; empty where the run lacks the step
  std::string what;                        ///< one sentence
  std::vector<FieldText> expected, found;  ///< what the reference has, and the run, field by field
  std::optional<grade::Likely> mistake;    ///< that makes the run's very numbers from there on
  std::vector<mistakes::Mistake> either;   ///< that make the same numbers here, where none is named for that
};
/// The likely mistake for its writer: what it is, what to ask oneself, and where that is taught; a line each.
std::vector<std::string> mistake_lines(const FirstWrong& first);

/// One task's run.
struct Graded {
  enum class State : std::uint8_t {
    judged,
    missing,     ///< nothing was handed in
    unreadable,  ///< what was handed in is not a run
    stopped,     ///< the grading did not come to its end
  };
  const Task* task = nullptr;
  State state = State::missing;
  std::string file;           ///< that was handed in
  std::string why;            ///< it has no grade, or ends early
  std::string ended;          ///< how the program ended that made it, where it did not end well
  PassedOver passed_over;     ///< lines of the run that cannot be read
  bool breaks_off = false;    ///< its run does, or comes to a step that cannot be
  std::string note;           ///< what else there is to know of it, and changes nothing
  bool from_picture = false;  ///< it has no steps: only parts of level "buffers" are graded
  std::int64_t steps = 0;
  std::vector<grade::PartCount> counts;  ///< by part; empty unless judged
  std::vector<std::string> left_out;     ///< parts that the run has no step of, though it did not break off
  std::optional<FirstWrong> first;
  std::optional<grade::Ends> ends;  ///< where something is wrong
  std::optional<OwnRun> own;        ///< of a scene of the student's own

  /// What of `ended`, `passed_over` and `why` a student may read: of a hidden scene nothing that quotes its run.
  std::string shown() const;
  /// Is that to be mended before any wrong step is looked at?
  bool comes_first() const { return !ended.empty() || passed_over.any() || breaks_off; }
  /// Has it all points?
  bool is_whole() const;
};

struct Assessment {
  const Homework* homework = nullptr;
  std::string submission;
  std::vector<Graded> tasks;

  /// Of a part on a task, computation and value together.
  double points(const Graded& task, std::size_t part) const;
  double most(const Graded& task, std::size_t part) const;
  double points() const;
  double most() const;  ///< of what was graded: all, or one task
  /// Whether any run could be judged, or was left out by choice. What cannot be graded is not worth 0: it has no grade.
  bool gradable() const;
};

/// The run of a task that a submission has: a file of its name in a folder; or the one file. Empty where there is none,
/// or only pictures. Throws InputError where a single file belongs to none of several tasks, unless it is `meant` for
/// this one.
std::filesystem::path run_of(const std::filesystem::path& submission, const Homework& homework, const Task& task,
                             bool meant = false);

/// What zstep itself records on the tasks, under their own conventions: for who grades many submissions.
class References {
 public:
  explicit References(const Homework& homework);
  /// Null where it has none under these conventions.
  std::shared_ptr<const Trace> find(const Task& task, const Conventions& conventions) const;

 private:
  std::map<std::string, std::shared_ptr<const Trace>> by_task_;
};

/// The two runs of a task.
struct Runs {
  std::shared_ptr<const Trace> reference;
  Trace submission;
  std::string impossible;             ///< why the run's next step cannot be
  std::vector<std::string> left_out;  ///< the parts that are not looked at, as the submission has no step of them
  PassedOver passed_over;             ///< lines of the submission
  grade::Numbering numbering = grade::Numbering::as_scene;  ///< of the submission
};
/// The right run of a task.
Trace reference_of(const Homework& homework, const Task& task);

/// Of a program that a student has not written to its end only the parts are looked at that its run has a step of; or
/// all of them: where it broke off, what is missing is what is wrong with it.
enum class Look : std::uint8_t { at_what_is_there, at_all };
/// Throws InputError where the file is no run.
Runs runs_of(const Homework& homework, const Task& task, const std::filesystem::path& file, Look look,
             const References* known = nullptr);

/// Grades all of it, or the task of this name alone; of a single file the one task that it is a run of. `on_task` is
/// called before each.
Assessment assess(const Homework& homework, const std::filesystem::path& submission, const std::string& only = "",
                  const std::function<void(const Task&)>& on_task = nullptr, const References* known = nullptr);
/// What there is to say where the grading itself came to no end, and why it did not.
Assessment not_graded(const Homework& homework, const std::filesystem::path& submission, const std::string& only,
                      const std::string& why);

}  // namespace zstep::homework
