// libFuzzer target: command lines, a word on each line. Each is parsed here, where coverage is watched, and then run
// by a process of its own, as one command runs in a process; in a folder of its own, and with words that lead nowhere
// else.
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <iterator>
#include <string>
#include <vector>

#include "sim/cli/app.hpp"
#include "sim/cli/messages.hpp"
#include "tests/folder.hpp"
#include "tests/fuzz/questions.hpp"
#include "tests/fuzz/trace_mutator.hpp"
#include "tests/where.hpp"

using namespace zstep;

namespace {

namespace fs = std::filesystem;
namespace code = cli::exit_code;

constexpr unsigned most_seconds = 5;  // what a person asks for, a large picture say, may take longer
constexpr int shift = 100;            // of the exit code of a command that came to its end, apart from a sanitizer's
constexpr int no_memory = 71;         // of libFuzzer, where more is asked for than it gives

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> words{""};
  char quote = 0;
  for (const char c : text) {
    if (at == ' ' && (c == '"' || c == '\'') && (quote == 0 || quote == c)) quote = quote == 0 ? c : char{0};
    else if (c == at && quote == 0) words.emplace_back();
    else words.back() += c;
  }
  return words;
}

/// The command lines of the manual, a word a line.
const std::vector<std::string>& known_lines() {
  static const std::vector<std::string> lines = [] {
    std::vector<std::string> found;
    for (const std::string& line : split(test::text_of(test::in_checkout("docs/command-line.md")), '\n')) {
      if (!line.starts_with("$ zstep ")) continue;
      std::string words;
      for (const std::string& word : split(line.substr(8), ' ')) words += word + "\n";
      found.push_back(words);
    }
    return found;
  }();
  return lines;
}

/// Nowhere but below the folder in which it is.
std::string kept_inside(std::string word) {
  word.erase(std::remove(word.begin(), word.end(), '\0'), word.end());
  while (word.find("..") != std::string::npos) word.erase(word.find(".."), 1);
  for (std::size_t at = 0; at < word.size(); ++at) {
    const bool within = at > 0 && word[0] != '-' && std::isalnum(static_cast<unsigned char>(word[at - 1])) != 0;
    if (word[at] == '/' && !within) word[at] = '_';
  }
  return word;
}

/// The files that the manual's command lines name.
void put_files(const fs::path& folder) {
  static const std::string lines = test::text_of(test::in_checkout("tests/golden/delhi.jsonl"));
  static const Bytes trace = fuzz::bytes_of_lines(lines);
  std::ofstream(folder / "run.jsonl", std::ios::binary) << lines;
  std::ofstream(folder / "run.ztrace", std::ios::binary)
      .write(reinterpret_cast<const char*>(trace.data()), static_cast<std::streamsize>(trace.size()));
  fs::copy_file(test::in_checkout("tests/fuzz/seeds/mesh/pyramid.obj"), folder / "mesh.obj");
  fs::copy_file(test::in_checkout("tests/golden/saddle.toml"), folder / "scene.toml");
  fs::copy_file(test::in_checkout("lessons/4-z-buffer.md"), folder / "lesson.md");
}

[[noreturn]] void run_here(const fs::path& folder, const std::vector<std::string>& words) {
  std::signal(SIGALRM, SIG_DFL);
  std::signal(SIGXFSZ, SIG_IGN);
  alarm(most_seconds);
  const rlimit most_bytes{1 << 24, 1 << 24};
  setrlimit(RLIMIT_FSIZE, &most_bytes);
  for (const char* name : {"HOME", "XDG_CONFIG_HOME", "TMPDIR"}) setenv(name, folder.c_str(), 1);
  setenv("PATH", "/nowhere", 1);
  if (chdir(folder.c_str()) != 0) std::_Exit(code::mistake);
  const int nothing = open("/dev/null", O_RDWR), said = open("stderr", O_CREAT | O_WRONLY | O_TRUNC, 0600);
  dup2(nothing, 0), dup2(nothing, 1), dup2(said, 2);
  const int ended = cli::run(words);
  std::fflush(nullptr);
  std::_Exit(shift + ended);
}

void run(const std::vector<std::string>& words) {
  const test::Folder folder;
  put_files(folder.path());
  const pid_t process = fork();
  if (process < 0) return;
  if (process == 0) run_here(folder.path(), words);
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {  // by libFuzzer's clock
  }
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) return;
  constexpr std::array known{shift + code::done,
                             shift + code::finding,
                             shift + code::bad_input,
                             shift + code::incomplete,
                             shift + code::exhausted,
                             code::incomplete,
                             no_memory};
  if (WIFEXITED(status) && std::find(known.begin(), known.end(), WEXITSTATUS(status)) != known.end()) return;
  std::cerr << test::text_of(folder / "stderr") << "ended with status " << status << ", of:";
  for (const std::string& word : words) std::cerr << " '" << word << "'";
  std::cerr << std::endl;
  fuzz::check(false);
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  static const fuzz::TextMutator mutate({"docs/command-line.md", "docs/trace-format.md"});
  fuzz::Random random(seed + 1);
  std::string text(data, data + size);
  if (fuzz::pick(random, 4) == 0) text = known_lines()[fuzz::pick(random, known_lines().size())];
  return fuzz::give(mutate(text, random), data, most);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::string> words = split({data, data + size}, '\n');
  if (words.back().empty()) words.pop_back();
  for (std::string& word : words) word = kept_inside(word);
  fuzz::answered([&] {
    cli::parse(words);
    run(words);
  });
  return 0;
}
