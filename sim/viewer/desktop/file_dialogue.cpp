#include "sim/viewer/desktop/file_dialogue.hpp"

#include <csignal>
#include <cstdlib>
#include <sstream>

#include <SDL.h>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace zstep::viewer {
namespace {

bool on_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((folder + "/" + program).c_str(), X_OK) == 0) return true;
  return false;
}

/// What the process prints, up to its end; at most as much as a path can be.
std::string read_all(int from) {
  constexpr std::size_t longest = 1 << 16;
  std::string text;
  char piece[4096];
  for (ssize_t got = 0; (got = read(from, piece, sizeof piece)) > 0;)
    if (text.size() < longest) text.append(piece, static_cast<std::size_t>(got));
  return text;
}

void drop_on_window(std::string path) {
  if (!path.empty() && path.back() == '\n') path.pop_back();
  if (path.empty()) return;
  SDL_Event event{};
  event.type = SDL_DROPFILE;
  event.drop.file = SDL_strdup(path.c_str());
  if (SDL_PushEvent(&event) < 1) SDL_free(event.drop.file);
}

}  // namespace

std::vector<std::string> dialogue_command(const std::filesystem::path& folder) {
  const std::string title = "Open a lesson, a scene, a mesh or a trace", at = folder.string() + "/";
  if (on_path("zenity")) return {"zenity", "--file-selection", "--title=" + title, "--filename=" + at};
  if (on_path("kdialog")) return {"kdialog", "--title", title, "--getopenfilename", at};
  return {};
}

bool FileDialogue::ask(const std::filesystem::path& folder) {
  std::vector<std::string> command = dialogue_command(folder);
  if (command.empty()) return false;
  if (process_ != 0) {
    siginfo_t ended{};
    if (waitid(P_PID, static_cast<id_t>(process_), &ended, WEXITED | WNOHANG | WNOWAIT) == 0 && ended.si_pid == 0)
      return true;  // it is open
    close();
  }
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return false;
  std::vector<char*> arguments;
  for (std::string& word : command) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  const int failed = posix_spawnp(&process_, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  if (failed != 0) {
    ::close(ends[0]);
    process_ = 0;
    return false;
  }
  waits_ = std::thread([from = ends[0], process = process_] {
    const std::string chosen = read_all(from);
    ::close(from);
    siginfo_t ended{};
    // It stays known by its number until close(), so that none but it can be ended there.
    waitid(P_PID, static_cast<id_t>(process), &ended, WEXITED | WNOWAIT);
    if (ended.si_code == CLD_EXITED && ended.si_status == 0) drop_on_window(chosen);
  });
  return true;
}

void FileDialogue::close() {
  if (process_ == 0) return;
  kill(process_, SIGTERM);
  waits_.join();
  waitpid(process_, nullptr, 0);
  process_ = 0;
}

}  // namespace zstep::viewer
