// zstep explain, history and why-not: where a number comes from, what came to a pixel, and why a polygon is not seen.

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>
#include <nlohmann/json.hpp>

#include "sim/answers/explain_value.hpp"
#include "sim/answers/origin/exact.hpp"
#include "sim/answers/pixel_history.hpp"
#include "sim/answers/visits.hpp"
#include "sim/answers/why_not.hpp"
#include "sim/cli/commands.hpp"
#include "sim/cli/long_work.hpp"
#include "sim/cli/messages.hpp"
#include "sim/cli/run_options.hpp"
#include "sim/cli/show.hpp"
#include "sim/cli/table.hpp"
#include "sim/cli/traces.hpp"
#include "sim/cli/words.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/judged.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"
#include "traces/file/visit.hpp"
#include "traces/text.hpp"

namespace zstep::cli {
namespace {

struct ExplainOptions {
  std::string trace;
  std::vector<std::string> what;  ///< X Y, or FIELD, or nothing
  std::string at;
  bool json = false, exact = false;
};

Trace::Pixel pixel_named(const Raster& raster, const std::string& column, const std::string& row) {
  const std::int64_t x = parse_whole("X", column, 0), y = parse_whole("Y", row, 0);
  if (x >= raster.width || y >= raster.height)
    throw InputError(fmt::format("{} {}", x, y),
                     fmt::format("is no pixel: the picture has {} by {}", raster.width, raster.height),
                     "columns and rows count from 0");
  return {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y)};
}

answers::Question question_of(const Trace& trace, const ExplainOptions& options) {
  answers::Question question;
  question.at = options.at.empty() ? trace.size() : step_of(trace, options.at);
  if (options.what.size() > 2)
    throw InputError("zstep explain",
                     fmt::format("asks about one pixel or one field, not about '{}'", fmt::join(options.what, " ")),
                     "give X Y, or --at STEP FIELD");
  if (options.what.size() == 2) {
    question.pixel = pixel_named(trace.scene().raster, options.what[0], options.what[1]);
    return question;
  }
  if (options.at.empty())
    throw InputError("zstep explain", "asks about nothing", "give a pixel, X Y, or a step, --at STEP");
  if (question.at == 0) throw InputError("--at", "nothing has happened before the first step", "give a step from 1 on");
  const std::vector<std::string> fields = answers::fields_of_step(trace, question.at);
  if (!options.what.empty()) {
    question.field = options.what[0];
    if (std::find(fields.begin(), fields.end(), question.field) == fields.end())
      throw InputError(
          question.field, fmt::format("is no field of step {}", question.at),
          did_you_mean(question.field, fields, fields.empty() ? "it has none" : "it has " + enumerate(fields, "and")));
  }
  return question;
}

using Exactness = std::optional<answers::Exactness>;

/// A number that was computed here, and not taken over from another step.
bool is_computed(const answers::ChainLink& link, const answers::ChainValue& value) {
  return !link.given && !answers::is_taken_over(value) && !(value.formula.empty() && value.operands.empty());
}

/// " or 0.33 of the depth buffer's last bit"; nothing of what is no depth.
std::string in_buffer(double error, double unit) {
  return unit > 0 ? fmt::format(" or {} of the depth buffer's last bit", answers::roughly(error / unit)) : "";
}

/// The number of a chain that brings most of the error without being what its formula gives: that is no rounding.
std::optional<answers::Exactness::Where> wrong_number(const answers::Chain& chain,
                                                      const answers::Exactness& exactness) {
  std::optional<answers::Exactness::Where> found;
  double most = 0;
  for (std::size_t at = 0; at < chain.links.size(); ++at)
    for (std::size_t i = 0; i < chain.links[at].values.size(); ++i) {
      const double brought = std::abs(exactness.of[at][i].brought);
      if (brought > most && !answers::holds(chain.links[at].values[i])) most = brought, found = {at, i};
    }
  return found;
}

/// Where most of the error of the number that was asked for came in.
std::string most_text(const answers::Chain& chain, const answers::Exactness& exactness) {
  const answers::ChainValue& asked = chain.links[0].values[0];
  const answers::Exact& whole = exactness.of[0][0];
  if (!whole.known || asked.condition || !asked.word.empty()) return "";
  if (whole.error == 0) return fmt::format("{} has no error.\n", asked.name);
  const double unit = exactness.buffer_unit;
  const std::string error =
      fmt::format("The error of {}, {}{},", asked.name, answers::roughly(whole.error), in_buffer(whole.error, unit));
  const auto part = [&](answers::Exactness::Where at) {
    const double brought = exactness.of[at.link][at.value].brought;
    return fmt::format("{}{}, comes from {} at step {} ({})", answers::roughly(brought), in_buffer(brought, unit),
                       chain.links[at.link].values[at.value].name, grouped(chain.links[at.link].step),
                       chain.links[at.link].what);
  };
  if (const auto wrong = wrong_number(chain, exactness))
    return fmt::format(
        "{} is more than rounding brings: {}, where the trace records another number than its formula "
        "gives.\n",
        error, part(*wrong));
  if (!exactness.most) return "";
  return fmt::format("{} is the sum of what each rounding brings. The largest part, {}.\n", error,
                     part(*exactness.most));
}

std::string text_of(const Trace& trace, const answers::Chain& chain, const Exactness& exactness) {
  std::size_t width = 5;
  for (const answers::ChainLink& link : chain.links) width = std::max(width, grouped(link.step).size());
  std::string text = fmt::format("{:>{}}\n", "STEP", width);
  for (std::size_t at = 0; at < chain.links.size(); ++at) {
    const answers::ChainLink& link = chain.links[at];
    const std::string indent(static_cast<std::size_t>(2 * link.depth), ' '),
        step = link.step == 0 ? "scene" : grouped(link.step);
    text += fmt::format("{:>{}}  {}{}", step, width, indent, link.what);
    for (const std::string& from : {link.source, printed_at(trace, link.step)})
      if (!from.empty()) text += "   " + from;
    text += '\n';
    for (std::size_t i = 0; i < link.values.size(); ++i) {
      const answers::ChainValue& value = link.values[i];
      const bool asked = at == 0 && i == 0;
      const double printed = answers::holds(value) ? value.value : answers::computed_value(value);
      const std::string hex = asked && !value.condition && value.word.empty() ? "   (" + hex_text(printed) + ")" : "";
      text += fmt::format("{:>{}}    {}{}{}\n", "", width, indent, answers::line_text(value), hex);
      if (const std::string doubt = answers::doubt_text(value); !doubt.empty())
        text += fmt::format("{:>{}}    {}{}\n", "", width, indent, doubt);
      if (exactness && value.word.empty() && (asked || is_computed(link, value)))
        text += fmt::format("{:>{}}      {}{}\n", "", width, indent, answers::exact_text(value, exactness->of[at][i]));
    }
  }
  if (exactness) text += most_text(chain, *exactness);
  if (chain.cut) text += "… and what is behind that: ask about one of these numbers\n";
  return text;
}

/// A number that JSON can hold: what is not finite becomes a word.
nlohmann::ordered_json json_of(const answers::Exact& exact) {
  if (!exact.known) return {{"not_exact", exact.why}};
  return {{"digits", exact.digits},
          {"error", json_number(exact.error)},
          {"ulps", json_number(exact.ulps)},
          {"brought", json_number(exact.brought)},
          {"enclosed", exact.enclosed}};
}

nlohmann::ordered_json json_of(const Trace& trace, const answers::Chain& chain, const Exactness& exactness) {
  nlohmann::ordered_json links = nlohmann::ordered_json::array();
  for (std::size_t at = 0; at < chain.links.size(); ++at) {
    const answers::ChainLink& link = chain.links[at];
    nlohmann::ordered_json values = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < link.values.size(); ++i) {
      const answers::ChainValue& value = link.values[i];
      nlohmann::ordered_json operands = nlohmann::ordered_json::array();
      for (const answers::Operand& operand : value.operands)
        operands.push_back({{"symbol", operand.symbol}, {"value", json_number(operand.value)}, {"link", operand.link}});
      values.push_back({{"name", value.name},
                        {"value", json_number(value.value)},
                        {"hex", hex_text(value.value)},
                        {"formula", value.formula},
                        {"numbers", answers::numbers_text(value)},
                        {"note", value.note},
                        {"operands", operands}});
      if (!value.word.empty()) values.back()["word"] = value.word;
      if (const std::string doubt = answers::doubt_text(value); !doubt.empty()) values.back()["doubt"] = doubt;
      if (exactness) values.back()["exact"] = json_of(exactness->of[at][i]);
    }
    links.push_back({{"step", link.step},
                     {"parent", link.parent},
                     {"what", link.what},
                     {"source", link.source},
                     {"values", values}});
    if (const std::string_view place = trace.printed_at(link.step); !place.empty()) links.back()[at_key] = place;
  }
  nlohmann::ordered_json all{{"links", links}, {"cut", chain.cut}};
  if (exactness && exactness->buffer_unit > 0)
    all["depth_buffer"] = {{"unit", exactness->buffer_unit},
                           {"error_units", json_number(exactness->of[0][0].error / exactness->buffer_unit)}};
  if (exactness && exactness->most)
    all["most"] = {{"link", exactness->most->link},
                   {"step", chain.links[exactness->most->link].step},
                   {"name", chain.links[exactness->most->link].values[exactness->most->value].name}};
  return all;
}

