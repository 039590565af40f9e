// zstep grade: of one submission, and of a class.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "sim/cli/show.hpp"
#include "sim/homework/assess.hpp"
#include "sim/homework/homework.hpp"

namespace zstep::cli {

struct GradeOptions {
  std::string folder, submission, scene, student, out;
  std::optional<std::string> format;
  std::string batch;                 ///< a folder of submissions; then the next two may be given
  std::optional<std::int64_t> jobs;  ///< at a time
  std::string report;                ///< the page of the class
  std::string steps_page, site;      ///< a page that shows both runs, and the folder of pages without one
  bool view = false;
  ShowOptions show;
};

/// Writes the page in which both runs of the task that is to be mended first are stepped through, from where they first
/// part. False where there is no such task.
bool write_steps_page(const homework::Homework& given, const homework::Assessment& all, const GradeOptions& options);

/// Grades a class; returns the exit code.
int grade_class(const homework::Homework& given, const GradeOptions& options);

}  // namespace zstep::cli
