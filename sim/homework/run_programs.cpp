#include "sim/homework/run_programs.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <span>

#include "sim/homework/new_homework.hpp"
#include "traces/image/file.hpp"
#include "sim/words/escaped.hpp"
#include "traces/error.hpp"
#include "traces/file/files.hpp"
#include "traces/text.hpp"

namespace zstep::homework {

GradingLimits limits_for(std::uintmax_t bytes, std::optional<double> seconds, std::optional<double> memory) {
  constexpr double mib = 1048576, least_seconds = 10, bytes_a_second = 4e6;
  constexpr double least_memory = 1024 * mib, most_memory = 8192 * mib, memory_a_byte = 12;
  const auto size = static_cast<double>(bytes);
  GradingLimits limits;
  limits.seconds = seconds.value_or(least_seconds + size / bytes_a_second);
  limits.memory =
      static_cast<std::uintmax_t>(memory ? *memory * mib : std::min(least_memory + memory_a_byte * size, most_memory));
  return limits;
}

}  // namespace zstep::homework

#if defined(_WIN32)

namespace zstep::homework {

Child::Child(const GradingLimits& limits, const std::function<int()>&) : limits_(limits) {
  throw InputError("--batch", "needs processes with limits, which this system does not have",
                   "grade on Linux or macOS, or one submission at a time");
}
Child::~Child() = default;
bool Child::ended() { return true; }
void Child::wait(const int*, std::size_t) {}
void Child::hear() {}

}  // namespace zstep::homework

#else

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#if defined(__linux__)
#include <sys/prctl.h>
#endif

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>

namespace zstep::homework {

namespace {

/// Sanitizers reserve more addresses than any limit allows.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool can_limit_memory = false;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
constexpr bool can_limit_memory = false;
#else
constexpr bool can_limit_memory = true;
#endif
#else
constexpr bool can_limit_memory = true;
#endif

template <class Resource>
void limit(Resource resource, std::uintmax_t soft, std::uintmax_t hard) {
  rlimit now{};
  if (getrlimit(resource, &now) != 0) return;
  rlimit wanted{static_cast<rlim_t>(soft), static_cast<rlim_t>(hard)};
  wanted.rlim_max = std::min(wanted.rlim_max, now.rlim_max);
  wanted.rlim_cur = std::min(wanted.rlim_cur, wanted.rlim_max);
  setrlimit(resource, &wanted);
}

/// In the child: nothing of the parent's terminal and none of its signals; then the limits.
void confine(const GradingLimits& limits, int pipe) {
#if defined(__linux__)
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // it does not outlive who waits for it
#endif
  for (const int signal : {SIGINT, SIGTERM, SIGPIPE, SIGXCPU, SIGXFSZ}) std::signal(signal, SIG_DFL);
  // Where the machine has no memory left, it is the child that goes, and not who says so.
  if (const int first = open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC); first >= 0) {
    [[maybe_unused]] const ssize_t written = write(first, "1000", 4);
    close(first);
  }
  const int nothing = open("/dev/null", O_RDWR | O_CLOEXEC);
  dup2(nothing, STDIN_FILENO);
  dup2(nothing, STDOUT_FILENO);
  dup2(pipe, STDERR_FILENO);
  const auto seconds = static_cast<std::uintmax_t>(std::max(1.0, limits.seconds + 0.999));
  limit(RLIMIT_CPU, seconds, seconds + 2);
  limit(RLIMIT_FSIZE, limits.file, limits.file);
  limit(RLIMIT_CORE, 0, 0);
  if (can_limit_memory) limit(RLIMIT_AS, limits.memory, limits.memory);
}

[[noreturn]] void become(const GradingLimits& limits, int pipe, const std::function<int()>& work) {
  confine(limits, pipe);
  int code = EXIT_FAILURE;
  try {
    code = work();
  } catch (const std::exception& error) {
    std::fputs(error.what(), stderr);
  } catch (...) {
    std::fputs("it ended in an unknown way", stderr);
  }
  std::fflush(stderr);
  _exit(code);  // nothing of the parent's is flushed or removed
}

}  // namespace