/// Why a pixel has no depth: nothing came there, its colour alone was written, or the run does not record what is.
std::string no_depth_text(const Trace& trace, Trace::Pixel pixel, std::int64_t at) {
  const std::vector<answers::Visit> visits = answers::visits_of(trace, pixel);
  const answers::Visit* last = answers::holder(visits, at + 1);
  const std::string where = fmt::format("pixel ({}, {})", pixel.x, pixel.y),
                    who = last ? polygon_label(trace.scene(), last->shows) : "";
  if (!answers::records_depths(trace))
    return fmt::format("{}: the run does not record what is written into the depth buffer{}", where,
                       last && last->z && last->compared()
                           ? fmt::format("; the last that was found to be nearer there is {}, at step {} (give --at {} "
                                         "z)",
                                         who, grouped(last->step), last->step)
                           : "");
  if (last == nullptr && answers::records_owners(trace))
    return fmt::format(
        "{} has no depth: {} up to step {}", where,
        trace.has(kind_of<CoverageAdd>) ? "no polygon was drawn at its centre" : "nothing was drawn there",
        grouped(at));
  if (last == nullptr) return fmt::format("{} has no depth: no step up to {} writes one", where, grouped(at));
  return fmt::format("{} has no depth: {}, but no step up to {} writes its depth", where,
                     answers::records_owners(trace)
                         ? fmt::format("step {} colours it {}", grouped(last->written), who)
                         : fmt::format("at step {} {} was found to be nearer there", grouped(last->step), who),
                     grouped(at));
}

