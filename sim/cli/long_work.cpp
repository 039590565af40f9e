#include "sim/cli/long_work.hpp"

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <memory>
#include <new>
#include <system_error>
#include <thread>
#include <utility>

#include <fmt/format.h>

#if defined(_WIN32)
#include <io.h>
#else
#include <unistd.h>
#endif

#include "sim/cli/messages.hpp"
#include "sim/cli/run_options.hpp"
#include "sim/cli/words.hpp"
#include "sim/cost/allocation_peak.hpp"
#include "traces/error.hpp"
#include "traces/file/files.hpp"
#include "traces/scene.hpp"
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

namespace {

constexpr double least_seconds = 7, seconds_a_byte = 1 / 50e3;
constexpr double least_memory = 768, memory_a_byte = 32;  // MiB; bytes

struct Budget {
  std::optional<double> seconds, memory;  ///< as given; MiB
  bool strict = false;
  std::atomic<double> until{0};  ///< of processor time
};

Budget& budget() {
  static Budget one;
  return one;
}

double processor_time() { return ratio(std::clock(), CLOCKS_PER_SEC); }

[[noreturn]] void end_incomplete(const std::string& line) {
  ::flockfile(stdout);  // between two lines, as each is printed in one piece; none follows
  Unfinished::remove_all();
  complain(line);
  std::_Exit(after_printing(exit_code::incomplete));
}

/// Looks at the clock beside the work, so that nothing that takes long must do so itself.
void watch_time() {
  while (processor_time() < budget().until) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  end_incomplete(fmt::format(
      "zstep: stopped after {:.0f} seconds; what is printed so far is right; --seconds {:.0f} gives it more time",
      budget().until.load(), std::ceil(10 * budget().until)));
}

std::optional<double> above_0(const char* name, std::optional<double> value) {
  if (value && !(*value > 0)) throw InputError(name, "is not more than 0", "leave it out, or give a larger number");
  return value;
}

[[noreturn]] void end_without_memory() {
  const std::string met = memory_budget_met();
  if (!met.empty()) end_incomplete(met);
  std::abort();
}

/// Without threads, as in a browser, only who asks whether time is up is ended by it.
void begin_watching() {
  try {
    std::thread(watch_time).detach();
  } catch (const std::system_error&) {
  }
}

}  // namespace

void add_limit_options(CLI::App& command) {
  add_number(command, "--seconds", budget().seconds,
             "Stop after this much processor time (default: by the size of the file)")
      ->group("Limits");
  add_number(command, "--memory", budget().memory,
             "Stop when it would need more than so many MiB (default: by the size of the file)")
      ->type_name("MIB")
      ->group("Limits");
}

void add_budget_options(CLI::App& command) {
  add_limit_options(command);
  command.add_flag("--strict", budget().strict, "Anything that is doubtful about the file is an error")
      ->group("Limits");
}

bool time_is_up() { return budget().until > 0 && processor_time() > budget().until - 0.5; }

std::optional<double> seconds_given() { return above_0("--seconds", budget().seconds); }
std::optional<double> memory_given() { return above_0("--memory", budget().memory); }

void begin_budget(double seconds, double memory) {
  compare::limit_heap(static_cast<std::int64_t>(std::fmin(memory_given().value_or(memory) * 1048576, 9e18)));
  std::set_terminate(end_without_memory);
  budget().until = processor_time() + seconds_given().value_or(seconds);
  begin_watching();
}

void begin_budget(std::optional<std::uintmax_t> file_bytes) {
  for (const auto& given : {seconds_given, memory_given}) given();
  const auto bytes = static_cast<double>(file_bytes.value_or(0));
  if (budget().memory || file_bytes) {
    const double most =
        budget().memory.value_or(least_memory) * 1048576 + (budget().memory ? 0 : bytes * memory_a_byte);
    compare::limit_heap(static_cast<std::int64_t>(std::fmin(most, 9e18)));
    std::set_terminate(end_without_memory);
  }
  if (budget().until > 0) return extend_budget(bytes * seconds_a_byte);
  if (!budget().seconds && !file_bytes) return;
  budget().until = processor_time() + budget().seconds.value_or(least_seconds + bytes * seconds_a_byte);
  begin_watching();
}

