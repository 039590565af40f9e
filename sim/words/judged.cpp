#include "sim/words/judged.hpp"

#include <cmath>
#include <filesystem>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sim/answers/seen_point.hpp"
#include "sim/words/derived.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "traces/events/fields.hpp"
#include "traces/text.hpp"

namespace zstep {
namespace {

std::string how_many(std::int64_t number, std::string_view singular, std::string_view plural) {
  return fmt::format("{} {}", grouped(number), number == 1 ? singular : plural);
}
void add(std::string& text, const std::string& more) { text += (text.empty() ? "" : "; ") + more; }

/// The value of a field, in the words of traces.
std::string value_text(const FieldOfKind& field, const Event& event) {
  using Type = FieldOfKind::Type;
  switch (field.type) {
    case Type::truth:
      return field.true_in(event) ? "true" : "false";
    case Type::word:
      return std::string(field.word_in(event));
    case Type::whole:
    case Type::real:
      break;
  }
  return fmt::format("{}", field.read(event));
}

/// What the trace has and what is expected, where a field is not a number but a word, or true or false.
std::optional<std::pair<std::string, std::string>> in_words(const Fault& fault) {
  const FieldOfKind* field = field_of_kind(fault.kind, fault.field);
  if (!field) return std::nullopt;
  const auto word = [&](double value) {
    if (field->type == FieldOfKind::Type::truth) return std::string(value != 0 ? "true" : "false");
    const auto place = static_cast<std::size_t>(value);
    return std::string(place < field->words.size() ? field->words[place] : "none of its words");
  };
  if (field->type != FieldOfKind::Type::truth && field->words.empty()) return std::nullopt;
  return std::pair(word(fault.recorded), word(fault.expected));
}

/// "z = 0.5" of 0.5: a number that was taken over as it is.
bool only_repeats(const std::string& formula, double value) {
  const std::size_t equals = formula.find(" = ");
  return equals != formula.npos && equals == formula.rfind(" = ") && formula.substr(equals + 3) == number(value);
}

/// How a pixel lies to a facet: "its centre lies 0.31 to the right of edge 1–2, which meets scan line 2 at x = 1.69".
std::string place_to(const formulas::DrawnFacet& facet, const Trace::Pixel& pixel, const Raster& raster) {
  const auto beside = facet.beside(pixel.x, pixel.y);
  if (!beside) return fmt::format("scan line {} does not meet it", pixel.y);
  const auto name = [](std::int32_t vertex) { return vertex < 0 ? std::string("(cut)") : fmt::format("{}", vertex); };
  const std::string edge = fmt::format("edge {}\u2013{}", name(beside->vertex_0), name(beside->vertex_1));
  const double distance = pixel.x - beside->x_edge;
  if (distance == 0) {
    if (facet.cover(pixel.x, pixel.y) == formulas::DrawnFacet::Cover::inside)
      return fmt::format("its {} lies on {}, and is the polygon's own there", seen_point(raster), edge);
    return fmt::format("its {} lies on {}, a {} edge, which does not own it", seen_point(raster), edge,
                       beside->is_left ? "left" : "right");
  }
  return fmt::format("its {} lies {} to the {} of {}, which meets scan line {} at x = {}", seen_point(raster),
                     number(std::abs(distance)), distance < 0 ? "left" : "right", edge, pixel.y,
                     tell_apart(beside->x_edge, pixel.x).first);
}

/// Where the pixel of a rule lies in the scene; empty where the rule is about none.
std::string place_in_scene(const Fault& fault, const Event& event, const formulas::Situation& before) {
  using formulas::Rule;
  if (fault.rule == Rule::pixel_on_facet) {
    const auto pixel = pixel_of(event);
    const formulas::DrawnFacet* facet = before.drawn_facet();
    return pixel && facet ? "Of " + polygon_label(before.scene, before.method().polygon) + ", " +
                                place_to(*facet, *pixel, before.scene.raster) + "."
                          : "";
  }
  if (!fault.pixel) return "";
  std::optional<formulas::DrawnFacet> never;
  if (fault.facet >= 0)
    never = formulas::DrawnFacet::from_scene(before.scene, before.header, fault.facet, before.roundoff);
  const formulas::DrawnFacet* facet = fault.facet >= 0 ? (never ? &*never : nullptr) : before.drawn_facet();
  if (!facet) return "";
  const std::int32_t polygon = fault.facet >= 0 ? before.scene.facets[fault.facet].polygon : before.method().polygon;
  return fmt::format(
      "It is pixel ({}, {}) of {}: {}{}.", fault.pixel->x, fault.pixel->y, polygon_label(before.scene, polygon),
      place_to(*facet, *fault.pixel, before.scene.raster),
      fault.more_pixels == 0
          ? ""
          : fmt::format("; {} missing, too", how_many(fault.more_pixels, "other pixel is", "other pixels are")));
}

}  // namespace

FaultText fault_text(const Fault& fault, const Event& event, const formulas::Situation& before) {
  FaultText text{.subject = subject_of(event, before)};
  if (fault.field.empty()) {
    text.detail = place_in_scene(fault, event, before);
    return text;
  }
  if (const auto formula =
          fault.by_scene ? formula_of_scene(event, before) : derived_formula(event, before, fault.field))
    text.formula = formula->text, text.compares = formula->compares;
  return text;
}

std::string what_is_wrong(const Fault& fault, const FaultText& text) {
  if (!fault.impossible.empty()) return fmt::format("this step is impossible: {}", fault.impossible);
  if (fault.rule) return std::string(rule_text(*fault.rule).broken) + (text.detail.empty() ? "" : " ") + text.detail;
  if (fault.no_number())
    return fmt::format("{} is {}, where a finite number must be", fault.field,
                       std::isnan(fault.recorded) ? "NaN" : number(fault.recorded));
  if (const auto words = text.compares ? std::nullopt : in_words(fault))
    return fmt::format("{} = {}, but the trace has {}", fault.field, words->second, words->first);
  auto [is, ought] = tell_apart(fault.recorded, fault.expected);
  if (std::isnan(fault.recorded)) is = "NaN";
  if (text.formula.empty()) return fmt::format("{} = {}, but the trace has {}", fault.field, ought, is);
  if (text.compares)
    return fmt::format("{}, but the trace says {}", text.formula, fault.recorded != 0 ? "nearer" : "not nearer");
  return fmt::format("{}{} = {}, but the trace has {}", fault.by_scene ? "by the scene, " : "", fault.field,
                     text.formula, is);
}

std::string what_follows(const Cause& cause) {
  std::string text;
  if (cause.again > 0) add(text, how_many(cause.again, "later step has", "later steps have") + " the same fault");
  if (cause.inherited > 0) add(text, how_many(cause.inherited, "step follows", "steps follow") + " from it");
  return text;
}

std::string step_and_subject(const Trace& trace, std::uint8_t line, const std::string& subject) {
  const StepInfo* step = find_step(trace.header().page, line);
  return (step ? step->name : "") + (subject.empty() ? "" : ", " + subject);
}

std::vector<std::string> not_judged_in_words(const Trace& trace, const CheckReport& report) {
  std::vector<std::string> lines;
  for (const NotJudged& one : not_judged(report)) {
    std::string names;
    for (const StepInfo& step : trace.header().page)
      if (step.kind == one.kind) names += (names.empty() ? "" : ", ") + step.name;
    const std::string steps = one.steps < one.of
                                  ? fmt::format("{} of {}", grouped(one.steps), how_many(one.of, "step", "steps"))
                                  : how_many(one.of, "step", "steps");
    const std::string fields = one.fields.empty() ? "" : fmt::format("{} of ", fmt::join(one.fields, ", "));
    lines.push_back(
        fmt::format("{}{} ({}){}", fields, names, steps, one.never ? ": no formula says what it must be" : ""));
  }
  for (const std::int32_t polygon : report.polygons_missing)
    lines.push_back(fmt::format("polygon {}: the run has no step of it", polygon_label(trace.scene(), polygon)));
  if (!report.coverage) lines.push_back("which pixels are drawn: some may be missing, others too many");
  return lines;
}

std::string verdict_in_words(const CheckReport& report) {
  switch (verdict_of(report)) {
    case Verdict::wrong:
      break;
    case Verdict::not_judged:
      return "Nothing could be judged.";
    case Verdict::right_where_judged:
      return "Nothing that can be judged is wrong.";
    case Verdict::right:
      return "Nothing is wrong.";
  }
  return "Something is wrong.";
}

CheckedRun judge_run(const Trace& trace, const OnChecked& on_checked, bool with_marks) {
  CheckedRun run;
  run.report = check(
      trace,
      [&](const Cause& cause, const formulas::Situation& before, const RecordedEvent& event) {
        run.texts.push_back(fault_text(cause.first, event.event, before));
      },
      on_checked, with_marks ? &run.marks : nullptr);
  run.likely = mistakes::diagnosis_of(trace, run.report);
  return run;
}

std::vector<std::string> likely_in_words(const mistakes::Diagnosis& likely) {
  std::vector<std::string> lines;
  if (likely.either.empty()) return lines;
  const auto add = [&](std::string_view begin, mistakes::Mistake mistake) {
    const mistakes::MistakeText& text = mistakes::text_of(mistake);
    lines.push_back(fmt::format("{}{}", begin, text.name));
    lines.emplace_back(text.question);
    lines.push_back(fmt::format("“{}” in: zstep lesson {}", text.stop, text.lesson));
  };
  if (likely.either.size() > 1) {
    lines.emplace_back("Likely one of these, which give the same in this run:");
    for (const mistakes::Mistake mistake : likely.either) lines.emplace_back(mistakes::text_of(mistake).name);
  } else {
    add("Likely: ", likely.either.front());
  }
  if (likely.also) add("And besides: ", *likely.also);
  return lines;
}

std::string why_too_early(const diff::TooEarly& order) {
  const auto [here, there] = tell_apart(order.z, order.z_before);
  return fmt::format("At pixel ({}, {}) z is {} here and {} there, and what is drawn last is seen.", order.x, order.y,
                     here, there);
}

std::string why_cause(const diff::Cause& cause) {
  if (const auto& order = cause.too_early) {
    std::string why = why_too_early(*order);
    why.pop_back();
    return fmt::format("it comes too early in B: step {} must come first. {}", grouped(order->before), why);
  }
  if (cause.elsewhere != 0)
    return fmt::format("{} has this step at another place, step {}", cause.first.only_a() ? "B" : "A",
                       grouped(cause.elsewhere));
  if (cause.first.only_a()) return "A has this step, B does not";
  if (cause.first.only_b()) return "B has this step, A does not";
  if (cause.part == diff::Part::rounding && cause.unexplained)
    return "only rounding: the results are no farther apart than the number formats allow";
  if (cause.part == diff::Part::rounding) return "only rounding: its operands are the same, or differ by rounding";
  if (cause.wrong_a && cause.wrong_b) return "both compute it wrongly from their own operands";
  if (cause.wrong_b) return "B computes it wrongly from its own operands";
  if (cause.wrong_a) return "A computes it wrongly from its own operands";
  if (cause.tie)
    return "a tie: in both runs z is equal to what is stored, and only one of them takes the later polygon";
  if (cause.unexplained) return "the results differ, and what they follow from is not recorded in both runs";
  if (cause.unjudged) return "the results differ, and nothing in the runs says which one is right";
  if (const auto& order = cause.other_order)
    return fmt::format("the runs draw in another order: A has step {} {} this one, B has the same, step {}, {} it",
                       grouped(order->a), order->first_in_a ? "before" : "after", grouped(order->b),
                       order->first_in_a ? "after" : "before");
  return "each run computes it rightly by its own header and operands: these differ, and no step that both record says "
         "why";
}

std::string what_follows(const diff::Cause& cause) {
  std::string text;
  if (cause.again > 0 && cause.too_early)
    add(text, how_many(cause.again, "later step comes", "later steps come") + " too early likewise");
  else if (cause.again > 0) add(text, how_many(cause.again, "later step differs", "later steps differ") + " likewise");
  if (cause.symptoms > 0) add(text, how_many(cause.symptoms, "difference follows", "differences follow") + " from it");
  if (cause.pixels > 0)
    add(text, how_many(cause.pixels, "differing step writes a pixel", "differing steps write pixels"));
  return text;
}

std::string FieldText::line() const {
  std::string text = name.empty() ? value : fmt::format("{} = {}", name, value);
  if (!formula.empty()) text += fmt::format("   {} {}", origin(), formula);
  return text;
}

std::vector<FieldText> fields_in_words(const Event& event, const formulas::Situation& before, std::uint16_t fields) {
  std::vector<FieldText> texts;
  const std::span<const FieldOfKind> all = fields_of_kind(event.index());
  for (std::size_t at = 0; at < all.size(); ++at) {
    if ((fields >> at & 1) == 0) continue;
    FieldText& text = texts.emplace_back();
    text.name = all[at].name, text.value = value_text(all[at], event);
    const auto formula = derived_formula(event, before, text.name);
    if (formula && !only_repeats(formula->text, all[at].read(event)))
      text.formula = formula->text, text.follows = formula->follows;
  }
  return texts;
}

std::vector<std::string> field_texts(const Event& event, const formulas::Situation& before, std::uint16_t fields) {
  std::vector<std::string> lines;
  for (const FieldText& text : fields_in_words(event, before, fields)) lines.push_back(text.line());
  return lines;
}

std::string printed_at(const Trace& trace, std::int64_t step) {
  const std::string_view place = trace.printed_at(step);
  return place.empty() ? "" : fmt::format("printed at {}", place);
}

std::string place_of_step(const Trace& trace, std::int64_t step) {
  const std::string path = printable(trace.name());
  const std::int64_t line = trace.line_of(step);
  const std::string place = line > 0 ? fmt::format("{}:{}", path, line) : fmt::format("{}, step {}", path, step),
                    printed = printed_at(trace, step);
  return printed.empty() ? place : place + ", " + printed;
}

}  // namespace zstep