Child::Child(const GradingLimits& limits, const std::function<int()>& work) : limits_(limits) {
  std::fflush(nullptr);  // or the child has it to print, too
  int ends[2];
  const bool piped = ::pipe(ends) == 0;
  // A child that says more than fits loses the rest; it does not wait.
  if (piped) {
    for (const int end : ends) {
      fcntl(end, F_SETFD, FD_CLOEXEC);
      fcntl(end, F_SETFL, O_NONBLOCK);
    }
    id_ = fork();
  }
  if (!piped || id_ < 0) {
    const int error = errno;
    if (piped) close(ends[0]), close(ends[1]);
    id_ = 0;
    throw InputError("--batch", fmt::format("no process could be started: {}", std::strerror(error)),
                     "give fewer --jobs, or close other programs");
  }
  if (id_ == 0) {
    close(ends[0]);
    become(limits, ends[1], work);
  }
  close(ends[1]);
  pipe_ = ends[0];
}

Child::~Child() {
  if (id_ > 0) {
    kill(id_, SIGKILL);
    waitpid(id_, nullptr, 0);
  }
  if (pipe_ >= 0) close(pipe_);
}

void Child::hear() {
  constexpr std::size_t enough = 2000;
  char bytes[512];
  for (ssize_t got; (got = read(pipe_, bytes, sizeof bytes)) > 0;)
    if (said_.size() < enough) said_.append(bytes, static_cast<std::size_t>(got));
}

bool Child::ended() {
  if (id_ == 0) return true;
  hear();
  int status = 0;
  const double longest = 3 * limits_.seconds + 10;
  const bool late = std::chrono::steady_clock::now() - begin_ > std::chrono::duration<double>(longest);
  if (late) kill(id_, SIGKILL);
  const int found = waitpid(id_, &status, late ? 0 : WNOHANG);
  if (found == 0 || (found < 0 && errno == EINTR)) return false;
  id_ = 0;
  hear();
  if (late) {
    why_ = fmt::format("did not end within {:.0f} seconds", longest);
  } else if (found > 0 && WIFEXITED(status)) {
    code_ = WEXITSTATUS(status);
  } else if (found > 0 && WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    if (signal == SIGXCPU) why_ = fmt::format("took more than {:.0f} seconds of processor time", limits_.seconds);
    else if (signal == SIGXFSZ) why_ = "wrote more than it may";
    else why_ = fmt::format("was ended by signal {} ({})", signal, strsignal(signal));
  } else {
    why_ = "was lost";
  }
  return true;
}

void Child::wait(const int* pipes, std::size_t count) {
  std::vector<pollfd> all;
  for (std::size_t i = 0; i < count; ++i) all.push_back({pipes[i], POLLIN, 0});
  constexpr int moment = 50;  // milliseconds
  poll(all.data(), static_cast<nfds_t>(all.size()), moment);
}

}  // namespace zstep::homework

#endif

