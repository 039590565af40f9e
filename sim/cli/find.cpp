// zstep find and dump: the steps that fulfil a condition, and steps as text or JSON Lines.

#include <algorithm>
#include <array>
#include <chrono>
#include <iostream>
#include <memory>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "sim/cli/commands.hpp"
#include "sim/cli/describe.hpp"
#include "sim/cli/long_work.hpp"
#include "sim/cli/run_options.hpp"
#include "sim/cli/traces.hpp"
#include "sim/cli/words.hpp"
#include "sim/places/search.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/judged.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"
#include "traces/events/fields.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/file/trace.hpp"
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
    const std::string printed = printed_at(trace, search.step());
    fmt::print("{}  {}  {}{}\n", search.step(), step ? step->name : "", said.sentence,
               printed.empty() ? "" : "   " + printed);
    if (most == 1)
      for (const std::string& formula : said.formulas) fmt::print("  {}\n", formula);
    if (!said.besides.empty()) fmt::print("  {}\n", said.besides);
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

// zstep dump: the steps of a trace as text or JSON Lines.

namespace {

struct DumpOptions {
  std::string trace;
  std::optional<std::int64_t> from, to;
  std::vector<std::string> kinds, steps;
  bool jsonl = false;
  bool whole() const { return !from && !to && kinds.empty() && steps.empty(); }
};

/// Which step ids to show, from the names asked for.
class Filter {
 public:
  Filter(const DumpOptions& options, const Page& page) {
    if (!options.kinds.empty()) by_kind(options.kinds, page);
    if (!options.steps.empty()) by_step(options.steps, page);
  }
  bool shows(std::uint8_t step) const { return shown_[step]; }

 private:
  using Ids = std::array<bool, 256>;
  static Ids all() {
    Ids ids{};
    ids.fill(true);
    return ids;
  }
  void narrow(const Ids& to) {
    for (std::size_t id = 0; id < shown_.size(); ++id) shown_[id] = shown_[id] && to[id];
  }

  void by_kind(const std::vector<std::string>& names, const Page& page) {
    const std::vector<std::string> known(kind_names().begin(), kind_names().end());
    Ids wanted{};
    for (const std::string& name : names) {
      const auto found = std::find(known.begin(), known.end(), name);
      if (found == known.end())
        throw InputError("--kind", fmt::format("'{}' is not a kind of event", name),
                         did_you_mean(name, known, "'zstep info' names those of a trace"));
      for (const StepInfo& step : page)
        if (step.kind == found - known.begin()) wanted[step.id] = true;
    }
    narrow(wanted);
  }

  void by_step(const std::vector<std::string>& names, const Page& page) {
    Ids wanted{};
    std::vector<std::string> known;
    for (const StepInfo& step : page) known.push_back(step.name);
    for (const std::string& name : names) {
      bool found = false;
      for (const StepInfo& step : page) {
        if (name != step.name && name != step.module + "." + step.name) continue;
        wanted[step.id] = found = true;
      }
      if (!found)
        throw InputError("--step", fmt::format("'{}' is not a step of this trace", name),
                         did_you_mean(name, known, "'zstep info' names them"));
    }
    narrow(wanted);
  }

  Ids shown_ = all();
};

/// What the words doubt of a step. For a replay of each step this takes some twenty times as long as printing it, so of
/// many steps it is left out and said so.
class Doubts {
 public:
  static constexpr std::int64_t most = 20'000;
  explicit Doubts(const Trace& trace) : trace_(trace), replay_(trace) {}

  std::string of(std::int64_t step) {
    if (!possible_) return "";
    try {
      replay_.go_to(step);
    } catch (const InputError&) {
      possible_ = false;  // from here on the trace tells what cannot be
      return "";
    }
    return explain(trace_, replay_.state(), *replay_.current()).doubt.value_or("");
  }

