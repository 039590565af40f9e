#include "sim/homework/pack_homework.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "sim/homework/folders.hpp"
#include "sim/homework/own_scenes.hpp"
#include "sim/homework/reports.hpp"
#include "sim/pages/page.hpp"
#include "sim/words/escaped.hpp"
#include "traces/error.hpp"
#include "traces/text.hpp"

#ifdef __linux__
#include <link.h>
#endif

namespace zstep::homework {

namespace {

namespace fs = std::filesystem;

#ifdef __linux__
/// The files of the libraries of this process, the loader among them.
std::vector<fs::path> loaded_libraries() {
  std::vector<fs::path> files;
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* list) {
        // The program itself has no name here; what the kernel brings along is no file.
        if (std::error_code ignored; info->dlpi_name != nullptr && fs::is_regular_file(info->dlpi_name, ignored))
          static_cast<std::vector<fs::path>*>(list)->emplace_back(info->dlpi_name);
        return 0;
      },
      &files);
  return files;
}
#endif

}  // namespace

void carry_program([[maybe_unused]] const fs::path& to) {
#ifdef __linux__
  const fs::path self = fs::read_symlink("/proc/self/exe");
  if (self.filename().string().starts_with("ld-"))
    throw InputError("homework pack", "this zstep came in a pack itself", "use the one that was built or installed");
  fs::create_directories(to / "lib");
  fs::copy_file(self, to / "lib" / "zstep");
  std::string loader;
  for (const fs::path& library : loaded_libraries()) {
    const std::string name = library.filename().string();
    fs::copy_file(library, to / "lib" / name, fs::copy_options::skip_existing);
    if (name.starts_with("ld-")) loader = name;
  }
  std::ofstream(to / "zstep") << "#!/bin/sh\n"
                                 "# zstep with the libraries that it was made with, whatever this machine has.\n"
                                 "lib=$(cd \"$(dirname \"$0\")/lib\" && pwd) || exit 2\n"
                              << (loader.empty()
                                      ? "exec \"$lib/zstep\" \"$@\"\n"
                                      : "exec \"$lib/" + loader + "\" --library-path \"$lib\" \"$lib/zstep\" \"$@\"\n");
  for (const char* file : {"zstep", "lib/zstep"}) fs::permissions(to / file, fs::perms(0755));
  if (!loader.empty()) fs::permissions(to / "lib" / loader, fs::perms(0755));
#else
  throw InputError("homework pack", "the services run Linux, and this zstep does not", "pack it on Linux");
#endif
}

namespace {

/// The seconds that a service should give a submission.
int seconds_for(const Homework& homework) {
  const double programs =
      homework.program.empty() ? 0 : homework.limits.clock_seconds() * static_cast<double>(homework.tasks.size());
  return static_cast<int>(std::min(600.0, std::ceil(programs) + 60));
}

/// Lines that grade a submission: what its program prints, or the runs that were handed in. From the first of them on
/// there is a result, whatever becomes of the rest.
std::string grading_lines(const Homework& homework, const std::string& folder, const std::string& submission,
                          const std::string& format) {
  const std::string run = fmt::format(
      "cd \"$(mktemp -d)\" && runs=runs || exit 1\n"
      "\"{0}/zstep/zstep\" homework run \"{0}/homework\" {1} -o \"$runs\"\n"
      "# 0: they ended well, 1: not all of them, 2: they cannot be run; the report says so. Else the grader was "
      "stopped.\n"
      "[ $? -le 2 ] || exit 0\n",
      folder, submission);
  return fmt::format(
      "rm -f \"$results\"\n"
      "# The result that stays where something ends the grader itself: no memory, no time. It says so.\n"
      "cp \"{0}/{1}\" \"$results\"\n"
      "{2}"
      "\"{0}/zstep/zstep\" grade --homework \"{0}/homework\" \"$runs\" --format {3} -o \"$results\"\n"
      "# 0: all right, 1: not all right, else it cannot be graded, and the report says why. Without one the grader "
      "failed.\n"
      "[ -s \"$results\" ]\n",
      folder, stopped_file, homework.program.empty() ? fmt::format("cd {} && runs=.\n", submission) : run, format);
}

}  // namespace

std::string packages_for(const std::string& command) {
  constexpr std::pair<const char*, const char*> known[] = {
      {"python3", "python3"},   {"node", "nodejs"},  {"java", "default-jdk-headless"}, {"c++", "g++"}, {"g++", "g++"},
      {"cc ", "gcc libc6-dev"}, {"make", "make g++"}};
  std::string packages = "bubblewrap util-linux";
  for (const auto& [word, package] : known)
    if (command.find(word) != std::string::npos && packages.find(package) == std::string::npos)
      packages += std::string(" ") + package;
  return packages;
}

