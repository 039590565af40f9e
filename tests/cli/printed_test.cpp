// Every command that zstep prints for a person to type, in README, docs, lessons, --help and messages, does what it is
// printed for: it is run where the reader is, in the folder of the clone. (The console pages of docs_test.cpp are run
// there, with what they print.)
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"
#include "tests/where.hpp"
#include "traces/file/container.hpp"

using namespace zstep::test;

namespace {

namespace fs = std::filesystem;

const std::set<std::string> commands{
    "list",     "lesson",  "view",    "render", "record",          "info",       "dump",  "import", "find",   "history",
    "why-not",  "explain", "query",   "export", "compare-methods", "completion", "check", "diff",   "header", "error",
    "homework", "grade",   "publish", "emit"};
/// Those of the launcher, which tests/launcher tries.
const std::set<std::string> of_launcher{"test", "bench", "build", "clean", "packages", "help", "web"};

std::string all_matches_replaced(const std::string& text, const std::string& pattern, const std::string& now) {
  return std::regex_replace(text, std::regex(pattern), now);
}

/// The folder of a clone with files that commands are shown with.
void furnish(const Folder& clone) {
  fs::create_symlink(program_path(), clone / "zstep");
  fs::create_symlink(in_checkout("lessons"), clone / "lessons");
  write_text(clone / "bunny.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n");
  write_text(clone / "bunny.ply",
             "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
             "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  REQUIRE(run(clone, "record pyramid-behind -o run.ztrace").code == 0);
  REQUIRE(run(clone, "dump run.ztrace --jsonl > run.jsonl").code == 0);
  fs::copy_file(clone / "run.jsonl", clone / "homework.jsonl");
  fs::copy_file(clone / "run.jsonl", clone / "head.jsonl");
  fs::copy_file(clone / "run.ztrace", clone / "right.ztrace");
  REQUIRE(run(clone, "render pyramid-behind --save picture.png --save-depth-raw depths.npy").code == 0);
  fs::copy_file(in_checkout("lessons/scenes/wall.toml"), clone / "my.toml");
  write_text(clone / "my-lesson.md", all_matches_replaced(text_of(in_checkout("lessons/5-worked-example.md")),
                                                          "scene = .*", "scene = \"delhi\""));
  REQUIRE(run(clone, "homework new z-buffer hw3").code == 0);
  REQUIRE(run(clone, "homework new z-buffer hw4").code == 0);
  write_text(clone / "hw4/homework.toml",
             text_of(clone / "hw4/homework.toml") + "\n[[scene]]\ngenerate = \"triangles\"\nname = \"own\"\n");
  write_text(clone / "names.txt", "ana\nbo\n");
  fs::create_directory(clone / "runs");
  for (const std::string scene :
       {"hw3/scenes/triangle", "hw3/scenes/crossing", "hw3/scenes/neighbours", "hw3/hidden/overlap"}) {
    const std::string name = fs::path(scene).filename().string();
    REQUIRE(run(clone, "record " + scene + ".toml -o " + name + ".ztrace").code == 0);
    REQUIRE(run(clone, "dump " + name + ".ztrace --jsonl > runs/" + name + ".jsonl").code == 0);
  }
  fs::copy_file(clone / "runs/triangle.jsonl", clone / "triangle.jsonl");
  fs::create_directory(clone / "submissions");
  fs::copy(clone / "runs", clone / "submissions/ada");
  fs::create_directory(clone / "site");
  write_text(clone / "site/publish.html", "<!-- zstep publish " + std::to_string(zstep::trace_version) + " -->\n");
  write_text(clone / "log.csv", "1,2,5,0\n1,2,6,1\n");
  write_text(clone / "my_program", "#!/bin/sh\ncat run.jsonl\n");
  fs::permissions(clone / "my_program", fs::perms::owner_all);
  for (const char* folder : {"docs", "src", ".config/fish/completions"}) fs::create_directories(clone / folder);
  fs::create_directories(clone / ".local/share/bash-completion/completions");
}

/// The words after `zstep`, up to a pipe or a redirection.
std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  std::istringstream rest(line.substr(std::min(line.size(), line.find("zstep") + 5)));
  for (std::string word; rest >> word && word != "|" && word != ">";) words.push_back(word);
  return words;
}

/// Runs a line as a person types it; a window is drawn into a file instead.
void check_runs(const Folder& clone, std::string line) {
  static std::set<std::string> slow_ones_done;
  const std::vector<std::string> words = words_of(line);
  const bool zstep = line.find("zstep") != std::string::npos;
  if (zstep && !words.empty() && of_launcher.count(words[0]) == 1) return;
  if (zstep && !words.empty() && words[0].front() != '-')
    CHECK_MESSAGE(commands.count(words[0].substr(0, words[0].find_first_of(");"))) == 1, line);
  if (line.find("compare-methods") != std::string::npos &&
      !slow_ones_done.insert(line.substr(line.find("zstep"))).second)
    return;
  const bool opens = zstep && !words.empty() &&
                     (words[0] == "view" || words[0] == "lesson" || line.find(" --view") != std::string::npos);
  if (opens && line.find("--screenshot") == std::string::npos && line.find("--help") == std::string::npos)
    line += " --screenshot window.png";
  write_text(
      clone / "typed.sh",
      "export HOME=\"$PWD\" ZSTEP_SITE=site PATH=\"$PWD:$PATH\"\npython3() { cat homework.jsonl; }\nset -o pipefail\n" +
          line + "\n");
  const Outcome outcome = shell(clone, "bash typed.sh");
  CAPTURE(outcome.out);
  CAPTURE(outcome.err);
  const bool no_films_here = outcome.err.find("ffmpeg, which is not installed") != std::string::npos;
  // 1: it found pixels that are wrong, as the painter's algorithm has some on most scenes; or a run that is made wrong.
  const bool looks_for_faults = line.find("compare-methods") != std::string::npos ||
                                line.find("zstep check run.jsonl") != std::string::npos ||
                                line.find("zstep diff right.ztrace run.jsonl") != std::string::npos;
  const bool found = outcome.code == 1 && looks_for_faults;
  CHECK_MESSAGE((outcome.code == 0 || found || no_films_here), line);
}

/// A synopsis, or a command's name in a sentence, is not typed as it is printed; its command and its options must be
/// there.
bool is_synopsis(const std::string& line) {
  const std::string bare = all_matches_replaced(line, "\"[^\"]*\"", "");
  const bool needs_more = words_of(line).size() == 1 && line.find("zstep list") == std::string::npos &&
                          line.find("zstep lesson") == std::string::npos;
  return needs_more || std::regex_search(bare, std::regex(R"(\[|…|\||\b[A-Z]{2,}\b)"));
}

void check_synopsis(const Folder& clone, const std::string& line) {
  const std::vector<std::string> words = words_of(line);
  REQUIRE(!words.empty());
  if (words[0] == "COMMAND" || of_launcher.count(words[0]) == 1) return;
  const std::string help = run(clone, words[0] + " --help").out;
  CHECK_MESSAGE(help.find("Usage: ") != std::string::npos, line);
  std::smatch option;
  for (std::string rest = line; std::regex_search(rest, option, std::regex("--[a-z-]+")); rest = option.suffix())
    CHECK_MESSAGE(help.find(option.str()) != std::string::npos, line << ": " << option.str());
}

void check_line(const Folder& clone, const std::string& line) {
  if (is_synopsis(line)) check_synopsis(clone, line);
  else check_runs(clone, line);
}

/// Commands of a Markdown page, from its blocks and from its code spans. Lines of one block that end in \ are one.
std::vector<std::string> commands_of(const std::string& page) {
  static const std::regex typed(R"(^(\./)?zstep( .*)?$|^cp .*$)");
  static const std::regex remark("  .*$| $");  // what the command is for
  std::vector<std::string> lines;
  std::istringstream in(page);
  std::string joined;
  bool block = false, console = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("```")) {
      console = !block && line == "```console";
      block = !block;
    } else if (console) continue;
    else if (block) {
      joined += (joined.empty() ? "" : " ") + std::regex_replace(line, std::regex("^ +"), "");
      if (joined.ends_with(" \\")) {
        joined.resize(joined.size() - 2);
        continue;
      }
      const std::string command = std::regex_replace(joined, remark, "");
      if (std::regex_match(command, typed)) lines.push_back(command);
      joined.clear();
    } else {
      std::smatch span;
      for (std::string rest = line; std::regex_search(rest, span, std::regex("`([^`]+)`")); rest = span.suffix())
        if (const std::string text = span[1]; std::regex_match(text, std::regex(R"(^(\./)?zstep .*$)")))
          lines.push_back(text);
    }
  }
  return lines;
}

