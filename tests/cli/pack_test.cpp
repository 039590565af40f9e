// zstep homework pack: what the services get, laid out and run as they do it.
#include <doctest/doctest.h>

#include <unistd.h>

#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"
#include "tests/cli/result_rules.hpp"

using namespace zstep::test;
using nlohmann::json;
namespace fs = std::filesystem;

namespace {

bool there_is_a(const char* program) {
  for (const char* folder : {"/usr/bin/", "/bin/", "/usr/local/bin/"})
    if (fs::exists(std::string(folder) + program)) return true;
  return false;
}

/// A folder hw whose programs are run by Python.
void homework_of_programs(const Folder& folder) {
  REQUIRE(run(folder, "homework new z-buffer hw").code == 0);
  std::string text = text_of(folder / "hw/homework.toml");
  const std::string before = "\n[options]\n";
  text.replace(text.find(before), before.size(), "\n[program]\ncommand = \"python3 zbuffer.py\"\n" + before);
  write_text(folder / "hw/homework.toml", text);
}

/// Runs a line in a root that has the system's programs and these folders, written to in place, and no network.
Outcome in_a_root(const Folder& folder, const std::string& binds, const std::string& line) {
  return shell(folder, "bwrap --unshare-pid --unshare-net " + std::string(geteuid() == 0 ? "--cap-add ALL " : "") +
                           "--ro-bind /usr /usr --ro-bind-try /bin /bin --ro-bind-try /lib /lib --ro-bind-try /lib64 "
                           "/lib64 --ro-bind-try /sbin /sbin --ro-bind-try /etc/alternatives /etc/alternatives --proc "
                           "/proc --dev /dev --tmpfs /tmp --setenv HOME / " +
                           binds + " -- " + line);
}
bool can_have_a_root(const Folder& folder) { return there_is_a("bwrap") && in_a_root(folder, "", "true").code == 0; }

/// Lets the packed zstep end as by the machine's own hand where it is called so: "grade", "homework".
void kill_zstep(const fs::path& pack, const std::string& called) {
  fs::rename(pack / "zstep", pack / "zstep.right");
  write_text(pack / "zstep", "#!/bin/sh\ncase $1 in " + called + ") kill -9 $$ ;; esac\nexec \"$0.right\" \"$@\"\n");
  fs::permissions(pack / "zstep", fs::perms(0755));
}
void mend_zstep(const fs::path& pack) { fs::rename(pack / "zstep.right", pack / "zstep"); }

void check_results(const json& results, double points) {
  CHECK(results["score"] == doctest::Approx(points));
  CHECK(results["tests"].size() >= 15);
}

/// Gradescope's result where the grader itself was ended.
void check_stopped(const fs::path& file) {
  const std::string text = text_of(file);
  check_gradescope(text);
  const json left = json::parse(text);
  check_results(left, 0);
  CHECK(left["extra_data"]["gradable"] == false);
  CHECK(has(left["output"].get<std::string>(), "could not be graded: the grader was stopped from outside"));
  for (const json& test : left["tests"]) CHECK(has(test["output"].get<std::string>(), "could not be graded"));
}

}  // namespace

