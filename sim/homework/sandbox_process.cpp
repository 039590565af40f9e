#include "sim/homework/sandbox_process.hpp"

#include <fcntl.h>
#include <grp.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <cerrno>
#include <csignal>
#include <vector>

#include "sim/homework/sandbox_usage.hpp"
#include "traces/error.hpp"

namespace zstep::homework {

namespace {

void limit(int what, std::uint64_t most) {
  const rlimit both{static_cast<rlim_t>(most), static_cast<rlim_t>(most)};
  setrlimit(static_cast<decltype(RLIMIT_CPU)>(what), &both);
}

/// In the new process, up to exec: nothing here asks for memory.
[[noreturn]] void become(char* const* words, char* const* environment, const char* folder, const int (&pipes)[2],
                         bool walls, bool as_nobody, const Limits& limits) {
  setsid();
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, 0), dup2(pipes[0], 1), dup2(pipes[1], 2);
  for (int open_file = 3; open_file < 4096; ++open_file) close(open_file);
  for (const int number : {SIGINT, SIGPIPE, SIGXFSZ, SIGCHLD}) std::signal(number, SIG_DFL);
  // Where the machine has no memory left, it is this that goes, and not the grader.
  if (const int first = open("/proc/self/oom_score_adj", O_WRONLY); first >= 0) {
    [[maybe_unused]] const ssize_t written = write(first, "1000", 4);
    close(first);
  }
  if (as_nobody && (setgroups(0, nullptr) != 0 || setgid(nobody) != 0 || setuid(nobody) != 0)) _exit(126);
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  limit(RLIMIT_DATA, Limits::bytes(limits.memory));  // what is only reserved, as Java and JavaScript do, does not count
  if (!walls && as_nobody) limit(RLIMIT_NPROC, static_cast<std::uint64_t>(limits.refused_from()));
#else
  limit(RLIMIT_AS, Limits::bytes(limits.memory));
#endif
  limit(RLIMIT_CPU, static_cast<std::uint64_t>(limits.seconds) + 1);
  limit(RLIMIT_FSIZE, Limits::bytes(limits.files));
  limit(RLIMIT_NOFILE, 256);
  limit(RLIMIT_CORE, 0);
  umask(077);
  if (chdir(folder) != 0) _exit(126);
  if (walls) {
    for (const char* place : bubblewrap_places) execve(place, words, environment);
  } else {
    execve(words[0], words, environment);
  }
  _exit(127);
}

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> all;
  for (std::string& word : words) all.push_back(word.data());
  all.push_back(nullptr);
  return all;
}

}  // namespace

Process::Process(const Stage& stage, const std::string& command, bool walls, const Limits& limits) {
  std::vector<std::string> words = stage.words(command, walls, limits), environment = stage.environment(walls);
  const std::vector<char*> word_list = pointers(words), environment_list = pointers(environment);
  const std::string folder = stage.folder(walls).string();
  const bool as_nobody = runs_as_nobody();
  int out[2], errors[2];
  if (pipe(out) != 0) throw InputError("the program", "cannot be run: no pipe can be had", "close other programs");
  if (pipe(errors) != 0) {
    close(out[0]), close(out[1]);
    throw InputError("the program", "cannot be run: no pipe can be had", "close other programs");
  }
#ifdef __linux__
  prctl(PR_SET_CHILD_SUBREAPER, 1);  // so what leaves its group is still found below this process
#endif
  process_ = fork();
  if (process_ == 0)
    become(word_list.data(), environment_list.data(), folder.c_str(), {out[1], errors[1]}, walls, as_nobody, limits);
  close(out[1]), close(errors[1]);
  pipes_ = {out[0], errors[0]};
  for (const int pipe : pipes_) fcntl(pipe, F_SETFL, O_NONBLOCK);
  if (process_ < 0) {
    for (const int pipe : pipes_) close(pipe);
    throw InputError("the program", "cannot be run: no process can be started", "close other programs");
  }
}

Process::~Process() {
  end();
  for (const int pipe : pipes_)
    if (pipe >= 0) close(pipe);
}

void Process::close_pipe(std::size_t which) {
  close(pipes_[which]);
  pipes_[which] = -1;
}

bool Process::look() {
  if (!ended_ && wait4(process_, &status_, WNOHANG, &taken_) == process_) ended_ = true;
  return ended_;
}

void Process::end() {
  kill(-process_, SIGKILL);
  if (!ended_) {
    kill(process_, SIGKILL);
    while (wait4(process_, &status_, 0, &taken_) < 0 && errno == EINTR) {
    }
    ended_ = true;
  }
  // What has left the group has this process as its parent now.
  for (int round = 0; round < 200; ++round) {
    const Usage left = usage_below(getpid());
    for (const pid_t one : left.processes) kill(one, SIGKILL);
    while (waitpid(-1, nullptr, WNOHANG) > 0) {
    }
    if (left.processes.empty()) break;
    usleep(5000);
  }
}

double Process::seconds() const {
  const auto of = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) / 1e6;
  };
  return of(taken_.ru_utime) + of(taken_.ru_stime);
}

}  // namespace zstep::homework
