#include "sim/cli/answer_apart.hpp"

#include <array>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>

#include <fmt/format.h>

#include "sim/cli/budget.hpp"
#include "traces/outcome.hpp"
#include "traces/text.hpp"

namespace zstep::cli {
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
