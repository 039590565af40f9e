// zstep check: does each step of a run follow from its own operands?
#include <algorithm>
#include <memory>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "sim/cli/commands.hpp"
#include "sim/cli/editor.hpp"
#include "sim/cli/long_work.hpp"
#include "sim/cli/show.hpp"
#include "sim/cli/traces.hpp"
#include "sim/cli/words.hpp"
#include "sim/words/escaped.hpp"
#include "sim/words/judged.hpp"
#include "sim/words/numbers.hpp"
#include "traces/check/check.hpp"
#include "traces/events/fields.hpp"
#include "traces/text.hpp"

namespace zstep::cli {
namespace {

using Json = nlohmann::ordered_json;

struct CheckOptions {
  std::string trace;
  bool all = false, json = false, view = false;
  ShowOptions show;
};

constexpr std::size_t most_causes = 10;

/// As JSON has it.
const char* word_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::not_judged:
      return "not_judged";
    case Verdict::right_where_judged:
      return "right_where_judged";
    case Verdict::right:
      return "right";
    case Verdict::wrong:
      break;
  }
  return "wrong";
}

void print_text(const Trace& trace, const CheckOptions& options, const CheckedRun& checked, const std::string& hint) {
  const CheckReport& report = checked.report;
  const Precision& precision = report.precision;
  fmt::print("{}: {} ({}); {} of them can be judged by a formula or a rule\n", printable(trace.name()),
             counted(report.steps, "step", "steps"), precision.text, grouped(report.judged));
  const std::string at_most =
      report.rounded == 0
          ? ""
          : fmt::format(", by at most {} {}", number(report.largest_rounding, 1, true),
                        precision.every_digit
                            ? fmt::format("ulps (units in the last place) of {}", word_of(precision.format))
                            : "units of the last digit that is written");
  fmt::print("{} numbers: {} exact, {} rounded{}\n", grouped(report.numbers), grouped(report.exact),
             grouped(report.rounded), at_most);
  const std::string end =
      checked.impossible.empty()
          ? ""
          : fmt::format("The run is judged up to a step that is impossible:\n{}\n", checked.impossible);
  if (const auto left = not_judged_in_words(trace, report); !left.empty())
    fmt::print(
        "Not judged, as neither the run nor its scene says what it must be:\n  {}\n"
        "To find a mistake in that, compare the run with a right one: zstep diff.\n",
        fmt::join(left, "\n  "));
  if (const auto never = never_recorded(trace.header(), report); !never.empty())
    fmt::print("Not in the run, and so not judged: {}\n", fmt::join(never, ", "));
  fmt::print("\n");
  if (report.causes.empty()) return fmt::print("{}", end.empty() ? verdict_in_words(report) + "\n" : end);
  fmt::print("{}: {} wrong, {} more follow from {}\n\n", counted(std::ssize(report.causes), "cause", "causes"),
             counted(report.wrong_steps, "step is", "steps are"), grouped(report.inherited),
             report.causes.size() == 1 ? "it" : "them");
  if (!hint.empty()) fmt::print("{}\n\n", hint);
  if (const auto likely = likely_in_words(checked.likely); !likely.empty())
    fmt::print("{}\n\n", fmt::join(likely, "\n  "));
  const std::size_t shown = options.all ? report.causes.size() : std::min(most_causes, report.causes.size());
  for (std::size_t i = 0; i < shown; ++i) {
    const Cause& cause = report.causes[i];
    fmt::print("{}. {}: {}\n   {}\n", i + 1, place_of_step(trace, cause.first.step),
               step_and_subject(trace, cause.first.line, checked.texts[i].subject),
               what_is_wrong(cause.first, checked.texts[i]));
    if (const std::string more = what_follows(cause); !more.empty()) fmt::print("   {}\n", more);
    if (!is_standard_input(options.trace))
      fmt::print("   zstep view {} --at {}\n", printable(shell_word(options.trace)), cause.first.step);
  }
  if (shown < report.causes.size())
    fmt::print("… and {} more: --all prints them\n", grouped(report.causes.size() - shown));
  fmt::print("{}", end);
}

