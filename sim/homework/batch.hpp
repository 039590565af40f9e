// Grading a class: a folder with one file or one folder a student. Each submission is graded in a process of its own;
// what it earned is kept as JSON, so that a batch that was stopped goes on where it was.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/homework/homework.hpp"
#include "sim/homework/own_scenes.hpp"

namespace zstep::homework {

/// What is kept of one submission.
struct Result {
  enum class State : std::uint8_t {
    graded,
    partly,      ///< some of its runs are missing or are no runs
    ungradable,  ///< there is something, but nothing that can be graded
    missing,     ///< there is nothing
  };
  struct Earned {
    double points = 0, most = 0;
  };
  std::string name;  ///< of the file or folder
  State state = State::missing;
  std::string why;            ///< something has no grade
  double points = 0;          ///< where anything was graded
  std::vector<Earned> parts;  ///< over all scenes, in the homework's order; empty where nothing was graded
  struct First {
    std::string scene, where, step, subject, what;
  };
  std::optional<First> first;  ///< wrong step
  std::string mistake;         ///< the likely one, by name; may be empty
  std::vector<OwnRun> own;     ///< of scenes of the student's own
  std::string file;            ///< with all of it, in the results' folder; empty where nothing is kept
  bool has_grade() const { return state == State::graded || state == State::partly; }
};
const char* word_of(Result::State state);

struct BatchOptions {
  std::filesystem::path submissions, results;
  std::string scene;                      ///< this one alone
  std::optional<double> seconds, memory;  ///< of each submission, as a person gave them; MiB
  int jobs = 1;
};

struct Batch {
  std::vector<Result> results;   ///< by name
  std::vector<AlikeRuns> alike;  ///< of scenes of each student's own
  double share = 1;              ///< of all points: of all scenes, or of the one that was graded
  int taken_over = 0;            ///< graded before, and nothing changed since
  int left_out = 0;              ///< names that begin with a dot
};

/// Grades all of them. `on_progress(done, all)` is called now and then; what it throws stops the batch.
Batch grade_batch(const Homework& homework, const BatchOptions& options,
                  const std::function<void(std::size_t, std::size_t)>& on_progress);

/// A row for each submission, as RFC 4180 has it; no cell begins like a formula.
std::string gradebook_csv(const Homework& homework, const Batch& batch);
/// One page for who teaches the class.
std::string class_html(const Homework& homework, const Batch& batch);

// What a batch keeps of each submission, as a JSON file: a key, which changes with what was graded, and the report.

/// A name as that of a file: letters, digits and a few signs stay, others become %XX; what is too long is cut, and
/// ends in a number of its own.
std::string file_name_of(const std::string& name);

void keep(const std::filesystem::path& path, const std::string& key, const std::string& report,
          const std::vector<OwnRun>& own);
void keep_refused(const std::filesystem::path& path, const std::string& key, const std::string& why);

/// Whether a result with this key is there, and whole.
bool is_kept(const std::filesystem::path& path, const std::string& key);

/// Of so many scenes. Throws InputError where it cannot be read.
Result read_kept(const std::filesystem::path& path, const std::string& name, const Homework& homework,
                 std::size_t scenes);

}  // namespace zstep::homework
