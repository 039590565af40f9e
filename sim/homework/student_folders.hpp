// What each student of a class gets: the homework without what is the instructor's, with scenes of the student's own.
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

}  // namespace zstep::homework