void extend_budget(double seconds) {
  if (!budget().seconds && budget().until > 0) budget().until = budget().until + seconds;
}

void end_budget() {
  if (budget().until > 0) budget().until = processor_time() + 2;
}

std::string memory_budget_met() {
  if (!compare::met_heap_limit()) return "";
  compare::limit_heap(0);
  return "zstep: needs more memory than it may take; what is printed so far is right; --memory 4096 allows it 4 GiB";
}

bool is_strict() { return budget().strict; }

namespace {

constexpr double mebibyte = 1048576;

Answer answer_within(const homework::GradingLimits& limits, const std::function<Answer()>& work) {
  begin_budget(limits.seconds, static_cast<double>(limits.memory) / mebibyte);
  return work();
}

/// In the child: leaves the answer in the file. An exit code says how that went.
int write_answer(const homework::GradingLimits& limits, const std::function<Answer()>& work, std::FILE* file) {
  try {
    const Answer answer = answer_within(limits, work);
    if (std::fwrite(answer.text.data(), 1, answer.text.size(), file) == answer.text.size() && std::fflush(file) == 0)
      return answer.code;
    complain("its report could not be kept");
  } catch (const std::bad_alloc&) {
    memory_budget_met();  // or there is none to end with
    return exit_code::exhausted;
  } catch (const InputErrors& error) {
    complain_lines(error.what());
  } catch (const std::exception& error) {
    complain(error.what());
  }
  return exit_code::mistake;
}

std::string text_in(std::FILE* file) {
  std::string text;
  std::rewind(file);
  std::array<char, 1 << 16> bytes;
  for (std::size_t count; (count = std::fread(bytes.data(), 1, bytes.size(), file)) > 0;)
    text.append(bytes.data(), count);
  return text;
}

std::string why_not(const homework::Child& child, const homework::GradingLimits& limits) {
  const bool memory = child.said().find("--memory") != std::string::npos;
  if (child.code() == exit_code::exhausted || (child.code() == exit_code::incomplete && memory))
    return fmt::format("needs more than the {:.0f} MiB that it may take; --memory allows it more",
                       static_cast<double>(limits.memory) / mebibyte);
  if (child.code() == exit_code::incomplete)
    return fmt::format("took more than the {:.3g} seconds of the processor that it may take; --seconds allows it more",
                       limits.seconds);
  if (!child.why().empty()) return child.why();
  return "failed" + (child.said().empty() ? "" : ": " + printable(child.said()));
}

}  // namespace

Answer answer_apart(const homework::GradingLimits& limits, const std::function<Answer()>& work,
                    const std::function<std::string(const std::string&)>& otherwise, Watch& watch) {
  // The child ends itself at the limits. These are for one that no longer can.
  homework::GradingLimits walls = limits;
  walls.seconds += 5;
  walls.memory += std::uintmax_t{1} << 30;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::tmpfile(), &std::fclose);
  std::unique_ptr<homework::Child> child;
  try {
    if (file) child = std::make_unique<homework::Child>(walls, [&] { return write_answer(limits, work, file.get()); });
  } catch (const InputError&) {
    // No process: see below.
  }
  if (!child) return answer_within(limits, work);
  while (!child->ended()) {
    watch.show("grading (Ctrl-C stops)");
    homework::Child::wait_for_one(std::array{child.get()});
  }
  if (const int code = child->code();
      code == exit_code::done || code == exit_code::finding || code == exit_code::bad_input) {
    watch.clear_line();
    if (!child->said().empty()) complain_lines(child->said());
    return {text_in(file.get()), code};
  }
  const std::string why = why_not(*child, limits);
  watch.clear_line();
  return {otherwise(why), exit_code::incomplete};
}

}  // namespace zstep::cli
