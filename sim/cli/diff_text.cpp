// What zstep diff prints of two runs, as text and as JSON.
#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "sim/answers/seen_point.hpp"
#include "sim/cli/diff.hpp"
#include "sim/cli/words.hpp"
#include "sim/words/derived.hpp"
#include "sim/words/escaped.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/judged.hpp"
#include "sim/words/numbers.hpp"
#include "traces/diff/seen.hpp"
#include "traces/events/fields.hpp"
#include "traces/formulas/walk.hpp"
#include "traces/replay/replay.hpp"
#include "traces/text.hpp"

namespace zstep::cli {

namespace {

using Json = nlohmann::ordered_json;
using diff::DiffReport, diff::Part;

constexpr std::size_t causes_shown = 10;

/// One side of a cause: the state before the step is what its formulas are of.
CauseSide side_of(const Trace& trace, const std::string& path, Replay& replay, std::int64_t step, std::uint16_t fields,
                  std::string& subject) {
  CauseSide side;
  side.step = step;
  if (step == 0) return side;
  side.where = place_of_step(trace, step);
  side.at = trace.printed_at(step);
  if (!is_standard_input(path)) side.command = fmt::format("zstep view {} --at {}", printable(shell_word(path)), step);
  const Event event = trace.event(step).event;
  formulas::look_before(trace, replay, step, [&](const formulas::Situation& before) {
    subject = subject_of(event, before);
    side.fields = field_texts(event, before, fields);
  });
  return side;
}

std::string kind_name(std::size_t kind) { return std::string(description_of_kind(kind).name); }

/// "A keeps the first of equal depths, B takes the last".
std::string ties_text(const Comparison& a, const Comparison& b) {
  const auto of = [](const Comparison& comparison) {
    return comparison.ties == Comparison::Ties::first ? "keeps the first of equal depths"
                                                      : "takes the last of equal depths";
  };
  return fmt::format("A {}, B {}", of(a), of(b));
}
std::string nearer_text(const Comparison& a, const Comparison& b) {
  const auto of = [](const Comparison& comparison) {
    return comparison.nearer == Comparison::Nearer::smaller ? "smaller" : "greater";
  };
  return fmt::format("of A the {} depth is nearer, of B the {}", of(a), of(b));
}

/// "option samples: 4 of A, not given of B": of runs of one method those that the two do not have alike.
std::vector<std::string> option_notes(const Header& a, const Header& b) {
  std::vector<std::string> notes;
  if (a.algorithm != b.algorithm) return notes;
  const auto &of_a = a.conventions.options, &of_b = b.conventions.options;
  std::set<std::string> names;
  for (const auto* options : {&of_a, &of_b})
    for (const auto& [name, value] : *options) names.insert(name);
  for (const std::string& name : names) {
    const auto value = [&](const auto& options) {
      const auto found = options.find(name);
      return found == options.end() ? std::string("not given") : found->second;
    };
    if (value(of_a) != value(of_b))
      notes.push_back(
          fmt::format("option {}: {} of A, {} of B", printable(name), printable(value(of_a)), printable(value(of_b))));
  }
  return notes;
}

std::vector<std::string> notes_of(const Trace& a, const Trace& b, const DiffReport& report) {
  std::vector<std::string> notes;
  const auto only = [&](const Trace& has, const Trace& has_not, const char* name) {
    std::string kinds;
    for (std::size_t kind = 0; kind < kind_count; ++kind)
      if (has.has(static_cast<std::uint8_t>(kind)) && !has_not.has(static_cast<std::uint8_t>(kind)) &&
          !report.alignment.compared[kind])
        kinds += (kinds.empty() ? "" : ", ") + kind_name(kind);
    if (!kinds.empty()) notes.push_back(fmt::format("{} never records {}: not compared", name, kinds));
  };
  only(a, b, "B");
  only(b, a, "A");
  const Scene &one = a.scene(), &other = b.scene();
  if (one.points != other.points) notes.push_back("the vertices of the two scenes differ");
  Camera as_other = one.camera;
  as_other.depth_range = other.camera.depth_range;
  if (one.points == other.points && !(as_other == other.camera))
    notes.push_back("the cameras of the two scenes differ");
  if (const Camera::DepthRange& range = one.camera.depth_range, &of_b = other.camera.depth_range; range != of_b)
    notes.push_back(
        fmt::format("depths of 0 to 1 are {} to {} of A, {} to {} of B", range.low, range.high, of_b.low, of_b.high));
  if (one.raster.y_up != other.raster.y_up)
    notes.push_back(fmt::format("row 0 is {} of A, {} of B", one.raster.y_up ? "at the bottom" : "on top",
                                other.raster.y_up ? "at the bottom" : "on top"));
  if (one.raster.corners != other.raster.corners)
    notes.push_back(
        fmt::format("A sees pixels at their {}s, B at their {}s", seen_point(one.raster), seen_point(other.raster)));
  const Header &h = a.header(), &k = b.header();
  const auto parts = [&](Convention which, bool differ, const std::string& what) {
    if (h.declares(which) && k.declares(which) && differ) notes.push_back(fmt::format("the headers differ: {}", what));
  };
  parts(Convention::depth, h.conventions.depth != k.conventions.depth, "which z is interpolated");
  parts(Convention::interpolation, h.conventions.interpolation != k.conventions.interpolation,
        "how depths are interpolated");
  parts(Convention::coverage, h.conventions.coverage != k.conventions.coverage, "which pixels a span covers");
  parts(Convention::cull, h.conventions.cull != k.conventions.cull, "whether back faces are culled");
  parts(Convention::number_format, h.conventions.number_format != k.conventions.number_format, "the number format");
  parts(Convention::number_format, h.conventions.rounding != k.conventions.rounding, "how quotients are rounded");
  parts(Convention::number_format, h.conventions.positions != k.conventions.positions,
        "where vertices are on the raster");
  parts(Convention::number_format, h.conventions.attribute != k.conventions.attribute,
        "how an attribute is interpolated");
  parts(Convention::nearer, h.comparison.nearer != k.comparison.nearer, nearer_text(h.comparison, k.comparison));
  parts(Convention::ties, h.comparison.ties != k.comparison.ties, ties_text(h.comparison, k.comparison));
  for (const std::string& note : option_notes(h, k)) notes.push_back(note);
  return notes;
}

void print_side(const char* name, const CauseSide& side) {
  if (side.step == 0) return fmt::print("   {}  –\n", name);
  fmt::print("   {}  {}\n", name, side.where);
  for (const std::string& field : side.fields) fmt::print("        {}\n", field);
}

void print_table(const DiffReport& report) {
  const bool counted_only = report.alignment.not_kept > 0;
  fmt::print("{:<20} {:>11} {:>9} {:>9} {:>9} {:>9}{}\n", "steps", "same", "rounding", "different", "only A", "only B",
             counted_only ? fmt::format(" {:>12}", "not followed") : "");
  for (std::size_t kind = 0; kind < kind_count; ++kind) {
    const diff::KindDifference& row = report.kinds[kind];
    if (row.same + row.rounding + row.different + row.only_a + row.only_b + row.not_followed == 0) continue;
    fmt::print("{:<20} {:>11} {:>9} {:>9} {:>9} {:>9}{}\n", kind_name(kind), row.same, row.rounding, row.different,
               row.only_a, row.only_b, counted_only ? fmt::format(" {:>12}", row.not_followed) : "");
  }
}

}  // namespace

std::string pictures_text(const diff::BufferDifference& found) {
  const std::string empty = found.empty_a == found.empty_b
                                ? ""
                                : fmt::format(" Where nothing is drawn the depth is {} in A, {} in B.",
                                              number(found.empty_a), number(found.empty_b));
  const std::string unknown =
      found.depths_compared ? empty : " Only colours are compared: one of the two has no depths.";
  if (found.colors == 0 && found.depths == 0)
    return (found.depths_rounded == 0 ? fmt::format("The pictures are the same, all {} pixels.", grouped(found.pixels))
                                      : fmt::format("The pictures are the same; {} of {} depths differ by rounding.",
                                                    grouped(found.depths_rounded), grouped(found.pixels))) +
           unknown;
  std::vector<std::string> parts;
  const auto add = [&](std::int64_t count, const std::string& what) {
    if (count > 0) parts.push_back(fmt::format("{} {} {}", grouped(count), count == 1 ? "has" : "have", what));
  };
  add(found.colors, "another colour");
  add(found.depths - found.only_a - found.only_b - found.not_finite,
      fmt::format("another depth (by at most {})", number(found.farthest)));
  add(found.only_a, "a depth in A alone");
  add(found.only_b, "a depth in B alone");
  add(found.not_finite, "a depth that is no finite number in one of the two");
  return fmt::format("The pictures differ: of {} pixels {}.{}", grouped(found.pixels), enumerate(parts, "and"),
                     unknown);
}

namespace {

/// "polygon long", "the background".
std::string seen_label(const Scene& scene, std::int32_t polygon) {
  return polygon == no_polygon ? "the background" : "polygon " + polygon_label(scene, polygon);
}

/// How one run comes to show `shown` at a pixel and not `other`, in one sentence.
std::string how_seen(const char* run, const Trace& trace, std::int32_t shown, const diff::DrawnAt& of_shown,
                     std::int32_t other, const diff::DrawnAt& of_other) {
  const std::string name = seen_label(trace.scene(), shown), rest = seen_label(trace.scene(), other);
  const auto [z, z_other] = tell_apart(of_shown.z, of_other.z);
  const bool known = std::isfinite(of_shown.z) && std::isfinite(of_other.z);
  const double behind = trace.header().comparison.behind(of_shown.z, of_other.z);
  const std::string_view stands = behind > 0 ? "which is nearer" : behind < 0 ? "which is farther" : "which is as deep";
  const std::string draws = fmt::format("Run {} draws {} (step {})", run, name, grouped(of_shown.step));
  if (of_shown.step != 0 && of_other.step != 0) {
    const std::string both = fmt::format("{} {} {} (step {})", draws, of_shown.step > of_other.step ? "over" : "before",
                                         rest, grouped(of_other.step));
    return both + (known ? fmt::format(", {}: z = {} against {}.", stands, z, z_other) : ".");
  }
  if (of_shown.step != 0 && of_other.found != 0)
    return fmt::format("{}, z = {}; {} (step {}) loses with z = {}.", draws, z, rest, grouped(of_other.found), z_other);
  if (of_shown.step != 0)
    return draws + (other == no_polygon ? " there." : fmt::format(", and never comes to {} there.", rest));
  if (of_other.found != 0)
    return fmt::format("Run {} compares {} there (step {}), and does not draw it.", run, rest, grouped(of_other.found));
  return fmt::format("Run {} never comes to {} there.", run, rest);
}

}  // namespace

std::vector<std::string> seen_text(const Trace& a, const Picture& end_a, const Trace& b, const Picture& end_b) {
  std::vector<std::string> sentences;
  for (const diff::SeenApart& group : diff::seen_apart(a, end_a, b, end_b))
    sentences.push_back(fmt::format("{} {} in run A, {} in run B; the first is ({}, {}). {} {}",
                                    counted(group.pixels, "pixel shows", "pixels show"),
                                    seen_label(a.scene(), group.polygon_a), seen_label(b.scene(), group.polygon_b),
                                    group.x, group.y,
                                    how_seen("A", a, group.polygon_a, group.a_in_a, group.polygon_b, group.b_in_a),
                                    how_seen("B", b, group.polygon_b, group.b_in_b, group.polygon_a, group.a_in_b)));
  if (sentences.empty())
    sentences.push_back(
        "The same polygons are seen; which step gives them another colour cannot be told from these runs.");
  return sentences;
}

DiffText diff_text(const Trace& a, const Trace& b, const DiffOptions& options, const DiffReport& report,
                   const diff::BufferDifference& pictures) {
  DiffText text{printable(a.name()), printable(b.name()), notes_of(a, b, report), {}, pictures_text(pictures)};
  Replay replay_a(a), replay_b(b);
  const std::size_t shown = options.all ? report.causes.size() : std::min(causes_shown, report.causes.size());
  // In the order of the steps: a replay goes forwards with less work.
  std::vector<std::size_t> order(shown);
  for (std::size_t i = 0; i < shown; ++i) order[i] = i;
  text.causes.resize(shown);
  const auto by = [&](auto step) {
    std::sort(order.begin(), order.end(), [&](std::size_t one, std::size_t other) { return step(one) < step(other); });
  };
  by([&](std::size_t i) { return report.causes[i].first.a; });
  for (const std::size_t i : order)
    text.causes[i].a = side_of(a, options.a, replay_a, report.causes[i].first.a, report.causes[i].first.fields,
                               text.causes[i].subject);
  by([&](std::size_t i) { return report.causes[i].first.b; });
  for (const std::size_t i : order)
    text.causes[i].b = side_of(b, options.b, replay_b, report.causes[i].first.b, report.causes[i].first.fields,
                               text.causes[i].subject);
  for (std::size_t i = 0; i < shown; ++i) {
    const diff::Cause& cause = report.causes[i];
    const Trace& of = cause.first.only_a() ? a : b;
    const StepInfo* step = find_step(of.header().page, cause.first.line);
    text.causes[i].step = step ? step->name : kind_name(cause.first.kind);
    text.causes[i].what = why_cause(cause);
    text.causes[i].follows = what_follows(cause);
  }
  return text;
}

void print_diff(const DiffText& text, const DiffReport& report, const diff::BufferDifference& pictures, bool all) {
  fmt::print("A: {}\nB: {}\n", text.name_a, text.name_b);
  for (const std::string& note : text.notes) fmt::print("{}\n", note);
  fmt::print("\n");
  const auto different =
      static_cast<std::int64_t>(std::count_if(report.causes.begin(), report.causes.end(),
                                              [](const diff::Cause& cause) { return cause.part == Part::different; }));
  const bool same_pictures = pictures.colors == 0 && pictures.depths == 0;
  const auto& differences = report.alignment.differences;
  const bool says_nothing = std::any_of(differences.begin(), differences.end(),
                                        [](const auto& one) { return !one.only_a() && !one.only_b(); });
  if (report.causes.empty() && says_nothing)
    fmt::print(
        "All steps that both have say the same. Which of two edges at one x is named, and the slope of a span without "
        "width, say nothing.\n");
  else if (report.causes.empty()) fmt::print("All steps that both have are the same, to the last bit.\n");
  else if (different == 0 && same_pictures)
    fmt::print("The runs differ only by rounding ({}).\n", report.precision.text);
  else if (different == 0)
    fmt::print("No step differs by more than rounding ({}), but rounding decides what is seen.\n",
               report.precision.text);
  else
    fmt::print("{}, {} in all\n", counted(different, "cause", "causes"),
               counted(report.differences(), "difference", "differences"));
  fmt::print("{}\n", text.pictures);
  for (const std::string& sentence : text.seen) fmt::print("{}\n", sentence);
  if (!text.likely.empty()) fmt::print("Of B:\n  {}\n", fmt::join(text.likely, "\n  "));
  fmt::print("\n");
  for (std::size_t i = 0; i < text.causes.size(); ++i) {
    const CauseText& cause = text.causes[i];
    fmt::print("{}. {}{}: {}\n", i + 1, cause.step, cause.subject.empty() ? "" : ", " + cause.subject, cause.what);
    print_side("A", cause.a);
    print_side("B", cause.b);
    if (!cause.follows.empty()) fmt::print("   {}\n", cause.follows);
    if (const std::string& command = cause.b.step != 0 ? cause.b.command : cause.a.command; !command.empty())
      fmt::print("   {}\n", command);
  }
  if (text.causes.size() < report.causes.size() && !all)
    fmt::print("… and {} more: --all prints them\n", grouped(report.causes.size() - text.causes.size()));
  if (!text.causes.empty()) fmt::print("\n");
  print_table(report);
}

void print_diff_json(const DiffText& text, const DiffReport& report, const diff::BufferDifference& pictures) {
  const auto side = [](const CauseSide& of) -> Json {
    if (of.step == 0) return nullptr;
    Json json{{"step", of.step}, {"where", of.where}, {"fields", of.fields}};
    if (!of.at.empty()) json[at_key] = of.at;
    return json;
  };
  Json causes = Json::array(), kinds = Json::object();
  for (std::size_t i = 0; i < text.causes.size(); ++i) {
    const diff::Cause& cause = report.causes[i];
    causes.push_back(Json{{"kind", kind_name(cause.first.kind)},
                          {"name", text.causes[i].step},
                          {"subject", text.causes[i].subject},
                          {"part", cause.part == Part::rounding ? "rounding" : "different"},
                          {"what", text.causes[i].what},
                          {"a", side(text.causes[i].a)},
                          {"b", side(text.causes[i].b)},
                          {"again", cause.again},
                          {"symptoms", cause.symptoms}});
  }
  for (std::size_t kind = 0; kind < kind_count; ++kind) {
    const diff::KindDifference& row = report.kinds[kind];
    if (row.same + row.rounding + row.different + row.only_a + row.only_b + row.not_followed == 0) continue;
    kinds[kind_name(kind)] =
        Json{{"same", row.same},     {"rounding", row.rounding}, {"different", row.different},
             {"only_a", row.only_a}, {"only_b", row.only_b},     {"not_followed", row.not_followed}};
  }
  const Json all{{"a", text.name_a},
                 {"b", text.name_b},
                 {"notes", text.notes},
                 {"format", report.precision.text},
                 {"complete", report.alignment.complete && report.alignment.not_kept == 0},
                 {"differences", report.differences()},
                 {"causes_in_all", report.causes.size()},
                 {"causes", causes},
                 {"kinds", kinds},
                 {"seen", text.seen},
                 {"likely", text.likely},
                 {"pixels", pictures.pixels},
                 {"colors_differ", pictures.colors},
                 {"depths_differ", pictures.depths},
                 {"depths_in_a_alone", pictures.only_a},
                 {"depths_in_b_alone", pictures.only_b},
                 {"depths_not_finite", pictures.not_finite},
                 {"depths_compared", pictures.depths_compared},
                 {"depth_farthest", pictures.farthest}};
  fmt::print("{}\n", all.dump(2));
}

}  // namespace zstep::cli
