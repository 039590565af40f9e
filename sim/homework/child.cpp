#include "sim/homework/child.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "traces/error.hpp"

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
