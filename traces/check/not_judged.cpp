#include "traces/check/not_judged.hpp"

#include "traces/events/fields.hpp"
#include "traces/formulas/follows.hpp"

namespace zstep {

namespace {

/// A field that has no meaning in some steps: the slope of a span without width.
bool may_say_nothing(std::size_t kind, std::string_view field) {
  return kind == kind_of<SpanBegin> && field == "dz_dx";
}

/// Of what is recorded no formula says what it must be, and rules, if any, only what it may not be.
bool never_judged(As as) { return has(as, As::recorded) && !has(as, As::formula) && !has(as, As::ruled); }

/// Kinds without a field that a formula gives, in which something may be wrong all the same.
bool is_decided(std::size_t kind) { return kind == kind_of<PolygonReject>; }

}  // namespace

std::vector<NotJudged> not_judged(const CheckReport& report) {
  std::vector<NotJudged> left;
  for (std::size_t kind = 0; kind < kind_count; ++kind) {
    const KindJudged& of = report.kinds[kind];
    if (of.steps == 0) continue;
    if (of.can_be_judged ? of.judged == 0 : of.joins_things) {
      left.push_back({static_cast<std::uint8_t>(kind), of.steps, of.steps, {}, !of.can_be_judged});
      continue;
    }
    NotJudged never{static_cast<std::uint8_t>(kind), of.steps, of.steps, {}, true};
    for (const FieldOfKind& field : fields_of_kind(kind))
      if (never_judged(field.as)) never.fields.push_back(field.name);
    if (!never.fields.empty()) left.push_back(std::move(never));
    if (!of.can_be_judged) continue;
    if (is_decided(kind) && of.judged < of.steps)
      left.push_back({static_cast<std::uint8_t>(kind), of.steps - of.judged, of.steps, {}});
    // Fields of which as much is known go together.
    std::size_t first = left.size();
    for (const FieldOfKind& field : fields_of_kind(kind)) {
      if (!has(field.as, As::formula)) continue;
      const std::int64_t open = of.steps - of.fields[static_cast<std::size_t>(&field - fields_of_kind(kind).data())];
      if (open == 0 || (open < of.steps && may_say_nothing(kind, field.name))) continue;
      auto same = first;
      while (same < left.size() && left[same].steps != open) ++same;
      if (same == left.size()) left.push_back({static_cast<std::uint8_t>(kind), open, of.steps, {}});
      left[same].fields.push_back(field.name);
    }
  }
  return left;
}

Verdict verdict_of(const CheckReport& report) {
  if (!report.causes.empty()) return Verdict::wrong;
  if (report.judged == 0) return Verdict::not_judged;
  const bool all = report.coverage && report.polygons_missing.empty() && not_judged(report).empty();
  return all ? Verdict::right : Verdict::right_where_judged;
}

std::vector<std::string_view> never_recorded(const Header& header, const CheckReport& report) {
  std::vector<std::string_view> names;
  for (const StepInfo& step : header.page)
    if (step.kind < kind_count && report.kinds[step.kind].steps == 0) names.push_back(step.name);
  return names;
}

}  // namespace zstep