namespace zstep::homework {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_noted = 4096;

fs::path note_beside(const fs::path& run) { return fs::path(run).replace_extension(".ended.txt"); }

bool lies_in(const fs::path& path, const fs::path& folder) {
  std::error_code ignored;
  const fs::path inner = fs::weakly_canonical(path, ignored), outer = fs::weakly_canonical(folder, ignored);
  const fs::path way = inner.lexically_relative(outer);
  return !way.empty() && *way.begin() != "..";
}

/// An empty text removes the note.
void write_note(const fs::path& run, const std::string& text) {
  std::error_code ignored;
  if (text.empty()) fs::remove(note_beside(run), ignored);
  else write_file(note_beside(run), std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

void check_folders(const Homework& homework, const fs::path& program, const fs::path& runs) {
  std::error_code ignored;
  if (!fs::is_directory(program, ignored))
    throw InputError(program.string(), "is no folder", "give the folder that the program is in");
  if (lies_in(homework.folder, program))
    throw InputError(program.string(), "holds the homework, which the program would see",
                     "put the program in a folder of its own");
  if (lies_in(runs, program))
    throw InputError(runs.string(), "lies in the program's folder", "give a folder beside it");
  if (fs::exists(fs::symlink_status(runs, ignored)) &&
      !(fs::is_directory(runs, ignored) && fs::is_empty(runs, ignored)))
    throw InputError(runs.string(), "is there already", "give the name of a new folder, or remove it");
  fs::create_directories(runs, ignored);
  if (!fs::is_directory(runs, ignored))
    throw InputError(runs.string(), "cannot be made", "check the folder it lies in");
}

}  // namespace

std::vector<ProgramRun> run_programs(const Homework& homework, const std::string& command, const fs::path& program,
                                     const fs::path& runs, const std::function<void(const Task&)>& on_task) {
  const std::string& typed = command.empty() ? homework.program : command;
  if (typed.empty())
    throw InputError((homework.folder / "homework.toml").string(), "says of no program how it is run",
                     "give --program 'python3 zbuffer.py', or write it under [program] as command");
  check_folders(homework, program, runs);
  const auto file_of = [&](const Task& task) { return runs / (task.name + ".jsonl"); };
  // Whatever ends this process, a run that is not there, or not to its end, is not taken for what the program did.
  for (const Task& task : homework.tasks)
    write_note(file_of(task),
               "The program was not run to its end: something stopped the grader from outside. Have it "
               "graded once more.\n");
  std::vector<ProgramRun> all;
  try {
    for (const Task& task : homework.tasks) {
      on_task(task);
      const fs::path file = file_of(task);
      const Ended ended = run_in_sandbox(typed, program, task.name, plain_numbers(*homework.method, task.scene), file,
                                         homework.limits, [&] { on_task(task); });
      write_note(file, ended.how == Ended::How::well
                           ? std::string()
                           : fmt::format("The program {}.\n{}", text_of(ended, homework.limits, !task.hidden),
                                         printable_lines(ended.errors)));
      all.push_back({&task, ended, file});
    }
  } catch (const InputError& error) {
    for (std::size_t left = all.size(); left < homework.tasks.size(); ++left) {
      try {
        write_note(file_of(homework.tasks[left]), fmt::format("The program was not run: {}\n", error.what()));
      } catch (const InputError&) {
        // What is thrown says why nothing can be written, too.
      }
    }
    throw;
  }
  return all;
}

std::string how_it_ended(const fs::path& run, bool hidden) {
  std::error_code ignored;
  const fs::path note = note_beside(run);
  if (!fs::is_regular_file(fs::symlink_status(note, ignored))) return "";
  InputFile in(note);
  std::string text(most_noted, '\0');
  text.resize(in.read(text.data(), text.size()));
  if (hidden) text.resize(std::min(text.size(), text.find('\n')));
  while (text.ends_with('\n')) text.pop_back();
  return printable_lines(text);
}

std::optional<SourceCommand> command_of_source(const fs::path& source) {
  const std::string name = source.filename().string(), word = shell_word(name), kind = source.extension().string();
  const char* then = " -o \"$TMPDIR/program\" && \"$TMPDIR/program\"";
  if (kind == ".py") return SourceCommand{"python3", "python3 " + word};
  if (kind == ".js") return SourceCommand{"node", "node " + word};
  if (kind == ".cpp") return SourceCommand{"c++", "c++ -std=c++17 -O1 " + word + then};
  if (kind == ".c") return SourceCommand{"cc", "cc -std=c99 -O1 " + word + " -lm" + then};
  if (kind == ".java")
    return SourceCommand{"javac",
                         "javac -d \"$TMPDIR\" *.java && java -cp \"$TMPDIR\" " + shell_word(source.stem().string())};
  return std::nullopt;
}

}  // namespace zstep::homework
