#include "sim/homework/pack_homework.hpp"

#include <cstdlib>
#include <fstream>

#include <fmt/format.h>

#include "sim/homework/pack_program.hpp"
#include "sim/homework/pack_scripts.hpp"
#include "sim/homework/reports.hpp"
#include "sim/homework/seeds.hpp"
#include "sim/homework/student_folders.hpp"
#include "sim/homework/unfinished_folder.hpp"
#include "sim/words/shell_word.hpp"
#include "traces/error.hpp"

namespace zstep::homework {

namespace {

namespace fs = std::filesystem;

void write_script(const fs::path& path, const std::string& text, bool runs = true) {
  fs::create_directories(path.parent_path());
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw InputError(path.string(), "cannot be written", "check the folder and the room on the disk");
  if (runs) fs::permissions(path, fs::perms(0755));
}

/// The homework without solution, class, starters and key.
void copy_to_grade(const Homework& homework, const fs::path& to) {
  fs::create_directories(to);
  for (const auto& entry : fs::directory_iterator(homework.folder)) {
    const std::string name = entry.path().filename().string();
    if (name != "solution" && name != "class" && name != "starter" && name != key_file && !name.starts_with('.'))
      fs::copy(entry.path(), to / name, fs::copy_options::recursive | fs::copy_options::copy_symlinks);
  }
}

bool call(const std::string& command) { return std::system((command + " >/dev/null 2>&1").c_str()) == 0; }

/// By a program that is there: writing zip files is nothing that zstep should know.
void zip(const fs::path& folder, const fs::path& file) {
  const std::string to = shell_word(fs::absolute(file).string()), in = "cd " + shell_word(folder.string()) + " && ";
  if (call("zip -v") && call(in + "zip -q -r -X " + to + " .")) return;
  if (call("python3 -m zipfile -h") && call(in + "python3 -m zipfile -c " + to + " *")) return;
  if (call("bsdtar --version") && call(in + "bsdtar --format zip -cf " + to + " *")) return;
  throw InputError(file.string(), "there is no program that writes zip files", "install zip: apt-get install zip");
}

/// The result of a grading that did not come to its end and cannot say so itself.
Assessment stopped(const Homework& homework) {
  return not_graded(
      homework, "the submission", "",
      "could not be graded: the grader was stopped from outside, as where its machine has no more memory or "
      "time. This says nothing about what you handed in. Hand it in once more, and ask your teacher if "
      "this comes again.");
}

void fill(const Homework& homework, Service service, const fs::path& folder) {
  const bool for_students = service == Service::github;
  const fs::path inside = for_students ? folder / ".zstep" : folder;
  if (for_students) copy_for_students(homework, inside / "homework");
  else copy_to_grade(homework, inside / "homework");
  const Homework copy = load_copy(homework, inside / "homework", for_students);
  carry_program(inside / "zstep");
  switch (service) {
    case Service::gradescope:
      write_script(folder / stopped_file, report_gradescope(stopped(homework), 0), false);
      write_script(folder / "setup.sh", gradescope_setup(homework));
      write_script(folder / "run_autograder", gradescope_run(homework));
      break;
    case Service::prairielearn:
      write_script(folder / stopped_file, report_prairielearn(stopped(homework)), false);
      write_script(folder / "Dockerfile", prairielearn_dockerfile(homework), false);
      write_script(folder / "grade.sh", prairielearn_run(homework));
      write_script(folder / "info.json", prairielearn_info(homework), false);
      write_script(folder / "question.html", prairielearn_question(homework), false);
      break;
    case Service::github:
      // Students have only the scenes that are theirs, and so has the workflow in their repository.
      write_script(folder / ".github/workflows/classroom.yml", github_workflow(copy), false);
      break;
  }
}

std::vector<std::string> notes_of(const Homework& homework, Service service, const std::string& out) {
  std::vector<std::string> notes;
  if (homework.program.empty())
    notes.push_back(
        "Students hand in runs, SCENE.jsonl. For their programs to be run, write [program] in homework.toml.");
  switch (service) {
    case Service::gradescope:
      notes.push_back(fmt::format("Upload {} as the autograder of a programming assignment.", out));
      break;
    case Service::prairielearn:
      notes.push_back(
          fmt::format("In {}: docker build -t NAME . && docker push NAME; write that name into info.json, and put it "
                      "and question.html into a folder of the course's questions/.",
                      out));
      break;
    case Service::github:
      notes.push_back(
          fmt::format("Put what is in {} into the repository that students begin from. They can read all of "
                      "it and change it; hidden scenes are not in it.",
                      out));
      break;
  }
  return notes;
}

}  // namespace

std::vector<std::string> pack_homework(const fs::path& folder, Service service, const fs::path& out) {
  const Homework homework = load_homework(folder);
  // Whoever has the key has everybody's scenes, and what a service grades has no student's name.
  if (homework.seeded())
    throw InputError(folder.string(), "has scenes of each student's own, which cannot be packed",
                     "grade the class here, with --batch, or take them out of a copy");
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(out, ignored)))
    throw InputError(out.string(), "is there already", "give the name of a new one, or remove it");
  if (service == Service::gradescope && out.extension() != ".zip")
    throw InputError(out.string(), "is no zip file's name", "Gradescope takes a zip: give -o autograder.zip");
  if (!fs::is_directory(fs::absolute(out / "").parent_path().parent_path(), ignored))
    throw InputError(out.string(), "lies in a folder that is not there", "make the folder first");
  const fs::path from_home =
      fs::weakly_canonical(out, ignored).lexically_relative(fs::weakly_canonical(folder, ignored));
  if (!from_home.empty() && *from_home.begin() != "..")
    throw InputError(out.string(), "lies in the folder of the homework", "choose a place beside it");
  try {
    UnfinishedFolder made(out);
    if (service == Service::gradescope) {
      const fs::path zipped = made.path() / "pack.zip";
      fill(homework, service, made.path() / "pack");
      zip(made.path() / "pack", zipped);
      fs::rename(zipped, out);
    } else {
      fill(homework, service, made.path());
      made.finish();
    }
  } catch (const fs::filesystem_error& error) {
    throw InputError(out.string(), fmt::format("cannot be made: {}", error.code().message()),
                     "check the folder it lies in, and the room on the disk");
  }
  return notes_of(homework, service, out.string());
}

}  // namespace zstep::homework