std::string gradescope_setup(const Homework& homework) {
  return fmt::format(
      "#!/usr/bin/env bash\n"
      "# Run once, as root, where the autograder's image is made.\n"
      "# https://gradescope-autograders.readthedocs.io/en/latest/specs/\n"
      "set -e\n"
      "{}"
      "chmod +x /autograder/source/zstep/zstep /autograder/source/zstep/lib/*\n",
      homework.program.empty() ? std::string()
                               : fmt::format("# What programs of students need. Add other languages here.\n"
                                             "export DEBIAN_FRONTEND=noninteractive\n"
                                             "apt-get update\n"
                                             "apt-get install -y --no-install-recommends {}\n",
                                             packages_for(homework.program)));
}

std::string gradescope_run(const Homework& homework) {
  return "#!/usr/bin/env bash\n"
         "# Grades what is in /autograder/submission and writes /autograder/results/results.json.\n"
         "# https://gradescope-autograders.readthedocs.io/en/latest/specs/\n"
         "umask 077\n"
         "source=/autograder/source results=/autograder/results/results.json\n"
         "# A student's program runs as another user: scenes, reference and results are not for it.\n"
         "chmod go= \"$source\" /autograder/results\n" +
         grading_lines(homework, "$source", "/autograder/submission", "gradescope");
}

std::string prairielearn_dockerfile(const Homework& homework) {
  return fmt::format(
      "# The image of an external grader: docker build -t NAME . && docker push NAME\n"
      "# https://prairielearn.readthedocs.io/en/latest/externalGrading/\n"
      "FROM debian:stable-slim\n"
      "RUN apt-get update && DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends bash {0} "
      "&& rm -rf /var/lib/apt/lists/*\n"
      "COPY zstep /zstep/zstep\n"
      "COPY homework /zstep/homework\n"
      "COPY {1} /zstep/{1}\n"
      "COPY grade.sh /zstep/grade.sh\n"
      "RUN chmod +x /zstep/grade.sh && chmod go= /zstep\n",
      homework.program.empty() ? std::string() : packages_for(homework.program), stopped_file);
}

std::string prairielearn_run(const Homework& homework) {
  return "#!/usr/bin/env bash\n"
         "# Grades what is in /grade/student and writes /grade/results/results.json.\n"
         "# https://prairielearn.readthedocs.io/en/latest/externalGrading/\n"
         "umask 077\n"
         "results=/grade/results/results.json\n"
         "mkdir -p /grade/results && chmod go= /grade/results\n" +
         grading_lines(homework, "/zstep", "/grade/student", "prairielearn");
}

std::string prairielearn_info(const Homework& homework) {
  const std::string whose = homework.title + "\n" + std::string(homework.method->id);
  const std::uint64_t high = keyed_number({0, 0}, whose), low = keyed_number({0, 1}, whose);
  // Version 4, and the variant that RFC 9562 describes.
  const std::string uuid = fmt::format("{:08x}-{:04x}-4{:03x}-{:04x}-{:012x}", high >> 32, high >> 16 & 0xffff,
                                       high & 0xfff, (low >> 48 & 0x3fff) | 0x8000, low & 0xffff'ffff'ffff);
  const nlohmann::ordered_json info{
      {"uuid", uuid},
      {"title", homework.title},
      {"topic", "Visible surfaces"},
      {"tags", nlohmann::ordered_json::array()},
      {"type", "v3"},
      {"gradingMethod", "External"},
      {"singleVariant", true},
      {"showCorrectAnswer", false},
      {"partialCredit", true},
      {"externalGradingOptions",
       {{"enabled", true}, {"image", "NAME"}, {"entrypoint", "/zstep/grade.sh"}, {"timeout", seconds_for(homework)}}}};
  return info.dump(2) + "\n";
}

namespace {

/// Text in a question's page, which is HTML, and before that a Mustache template.
std::string in_question(std::string_view text) {
  std::string html;
  for (const char c : shown(text)) html += c == '{' ? "&#123;" : c == '}' ? "&#125;" : std::string(1, c);
  return html;
}

}  // namespace

std::string prairielearn_question(const Homework& homework) {
  std::string files, what;
  if (homework.program.empty()) {
    for (const Task& task : homework.tasks)
      if (!task.hidden)
        what += (what.empty() ? "" : ", ") + fmt::format("<code>{}.jsonl</code>", in_question(task.name));
    what = "Hand in what your program prints on each scene: " + what + ".";
    files = "*.jsonl, *.png, *.npy, *.pfm";
  } else {
    what = fmt::format("Hand in your program, all files of it. On each scene it is run by <code>{} SCENE.txt</code>.",
                       in_question(homework.program));
    files = "*";
  }
  return fmt::format(
      "<pl-question-panel>\n"
      "  <h2>{}</h2>\n"
      "  <p>{}</p>\n"
      "  <pl-file-upload optional-file-patterns=\"{}\"></pl-file-upload>\n"
      "</pl-question-panel>\n"
      "<pl-submission-panel>\n"
      "  <pl-external-grader-results></pl-external-grader-results>\n"
      "  <pl-file-preview></pl-file-preview>\n"
      "</pl-submission-panel>\n",
      in_question(homework.title), what, files);
}

