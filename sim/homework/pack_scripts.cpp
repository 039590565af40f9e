#include "sim/homework/pack_scripts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sim/homework/seeds.hpp"
#include "sim/pages/page.hpp"
#include "sim/words/shell_word.hpp"

namespace zstep::homework {

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
    std::transform(upper.begin(), upper.end(), upper.begin(),
                   [](char c) { return static_cast<char>(std::toupper(c)); });
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

}  // namespace zstep::homework