std::vector<std::string> pages_in(const std::string& folder) {
  std::vector<std::string> pages;
  for (const fs::directory_entry& entry : fs::directory_iterator(in_checkout(folder)))
    if (entry.path().extension() == ".md") pages.push_back(folder + "/" + entry.path().filename().string());
  std::sort(pages.begin(), pages.end());
  return pages;
}

void check_page(const std::string& page, std::size_t at_least) {
  CAPTURE(page);
  const Folder clone;
  furnish(clone);
  const std::vector<std::string> lines = commands_of(text_of(in_checkout(page)));
  CHECK(lines.size() >= at_least);
  for (const std::string& line : lines) check_line(clone, line);
}

/// In messages a command stands between words: it is what can be one. Comments and the examples of --help, which begin
/// a line, are left out.
std::vector<std::string> commands_in_source(const std::string& source) {
  static const std::regex start(
      R"((//[^\n]*|  )?zstep ([a-z-]+)((?: (?:--?[a-z-]+|[A-Z]{2,}(?:\.[a-z]+)?|[\w/-]+\.(?:ztrace|jsonl|png|toml|csv|npy|md)|)"
      R"(\d[\dx]*|[A-Z]|methods|options|scenes|lessons|teapot|pyramid)(?![\w{]))*))");
  std::vector<std::string> lines;
  std::smatch found;
  for (std::string rest = source; std::regex_search(rest, found, start); rest = found.suffix())
    if (!found[1].matched && commands.count(found[2]) == 1 && !found[3].str().empty() &&
        !std::string(found.suffix()).starts_with(" {"))
      lines.push_back(found.str());
  return lines;
}

