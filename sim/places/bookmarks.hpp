// Bookmarks: steps of a trace with names, in a small file that a person can read: beside the trace, or a lesson's among
// what zstep keeps.
//
//     # bookmarks of run.ztrace
//     219 the first tie
//     231 hidden by B
//
// A line is a step and its name; empty lines and those that begin with # are passed over.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/classroom/lesson.hpp"
#include "traces/file/trace.hpp"

namespace zstep::places {

struct Bookmark {
  std::int64_t step = 0;
  std::string name;
  bool operator==(const Bookmark&) const = default;
};

/// Of a trace, by step. A name stands once.
class Bookmarks {
 public:
  /// Those beside the trace; none where it has no such file. Throws InputError for a file that holds something else: it
  /// is then never written over.
  explicit Bookmarks(const Trace& trace);
  /// Those of a lesson, whose run has no file. nullptr: those beside the trace.
  Bookmarks(const Trace& trace, const Lesson* lesson);
  /// None, and none can be kept: of a run without a file.
  Bookmarks() = default;

  const std::vector<Bookmark>& all() const { return all_; }
  /// The step of this name.
  std::optional<std::int64_t> find(const std::string& name) const;
  /// Sets a bookmark, in place of one of this name, and writes the file. Throws InputError and changes nothing where
  /// the name is none, the trace is no file, or its folder cannot be written to.
  void set(std::int64_t step, const std::string& name);
  void remove(std::size_t place);
  /// Throws the InputError that set() would throw for any name, before one is typed.
  void check_can_keep() const;

 private:
  void keep(std::vector<Bookmark> all);
  void open(const Trace& trace, const std::filesystem::path& file, const std::string& whose);
  std::filesystem::path file_;  ///< that they are kept in; empty where they cannot be
  std::string whose_;           ///< "run.ztrace", "the lesson z-buffer"
  std::vector<Bookmark> all_;
};

/// The bookmarks of a text in that form, by step. Throws InputError, of `file` and a line counted from `first_line`,
/// where it is none, or one lies beyond the trace's end, `size`.
std::vector<Bookmark> bookmarks_in(std::string_view text, const std::string& file, int first_line, std::int64_t size);
/// The same of a file; none where there is no such file.
std::vector<Bookmark> read_bookmarks(const std::filesystem::path& file, std::int64_t size);
/// Writes such a file. Throws InputError where its folder cannot be written to.
void write_bookmarks(const std::filesystem::path& file, const std::string& whose, const std::vector<Bookmark>& all);
/// Whose bookmarks the first line of a lesson's file says they are.
std::string whose_marks(const std::string& lesson);

/// run.ztrace -> run.ztrace.marks
std::filesystem::path marks_file(const std::string& trace);
/// A lesson's, by its name: lessons/z-buffer.marks in kept_folder().
std::filesystem::path marks_file(const Lesson& lesson);

/// Where zstep keeps what stays from run to run: $XDG_CONFIG_HOME/zstep or the platform's likeness of it; empty when
/// there is no home.
std::filesystem::path kept_folder();

}  // namespace zstep::places
