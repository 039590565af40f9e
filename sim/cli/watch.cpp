#include "sim/cli/watch.hpp"

#include <csignal>
#include <cstdio>

#include <fmt/format.h>

#if defined(_WIN32)
#include <io.h>
#else
#include <unistd.h>
#endif

#include "sim/cli/budget.hpp"
#include "sim/cli/words.hpp"
#include "traces/outcome.hpp"
#include "traces/text.hpp"

namespace zstep::cli {
namespace {

volatile std::sig_atomic_t pressed = 0;

extern "C" void note_interrupt(int signal) {
  pressed = 1;
  std::signal(signal, SIG_DFL);
}

bool stderr_is_terminal() {
#if defined(_WIN32)
  return _isatty(_fileno(stderr)) != 0;
#else
  return isatty(STDERR_FILENO) != 0;
#endif
}

constexpr std::chrono::milliseconds quiet_at_first{500};
constexpr std::chrono::milliseconds between_updates{100};

}  // namespace

Watch::Watch() : terminal_(stderr_is_terminal()) {
  pressed = 0;
  before_ = std::signal(SIGINT, note_interrupt);
  if (before_ == SIG_IGN) std::signal(SIGINT, SIG_IGN);  // a background job is not to be stopped by Ctrl-C
}

Watch::~Watch() {
  if (before_ != SIG_ERR) std::signal(SIGINT, before_);
  clear_line();
}

bool Watch::interrupted() const { return pressed != 0; }

void Watch::check() const {
  if (pressed != 0) throw Interrupted{0};
}

void Watch::attach(TraceRecorder& recorder) {
  recorder.on_block([this](std::int64_t events) { tick(events); });
}

bool Watch::due() const {
  if (!terminal_) return false;
  const Clock::time_point now = Clock::now();
  return now - start_ >= quiet_at_first && now - last_shown_ >= between_updates;
}

void Watch::tick(std::int64_t events) {
  if (pressed != 0) throw Interrupted{events};
  if (time_is_up()) throw Incomplete("the recording", "was not done in time", "give --seconds more");
  if (!due()) return;
  const double seconds = std::chrono::duration<double>(Clock::now() - start_).count();
  show(fmt::format("recording: {} steps, {:.1f} s (Ctrl-C stops and keeps them)", grouped(events), seconds), events);
}

void Watch::show(const std::string& line, std::int64_t events) {
  if (pressed != 0) throw Interrupted{events};
  if (!due()) return;
  last_shown_ = Clock::now();
  shown_ = true;
  std::fputs(("\r\x1b[K" + printable(line)).c_str(), stderr);
  std::fflush(stderr);
}

void Watch::clear_line() {
  if (!shown_) return;
  std::fputs("\r\x1b[K", stderr);
  std::fflush(stderr);
  shown_ = false;
}

}  // namespace zstep::cli
