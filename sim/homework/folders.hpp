// Folders of a class: what each student gets, what is there for a while, and what is made whole or not at all.
#pragma once

#include <filesystem>
#include <string>

#include "sim/homework/homework.hpp"

namespace zstep::homework {

/// Copies to a new folder what all students get: no solution, no hidden scenes, no key.
void copy_for_students(const Homework& homework, const std::filesystem::path& to);

/// The homework that a copy of a folder is. Throws InputError where it lacks a scene, or what a scene needs: one that
/// is a link, say, or lies in a folder that is not copied. `for_students`: hidden scenes are to be missing.
Homework load_copy(const Homework& homework, const std::filesystem::path& copy, bool for_students);

/// Makes OUT/STUDENT: homework.toml, hand-out, starters and the scenes that students have, those of their own among
/// them; no solution, no hidden scenes, no key. Returns the homework as this student has it. Throws InputError, with
/// nothing left behind.
Homework make_student_folder(const std::filesystem::path& homework, const std::string& student,
                             const std::filesystem::path& out);

// A folder for a while, gone afterwards, whatever was put into it.

class TemporaryFolder {
 public:
  /// Where the system keeps what is temporary (TMPDIR), as NAME-XXXXXX. Throws InputError where none can be made there.
  explicit TemporaryFolder(const std::string& name);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Removes a file, or a folder with all that is in it: links are not followed, and however deep folders are nested and
/// however long their names are, no more than two are open and no path has more than two names. False where something
/// is left.
bool remove_all_of(const std::filesystem::path& path);

// Folders that are made whole or not at all.

/// An empty folder, .NAME.part, beside the one that it becomes. It is gone when this goes; what a run left there that
/// was killed gives way to the next one's. Its name is no student's, as those do not begin with a dot.
class UnfinishedFolder {
 public:
  explicit UnfinishedFolder(const std::filesystem::path& becomes);
  ~UnfinishedFolder();
  UnfinishedFolder(const UnfinishedFolder&) = delete;
  UnfinishedFolder& operator=(const UnfinishedFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Gives it its name. An empty folder of that name gives way. Throws filesystem_error.
  void finish();

 private:
  std::filesystem::path becomes_, path_;
};

}  // namespace zstep::homework