TEST_CASE("homework pack: Gradescope's autograder has what it needs, no more, and grades as Gradescope calls it") {
  if (!there_is_a("zip") && !there_is_a("python3") && !there_is_a("bsdtar")) return;
  const Folder folder;
  homework_of_programs(folder);
  const Outcome packed = run(folder, "homework pack hw --gradescope -o autograder.zip");
  CAPTURE(packed.err);
  REQUIRE(packed.code == 0);
  CHECK(has(packed.out, "Upload autograder.zip"));
  CHECK(folder.names() == std::vector<std::string>{"autograder.zip", "hw"});
  CHECK(text_of(folder / "autograder.zip").starts_with("PK\3\4"));
  if (!there_is_a("python3")) return;
  REQUIRE(shell(folder,
                "mkdir -p autograder/source autograder/results && /usr/bin/python3 -m zipfile -e autograder.zip "
                "autograder/source && chmod +x autograder/source/run_autograder && cp "
                "autograder/source/run_autograder autograder/ && cp -r hw/solution autograder/submission")
              .code == 0);
  for (const char* file : {"setup.sh", "run_autograder", "homework/homework.toml", "homework/hidden/overlap.toml",
                           "zstep/zstep", "zstep/lib/zstep"})
    CHECK_MESSAGE(fs::exists(folder / ("autograder/source/" + std::string(file))), file);
  CHECK_FALSE(fs::exists(folder / "autograder/source/homework/solution"));
  CHECK(shell(folder, "bash -n autograder/source/setup.sh && bash -n autograder/run_autograder").code == 0);
  CHECK(has(text_of(folder / "autograder/source/setup.sh"), "bubblewrap"));
  CHECK(has(text_of(folder / "autograder/source/setup.sh"), "python3"));
  // As setup.sh does at its end; a zip does not keep what may be run everywhere.
  REQUIRE(
      shell(folder, "grep -v '^apt-get' autograder/source/setup.sh | sed 's|/autograder|autograder|g' | bash").code ==
      0);
  // Every library comes along.
  const Outcome needs = shell(folder, "cd autograder/source/zstep/lib && ./ld-* --library-path . --list ./zstep");
  CHECK(needs.code == 0);
  std::istringstream lines(needs.out);
  int libraries = 0;
  for (std::string line; std::getline(lines, line);)
    if (has(line, "=>")) {
      ++libraries;
      CHECK_MESSAGE((has(line, "=> ./") || has(line, "ld-linux")), line);
    }
  CHECK(libraries > 5);

  if (!can_have_a_root(folder)) return;
  const std::string binds = "--bind autograder /autograder";
  const Outcome graded = in_a_root(folder, binds, "sh -c 'cd /autograder && ./run_autograder'");
  CAPTURE(graded.out);
  CAPTURE(graded.err);
  CHECK(graded.code == 0);
  check_gradescope(text_of(folder / "autograder/results/results.json"));
  check_results(json::parse(text_of(folder / "autograder/results/results.json")), 65);
  // Nothing handed in: a result, too.
  fs::remove_all(folder / "autograder/submission");
  fs::create_directory(folder / "autograder/submission");
  write_text(folder / "autograder/submission/results.json", "{\"score\":65}");
  CHECK(in_a_root(folder, binds, "sh -c 'cd /autograder && ./run_autograder'").code == 0);
  check_results(json::parse(text_of(folder / "autograder/results/results.json")), 0);

  // Something ends the grader itself: a result is left that says so, and that of an earlier run is not.
  for (const char* killed : {"grade", "homework"}) {
    CAPTURE(killed);
    kill_zstep(folder / "autograder/source/zstep", killed);
    write_text(folder / "autograder/results/results.json", "{\"score\":65}");
    CHECK(in_a_root(folder, binds, "sh -c 'cd /autograder && ./run_autograder'").code == 0);
    mend_zstep(folder / "autograder/source/zstep");
    check_stopped(folder / "autograder/results/results.json");
  }

  // A program that hangs is ended by its own limit; where the service's comes first, that ends the grader.
  fs::remove(folder / "autograder/submission/results.json");
  write_text(folder / "autograder/submission/zbuffer.py", "while True:\n    pass\n");
  in_a_root(folder, binds, "timeout -s KILL 2 sh -c 'cd /autograder && ./run_autograder'");
  check_stopped(folder / "autograder/results/results.json");
  const fs::path toml = folder / "autograder/source/homework/homework.toml";
  std::string text = text_of(toml);
  const std::string command = "\n[program]\n";
  text.replace(text.find(command), command.size(), command + "seconds = 0.5\n");
  write_text(toml, text);
  CHECK(in_a_root(folder, binds, "sh -c 'cd /autograder && ./run_autograder'").code == 0);
  const std::string ended = text_of(folder / "autograder/results/results.json");
  check_gradescope(ended);
  check_results(json::parse(ended), 0);
  CHECK(has(ended, "was stopped after "));
}