/// The mistake that the run is likely to go wrong by, where a number of this chain is wrong.
std::vector<std::string> likely_text(const Trace& trace, const answers::Chain& chain) {
  const bool wrong = std::any_of(chain.links.begin(), chain.links.end(), [](const answers::ChainLink& link) {
    return std::any_of(link.values.begin(), link.values.end(),
                       [](const answers::ChainValue& value) { return !answers::doubt_text(value).empty(); });
  });
  constexpr std::int64_t most_steps = 1'000'000;  // the run is gone through several times
  if (!wrong || trace.size() > most_steps) return {};
  return likely_in_words(mistakes::diagnosis_of(trace, check(trace)));
}

int explain(const ExplainOptions& options) {
  const Trace trace = open_trace(options.trace);
  const answers::Question question = question_of(trace, options);
  const answers::Chain chain = answers::explain_value(trace, question);
  if (chain.links.empty() && question.pixel) fmt::print("{}\n", no_depth_text(trace, *question.pixel, question.at));
  else if (chain.links.empty()) fmt::print("step {} has no number to explain\n", question.at);
  if (chain.links.empty()) return exit_code::done;
  Exactness exactness;
  if (options.exact) exactness = answers::exactness_of(chain, trace);
  const std::vector<std::string> likely = likely_text(trace, chain);
  if (options.json) {
    nlohmann::ordered_json all = json_of(trace, chain, exactness);
    if (!likely.empty()) all["likely"] = likely;
    fmt::print("{}\n", printable_json(all.dump(2)));
  } else {
    fmt::print("{}", text_of(trace, chain, exactness));
    if (!likely.empty()) fmt::print("{}\n", fmt::join(likely, "\n  "));
  }
  return exit_code::done;
}

}  // namespace

