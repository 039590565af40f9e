// zstep find: the steps that fulfil a condition.
#include <chrono>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "sim/cli/budget.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/run_options.hpp"
#include "sim/cli/traces.hpp"
#include "sim/cli/watch.hpp"
#include "sim/cli/words.hpp"
#include "sim/places/search.hpp"
#include "sim/words/explain.hpp"
#include "traces/error.hpp"
#include "traces/replay/replay.hpp"

namespace zstep::cli {
namespace {

struct FindOptions {
  std::string trace, condition;
  std::optional<std::int64_t> from, most;
  bool backwards = false, all = false;
};

int find(const FindOptions& options) {
  using places::Search;
  const Trace trace = open_trace(options.trace);
  if (options.from && *options.from > trace.size())
    throw InputError("--from", fmt::format("the trace ends at step {}", trace.size()), "give a smaller one");
  if (options.all && options.most)
    throw InputError("zstep find", "--all and --most are both given", "keep one of them");
  const std::int64_t most = options.all ? trace.size() : options.most.value_or(1);
  // --from is where one stands: the step itself counts.
  const std::int64_t from = options.backwards ? options.from.value_or(trace.size()) + 1 : options.from.value_or(1) - 1;
  Search search(trace, places::Condition(trace, options.condition), from,
                options.backwards ? Search::Way::backwards : Search::Way::forwards);
  Watch watch;
  Replay replay(trace);
  std::int64_t found = 0;
  while (found < most) {
    const Search::Result result = search.look(std::chrono::milliseconds(50));
    if (result == Search::Result::none) break;
    if (result == Search::Result::not_yet) {
      watch.show(fmt::format("looking: step {} of {}, {} found (Ctrl-C stops)", grouped(search.at()),
                             grouped(trace.size()), grouped(found)));
      continue;
    }
    watch.clear_line();
    replay.go_to(search.step());
    const RecordedEvent& event = *replay.current();
    const StepInfo* step = find_step(trace.header().page, event.step);
    const Explanation said = explain(trace, replay.state(), event);
    fmt::print("{}  {}  {}\n", search.step(), step ? step->name : "", said.sentence);
    if (most == 1)
      for (const std::string& formula : said.formulas) fmt::print("  {}\n", formula);
    if (said.doubt) fmt::print("  {}\n", *said.doubt);
    ++found;
    search.go_on();
    if (watch.interrupted()) throw Interrupted{0};
  }
  if (found == 0) fmt::print("no{} step fulfils it\n", options.from ? options.backwards ? " earlier" : " later" : "");
  return exit_code::done;
}

}  // namespace

void add_find(CLI::App& app, Action& action) {
  const auto options = std::make_shared<FindOptions>();
  CLI::App* command = app.add_subcommand("find", "Find the steps that fulfil a condition");
  command->add_option("trace", options->trace, "A .ztrace or .jsonl file")->type_name("FILE.ztrace")->required();
  add_budget_options(*command);
  command->add_option("condition", options->condition, "\"not nearer\", \"z < 4.2 && x == 9\", \"changes(9, 17)\"")
      ->type_name("CONDITION")
      ->required();
  add_whole(*command, "--from", options->from, 1, "The first step to look at (default 1; backwards, the last)");
  command->add_flag("--backwards", options->backwards, "From there to the beginning");
  add_whole(*command, "--most", options->most, 1, "How many to print (default 1, with its numbers)")->type_name("N");
  command->add_flag("--all", options->all, "Print all of them");
  command->footer(
      "A condition speaks of the fields of events (zstep query FILE lists them): == != < <= > >=, + - * /, and or not "
      "or\n"
      "&& || !. A step without such a field does not fulfil it. Besides: step; polygon == NAME; changes(x, y), "
      "touches(x, y);\n"
      "line == 12; a step of the pseudo-code or a kind of event, alone or before `where`.\n"
      "\n"
      "Examples:\n"
      "  zstep find run.ztrace \"not nearer\"\n"
      "  zstep find run.ztrace \"compare where z < 0 and x == 15\" --all\n"
      "  zstep find run.ztrace \"changes(15, 12)\" --backwards");
  command->callback([options, &action] { action = [options] { return find(*options); }; });
}

}  // namespace zstep::cli