 private:
  const Trace& trace_;
  Replay replay_;
  bool possible_ = true;
};

int dump(const DumpOptions& options) {
  const Trace trace = open_trace(options.trace);
  const Page& page = trace.header().page;
  const Filter filter(options, page);
  if (options.jsonl && options.whole()) {
    write_jsonl(trace, std::cout);
  } else {
    const std::int64_t from = options.from.value_or(1), to = options.to.value_or(trace.size());
    if (options.from && from > trace.size())
      throw InputError("--from", fmt::format("the trace ends at step {}", trace.size()), "give a smaller one");
    if (options.to && from > to)
      throw InputError("--from", fmt::format("{} is after --to {}", from, to), "give a smaller one");
    std::size_t widest = 0;
    for (const StepInfo& step : page)
      if (filter.shows(step.id)) widest = std::max(widest, step.name.size());
    const bool few = std::min(to, trace.size()) - from < Doubts::most;
    if (!few && !options.jsonl)
      fmt::print(stderr,
                 "note: more than {} steps: they are not held against their formulas; --from and --to pick some\n",
                 grouped(Doubts::most));
    std::optional<Doubts> doubts;
    if (few && !options.jsonl) doubts.emplace(trace);
    const std::size_t digits = fmt::format("{}", std::min(to, trace.size())).size();
    const auto print = [&](std::int64_t position, const RecordedEvent& recorded) {
      if (!filter.shows(recorded.step)) return true;
      const std::string_view place = trace.printed_at(position, recorded.step);
      if (options.jsonl) {
        std::cout << jsonl_event(trace.header(), trace.scene(), recorded, place) + '\n';
      } else {
        const StepInfo* info = find_step(page, recorded.step);
        const std::string fields = fields_text(recorded.event);
        std::cout << fmt::format("{:>{}}  {:<{}}  {}{}\n", position, digits, info == nullptr ? "?" : info->name, widest,
                                 fields, place.empty() ? "" : fmt::format("  {}={}", at_key, place));
        if (const std::string doubt = doubts ? doubts->of(position) : ""; !doubt.empty())
          std::cout << fmt::format("{:>{}}  {}\n", "", digits, doubt);
      }
      return static_cast<bool>(std::cout);
    };
    if (doubts) {  // it asks the trace for other steps, which may not happen while the trace goes through them
      std::vector<RecordedEvent> events;
      trace.each(from - 1, to, [&](std::int64_t, const RecordedEvent& recorded) {
        events.push_back(recorded);
        return true;
      });
      for (std::size_t k = 0; k < events.size(); ++k)
        if (!print(from + static_cast<std::int64_t>(k), events[k])) break;
    } else {
      trace.each(from - 1, to, print);
    }
  }
  std::cout.flush();
  return exit_code::done;
}

}  // namespace

void add_dump(CLI::App& app, Action& action) {
  const auto options = std::make_shared<DumpOptions>();
  CLI::App* command = app.add_subcommand("dump", "Print the steps of a trace, one a line");
  command->add_option("trace", options->trace, "A .ztrace or .jsonl file")->type_name("FILE.ztrace")->required();
  add_budget_options(*command);
  add_whole(*command, "--from", options->from, 1, "The first step to print (steps count from 1)");
  add_whole(*command, "--to", options->to, 1, "The last step to print");
  command
      ->add_option("--kind", options->kinds, "Only events of this kind, as depth_compare; may be given more than once")
      ->type_name("KIND")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      ->add_option("--step", options->steps,
                   "Only this line of the pseudo-code, as compare; may be given more than once")
      ->type_name("NAME")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_flag("--jsonl", options->jsonl, "As JSON Lines; the whole trace so can be read back by zstep import");
  command->footer(
      "Where a step's numbers are not what its formula gives, the line below says so (of at most 20 000 steps).\n"
      "With --jsonl and without a filter the first line is the trace's header; with a filter there are only events.\n"
      "\n"
      "Examples:\n"
      "  zstep dump run.ztrace --from 1 --to 40\n"
      "  zstep dump run.ztrace --kind depth_compare --kind pixel_write\n"
      "  zstep dump run.ztrace --jsonl > run.jsonl");
  command->callback([options, &action] { action = [options] { return dump(*options); }; });
}

}  // namespace zstep::cli