/// What a person puts in the place of the capital words of a message.
std::string filled_in(std::string line) {
  for (const auto& [word, now] : std::vector<std::pair<std::string, std::string>>{{"FILE\\.ztrace", "run.ztrace"},
                                                                                  {"FILE\\.jsonl", "run.jsonl"},
                                                                                  {"FILE\\.png", "file.png"},
                                                                                  {"FILE", "run.ztrace"},
                                                                                  {"SCENE", "pyramid"}})
    line = all_matches_replaced(line, "\\b" + word + "\\b", now);
  return line;
}

}  // namespace

TEST_CASE("every command printed in the README runs") { check_page("README.md", 9); }

TEST_CASE("every command printed in the docs runs") {
  for (const std::string& page : pages_in("docs")) check_page(page, 0);
  check_page("CONTRIBUTING.md", 0);
}

TEST_CASE("no lesson sends anyone to a terminal, and each has something to be tried in the window") {
  for (const std::string& page : pages_in("lessons")) {
    CAPTURE(page);
    const std::string text = text_of(in_checkout(page));
    CHECK(commands_of(text).empty());
    CHECK(text.find("\n::: task\n") != std::string::npos);
  }
}

TEST_CASE("every example of --help runs") {
  const Folder clone;
  furnish(clone);
  for (const std::string& command : commands) {
    CAPTURE(command);
    std::istringstream help(run(clone, command + " --help").out);
    bool examples = false;
    int tried = 0;
    for (std::string line; std::getline(help, line);) {
      if (line.starts_with("Examples:")) examples = true;
      else if (examples && line.find("zstep") != std::string::npos) check_runs(clone, line.substr(2)), ++tried;
    }
    CHECK(tried >= 1);
  }
}

TEST_CASE("every command that a message names runs") {
  const Folder clone;
  furnish(clone);
  std::set<std::string> lines;
  for (const char* folder : {"sim", "algorithms", "traces"})
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(in_checkout(folder)))
      // What packed scripts run is run by tests/cli/pack_test.cpp.
      if ((entry.path().extension() == ".cpp" || entry.path().extension() == ".hpp") &&
          entry.path().filename() != "pack_homework.cpp")
        for (const std::string& line : commands_in_source(text_of(entry.path()))) lines.insert(filled_in(line));
  CHECK(lines.size() >= 10);
  for (const std::string& line : lines) {
    if (line.find(" NAME") != std::string::npos) continue;  // the head of a list of names
    check_runs(clone, line);
  }
}