/// Of the mistakes that are likely: those that the run does not tell apart, and what is made besides.
Json ids_of(const mistakes::Diagnosis& likely) {
  Json ids = Json::array();
  for (const mistakes::Mistake mistake : likely.either) ids.push_back(mistakes::text_of(mistake).id);
  Json json{{"either", ids}};
  if (likely.also) json["also"] = mistakes::text_of(*likely.also).id;
  return json;
}

void print_json(const Trace& trace, const CheckedRun& checked, const std::string& hint) {
  const CheckReport& report = checked.report;
  Json causes = Json::array();
  for (std::size_t i = 0; i < report.causes.size(); ++i) {
    const Cause& cause = report.causes[i];
    const Fault& fault = cause.first;
    Json one{{"step", fault.step}};
    if (const std::int64_t line = trace.line_of(fault.step); line > 0) one["line"] = line;
    if (const std::string_view place = trace.printed_at(fault.step); !place.empty()) one[at_key] = place;
    one["name"] = step_and_subject(trace, fault.line, "");
    one["subject"] = checked.texts[i].subject;
    if (fault.rule) one["rule"] = rule_text(*fault.rule).name;
    if (!fault.field.empty()) {
      one["field"] = fault.field, one["recorded"] = fault.recorded, one["expected"] = fault.expected;
      if (!checked.texts[i].formula.empty()) one["formula"] = checked.texts[i].formula;
    }
    one["what"] = what_is_wrong(fault, checked.texts[i]);
    one["again"] = cause.again, one["inherited"] = cause.inherited;
    causes.push_back(one);
  }
  Json all{{"trace", trace.name()},           {"steps", report.steps},
           {"judged", report.judged},         {"numbers", report.numbers},
           {"exact", report.exact},           {"rounded", report.rounded},
           {"format", report.precision.text}, {"wrong", report.wrong_steps},
           {"inherited", report.inherited},   {"causes", causes}};
  all["verdict"] = checked.impossible.empty() ? word_of(verdict_of(report)) : word_of(Verdict::wrong);
  Json left = Json::array();
  for (const NotJudged& one : not_judged(report))
    left.push_back(
        {{"event", description_of_kind(one.kind).name}, {"steps", one.steps}, {"of", one.of}, {"fields", one.fields}});
  all["not_judged"] = left;
  all["coverage_judged"] = report.coverage;
  all["polygons_missing"] = report.polygons_missing;
  all["never_recorded"] = never_recorded(trace.header(), report);
  if (!checked.impossible.empty()) all["impossible"] = checked.impossible;
  if (!hint.empty()) all["hint"] = hint;
  all["likely"] = ids_of(checked.likely);
  fmt::print("{}\n", all.dump(2));
}

/// "With "nearer": "greater" in its header nothing would be wrong."
std::string other_convention(const Trace& trace, const CheckReport& report) {
  constexpr std::int64_t most_steps = 5'000'000;  // each convention takes as long as the check
  if (report.causes.empty() || trace.size() > most_steps) return "";
  const auto other = convention_it_follows(trace, report);
  if (!other) return "";
  std::vector<std::string> declared;
  for (const OtherConvention::Declared& one : other->declared) {
    const bool is_truth = one.word == "true" || one.word == "false";
    declared.push_back(fmt::format("\"{}\": {} in its {}", one.key, is_truth ? one.word : '"' + one.word + '"',
                                   one.in_raster ? "scene's raster" : "header"));
  }
  return fmt::format("With {} {} would be wrong. Either its header or the program is wrong.",
                     fmt::join(declared, " and "),
                     other->wrong_steps == 0 ? "nothing" : "only " + counted(other->wrong_steps, "step", "steps"));
}

/// The step at which the window opens: the first cause, or the end of what could be judged.
std::int64_t first_place(const Trace& trace, const CheckedRun& checked) {
  if (!checked.report.causes.empty()) return checked.report.causes.front().first.step;
  return checked.impossible.empty() ? 0 : trace.size();
}