TEST_CASE("homework pack: PrairieLearn's grader has an image, a script and the lines of info.json, and grades") {
  const Folder folder;
  homework_of_programs(folder);
  const Outcome packed = run(folder, "homework pack hw --prairielearn -o grader");
  CAPTURE(packed.err);
  REQUIRE(packed.code == 0);
  const json info = json::parse(text_of(folder / "grader/info.json"));
  const json& options = info["externalGradingOptions"];
  CHECK(options["enabled"] == true);
  CHECK(options["entrypoint"] == "/zstep/grade.sh");
  CHECK(options["timeout"].get<int>() <= 600);
  const std::string image = text_of(folder / "grader/Dockerfile");
  for (const char* copied : {"COPY zstep ", "COPY homework ", "COPY grade.sh ", "COPY stopped.json "})
    CHECK(has(image, copied));
  CHECK_FALSE(fs::exists(folder / "grader/homework/solution"));
  if (!can_have_a_root(folder) || !there_is_a("python3")) return;
  REQUIRE(shell(folder, "mkdir grade && cp -r hw/solution grade/student").code == 0);
  const Outcome graded = in_a_root(folder, "--bind grader /zstep --bind grade /grade", "/zstep/grade.sh");
  CAPTURE(graded.out);
  CAPTURE(graded.err);
  CHECK(graded.code == 0);
  check_prairielearn(text_of(folder / "grade/results/results.json"));
  const json results = json::parse(text_of(folder / "grade/results/results.json"));
  CHECK(results["gradable"] == true);
  check_results(results, 1);
  const auto check_left = [&] {
    const std::string text = text_of(folder / "grade/results/results.json");
    check_prairielearn(text);
    const json left = json::parse(text);
    CHECK(left["gradable"] == false);
    CHECK_FALSE(left.contains("score"));
    CHECK(left["format_errors"].size() == 4);
    CHECK(has(left["format_errors"][0].get<std::string>(), "the grader was stopped from outside"));
  };
  kill_zstep(folder / "grader/zstep", "grade");
  CHECK(in_a_root(folder, "--bind grader /zstep --bind grade /grade", "/zstep/grade.sh").code == 0);
  mend_zstep(folder / "grader/zstep");
  check_left();
  // A program that hangs until the service's time is up.
  write_text(folder / "grade/student/zbuffer.py", "while True:\n    pass\n");
  in_a_root(folder, "--bind grader /zstep --bind grade /grade", "timeout -s KILL 2 /zstep/grade.sh");
  check_left();
}

TEST_CASE("homework pack: PrairieLearn's question is whole, and the same one when it is packed again") {
  const Folder folder;
  homework_of_programs(folder);
  for (const char* out : {"one", "two"})
    REQUIRE(run(folder, std::string("homework pack hw --prairielearn -o ") + out).code == 0);
  const std::string text = text_of(folder / "one/info.json"), question = text_of(folder / "one/question.html");
  CHECK(text == text_of(folder / "two/info.json"));
  const json info = json::parse(text);
  // What apps/prairielearn/src/schemas/infoQuestion.ts requires, and what the grading needs beside: left out, the
  // method would be Internal.
  const std::regex uuid("[0-9a-f]{8}-[0-9a-f]{4}-4[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}");
  CHECK(std::regex_match(info["uuid"].get<std::string>(), uuid));
  CHECK(info["title"] == "The Z-buffer");
  CHECK_FALSE(info["topic"].get<std::string>().empty());
  CHECK(info["type"] == "v3");
  CHECK(info["gradingMethod"] == "External");
  CHECK(info["singleVariant"] == true);
  CHECK(info["partialCredit"] == true);
  for (const auto& [key, value] : info.items())
    CHECK_MESSAGE(std::set<std::string>({"uuid", "title", "topic", "tags", "type", "gradingMethod", "singleVariant",
                                         "showCorrectAnswer", "partialCredit", "externalGradingOptions"})
                      .contains(key),
                  key);
  for (const char* part : {"<pl-question-panel>", "<pl-file-upload optional-file-patterns=\"*\">",
                           "<pl-submission-panel>", "<pl-external-grader-results>"})
    CHECK_MESSAGE(has(question, part), part);
  // Another homework is another question; what HTML or Mustache would take for its own is written so that it is text.
  std::string toml = text_of(folder / "hw/homework.toml");
  toml.replace(toml.find("title = \"The Z-buffer\""), 22, "title = \"<Z> {{buffer}} & Co\"");
  toml.erase(toml.find("\n[program]\n"), toml.find("\n[options]\n") - toml.find("\n[program]\n"));
  write_text(folder / "hw/homework.toml", toml);
  REQUIRE(run(folder, "homework pack hw --prairielearn -o three").code == 0);
  const json other = json::parse(text_of(folder / "three/info.json"));
  CHECK(other["uuid"] != info["uuid"]);
  CHECK(other["title"] == "<Z> {{buffer}} & Co");
  const std::string runs = text_of(folder / "three/question.html");
  CHECK(has(runs, "&lt;Z&gt; &#123;&#123;buffer&#125;&#125; &amp; Co"));
  CHECK(has(runs, "<code>triangle.jsonl</code>"));
  CHECK_FALSE(has(runs, "overlap"));
}