namespace {

/// The scenes' points in whole numbers that add up to all of them, rounded: those that lose most by being cut off get
/// one more.
std::vector<std::int64_t> whole_points(const Homework& homework) {
  const double all = homework.points();
  std::vector<std::int64_t> points;
  std::vector<std::pair<double, std::size_t>> lost;
  std::int64_t given = 0;
  for (const Task& task : homework.tasks) {
    const double exact = homework.share(task) * all;
    points.push_back(static_cast<std::int64_t>(std::floor(exact)));
    given += points.back();
    lost.emplace_back(std::floor(exact) - exact, lost.size());
  }
  std::sort(lost.begin(), lost.end());
  for (std::size_t k = 0; given < std::llround(all); ++given, ++k) ++points[lost[k % lost.size()].second];
  return points;
}

/// A text in a workflow. JSON's texts are YAML's, too.
std::string in_yaml(const std::string& text) { return nlohmann::json(text).dump(); }

}  // namespace

std::string github_workflow(const Homework& homework) {
  std::string steps, runners, results;
  const std::vector<std::int64_t> points = whole_points(homework);
  for (std::size_t k = 0; k < homework.tasks.size(); ++k) {
    const Task& task = homework.tasks[k];
    const std::string id = fmt::format("scene-{}", k + 1),
                      command = ".zstep/zstep/zstep grade --homework .zstep/homework \"$RUNNER_TEMP/runs\" --scene " +
                                shell_word(task.name);
    steps += fmt::format(
        "      - name: {0}\n"
        "        id: {1}\n"
        "        if: always()\n"
        "        uses: classroom-resources/autograding-command-grader@v1\n"
        "        with:\n"
        "          test-name: {0}\n"
        "          command: {2}\n"
        "          timeout: 5\n"
        "          max-score: {3}\n",
        in_yaml(task.name), id, in_yaml(command), points[k]);
    std::string upper = id;
    for (char& c : upper) c = upper_case(c);
    results += fmt::format("          {}_RESULTS: \"${{{{steps.{}.outputs.result}}}}\"\n", upper, id);
    runners += (runners.empty() ? "" : ",") + id;
  }
  const std::string program =
      homework.program.empty()
          ? "      - run: cp -r . \"$RUNNER_TEMP/runs\"\n"
          : fmt::format(
                "      - run: sudo apt-get update && sudo apt-get install -y --no-install-recommends {}\n"
                "      - run: |\n"
                "          mkdir \"$RUNNER_TEMP/program\" && cp -r ./* \"$RUNNER_TEMP/program\"\n"
                "          .zstep/zstep/zstep homework run .zstep/homework \"$RUNNER_TEMP/program\" -o "
                "\"$RUNNER_TEMP/runs\" "
                "|| true\n",
                packages_for(homework.program));
  return fmt::format(
      "# GitHub Classroom reads the points of the scenes; the report with each part's points is in the job's summary.\n"
      "# https://docs.github.com/en/education/manage-coursework-with-github-classroom/teach-with-github-classroom/"
      "use-autograding\n"
      "name: Homework\n"
      "on: [push, workflow_dispatch, repository_dispatch]\n"
      "permissions:\n"
      "  checks: write\n"
      "  actions: read\n"
      "  contents: read\n"
      "jobs:\n"
      "  grade:\n"
      "    runs-on: ubuntu-latest\n"
      "    if: github.actor != 'github-classroom[bot]'\n"
      "    steps:\n"
      "      - uses: actions/checkout@v4\n"
      "{}"
      "      - run: |\n"
      "          report=$(.zstep/zstep/zstep grade --homework .zstep/homework \"$RUNNER_TEMP/runs\") || true\n"
      "          [ -n \"$report\" ] || report='could not be graded: the grading was stopped from outside'\n"
      "          printf '```\\n%s\\n```\\n' \"$report\" >> \"$GITHUB_STEP_SUMMARY\"\n"
      "{}"
      "      - uses: classroom-resources/autograding-grading-reporter@v1\n"
      "        if: always()\n"
      "        env:\n{}"
      "        with:\n"
      "          runners: {}\n",
      program, steps, results, runners);
}

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