/// The same for a pixel: what is wrong there, or the cause of what is; else its last step. Says which it is.
std::int64_t first_place(const Trace& trace, const CheckedRun& checked, const ShowOptions& show) {
  const auto pixel = pixel_selected(show, trace.scene().raster);
  if (!pixel) return first_place(trace, checked);
  const auto say = [&](std::int64_t step, std::string_view what) {
    fmt::print("Pixel ({}, {}): opened at step {}, {}\n", pixel->x, pixel->y, grouped(step), what);
    return step;
  };
  const auto at_pixel = [&](const CheckMarks::Step& mark) {
    const auto touched = pixel_of(trace.event(mark.step).event);
    return touched && touched->x == pixel->x && touched->y == pixel->y;
  };
  const std::vector<CheckMarks::Step>& marks = checked.marks.steps;
  const auto wrong = std::find_if(marks.begin(), marks.end(),
                                  [&](const CheckMarks::Step& mark) { return mark.wrong && at_pixel(mark); });
  if (wrong != marks.end()) return say(wrong->step, "the first there that is wrong");
  const auto mark = std::find_if(marks.begin(), marks.end(), at_pixel);
  if (mark != marks.end())
    return say(checked.report.causes[static_cast<std::size_t>(mark->cause)].first.step,
               "from which something wrong there follows");
  const auto any = [](const RecordedEvent&) { return true; };
  if (const auto last = trace.previous(trace.size() + 1, any, {*pixel}))
    return say(*last, "the last there: none of its steps is known to be wrong");
  return say(first_place(trace, checked), "as no step is about it");
}

int run(const CheckOptions& options) {
  check_view(options.view, options.show, {options.trace});
  std::string impossible;
  struct Judged {
    Trace trace;
    CheckedRun checked;
  };
  // A window may outlive this call.
  const auto judged = std::make_shared<Judged>(
      Judged{open_to_judge(options.trace, impossible, cost_of(options.view, options.show)), {}});
  const Trace& trace = judged->trace;
  CheckedRun& checked = judged->checked;
  Watch watch;
  checked = judge_run(
      trace,
      [&](std::int64_t done) {
        watch.show(fmt::format("checking: step {} of {} (Ctrl-C stops)", grouped(done), grouped(trace.size())));
        return false;
      },
      options.view);
  checked.impossible = impossible;
  const std::string hint = other_convention(trace, checked.report);
  watch.clear_line();
  if (options.json) print_json(trace, checked, hint);
  else print_text(trace, options, checked, hint);
  const bool right = checked.report.causes.empty() && impossible.empty();
  if (options.view) {
    ShowOptions show_options = options.show;
    if (show_options.at.empty()) show_options.at = std::to_string(first_place(trace, checked, options.show));
    if (options.show.screenshot.empty() && !checked.report.causes.empty())
      open_in_editor(trace.printed_at(checked.report.causes.front().first.step));
    if (const int code = show(trace, show_options, {.checked = &checked, .kept = judged}); code != exit_code::done)
      return code;
  }
  return right ? exit_code::done : exit_code::finding;
}

}  // namespace

void add_check(CLI::App& app, Action& action) {
  const auto options = std::make_shared<CheckOptions>();
  CLI::App* command = app.add_subcommand("check", "Does each step follow from its own operands?");
  command->add_option("trace", options->trace, "A .ztrace or .jsonl file, or - for standard input")
      ->type_name("FILE.ztrace")
      ->required();
  command->add_flag("--all", options->all, "Print all causes, not ten");
  CLI::Option* json = command->add_flag("--json", options->json, "Print JSON");
  command
      ->add_flag("--view", options->view,
                 "Then open the viewer at the first cause (with --pixel: that pixel's), with all causes marked")
      ->excludes(json);
  add_show_options(*command, options->show);
  command->footer(
      "Compares every number with what its formula gives for the trace's own operands, under the conventions in its\n"
      "header, every pixel of a polygon with what the scene has there, and checks every step against the rules of the\n"
      "method. What neither the run nor its scene says is listed as not judged. Exit code 0: nothing that can be "
      "judged is wrong; 1: something is. Where steps say where in the "
      "program\n"
      "they were printed, --view opens the first cause's place with ZSTEP_EDITOR, as ZSTEP_EDITOR=\"code -g {}\".\n"
      "\n"
      "Examples:\n"
      "  zstep check run.jsonl\n"
      "  zstep check run.ztrace --json\n"
      "  ./my_program | zstep check -\n"
      "  zstep check run.jsonl --view");
  command->callback([options, &action] { action = [options] { return run(*options); }; });
}

}  // namespace zstep::cli