TEST_CASE("homework pack: the points of GitHub's scenes are whole and add up to the homework's") {
  for (const char* weights : {"", "weight = 3\n", "weight = 0.01\n"}) {
    const Folder folder;
    homework_of_programs(folder);
    std::string toml = text_of(folder / "hw/homework.toml");
    const std::string scene = "file = \"scenes/crossing.toml\"\n";
    toml.replace(toml.find(scene), scene.size(), scene + weights);
    write_text(folder / "hw/homework.toml", toml);
    REQUIRE(run(folder, "homework pack hw --github -o repository").code == 0);
    const std::string workflow = text_of(folder / "repository/.github/workflows/classroom.yml");
    const std::regex score("max-score: ([0-9]+)\n");
    int all = 0, scenes = 0;
    for (std::sregex_iterator at(workflow.begin(), workflow.end(), score), end; at != end; ++at, ++scenes)
      all += std::stoi((*at)[1]);
    CHECK(scenes == 3);
    CHECK(all == 65);
  }
}

TEST_CASE("homework pack: GitHub's repository has no hidden scene and no solution, and its zstep grades") {
  const Folder folder;
  homework_of_programs(folder);
  write_text(folder / "hw/secret.key", "5ec2e75ec2e75ec2e75ec2e75ec2e75e\n");
  REQUIRE(run(folder, "homework pack hw --github -o repository").code == 0);
  REQUIRE(run(folder, "homework pack hw --prairielearn -o grader").code == 0);
  CHECK(shell(folder, "grep -rl 5ec2e75ec2e7 repository/.zstep/homework grader/homework").out.empty());
  const std::string workflow = text_of(folder / "repository/.github/workflows/classroom.yml");
  for (const char* part : {"actions/checkout@v4", "--scene triangle", "--scene crossing", "--scene neighbours",
                           "runners: scene-1,scene-2,scene-3", "python3"})
    CHECK_MESSAGE(has(workflow, part), part);
  CHECK_FALSE(has(workflow, "overlap"));
  CHECK(shell(folder, "find repository -name 'overlap*' -o -name solution").out.empty());
  REQUIRE(shell(folder,
                "mkdir runs && \"$zstep\" record hw/scenes/triangle.toml -o t.ztrace && "
                "\"$zstep\" dump t.ztrace --jsonl > runs/triangle.jsonl")
              .code == 0);
  const Outcome graded =
      shell(folder, "repository/.zstep/zstep/zstep grade --homework repository/.zstep/homework runs --scene triangle");
  CAPTURE(graded.out);
  CAPTURE(graded.err);
  CHECK(graded.code == 0);
}

TEST_CASE("homework pack: what cannot be packed is refused in a line, and nothing is left behind") {
  const Folder folder;
  REQUIRE(run(folder, "homework new z-buffer hw").code == 0);
  CHECK(has(run(folder, "homework pack hw --prairielearn -o grader").out, "write [program] in homework.toml"));
  struct Refused {
    const char *words, *message;
  };
  for (const Refused& one :
       {Refused{"hw -o a.zip", "for which service?"}, Refused{"hw --gradescope --github -o a.zip", "several services"},
        Refused{"hw --gradescope", "give -o FILE.zip or a folder"},
        Refused{"hw --gradescope -o a.tar", "Gradescope takes a zip"},
        Refused{"hw --prairielearn -o grader", "is there already"}, Refused{"nowhere --github -o a", "homework.toml"},
        Refused{"hw --github -o nowhere/a/b", "nowhere"}}) {
    const Outcome outcome = run(folder, std::string("homework pack ") + one.words);
    CAPTURE(one.words);
    CAPTURE(outcome.err);
    CHECK(outcome.code == 2);
    CHECK(has(outcome.err, one.message));
    CHECK(times(outcome.err, "\n") == 1);
  }
  CHECK(folder.names() == std::vector<std::string>{"grader", "hw"});
}
