#include "tests/cli/program.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <random>
#include <sstream>

#include "tests/where.hpp"

namespace zstep::test {

namespace fs = std::filesystem;

Outcome shell(const Folder& folder, const std::string& line) {
  const Folder captured;
  const std::string command = "cd '" + folder.path().string() +
                              "' && unset DISPLAY WAYLAND_DISPLAY SDL_VIDEODRIVER && zstep='" + program_path() +
                              "' && { " + line + "\n} > '" + (captured / "out").string() + "' 2> '" +
                              (captured / "err").string() + "' < /dev/null";
  const int status = std::system(command.c_str());
  Outcome outcome;
  if (WIFEXITED(status)) outcome.code = WEXITSTATUS(status);
  else if (WIFSIGNALED(status)) outcome.code = 128 + WTERMSIG(status);
  outcome.out = text_of(captured / "out");
  outcome.err = text_of(captured / "err");
  return outcome;
}

Outcome run(const Folder& folder, const std::string& arguments) { return shell(folder, "\"$zstep\" " + arguments); }

pid_t start(const Folder& folder, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{program_path()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGINT, SIG_DFL);
    const int err = open((folder / "err").c_str(), O_CREAT | O_WRONLY, 0600);
    if (chdir(folder.path().c_str()) != 0 || err < 0) _exit(99);
    dup2(err, STDERR_FILENO);
    execv(argv[0], argv.data());
    _exit(99);
  }
  return child;
}

void write_text(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

int times(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++count;
  return count;
}

}  // namespace zstep::test
