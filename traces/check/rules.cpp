#include "traces/check/rules.hpp"

#include <array>

namespace zstep {

namespace {

using formulas::Rule;

struct NamedRule {
  Rule rule;
  RuleText text;
};

constexpr std::array<NamedRule, static_cast<std::size_t>(Rule::count)> named_rules{{
    {Rule::edge_in_bucket,
     {"edge_in_bucket", "An edge enters the active edge list at its first scan line.",
      "The edge enters the active edge list at a scan line that is not its first."}},
    {Rule::edge_sorted,
     {"edge_sorted", "An edge enters a list that is in order at the place where its x puts it.",
      "The edge enters the active edge list at a place where its x does not belong."}},
    {Rule::edge_retires,
     {"edge_retires", "An edge leaves the active edge list at the scan line where it ends, or after the one before.",
      "The edge leaves the active edge list at a scan line where it does not end."}},
    {Rule::edge_left_behind,
     {"edge_left_behind", "No edge stays in the active edge list beyond the scan line where it ends.",
      "An edge is still in the active edge list, though it has ended."}},
    {Rule::edge_missing,
     {"edge_missing", "Each edge has entered the active edge list once its first scan line is over.",
      "The first scan line of an edge is over, and the edge has not entered the active edge list."}},
    {Rule::edge_moves_once,
     {"edge_moves_once", "An active edge moves once from each scan line to the next.",
      "The edge has not moved once for each scan line since it entered the active edge list."}},
    {Rule::swap_needed,
     {"swap_needed", "Two neighbours in the active edge list change places only where the left one has the larger x.",
      "Two edges change places in the active edge list, though they were in order."}},
    {Rule::list_in_order,
     {"list_in_order", "When a span begins, the active edge list is in order from left to right.",
      "A span begins, though the active edge list is not in order from left to right."}},
    {Rule::span_pairs,
     {"span_pairs", "A span goes from an edge of the active edge list to the next one.",
      "The span goes between two edges that are not neighbours in the active edge list."}},
    {Rule::span_line,
     {"span_line", "A span lies on the scan line at work.",
      "The span lies on another scan line than the one at work."}},
    {Rule::pixel_in_span,
     {"pixel_in_span", "A pixel lies between the first and the last of its span.",
      "The pixel lies outside the span at work."}},
    {Rule::write_after_win,
     {"write_after_win", "A pixel is written only after its depth was found nearer.",
      "The pixel is written, though its depth was found not to be nearer."}},
    {Rule::win_is_written,
     {"win_is_written", "After a depth was found nearer, the depth buffer takes it.",
      "The depth of the pixel before was found nearer, but the depth buffer did not take it."}},
    {Rule::skip_is_right,
     {"skip_is_right", "An edge is left out of the edge table only where it meets no scan line.",
      "The edge is left out of the edge table, though it meets a scan line."}},
    {Rule::box_entered,
     {"box_entered", "A ray that meets a box enters it before it leaves it.",
      "The ray is said to meet the box, though it would leave it before it enters."}},
    {Rule::kept_inside,
     {"kept_inside", "A ray keeps a point only where it lies inside its facet.",
      "The ray keeps a point that lies outside its facet."}},
}};

}  // namespace

RuleText rule_text(Rule rule) { return named_rules[static_cast<std::size_t>(rule)].text; }

static_assert([] {
  for (std::size_t i = 0; i < named_rules.size(); ++i)
    if (static_cast<std::size_t>(named_rules[i].rule) != i) return false;
  return true;
}());

}  // namespace zstep
