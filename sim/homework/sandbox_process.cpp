#include "sim/homework/sandbox_process.hpp"

#include <fcntl.h>
#include <grp.h>
#include <poll.h>
#include <sched.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <cerrno>
#include <csignal>
#include <optional>
#include <utility>
#include <vector>

#include "sim/homework/sandbox_files.hpp"
#include "sim/homework/sandbox_usage.hpp"
#include "traces/error.hpp"

namespace zstep::homework {

namespace {

void limit(int what, std::uint64_t most) {
  const rlimit both{static_cast<rlim_t>(most), static_cast<rlim_t>(most)};
  setrlimit(static_cast<decltype(RLIMIT_CPU)>(what), &both);
}

/// What the program begins with.
struct Begin {
  char* const* words;
  char* const* environment;
  const char* folder;
  int out, errors;
  bool walls;
  std::optional<unsigned> user;
  const Limits& limits;
  pid_t grader;
};

/// All but the first three, and `kept`.
void close_all_but(int kept) {
  for (int open_file = 3; open_file < 4096; ++open_file)
    if (open_file != kept) close(open_file);
}

/// In the new process, up to exec: nothing here asks for memory.
[[noreturn]] void become(const Begin& begin) {
  const Limits& limits = begin.limits;
  setsid();
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, 0), dup2(begin.out, 1), dup2(begin.errors, 2);
  close_all_but(-1);
  for (const int number : {SIGINT, SIGPIPE, SIGXFSZ, SIGCHLD}) std::signal(number, SIG_DFL);
  // Where the machine has no memory left, it is this that goes, and not the grader.
  if (const int first = open("/proc/self/oom_score_adj", O_WRONLY); first >= 0) {
    [[maybe_unused]] const ssize_t written = write(first, "1000", 4);
    close(first);
  }
  const bool other_user = begin.user.has_value();
#ifdef __linux__
  if (other_user)
    unshare(CLONE_NEWIPC);  // where that is allowed: shared memory of the old kind goes with its processes
#endif
  if (other_user && (setgroups(0, nullptr) != 0 || setgid(*begin.user) != 0 || setuid(*begin.user) != 0)) _exit(126);
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  limit(RLIMIT_DATA, Limits::bytes(limits.memory));  // what is only reserved, as Java and JavaScript do, does not count
  if (!begin.walls && other_user) limit(RLIMIT_NPROC, static_cast<std::uint64_t>(limits.refused_from()));
#else
  limit(RLIMIT_AS, Limits::bytes(limits.memory));
#endif
  limit(RLIMIT_CPU, static_cast<std::uint64_t>(limits.seconds) + 1);
  limit(RLIMIT_FSIZE, Limits::bytes(limits.files));
  limit(RLIMIT_NOFILE, 256);
  limit(RLIMIT_CORE, 0);
  umask(077);
  if (chdir(begin.folder) != 0) _exit(126);
  if (begin.walls) {
    for (const char* place : bubblewrap_places) execve(place, begin.words, begin.environment);
  } else {
    execve(begin.words[0], begin.words, begin.environment);
  }
  _exit(127);
}

/// Ends what is below this process, whatever has left its group or session: what it started is its own by now.
void end_all_below() {
  for (int round = 0; round < 200; ++round) {
    const Usage left = usage_below(getpid());
    for (const pid_t one : left.processes) kill(one, SIGKILL);
    while (waitpid(-1, nullptr, WNOHANG) > 0) {
    }
    if (left.processes.empty()) break;
    usleep(5000);
  }
}

/// The keeper, a process between the grader and the program: whatever becomes of the grader, the program and all that
/// it has started end with the program, or with the lifeline, which is open as long as the grader is there. Its exit
/// code is the program's, or 128 and the signal.
[[noreturn]] void keep(const Begin& begin, const Stage& stage, int lifeline) {
  setsid();
  for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) std::signal(number, SIG_DFL);
#ifdef __linux__
  prctl(PR_SET_CHILD_SUBREAPER, 1);
#endif
  const pid_t program = fork();
  if (program == 0) become(begin);
  const int nothing = open("/dev/null", O_RDWR);
  for (const int stream : {0, 1, 2}) dup2(nothing, stream);
  close_all_but(lifeline);
  constexpr int milliseconds = 10;
  int status = 127 << 8;
  bool over = program < 0;
  while (!over) {
    pollfd line{lifeline, POLLIN, 0};
    if (poll(&line, 1, milliseconds) > 0) break;
    int one = 0;
    for (pid_t ended; (ended = waitpid(-1, &one, WNOHANG)) > 0;)
      if (ended == program) status = one, over = true;
  }
  if (program > 0) kill(-program, SIGKILL);
  end_all_below();
  if (getppid() != begin.grader) {  // who would have done so is gone
    if (begin.user) remove_files_of(*begin.user);
    remove_all_of(stage.whole());
  }
  _exit(WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status));
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
  std::array<std::array<int, 2>, 3> pipes;  // output, errors, lifeline
  for (std::size_t k = 0; k < pipes.size(); ++k) {
    if (pipe(pipes[k].data()) == 0) continue;
    for (std::size_t made = 0; made < k; ++made) close(pipes[made][0]), close(pipes[made][1]);
    throw InputError("the program", "cannot be run: no pipe can be had", "close other programs");
  }
#ifdef __linux__
  prctl(PR_SET_CHILD_SUBREAPER, 1);  // what has lost its keeper, too, is found below this process
#endif
  const Begin begin{word_list.data(), environment_list.data(),
                    folder.c_str(),   pipes[0][1],
                    pipes[1][1],      walls,
                    program_user(),   limits,
                    getpid()};
  keeper_ = fork();
  if (keeper_ == 0) {
    close(pipes[2][1]);
    keep(begin, stage, pipes[2][0]);
  }
  close(pipes[0][1]), close(pipes[1][1]), close(pipes[2][0]);
  pipes_ = {pipes[0][0], pipes[1][0]}, lifeline_ = pipes[2][1];
  for (const int pipe : pipes_) fcntl(pipe, F_SETFL, O_NONBLOCK);
  if (keeper_ < 0) {
    for (const int pipe : {pipes_[0], pipes_[1], lifeline_}) close(pipe);
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
  if (!ended_ && wait4(keeper_, &status_, WNOHANG, &taken_) == keeper_) ended_ = true;
  return ended_;
}

void Process::end() {
  if (lifeline_ >= 0) close(std::exchange(lifeline_, -1));
  if (!ended_) {
    while (wait4(keeper_, &status_, 0, &taken_) < 0 && errno == EINTR) {
    }
    ended_ = true;
  }
  if (WIFSIGNALED(status_)) end_all_below();  // a program that may has ended its keeper
}

double Process::seconds() const {
  const auto of = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) / 1e6;
  };
  return of(taken_.ru_utime) + of(taken_.ru_stime);
}

}  // namespace zstep::homework
