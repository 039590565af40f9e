#include "sim/cli/budget.hpp"

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <system_error>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "sim/cli/messages.hpp"
#include "sim/cli/run_options.hpp"
#include "sim/cost/allocation_peak.hpp"
#include "traces/error.hpp"
#include "traces/file/output.hpp"

namespace zstep::cli {
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

double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

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

}  // namespace zstep::cli
