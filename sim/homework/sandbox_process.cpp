
#include "sim/homework/sandbox_process.hpp"

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fmt/format.h>
#include <fstream>
#include <grp.h>
#include <optional>
#include <poll.h>
#include <sched.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>
#include <vector>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include "sim/classroom/lesson.hpp"
#include "sim/homework/sandbox.hpp"
#include "traces/error.hpp"

namespace zstep::homework {

namespace {

namespace fs = std::filesystem;

constexpr unsigned nobody = 65534;  // inside of walls
constexpr auto readable_folder = fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec |
                                 fs::perms::others_read | fs::perms::others_exec;

/// Copies folders and plain files. Links, devices and the like stay: what they lead to is not the student's.
void copy_program(const fs::path& from, const fs::path& to, const Limits& limits) {
  fs::create_directory(to);
  fs::permissions(to, readable_folder);
  std::uintmax_t bytes = 0;
  int count = 0;
  for (auto at = fs::recursive_directory_iterator(from); at != fs::recursive_directory_iterator(); ++at) {
    const fs::path there = to / at->path().lexically_relative(from);
    const fs::file_status status = at->symlink_status();
    if (++count > most_files || at.depth() > deepest_folders)
      throw InputError(
          from.string(),
          fmt::format("holds more than {} files, or folders more than {} deep", most_files, deepest_folders),
          "hand in the program alone");
    if (fs::is_directory(status)) {
      if (at->path().filename() == ".git") {
        at.disable_recursion_pending();
        continue;
      }
      fs::create_directory(there);
      fs::permissions(there, readable_folder);
    } else if (fs::is_regular_file(status)) {
      bytes += at->file_size();
      if (bytes > Limits::bytes(limits.files))
        throw InputError(from.string(), fmt::format("holds more than {} MiB", limits.files),
                         "hand in the program alone");
      fs::copy_file(at->path(), there);
      const bool runs = (status.permissions() & fs::perms::owner_exec) != fs::perms::none;
      fs::permissions(there, runs ? readable_folder : fs::perms(0644));
    }
  }
}

bool lies_in_system(const fs::path& path) {
  const std::string text = path.string();
  return text.starts_with("/usr/") || text.starts_with("/bin/") || text.starts_with("/lib");
}

}  // namespace

std::optional<unsigned> program_user() {
  if (geteuid() != 0) return std::nullopt;
  const std::uint64_t process = getpid();
  // Above all that systems give to people and services; or, in a container with fewer, where Debian has none of them.
  const std::uint64_t usual = 2'000'000'000 + process, among_few = 60'000 + process % 5'000;
  std::ifstream users("/proc/self/uid_map");  // lines of: the first user here, the first outside, how many
  if (!users) return static_cast<unsigned>(among_few);
  std::optional<unsigned> found;
  for (std::uint64_t first = 0, outside = 0, count = 0; users >> first >> outside >> count;)
    for (const std::uint64_t one : {usual, among_few})
      if (!found && first <= one && one < first + count) found = static_cast<unsigned>(one);
  return found;
}

Stage::Stage(const fs::path& program, const std::string& name, const std::string& scene, const Limits& limits)
    : folder_("zstep-run"),
      program_(folder_.path() / "program"),
      scene_(folder_.path() / "scene"),
      scratch_(folder_.path() / "scratch"),
      name_(name + ".txt") {
  try {
    fs::permissions(folder_.path(), readable_folder);
    copy_program(program, program_, limits);
    fs::create_directory(scene_);
    fs::permissions(scene_, readable_folder);
    std::ofstream text(scene_ / name_, std::ios::binary);
    text << scene;
    text.close();
    if (!text) throw InputError((scene_ / name_).string(), "cannot be written", "make room on the disk");
    fs::permissions(scene_ / name_, fs::perms(0644));
    fs::create_directory(scratch_);
    fs::permissions(scratch_, fs::perms::owner_all);
    if (const auto user = program_user(); user && chown(scratch_.c_str(), *user, *user) != 0)
      throw InputError(scratch_.string(), "cannot be given to another user", "run zstep as a plain user");
  } catch (const fs::filesystem_error& error) {
    throw InputError(error.path1().string(), "cannot be copied: " + error.code().message(), "check its permissions");
  }
}

std::vector<std::string> Stage::words(const std::string& command, bool walls, const Limits& limits) const {
  const std::string scene = walls ? "/scene/" + name_ : (scene_ / name_).string();
  const std::vector<std::string> shell{"/bin/sh", "-c", command + " \"$1\"", "sh", scene};
  if (!walls) return shell;
  const std::string room = std::to_string(Limits::bytes(limits.files));
  std::vector<std::string> all{"bwrap",
                               "--unshare-all",
                               "--unshare-user",
                               "--disable-userns",
                               "--die-with-parent",
                               "--uid",
                               std::to_string(nobody),
                               "--gid",
                               std::to_string(nobody),
                               "--cap-drop",
                               "ALL",
                               "--ro-bind",
                               "/usr",
                               "/usr"};
  const auto add = [&](std::initializer_list<std::string> more) { all.insert(all.end(), more); };
  for (const char* folder : {"/bin", "/sbin", "/lib", "/lib32", "/lib64", "/etc/alternatives", "/etc/ld.so.cache"})
    add({"--ro-bind-try", folder, folder});
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator("/etc", ignored))  // where Debian keeps Java's settings
    if (entry.path().filename().string().starts_with("java"))
      add({"--ro-bind-try", entry.path().string(), entry.path().string()});
  // An installed zstep could print the right run, and its lessons have the solutions.
  if (const fs::path self = fs::read_symlink("/proc/self/exe", ignored); lies_in_system(self))
    add({"--ro-bind", "/dev/null", self.string()});
  for (const fs::path& lessons : lesson_folders())
    if (lies_in_system(lessons) && fs::is_directory(lessons, ignored)) add({"--tmpfs", lessons.string()});
  add({"--proc", "/proc", "--dev", "/dev", "--size", room, "--tmpfs", "/dev/shm", "--size", room, "--tmpfs", "/tmp"});
  add({"--ro-bind", program_.string(), "/program", "--ro-bind", scene_.string(), "/scene"});
  add({"--remount-ro", "/dev", "--remount-ro", "/", "--chdir", "/program", "--"});
  // Only inside is it the number of its own processes that counts, and not that of all the user's.
  if (fs::exists("/usr/bin/prlimit", ignored))
    add({"/usr/bin/prlimit", "--nproc=" + std::to_string(limits.refused_from())});
  all.insert(all.end(), shell.begin(), shell.end());
  return all;
}

std::vector<std::string> Stage::environment(bool walls) const {
  const std::string room = walls ? "/tmp" : scratch_.string();
  return {"PATH=/usr/local/bin:/usr/bin:/bin", "HOME=" + room, "TMPDIR=" + room, "LANG=C.UTF-8",
          "PYTHONDONTWRITEBYTECODE=1"};
}

}  // namespace zstep::homework

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
