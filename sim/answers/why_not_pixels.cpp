// Methods that bring polygons to the pixel one by one: compared (Z-buffer, line buffer, shadow buffer, transparency) or
// painted (painter's algorithm, depth sort, BSP tree).
#include <algorithm>
#include <cmath>

#include "sim/answers/why_not_parts.hpp"

namespace zstep::answers {
namespace {

std::string step_text(std::int64_t step) { return "step " + grouped(step); }

void add_gap(const Asked& q, Verdict& verdict, double z, double other) {
  verdict.gap = z - other;
  verdict.formulas.push_back(difference(q.z, q.name, q.label(verdict.other), z, other));
}

/// What the last owner is, when it is neither of the two that the verdict is about.
void add_last(const Asked& q, Verdict& verdict, const std::vector<Touch>& touches) {
  const Touch* last = holder(touches, q.trace.size() + 1);
  if (!last || last->polygon == verdict.other || last->polygon == q.polygon) return;
  verdict.sentence += fmt::format(" In the end {} is seen there.", q.label(last->polygon));
  verdict.chain.push_back({last->written, last->polygon, fmt::format("the pixel becomes {}, which is seen in the end", q.label(last->polygon))});
}

/// What was recorded as nearer and never written, or is nearer by its numbers and was recorded as not.
std::string unwritten_text(const Touch& mine, double stored) {
  if (mine.nearer != (mine.z < stored)) return fmt::format("at {} {}, and nothing was written", step_text(mine.step), contradiction_text(mine.nearer, mine.z, stored));
  return fmt::format("at {} it was found to be nearer, but the trace does not say that it was written", step_text(mine.step));
}

/// It was compared and was not nearer than what stood there.
Verdict why_lost(Asked& q, const std::vector<Touch>& touches, const Touch& mine) {
  const Touch* there = holder(touches, mine.step);
  if (!there) {
    Verdict verdict = q.verdict(Why::lost, mine.step, mine.nearer ? unwritten_text(mine, no_depth) : "the trace says that it is not nearer, though nothing was drawn there before");
    q.add_formulas(verdict, mine.step, q.polygon);
    verdict.chain.push_back({mine.step, q.polygon, fmt::format("{} loses the compare", q.name)});
    return verdict;
  }
  const bool tie = mine.z == there->z, doubtful = mine.nearer || mine.z < there->z;
  const std::string other = q.label(there->polygon);
  Verdict verdict = tie ? q.verdict(Why::tie, mine.step, doubtful ? unwritten_text(mine, there->z) : fmt::format("at {} it is exactly as near as {}, which was there first, and of equals the first stays", step_text(mine.step), other))
                        : q.verdict(Why::lost, mine.step, doubtful ? unwritten_text(mine, there->z) : fmt::format("at {} it lost the compare to {} by \u0394{} = {}", step_text(mine.step), other, q.z, told(mine.z - there->z)));
  verdict.other = there->polygon;
  q.add_formulas(verdict, mine.step, q.polygon, there);
  add_gap(q, verdict, mine.z, there->z);
  verdict.chain.push_back({there->written, there->polygon, fmt::format("the pixel becomes {}, {} = {}", other, q.z, told(there->z))});
  verdict.chain.push_back({mine.step, q.polygon, fmt::format("{} at {} = {} {}", q.name, q.z, told(mine.z), doubtful ? "is compared" : tie ? "is a tie" : "loses the compare")});
  add_last(q, verdict, touches);
  return verdict;
}

/// It was there until another came.
Verdict why_gone(Asked& q, const std::vector<Touch>& touches, const Touch& mine, const Touch& next) {
  const bool painted = next.how == Touch::How::painted;
  const std::string other = q.label(next.polygon);
  Verdict verdict = q.verdict(painted ? Why::painted_over : Why::overwritten, painted ? next.written : next.step,
                              painted ? fmt::format("it was painted there at {}, and {} was painted over it at {}", step_text(mine.written), other, step_text(next.written))
                                      : fmt::format("it was there from {} on, until {} was found to be nearer at {}", step_text(mine.written), other, step_text(next.step)));
  verdict.other = next.polygon;
  if (!painted) q.add_formulas(verdict, next.step, next.polygon, holder(touches, next.step));
  if (const Touch* there = holder(touches, next.step); next.how == Touch::How::compared && there && next.z >= there->z)
    verdict.sentence += fmt::format(" There {}.", contradiction_text(true, next.z, there->z));
  add_gap(q, verdict, mine.z, next.z);
  if (painted && *verdict.gap < 0) verdict.sentence += fmt::format(" {} is the nearer one there: the order was wrong for this pixel.", q.name);
  verdict.chain.push_back({mine.written, q.polygon, fmt::format("the pixel becomes {}, {} = {}", q.name, q.z, told(mine.z))});
  if (painted) add_order(q, verdict, mine.step, next.step);
  else verdict.chain.push_back({next.step, next.polygon, fmt::format("{} at {} = {} wins the compare", other, q.z, told(next.z))});
  verdict.chain.push_back({next.written, next.polygon, fmt::format("the pixel becomes {}", other)});
  add_last(q, verdict, touches);
  return verdict;
}

/// What part of the pixel's colour is its own after all that was laid over it; `over` is the first that hides it wholly.
struct Share {
  double part = 0;
  const Touch* over = nullptr;
  int layers = 0;
};
Share share_of(const std::vector<Touch>& touches, const Touch& mine) {
  Share share{mine.opacity, nullptr, 0};
  for (const Touch& later : touches) {
    if (later.step <= mine.step || later.written == 0) continue;
    if (later.how != Touch::How::blended || later.opacity >= 1) {
      share.part = 0;
      if (!share.over) share.over = &later;
    } else {
      share.part *= 1 - later.opacity;
      ++share.layers;
    }
  }
  return share;
}

std::optional<Verdict> why_mixed(Asked& q, const std::vector<Touch>& touches, const Touch& mine) {
  const Share share = share_of(touches, mine);
  if (share.over) return std::nullopt;
  const std::string layers = share.layers == 0 ? "" : fmt::format(", behind {} layer{} of glass", share.layers, share.layers == 1 ? "" : "s");
  Verdict verdict = q.verdict(Why::mixed, mine.written, "");
  verdict.sentence = fmt::format("{} is a part of what is seen {}: {} of its colour is its own{}.", q.name, q.where, number(share.part), layers);
  if (share.part == 0) verdict.sentence = fmt::format("{} is not to be seen {}: its opacity is 0.", q.name, q.where);
  q.add_formulas(verdict, mine.written);
  verdict.chain.push_back({mine.written, q.polygon, fmt::format("{} is laid over the pixel with opacity {}", q.name, number(mine.opacity))});
  for (const Touch& later : touches)
    if (later.step > mine.step && later.written != 0) verdict.chain.push_back({later.written, later.polygon, fmt::format("{} is laid over it with opacity {}", q.label(later.polygon), number(later.opacity))});
  return verdict;
}

/// Front to back: what covers the pixel but found it painted already.
Verdict why_taken(Asked& q, const Touch& first) {
  Verdict verdict = q.verdict(Why::taken, first.written, fmt::format("{} was painted there at {}, and from front to back what is painted stays", q.label(first.polygon), step_text(first.written)));
  verdict.other = first.polygon;
  verdict.chain.push_back({first.written, first.polygon, fmt::format("the pixel becomes {}, {} = {}", q.label(first.polygon), q.z, told(first.z))});
  return verdict;
}

/// It had the pixel before the buffers were cleared once more.
std::optional<Verdict> why_wiped(Asked& q) {
  const std::int64_t eye = begin_of_eye_pass(q.trace), clear = begin_of_picture(q.trace);
  const auto again = std::count_if(q.trace.clears().begin(), q.trace.clears().end(), [eye](std::int64_t step) { return step > eye; });
  if (again < 2) return std::nullopt;
  const std::vector<Touch> touches = touches_of(q.trace, q.pixel, eye);
  const Touch* last = nullptr;
  for (const Touch& touch : touches)
    if (touch.polygon == q.polygon && touch.written != 0) last = &touch;
  if (!last) return std::nullopt;
  Verdict verdict = q.verdict(Why::wiped, clear, fmt::format("it was there at {}, until the buffers were cleared once more at {}", step_text(last->written), step_text(clear)));
  verdict.chain.push_back({last->written, q.polygon, fmt::format("the pixel becomes {}", q.name)});
  verdict.chain.push_back({clear, no_polygon, "the buffers are cleared"});
  return verdict;
}

bool comes_to_pixel(const Asked& q) {
  const auto here = [&](const RecordedEvent& recorded) {
    const auto* compare = std::get_if<DepthCompare>(&recorded.event);
    const auto* paint = std::get_if<PixelPaint>(&recorded.event);
    return (compare && compare->x == q.pixel.x && compare->y == q.pixel.y) || (paint && paint->x == q.pixel.x && paint->y == q.pixel.y);
  };
  for (const std::int64_t mark : marks_of(q.trace, q.polygon))
    if (next_within(q.trace, mark, next_mark(q.trace, mark), here)) return true;
  return false;
}

void add_shadow(const Asked& q, Verdict& verdict) {
  const auto dark = [&](const RecordedEvent& recorded) {
    const auto* color = std::get_if<ColorWrite>(&recorded.event);
    return color && color->x == q.pixel.x && color->y == q.pixel.y;
  };
  if (const auto step = q.trace.next(verdict.step, dark, q.pixel)) {
    verdict.chain.push_back({*step, q.polygon, "it is darkened: it lies in shadow"});
    verdict.sentence += " It is in shadow there.";
  }
}

}  // namespace

Verdict why_by_pixels(Asked& q, const std::vector<FacetThere>& facets) {
  // Where each polygon is dealt with at its marks alone, a look there tells whether it ever came to the pixel.
  if (!records<PieceDraw>(q.trace) && !records<FlagFlip>(q.trace) && !q.trace.polygons().empty() && !comes_to_pixel(q))
    if (auto verdict = why_by_facets(q, facets)) return why_wiped(q).value_or(*verdict);
  const std::vector<Touch> touches = touches_of(q.trace, q.pixel);
  const Touch *last = holder(touches, q.trace.size() + 1), *mine = nullptr, *least = nullptr;
  for (const Touch& touch : touches) {
    if (touch.polygon != q.polygon) continue;
    if (touch.written != 0) {
      mine = &touch;  // the last time that it changed the pixel
    } else if (!least || touch.z - (holder(touches, touch.step) ? holder(touches, touch.step)->z : 0) <
                             least->z - (holder(touches, least->step) ? holder(touches, least->step)->z : 0)) {
      least = &touch;
    }
  }
  if (last && last->polygon == q.polygon) {
    const Share share = share_of(touches, *last);
    const bool glass = share.layers > 0 && share.over == nullptr;
    Verdict verdict = seen(q, last->written, fmt::format("{} put it there, {} = {}", step_text(last->written), q.z, told(last->z)), fmt::format("the pixel becomes {}", q.name));
    if (last->step != last->written) verdict.chain.push_back({last->step, q.polygon, fmt::format("{} at {} = {} wins the compare", q.name, q.z, told(last->z))});
    if (glass) verdict.sentence += fmt::format(" {} layer{} of glass before it leave{} it {} of the pixel's colour.", share.layers, share.layers == 1 ? "" : "s", share.layers == 1 ? "s" : "", number(share.part));
    q.add_formulas(verdict, last->step, q.polygon, holder(touches, last->step));
    if (records<ShadowCompare>(q.trace)) add_shadow(q, verdict);
    return verdict;
  }
  if (mine && mine->how == Touch::How::blended)
    if (auto verdict = why_mixed(q, touches, *mine)) return *verdict;
  if (mine) {
    const Touch* next = nullptr;
    const bool blends = mine->how == Touch::How::blended;
    for (const Touch& touch : touches)
      if (!next && touch.step > mine->step && touch.written != 0 && (!blends || touch.opacity >= 1)) next = &touch;
    if (next) return why_gone(q, touches, *mine, *next);
  }
  if (least) return why_lost(q, touches, *least);
  if (const auto verdict = why_wiped(q)) return *verdict;
  if (auto verdict = why_by_facets(q, facets)) return *verdict;
  const auto& options = q.trace.header().conventions.options;
  const auto order = options.find("order");
  if (order != options.end() && order->second == "front-to-back" && !touches.empty()) return why_taken(q, touches.front());
  return not_recorded(q);
}

}  // namespace zstep::answers