void add_explain(CLI::App& app, Action& action) {
  const auto options = std::make_shared<ExplainOptions>();
  CLI::App* command =
      app.add_subcommand("explain", "Tell where a number comes from, back to the lines of the mesh file");
  command->add_option("trace", options->trace, "A .ztrace or .jsonl file")->type_name("FILE.ztrace")->required();
  add_budget_options(*command);
  command
      ->add_option("what", options->what,
                   "A pixel whose depth is meant, or with --at a field of that step (its main one if none is given)")
      ->type_name("X Y or FIELD")
      ->expected(0, -1);
  command
      ->add_option("--at", options->at,
                   "The step, part of the trace or bookmark; for a pixel, the moment (default: the end)")
      ->type_name("STEP|PERCENT%|BOOKMARK");
  command->add_flag("--exact", options->exact,
                    "Beside each number that is computed what it is without rounding, its error in ulps (units of the "
                    "last digit), and where most of the error came in");
  command->add_flag("--json", options->json, "As JSON, with each value's hex float");
  command->footer(
      "Each number stands with its formula, the same with numbers, and its result; what it was made of is indented "
      "below it.\n"
      "The fields of a step's event are listed by zstep dump.\n"
      "\n"
      "Examples:\n"
      "  zstep explain run.ztrace 15 12\n"
      "  zstep explain run.ztrace --at 1056 z");
  command->callback([options, &action] { action = [options] { return explain(*options); }; });
}

// zstep history: everything that happened to one pixel.

namespace {

/// A table of steps: of a run that says where they were printed, with that beside them.
class PrintedTable {
 public:
  PrintedTable(const Trace& trace, std::vector<Table::Align> columns)
      : trace_(trace), table_((columns.push_back(Table::Align::left), std::move(columns))) {}
  void head(std::vector<std::string> cells) { add(std::move(cells), trace_.has_places() ? "PRINTED AT" : ""); }
  void row(std::int64_t step, std::vector<std::string> cells) { add(std::move(cells), trace_.printed_at(step)); }
  std::string text() const { return table_.text(0); }

 private:
  void add(std::vector<std::string> cells, std::string_view place) {
    cells.emplace_back(place);
    table_.row(std::move(cells));
  }
  const Trace& trace_;
  Table table_;
};

struct HistoryOptions {
  std::string trace;
  std::string x, y;
  bool why = false;
};

int history(const HistoryOptions& options) {
  const Trace trace = open_trace(options.trace);
  const Raster& raster = trace.scene().raster;
  const auto [x, y] = pixel_named(raster, options.x, options.y);
  std::vector<answers::Visit> all = answers::pixel_history(trace, {x, y});
  if (all.empty()) {
    fmt::print("pixel ({}, {}): no step reaches it{}; it shows the background\n", x, y,
               trace.whole() ? "" : " before the recording was cut off");
    return exit_code::done;
  }
  using enum Table::Align;
  PrintedTable table(trace, {right, left, right, right, left, left});
  const bool rays = trace.has(kind_of<RayBegin>);
  table.head({"STEP", "POLYGON", rays ? "T" : "DEPTH", "AGAINST", "OF", "OUTCOME"});
  std::string why;
  Replay replay(trace);
  for (answers::Visit& visit : all) {
    if (options.why) answers::tell(replay, visit);
    const std::string polygon = visit.polygon == no_polygon ? "" : polygon_label(trace.scene(), visit.polygon);
    const std::string of = !visit.stored ? "" : polygon_label(trace.scene(), visit.stored_polygon);
    table.row(visit.step,
              {grouped(visit.step), polygon, visit.z ? answers::depth_text(*visit.z) : "",
               visit.stored ? answers::depth_text(*visit.stored) : "", of, answers::outcome_text(trace, all, visit)});
    why += fmt::format("\n{}: {}\n", grouped(visit.step), visit.sentence);
    for (const std::string& formula : visit.formulas) why += "  " + formula + "\n";
  }
  fmt::print("{}", table.text());
  if (options.why) fmt::print("{}", why);
  return exit_code::done;
}

}  // namespace

