#include "sim/cost/apart.hpp"

#include <chrono>
#include <exception>

#if !defined(_WIN32) && !defined(__EMSCRIPTEN__)
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#define ZSTEP_CAN_FORK 1
#endif

namespace zstep::compare {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

#if ZSTEP_CAN_FORK

constexpr int milliseconds_between_ticks = 100;

// A pipe's reading end and the process that writes to it; both are gone when this is.
class Child {
 public:
  Child(pid_t process, int pipe) : process_(process), pipe_(pipe) {}
  ~Child() {
    close(pipe_);
    if (process_ > 0) {
      kill(process_, SIGKILL);
      wait();
    }
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  int pipe() const { return pipe_; }
  int wait() {
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = 0;
    return status;
  }

 private:
  pid_t process_;
  int pipe_;
};

void write_all(int pipe, const std::uint8_t* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t written = write(pipe, bytes, count);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) _exit(1);
    bytes += written, count -= static_cast<std::size_t>(written);
  }
}

// The first byte says whether the rest is what the work returned or why it failed.
[[noreturn]] void work_and_leave(const std::function<std::vector<std::uint8_t>()>& work, int pipe) {
  std::signal(SIGINT, SIG_DFL);
  std::uint8_t done = 1;
  std::vector<std::uint8_t> bytes;
  try {
    bytes = work();
  } catch (const std::exception& error) {
    done = 0;
    const char* what = error.what();
    bytes.assign(what, what + std::strlen(what));
  }
  write_all(pipe, &done, 1);
  write_all(pipe, bytes.data(), bytes.size());
  _exit(0);
}

#endif

}  // namespace

#if ZSTEP_CAN_FORK

Apart run_apart(const std::function<std::vector<std::uint8_t>()>& work, double limit,
                const std::function<void(double)>& tick) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe can be had");
  std::fflush(nullptr);  // or the copy would hold, and perhaps print, what is not printed yet
  const pid_t process = fork();
  if (process == 0) {
    close(ends[0]);
    work_and_leave(work, ends[1]);
  }
  close(ends[1]);
  if (process < 0) {
    close(ends[0]);
    throw std::runtime_error("no process can be started");
  }

  Child child(process, ends[0]);
  Apart result;
  const Clock::time_point start = Clock::now();
  std::uint8_t buffer[1 << 16];
  for (;;) {
    pollfd ready{child.pipe(), POLLIN, 0};
    const int count = poll(&ready, 1, milliseconds_between_ticks);
    tick(seconds_since(start));
    if (count > 0) {
      const ssize_t got = read(child.pipe(), buffer, sizeof buffer);
      if (got == 0) break;
      if (got > 0) result.bytes.insert(result.bytes.end(), buffer, buffer + got);
    } else if (seconds_since(start) > limit) {
      result.end = Apart::End::out_of_time;
      result.bytes.clear();
      return result;
    }
  }
  const int status = child.wait();
  tick(seconds_since(start));  // Ctrl-C reaches both: here it is not a failure
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || result.bytes.empty()) {
    result.end = Apart::End::failed;
    result.what = WIFSIGNALED(status) ? std::string("it was ended by signal ") + std::to_string(WTERMSIG(status))
                                      : "it came to an early end";
    result.bytes.clear();
    return result;
  }
  if (result.bytes.front() == 0) {
    result.end = Apart::End::failed;
    result.what.assign(result.bytes.begin() + 1, result.bytes.end());
    result.bytes.clear();
    return result;
  }
  result.bytes.erase(result.bytes.begin());
  return result;
}

#else

Apart run_apart(const std::function<std::vector<std::uint8_t>()>& work, double,
                const std::function<void(double)>& tick) {
  Apart result;
  const Clock::time_point start = Clock::now();
  try {
    result.bytes = work();
  } catch (const std::exception& error) {
    result.end = Apart::End::failed;
    result.what = error.what();
  }
  tick(seconds_since(start));
  return result;
}

#endif

}  // namespace zstep::compare
