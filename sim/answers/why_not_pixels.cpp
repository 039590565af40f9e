// Methods that bring polygons to the pixel one by one: compared (Z-buffer, line buffer, shadow buffer, transparency) or
// painted (painter's algorithm, depth sort, BSP tree).

#include <algorithm>
#include <cmath>

#include "sim/answers/why_not_parts.hpp"
#include "traces/file/header.hpp"
#include "traces/scene.hpp"

namespace zstep::answers {

// Why one piece was drawn before another: the plane of the tree that parts them, or their depths in the list.

namespace {

std::int32_t node_of(const MethodState& machine, std::int32_t piece) {
  for (std::size_t node = 0; node < machine.tree.size(); ++node)
    for (const std::int32_t held : machine.tree[node].pieces)
      if (held == piece) return index32(node);
  return -1;
}

/// The node whose subtree holds both, nearest to them; -1 if there is none.
std::int32_t node_over_both(const MethodState& machine, std::int32_t one, std::int32_t other) {
  std::vector<std::int32_t> above;
  for (std::int32_t node = one; node >= 0; node = machine.tree[node].parent) above.push_back(node);
  for (std::int32_t node = other; node >= 0; node = machine.tree[node].parent)
    for (const std::int32_t known : above)
      if (known == node) return node;
  return -1;
}

void add_tree(Asked& q, const MethodState& machine, Verdict& verdict, std::int32_t piece, std::int32_t later,
              std::int64_t drawn) {
  const std::int32_t mine = node_of(machine, piece), other = node_of(machine, later);
  const std::int32_t node = node_over_both(machine, mine, other);
  if (node < 0) return;
  const TreeNode& parting = machine.tree[node];
  const std::string wall = piece_label(q.scene, machine, parting.pieces.front());
  if (mine == other) {
    verdict.sentence += keeps_first(q.trace.header())
                            ? " Both lie in one plane of the tree, and there the first in the file is drawn last."
                            : " Both lie in one plane of the tree.";
    return;
  }
  verdict.sentence +=
      other == node ? fmt::format(" In the tree it lies behind {} as the eye sees it, so it was drawn first.", wall)
      : mine == node
          ? fmt::format(" In the tree {} lies in front of its plane as the eye sees it, so it was drawn first.",
                        q.label(verdict.other))
          : fmt::format(
                " In the tree the plane of {} parts the two, and it lies on the side away from the eye, so "
                "it was drawn first.",
                wall);
  if (parting.eye)
    verdict.add_formula("plane of {} at the eye: A x + B y + C z + D w = {}, the eye is {}", wall,
                        number(parting.eye->value), parting.eye->front ? "in front" : "behind");
  const auto side =
      last_that<EyeSide>(q.trace, drawn, last_mark(q.trace), [node](const EyeSide& eye) { return eye.node == node; });
  if (side) verdict.add_step(side->step, no_polygon, "the eye is held against the plane of {}", wall);
}

}  // namespace

void add_order(Asked& q, Verdict& verdict, std::int64_t earlier, std::int64_t later) {
  if (!records<PieceDraw>(q.trace)) return;
  const auto first = last_event<PieceDraw>(q.trace, earlier), second = last_event<PieceDraw>(q.trace, later);
  if (!first || !second || first->step == second->step) return;
  const std::int32_t piece = first->event.piece, other = second->event.piece;
  const MethodState& machine = q.state_at(second->step).machine;
  const auto label = [&](std::int32_t number) { return piece_label(q.scene, machine, number); };
  verdict.add_step(first->step, q.polygon, "{} is drawn", label(piece));
  verdict.add_step(second->step, verdict.other, "{} is drawn", label(other));
  if (records<EyeSide>(q.trace)) return add_tree(q, machine, verdict, piece, other, first->step);
  const Piece &mine = machine.pieces[piece], &its = machine.pieces[other];
  const std::vector<std::int32_t> places = draw_places(machine);
  if (mine.extent && its.extent)
    verdict.add_formula("farthest {} of {} = {}, of {} = {}; drawn as number {} and {}", q.z, label(piece),
                        told(mine.extent->z_max), label(other), told(its.extent->z_max), places[piece] + 1,
                        places[other] + 1);
}

namespace {

std::string step_text(std::int64_t step) { return "step " + grouped(step); }

/// Whose the pixel is by it, or whose colour was mixed in.
std::int32_t whose(const Visit& visit) { return visit.takes ? visit.shows : visit.polygon; }

/// Was it compared? A blend may follow a compare, or come without one.
bool was_compared(const Visit& visit) {
  return visit.compared() || (visit.outcome == Outcome::mixed && visit.step != visit.blended);
}

/// "the trace says nearer, but 7 < 7 is false".
std::string contradiction_of(const Asked& q, const Visit& visit) {
  return contradiction_text(q.trace, visit.nearer(), *visit.z, *visit.stored);
}

/// "B at z = 5 wins the compare"; where its numbers have another outcome, or none, that.
std::string compare_link(const Asked& q, const Visit& visit) {
  const std::string z =
      visit.stored && std::isfinite(*visit.stored) ? told_apart(*visit.z, *visit.stored).first : told(*visit.z);
  std::string outcome = visit.nearer()                  ? "wins the compare"
                        : visit.outcome == Outcome::tie ? "is a tie"
                                                        : "loses the compare";
  if (!follows(q.trace, visit)) outcome = "is compared: " + contradiction_of(q, visit);
  if (!visit.stored)
    outcome =
        fmt::format("is {} than a depth that the trace does not record", visit.nearer() ? "nearer" : "not nearer");
  return fmt::format("{} at {} = {} {}", q.label(visit.polygon), q.z, z, outcome);
}

std::string z_text(const Asked& q, const Visit& visit) {
  return visit.z ? fmt::format(", {} = {}", q.z, told(*visit.z)) : "";
}

/// By how much it is behind the other, where both depths are recorded.
void add_gap(const Asked& q, Verdict& verdict, std::optional<double> z, std::optional<double> other) {
  if (!z || !other || !std::isfinite(*other)) return;
  const Comparison& comparison = q.trace.header().comparison;
  verdict.gap = comparison.behind(*z, *other);
  const bool greater = comparison.nearer == Comparison::Nearer::greater;
  verdict.add_formula("{}", greater ? difference(q.z, q.label(verdict.other), q.name, *other, *z)
                                    : difference(q.z, q.name, q.label(verdict.other), *z, *other));
}

/// What the last owner is, when it is neither of the two that the verdict is about.
void add_last(const Asked& q, Verdict& verdict, const std::vector<Visit>& visits) {
  const Visit* last = holder(visits, q.trace.size() + 1);
  if (!last || last->shows == verdict.other || last->shows == q.polygon) return;
  verdict.say(" In the end {} is seen there.", q.label(last->shows));
  verdict.add_step(last->written, last->shows, "the pixel becomes {}, which is seen in the end", q.label(last->shows));
}

/// What of a polygon that took the pixel is not as the rule has it: its depth, or whose colour it is.
void add_remarks(const Asked& q, Verdict& verdict, const Visit& visit) {
  const std::string who = q.label(visit.shows);
  if (visit.polygon != visit.shows && visit.compared())
    verdict.say(" It is {} that was compared at {}: {} writes {} instead.", q.label(visit.polygon),
                step_text(visit.step), step_text(visit.written), who);
  if (lacks_depth(visit)) verdict.say(" The depth of {} was never written there.", who);
  if (keeps_other_depth(visit))
    verdict.say(" The depth that {} wrote for {} is {}, though {} was compared.", step_text(visit.kept_at), who,
                told(*visit.kept), told(*visit.z));
}

/// Why a compare that was not followed by a write left no trace.
std::string lost_text(const Asked& q, const Visit& mine) {
  const std::string step = step_text(mine.step), other = q.label(mine.stored_polygon);
  if (!follows(q.trace, mine)) return fmt::format("at {} {}, and nothing was written", step, contradiction_of(q, mine));
  if (mine.nearer() && mine.kept)
    return fmt::format("at {} it was found to be nearer, but its depth alone was written, at {}", step,
                       step_text(mine.kept_at));
  if (mine.nearer())
    return fmt::format("at {} it was found to be nearer, but the trace does not say that it was written", step);
  if (!mine.stored) return fmt::format("at {} the trace says that it is not nearer, and does not say than what", step);
  const bool tie = mine.outcome == Outcome::tie;
  if (mine.only_cleared || mine.stored_polygon == no_polygon) {
    const std::string is =
        fmt::format("at {} its {} is {} {}", step, q.z, tie ? "equal to" : "not nearer than", told(*mine.stored));
    if (!mine.only_cleared) return is + ", the depth written there before without a colour";
    const bool line = depth_buffer(q.trace.header()) == DepthBuffer::line;
    return fmt::format("{}, to which the {} was cleared{}", is, line ? "line buffer" : "depth buffer",
                       mine.stored_polygon == no_polygon
                           ? ""
                           : fmt::format("; {} was drawn there, but its depth was never written", other));
  }
  return tie ? fmt::format("at {} it is exactly as near as {}, which was there first, and {}", step, other,
                           q.trace.header().declares(Convention::ties) ? "of equals the first stays"
                                                                       : "the trace says not nearer")
             : fmt::format("at {} it lost the compare to {} by \u0394{} = {}", step, other, q.z,
                           told(q.trace.header().comparison.behind(*mine.z, *mine.stored)));
}

/// It was compared and was not nearer than what stood there.
Verdict why_lost(Asked& q, const std::vector<Visit>& visits, const Visit& mine) {
  const Visit* there = holder(visits, mine.step);
  const bool tie = mine.outcome == Outcome::tie;
  Verdict verdict = q.verdict(tie ? Why::tie : Why::lost, mine.step, lost_text(q, mine));
  verdict.other = mine.stored_polygon;
  q.add_formulas(verdict, mine);
  if (there) {
    if (!mine.only_cleared) add_gap(q, verdict, mine.z, mine.stored);
    if (keeps_other_depth(*there)) add_remarks(q, verdict, *there);
    verdict.add_step(there->written, there->shows, "the pixel becomes {}{}", q.label(there->shows), z_text(q, *there));
  }
  verdict.add_step(mine.step, q.polygon, "{}", compare_link(q, mine));
  add_last(q, verdict, visits);
  return verdict;
}

/// It won its compare, or came without one, and another polygon's colour was written.
Verdict why_miswritten(Asked& q, const std::vector<Visit>& visits, const Visit& mine) {
  const std::string other = q.label(mine.shows);
  const bool compared = was_compared(mine);
  const std::string how = !compared       ? "is at work there"
                          : mine.nearer() ? "won the compare at " + step_text(mine.step)
                                          : "lost the compare at " + step_text(mine.step);
  Verdict verdict =
      q.verdict(Why::contradicted, mine.written, "it {}, but {} writes {} there", how, step_text(mine.written), other);
  verdict.other = mine.shows;
  q.add_formulas(verdict, mine);
  if (compared) verdict.add_step(mine.step, q.polygon, "{}", compare_link(q, mine));
  verdict.add_step(mine.written, mine.shows, "the pixel becomes {}", other);
  add_last(q, verdict, visits);
  return verdict;
}

/// Was the pixel written before its compare?
bool written_first(const Visit& visit) { return visit.takes && was_compared(visit) && visit.written < visit.step; }

/// How another polygon took the pixel from it.
std::string gone_text(const Asked& q, const Visit& mine, const Visit& next) {
  const std::string other = q.label(whose(next)), since = step_text(mine.written);
  if (next.outcome == Outcome::painted)
    return fmt::format("it was painted there at {}, and {} was painted over it at {}", since, other,
                       step_text(next.written));
  if (next.outcome == Outcome::mixed && !was_compared(next))
    return fmt::format("it was there from {} on, until {} was laid over it at {} with opacity {}", since, other,
                       step_text(next.written), number(next.opacity));
  if (next.outcome == Outcome::written)
    return fmt::format("it was there from {} on, until {} wrote {} there without a compare", since,
                       step_text(next.written), other);
  if (written_first(next))
    return fmt::format("it was there from {} on, until {} wrote {}; only then, at {}, {} was compared, and found {}",
                       since, step_text(next.written), other, step_text(next.step), q.label(next.polygon),
                       next.nearer() ? "to be nearer" : "not to be nearer");
  if (next.compared() && !next.nearer())
    return fmt::format("it was there from {} on; {} lost the compare at {}, and {} wrote {} all the same", since,
                       q.label(next.polygon), step_text(next.step), step_text(next.written), other);
  if (next.compared() && next.stored && next.stored_polygon == q.polygon && lacks_depth(mine))
    return fmt::format(
        "it was there from {} on, but its depth was never written; so {} was held against {} at {} and found to be "
        "nearer",
        since, q.label(next.polygon), told(*next.stored), step_text(next.step));
  return fmt::format("it was there from {} on, until {} was found to be nearer at {}", since, q.label(next.polygon),
                     step_text(next.step));
}

/// It was there until another came.
Verdict why_gone(Asked& q, const std::vector<Visit>& visits, const Visit& mine, const Visit& next) {
  const bool painted = next.outcome == Outcome::painted, compared = was_compared(next);
  const std::string other = q.label(whose(next));
  const Why kind = !compared ? Why::painted_over : next.nearer() ? Why::overwritten : Why::contradicted;
  const std::int64_t taken = compared && !written_first(next) ? next.step : next.written;
  Verdict verdict = q.verdict(kind, taken, gone_text(q, mine, next));
  verdict.other = whose(next);
  if (compared) q.add_formulas(verdict, next);
  if (next.compared() && !follows(q.trace, next)) verdict.say(" There {}.", contradiction_of(q, next));
  if (!lacks_depth(mine)) add_gap(q, verdict, mine.z, next.z);
  if (keeps_other_depth(mine)) add_remarks(q, verdict, mine);
  if (next.takes && compared && next.polygon != next.shows) add_remarks(q, verdict, next);
  if (painted && verdict.gap && *verdict.gap < 0)
    verdict.say(" {} is the nearer one there: the order was wrong for this pixel.", q.name);
  verdict.add_step(mine.written, q.polygon, "the pixel becomes {}{}", q.name, z_text(q, mine));
  if (painted) add_order(q, verdict, mine.step, next.step);
  else if (compared) verdict.add_step(next.step, next.polygon, "{}", compare_link(q, next));
  verdict.add_step(next.written, whose(next), "the pixel becomes {}", other);
  add_last(q, verdict, visits);
  return verdict;
}

/// What part of the pixel's colour is its own after all that was laid over it; `over` is the first that hides it
/// wholly.
struct Share {
  double part = 0;
  const Visit* over = nullptr;
  int layers = 0;
};
Share share_of(const std::vector<Visit>& visits, const Visit& mine) {
  Share share{mine.opacity, nullptr, 0};
  for (const Visit& later : visits) {
    if (later.step <= mine.step || later.written == 0) continue;
    if (later.outcome != Outcome::mixed || later.opacity >= 1) {
      share.part = 0;
      if (!share.over) share.over = &later;
    } else {
      share.part *= 1 - later.opacity;
      ++share.layers;
    }
  }
  return share;
}

std::optional<Verdict> why_mixed(Asked& q, const std::vector<Visit>& visits, const Visit& mine) {
  const Share share = share_of(visits, mine);
  if (share.over) return std::nullopt;
  const std::string layers =
      share.layers == 0 ? "" : fmt::format(", behind {} layer{} of glass", share.layers, share.layers == 1 ? "" : "s");
  Verdict verdict = q.verdict(Why::mixed, mine.written, "{} of its colour is its own{}", number(share.part), layers);
  if (share.part == 0) verdict.sentence = fmt::format("{} is not to be seen {}: its opacity is 0.", q.name, q.where);
  q.add_formulas(verdict, mine.written);
  verdict.add_step(mine.written, q.polygon, "{} is laid over the pixel with opacity {}", q.name, number(mine.opacity));
  for (const Visit& later : visits)
    if (later.step > mine.step && later.written != 0)
      verdict.add_step(later.written, later.polygon, "{} is laid over it with opacity {}", q.label(later.polygon),
                       number(later.opacity));
  return verdict;
}

/// Front to back: what covers the pixel but found it painted already.
Verdict why_taken(Asked& q, const Visit& first) {
  Verdict verdict =
      q.verdict(Why::taken, first.written, "{} was painted there at {}, and from front to back what is painted stays",
                q.label(first.polygon), step_text(first.written));
  verdict.other = first.polygon;
  verdict.add_step(first.written, first.polygon, "the pixel becomes {}{}", q.label(first.polygon), z_text(q, first));
  return verdict;
}

/// It had the pixel before the buffers were cleared once more.
std::optional<Verdict> why_wiped(Asked& q) {
  const std::int64_t eye = begin_of_eye_pass(q.trace), clear = begin_of_picture(q.trace);
  const auto again =
      std::count_if(q.trace.clears().begin(), q.trace.clears().end(), [eye](std::int64_t step) { return step > eye; });
  if (again < 2) return std::nullopt;
  const std::vector<Visit> visits = visits_of(q.trace, q.pixel, eye);
  const auto last = std::find_if(visits.rbegin(), visits.rend(),
                                 [&](const Visit& visit) { return visit.takes && visit.shows == q.polygon; });
  if (last == visits.rend()) return std::nullopt;
  Verdict verdict = q.verdict(Why::wiped, clear, "it was there at {}, until the buffers were cleared once more at {}",
                              step_text(last->written), step_text(clear));
  verdict.add_step(last->written, q.polygon, "the pixel becomes {}", q.name);
  verdict.add_step(clear, no_polygon, "the buffers are cleared");
  return verdict;
}

void add_shadow(const Asked& q, Verdict& verdict) {
  if (const auto step = next_color(q, verdict.step)) {
    verdict.add_step(*step, q.polygon, "it is darkened: it lies in shadow");
    verdict.sentence += " It is in shadow there.";
  }
}

/// It is what the pixel shows in the end.
Verdict why_seen(Asked& q, const std::vector<Visit>& visits, const Visit& last) {
  const Share share = share_of(visits, last);
  const std::string step = step_text(last.written);
  const bool compared = last.compared();
  const std::string how =
      last.outcome == Outcome::written ? fmt::format("{} wrote it there without a compare{}", step, z_text(q, last))
      : compared && !last.nearer()
          ? fmt::format("{} wrote it there, though {} lost the compare at {}", step,
                        last.polygon == q.polygon ? "it" : q.label(last.polygon), step_text(last.step))
      : !records_owners(q.trace)
          ? fmt::format("at {} it was found to be nearer{}, and nothing was after it", step, z_text(q, last))
          : fmt::format("{} put it there{}", step, z_text(q, last));
  Verdict verdict = seen(q, last.written, how);
  if (was_compared(last)) verdict.add_step(last.step, last.polygon, "{}", compare_link(q, last));
  if (compared && !follows(q.trace, last)) verdict.say(" At {} {}.", step_text(last.step), contradiction_of(q, last));
  add_remarks(q, verdict, last);
  if (share.layers > 0 && share.over == nullptr)
    verdict.say(" {} layer{} of glass before it leave{} it {} of the pixel's colour.", share.layers,
                share.layers == 1 ? "" : "s", share.layers == 1 ? "s" : "", number(share.part));
  q.add_formulas(verdict, last);
  if (records<ShadowCompare>(q.trace)) add_shadow(q, verdict);
  return verdict;
}

/// What steps at the pixel may have been its own, though the trace does not say whose they are.
std::string unnamed_text(const std::vector<Visit>& visits) {
  for (const Visit& visit : visits)
    if (visit.polygon == no_polygon && visit.compared())
      return fmt::format("it covers the pixel; at {} a polygon that the trace does not name was compared there, and {}",
                         step_text(visit.step), visit.nearer() ? "found to be nearer" : "found not to be nearer");
  return "";
}

/// Its depth was interpolated there, and the trace does not say what came of it.
Verdict why_interpolated(const Asked& q, const Visit& mine) {
  Verdict verdict =
      q.verdict(Why::not_recorded, mine.step, "it was interpolated there at {}{}, and no compare of it is recorded",
                step_text(mine.step), z_text(q, mine));
  verdict.add_step(mine.step, q.polygon, "{} is interpolated{}", q.name, z_text(q, mine));
  return verdict;
}

/// How far a compare is from being won.
double behind(const Asked& q, const Visit& visit) {
  const double stored = visit.stored.value_or(0);
  return q.trace.header().comparison.behind(visit.z.value_or(0), std::isfinite(stored) ? stored : 0);
}

/// By some of the pixel's samples the polygon is seen, by others not.
std::optional<Verdict> why_mixed_by_samples(Asked& q) {
  if (!q.trace.has(kind_of<CoverageAdd>)) return std::nullopt;
  const auto step = find_last<CoverageAdd>(q.trace, q.trace.size(), [&](const CoverageAdd& share) {
    return share.owner == q.polygon && share.x == q.pixel.x && share.y == q.pixel.y;
  });
  if (!step) return std::nullopt;
  const double share = get<CoverageAdd>(q.trace.event(*step).event).coverage;
  return share > 0 ? std::optional(mixed_by_share(q, *step, share)) : std::nullopt;
}

Verdict by_visits(Asked& q, const std::vector<FacetThere>& facets, const std::vector<Visit>& visits) {
  const Visit *last = holder(visits, q.trace.size() + 1), *mine = nullptr, *least = nullptr, *miswritten = nullptr,
              *interpolated = nullptr;
  for (const Visit& visit : visits) {
    const bool its_own = visit.polygon == q.polygon;
    if ((visit.takes && visit.shows == q.polygon) || (its_own && visit.outcome == Outcome::mixed))
      mine = &visit;  // the last time that it changed the pixel
    else if (its_own && visit.takes) miswritten = &visit;
    else if (its_own && visit.outcome == Outcome::interpolated) interpolated = &visit;
    else if (its_own && visit.compared() && (!least || behind(q, visit) < behind(q, *least))) least = &visit;
  }
  if (last && last->shows == q.polygon) return why_seen(q, visits, *last);
  if (auto verdict = why_mixed_by_samples(q)) return *verdict;
  if (mine && mine->outcome == Outcome::mixed)
    if (auto verdict = why_mixed(q, visits, *mine)) return *verdict;
  if (mine) {
    const Visit* next = nullptr;
    const bool blends = mine->outcome == Outcome::mixed;
    for (const Visit& visit : visits)
      if (!next && visit.step > mine->step && (visit.takes || visit.outcome == Outcome::mixed) &&
          (!blends || visit.opacity >= 1))
        next = &visit;
    if (next) return why_gone(q, visits, *mine, *next);
  }
  if (miswritten) return why_miswritten(q, visits, *miswritten);
  if (least) return why_lost(q, visits, *least);
  if (const auto verdict = why_wiped(q)) return *verdict;
  if (interpolated) return why_interpolated(q, *interpolated);
  if (auto verdict = why_by_facets(q, facets)) return *verdict;
  if (auto verdict = why_tile_hidden(q, facets, visits)) return *verdict;
  const auto& options = q.trace.header().conventions.options;
  const auto order = options.find("order");
  const auto first = std::find_if(visits.begin(), visits.end(), [](const Visit& visit) { return visit.takes; });
  if (order != options.end() && order->second == "front-to-back" && first != visits.end()) return why_taken(q, *first);
  if (const std::string text = unnamed_text(visits); !text.empty()) return q.verdict(Why::not_recorded, 0, text);
  return not_recorded(q);
}

}  // namespace

Verdict why_by_pixels(Asked& q, const std::vector<FacetThere>& facets) {
  // Most polygons never come to the pixel, which is soon told.
  if (records_owners(q.trace) && !may_have_visits(q.trace, q.pixel, q.polygon)) {
    if (auto verdict = why_mixed_by_samples(q)) return *verdict;
    if (auto verdict = why_by_facets(q, facets)) return *verdict;
  }
  std::vector<Visit> visits = visits_of(q.trace, q.pixel);
  std::erase_if(visits, [](const Visit& visit) { return visit.outcome == Outcome::colored; });
  Verdict verdict = by_visits(q, facets, visits);
  const bool by_compares = std::any_of(visits.begin(), visits.end(), [](const Visit& visit) { return visit.takes; });
  if (by_compares && !records_owners(q.trace))
    verdict.sentence += " The run does not record what is written to pixels; this follows from its compares.";
  return verdict;
}

}  // namespace zstep::answers
