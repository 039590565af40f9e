// zstep check: does each step of a run follow from its own operands?
#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "sim/cli/budget.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/file_lines.hpp"
#include "sim/cli/show.hpp"
#include "sim/cli/traces.hpp"
#include "sim/cli/watch.hpp"
#include "sim/cli/words.hpp"
#include "sim/words/derived.hpp"
#include "sim/words/numbers.hpp"
#include "sim/words/shell_word.hpp"
#include "traces/check/check.hpp"
#include "traces/text.hpp"

namespace zstep::cli {
namespace {

using Json = nlohmann::ordered_json;

struct CheckOptions {
  std::string trace;
  bool all = false, json = false;
};

constexpr std::size_t most_causes = 10;

/// What is said of a cause, made where it was found: the state before it is gone later.
struct Told {
  std::string subject, formula;
};

std::string step_name(const Trace& trace, std::uint8_t line) {
  const StepInfo* step = find_step(trace.header().page, line);
  return step ? step->name : "";
}

/// What is wrong, in one line.
std::string what(const Cause& cause, const Told& told) {
  const Fault& fault = cause.first;
  if (!fault.impossible.empty()) return fmt::format("this step cannot be: {}", fault.impossible);
  if (fault.rule) return std::string(rule_text(*fault.rule).broken);
  const auto [is, ought] = tell_apart(fault.recorded, fault.expected);
  if (told.formula.empty()) return fmt::format("{} = {}, but the trace has {}", fault.field, ought, is);
  if (told.formula.find(":  ") != std::string::npos)  // a compare
    return fmt::format("{}, but the trace says {}", told.formula, fault.recorded != 0 ? "nearer" : "not nearer");
  return fmt::format("{} = {}, but the trace has {}", fault.field, told.formula, is);
}

std::string follow_text(const Cause& cause) {
  std::string text;
  if (cause.again > 0) text += counted(cause.again, "later step has", "later steps have") + " the same fault";
  if (cause.inherited > 0)
    text += (text.empty() ? "" : "; ") + counted(cause.inherited, "step follows", "steps follow") + " from it";
  return text;
}

void print_text(const Trace& trace, const CheckOptions& options, const CheckReport& report,
                const std::vector<Told>& told, const std::string& impossible, const std::string& hint) {
  const Precision& precision = report.precision;
  fmt::print("{}: {} ({}), of which {} have a formula or a rule\n", printable(trace.name()),
             counted(report.steps, "step", "steps"), precision.text, grouped(report.judged));
  fmt::print("{} numbers: {} exact, {} rounded (at most {} units of a float64's last digit)\n\n",
             grouped(report.numbers), grouped(report.exact), grouped(report.rounded),
             number(report.largest_rounding, 1, true));
  const std::string end =
      impossible.empty() ? "" : fmt::format("The run is judged up to a step that cannot be:\n{}\n", impossible);
  if (report.causes.empty()) return fmt::print("{}", end.empty() ? "Nothing is wrong.\n" : end);
  fmt::print("{}: {} wrong, {} more follow from {}\n\n",
             counted(static_cast<std::int64_t>(report.causes.size()), "cause", "causes"),
             counted(report.wrong_steps, "step is", "steps are"), grouped(report.inherited),
             report.causes.size() == 1 ? "it" : "them");
  if (!hint.empty()) fmt::print("{}\n\n", hint);
  FileLines lines(options.trace);
  const std::size_t shown = options.all ? report.causes.size() : std::min(most_causes, report.causes.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const Cause& cause = report.causes[i];
    fmt::print("{}. {}: {}{}\n   {}\n", i + 1, place_of_step(options.trace, lines, cause.first.step),
               step_name(trace, cause.first.line),
               told[i].subject.empty() ? "" : ", " + told[i].subject, what(cause, told[i]));
    if (const std::string more = follow_text(cause); !more.empty()) fmt::print("   {}\n", more);
    fmt::print("   zstep view {} --at {}\n", shell_word(options.trace), cause.first.step);
  }
  if (shown < report.causes.size())
    fmt::print("… and {} more: --all prints them\n", grouped(static_cast<std::int64_t>(report.causes.size() - shown)));
  fmt::print("{}", end);
}

void print_json(const Trace& trace, const CheckOptions& options, const CheckReport& report,
                const std::vector<Told>& told, const std::string& impossible, const std::string& hint) {
  Json causes = Json::array();
  FileLines lines(options.trace);
  for (std::size_t i = 0; i < report.causes.size(); ++i) {
    const Cause& cause = report.causes[i];
    const Fault& fault = cause.first;
    Json one{{"step", fault.step}};
    if (const std::int64_t line = lines.of(fault.step); line > 0) one["line"] = line;
    one["name"] = step_name(trace, fault.line);
    one["subject"] = told[i].subject;
    if (fault.rule) one["rule"] = rule_text(*fault.rule).name;
    if (!fault.field.empty()) {
      one["field"] = fault.field, one["recorded"] = fault.recorded, one["expected"] = fault.expected;
      if (!told[i].formula.empty()) one["formula"] = told[i].formula;
    }
    one["what"] = what(cause, told[i]);
    one["again"] = cause.again, one["inherited"] = cause.inherited;
    causes.push_back(one);
  }
  Json all{{"trace", trace.name()},       {"steps", report.steps},     {"judged", report.judged},
                 {"numbers", report.numbers},   {"exact", report.exact},     {"rounded", report.rounded},
                 {"format", report.precision.text}, {"wrong", report.wrong_steps}, {"inherited", report.inherited},
                 {"causes", causes}};
  if (!impossible.empty()) all["impossible"] = impossible;
  if (!hint.empty()) all["hint"] = hint;
  fmt::print("{}\n", all.dump(2));
}

/// "With "nearer": "greater" in its header nothing would be wrong."
std::string other_convention(const Trace& trace, const CheckReport& report) {
  constexpr std::int64_t most_steps = 5'000'000;  // each convention takes as long as the check
  if (report.causes.empty() || trace.size() > most_steps) return "";
  const auto other = convention_it_follows(trace, report);
  if (!other) return "";
  return fmt::format("With \"{}\": \"{}\" in its header {} would be wrong: the program's mistake, or the header's.",
                     other->key, other->word,
                     other->wrong_steps == 0 ? "nothing" : "only " + counted(other->wrong_steps, "step", "steps"));
}

int run(const CheckOptions& options) {
  std::string impossible;
  const Trace trace = open_to_judge(options.trace, impossible);
  std::vector<Told> told;
  Watch watch;
  const CheckReport report = check(
      trace,
      [&](const Cause& cause, const formulas::Situation& at, const RecordedEvent& event) {
        told.push_back({subject_of(event.event, at),
                        cause.first.field.empty()
                            ? ""
                            : derived_formula(event.event, at, cause.first.field).value_or("")});
      },
      [&](std::int64_t done) {
        watch.show(fmt::format("checking: step {} of {} (Ctrl-C stops)", grouped(done), grouped(trace.size())));
        return false;
      });
  const std::string hint = other_convention(trace, report);
  watch.clear_line();
  if (options.json) print_json(trace, options, report, told, impossible, hint);
  else print_text(trace, options, report, told, impossible, hint);
  return report.causes.empty() && impossible.empty() ? exit_code::done : exit_code::finding;
}

}  // namespace

void add_check(CLI::App& app, Action& action) {
  const auto options = std::make_shared<CheckOptions>();
  CLI::App* command = app.add_subcommand("check", "Does each step follow from its own operands?");
  command->add_option("trace", options->trace, "A .ztrace or .jsonl file")->type_name("FILE.ztrace")->required();
  add_budget_options(*command);
  command->add_flag("--all", options->all, "Print all causes, not ten");
  command->add_flag("--json", options->json, "Print JSON");
  command->footer(
      "Holds every number against the formula it must follow from, with the trace's own operands and under the\n"
      "conventions that its header declares, and every step against the rules of the method. Exit code 0: nothing is\n"
      "wrong; 1: something is.\n"
      "\n"
      "Examples:\n"
      "  zstep check run.jsonl\n"
      "  zstep check run.ztrace --json");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace zstep::cli