void add_history(CLI::App& app, Action& action) {
  const auto options = std::make_shared<HistoryOptions>();
  CLI::App* command = app.add_subcommand("history", "Tell everything that happened to one pixel");
  command->add_option("trace", options->trace, "A .ztrace or .jsonl file")->type_name("FILE.ztrace")->required();
  add_budget_options(*command);
  command->add_option("x", options->x, "The pixel's column, from 0")->type_name("X")->required();
  command->add_option("y", options->y, "Its row")->type_name("Y")->required();
  command->add_flag("--why", options->why, "Each step in words, with its numbers");
  command->footer(
      "Polygons that cover the pixel's centre and were not drawn (culled, seen edge-on, out of view) are listed, too; "
      "so\n"
      "are those that were found to be behind on a whole interval of a scan line or a whole area, with their planes' "
      "depths.\n"
      "\n"
      "Examples:\n"
      "  zstep history run.ztrace 15 12\n"
      "  zstep history run.ztrace 15 12 --why");
  command->callback([options, &action] { action = [options] { return history(*options); }; });
}

// zstep why-not: why a polygon is not what is seen, at a pixel or anywhere.

namespace {

struct WhyNotOptions {
  std::string trace, polygon;
  std::string x, y;
};

std::int32_t polygon_typed(const Scene& scene, const std::string& text) {
  if (const auto polygon = answers::polygon_called(scene, text)) return *polygon;
  std::vector<std::string> names;
  for (const Polygon& polygon : scene.polygons)
    if (!polygon.name->empty()) names.push_back(*polygon.name);
  const std::string usual =
      scene.polygons.empty() ? "the scene has no polygons"
                             : fmt::format("its polygons are numbered from 0 to {}{}", scene.polygons.size() - 1,
                                           names.empty() ? "" : fmt::format(", the first is called {}", names.front()));
  throw InputError(text, "is no polygon of this trace", did_you_mean(text, names, usual));
}

int why_not(const WhyNotOptions& options) {
  const Trace trace = open_trace(options.trace);
  const Raster& raster = trace.scene().raster;
  const std::int32_t polygon = polygon_typed(trace.scene(), options.polygon);
  answers::Verdict verdict;
  if (options.x.empty()) {
    verdict = answers::why_not(trace, polygon);
  } else {
    if (options.y.empty())
      throw InputError("Y", "is missing: a pixel has a column and a row",
                       "write for example zstep why-not run.ztrace B 15 12");
    verdict = answers::why_not(trace, polygon, pixel_named(raster, options.x, options.y));
  }
  fmt::print("{}\n", verdict.sentence);
  for (const std::string& formula : verdict.formulas) fmt::print("  {}\n", formula);
  if (verdict.chain.empty()) return exit_code::done;
  using enum Table::Align;
  PrintedTable table(trace, {right, left, left});
  table.head({"STEP", "POLYGON", "WHAT"});
  for (const answers::Link& link : verdict.chain)
    table.row(link.step, {grouped(link.step),
                          link.polygon == no_polygon ? "" : polygon_label(trace.scene(), link.polygon), link.text});
  fmt::print("\n{}", table.text());
  return exit_code::done;
}

}  // namespace

void add_why_not(CLI::App& app, Action& action) {
  const auto options = std::make_shared<WhyNotOptions>();
  CLI::App* command = app.add_subcommand("why-not", "Tell why a polygon is not what is seen");
  command->add_option("trace", options->trace, "A .ztrace or .jsonl file")->type_name("FILE.ztrace")->required();
  add_budget_options(*command);
  command->add_option("polygon", options->polygon, "The polygon, by name or number")->type_name("POLYGON")->required();
  command->add_option("x", options->x, "The pixel's column, from 0; without a pixel the whole picture is examined")
      ->type_name("X");
  command->add_option("y", options->y, "Its row")->type_name("Y");
  command->footer(
      "The sentence comes first, then the numbers, then the steps that led there. Visible polygons are explained as\n"
      "well.\n"
      "\n"
      "Examples:\n"
      "  zstep why-not run.ztrace B 15 12\n"
      "  zstep why-not run.ztrace G");
  command->callback([options, &action] { action = [options] { return why_not(*options); }; });
}

}  // namespace zstep::cli
