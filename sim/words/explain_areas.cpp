// Warnock's areas: the four bins and the four cases (002, "Warnock's Algorithm").
#include "sim/words/explain_parts.hpp"
#include "traces/formulas/of_areas.hpp"

namespace zstep::words {
namespace {

std::string columns_and_rows(const AreaBegin& a) {
  const auto range = [](const char* one, const char* many, std::int32_t first, std::int32_t end) {
    return end - first == 1 ? fmt::format("{} {}", one, first) : fmt::format("{} {} to {}", many, first, end - 1);
  };
  return range("column", "columns", a.first_column, a.end_column) + ", " + range("row", "rows", a.first_row, a.end_row);
}

/// From where to where the squares of its pixels go, in x and in y.
using Form = fmt::format_string<std::string, std::string, std::string, std::string>;
std::string squares(Form form, const AreaBegin& area) {
  const auto [low, high] = formulas::rectangle_of(area);
  return fmt::format(form, number(low.x), number(high.x), number(low.y), number(high.y));
}

std::string named(const Telling& t, Bin bin) {
  std::string text;
  for (const AreaBin& row : t.machine.bins)
    if (row.bin == bin) text += (text.empty() ? "" : ", ") + t.piece(row.piece);
  return text.empty() ? "none" : text;
}

/// How the piece that fills the area compares with all others, by the depths that the trace has: at its corners, or of
/// a single pixel at the centre.
formulas::detail::AtCorners held_at_corners(const Telling& t, std::int32_t piece, bool centre = false) {
  const AreaBegin* area = formulas::detail::area_at_work(t.at);
  std::vector<PlaneDepth> own, others;
  for (std::int64_t step = t.after.position - 1; step > 0; --step) {
    const Event event = t.trace.event(step).event;
    if (holds<AreaBegin>(event)) break;
    if (const auto* depth = get_if<PlaneDepth>(&event)) (depth->piece == piece ? own : others).push_back(*depth);
  }
  formulas::detail::AtCorners held;
  for (const PlaneDepth& other : others)
    for (const PlaneDepth& one : own)
      if (one.x_at == other.x_at && one.y_at == other.y_at &&
          (!centre || (area && one.x_at == area->first_column && one.y_at == area->first_row)))
        held.add(one.z, other.z);
  return held;
}

}  // namespace

void tell(Telling& t, const AreaBegin& e) {
  const std::string where = columns_and_rows(e);
  if (e.parent < 0) t.say(fmt::format("The first area is the whole picture: {}.", where));
  else t.say(fmt::format("Area {} is a quarter of area {}: {}.", e.area, e.parent, where));
  t.formula(squares("the squares of its pixels: {} \u2264 x \u2264 {}, {} \u2264 y \u2264 {}", e));
}

void tell(Telling& t, const AreaBin& e) {
  const std::string who = t.piece(e.piece);
  if (t.step() == "still_surrounding") {
    t.say(fmt::format("{} surrounds the area around this one, so it surrounds this one, too: no test is needed.", who));
    return t.formula("a part of what is surrounded is surrounded");
  }
  if (e.by_box) {
    const AreaBegin* area = formulas::detail::area_at_work(t.at);
    const Piece* piece = t.at.piece(e.piece);
    t.say(e.bin == Bin::disjoint
              ? fmt::format("The box of {} misses the area: {} is disjoint, and its edges need no test.", who, who)
              : fmt::format("The box of {} lies in the area: {} is contained, and its edges need no test.", who, who));
    if (area && piece && piece->extent) {
      const Extent& box = *piece->extent;
      t.formula(fmt::format("its box: x {} to {}, y {} to {}", number(box.x_min), number(box.x_max), number(box.y_min),
                            number(box.y_max)));
      t.formula(squares("the area: x {} to {}, y {} to {}", *area));
    }
    return;
  }
  switch (e.bin) {
    case Bin::disjoint:
      t.say(fmt::format("No edge of {} meets the area, and {} is not around it: disjoint.", who, who));
      break;
    case Bin::surrounding:
      t.say(fmt::format("No edge of {} meets the area, and the area lies inside {}: surrounding.", who, who));
      break;
    case Bin::contained:
      t.say(fmt::format("All edges of {} lie in the area: contained.", who));
      break;
    default:
      t.say(fmt::format("An edge of {} meets the area, and {} goes on outside it: intersecting.", who, who));
  }
  // An area that no edge meets lies wholly inside or wholly outside.
  const bool apart = e.bin == Bin::disjoint || e.bin == Bin::surrounding;
  const bool numbers = e.crossings == 0 ? apart && e.corners_inside == (e.bin == Bin::surrounding ? 4 : 0) : !apart;
  if (!numbers)
    t.contradict(fmt::format(
        "The trace says that {} is {}, but {} of its edges meet the area and {} of the area's corners lie inside it.",
        who, word_of(e.bin), e.crossings, e.corners_inside));
  t.formula(fmt::format("edges that meet the area: {}", e.crossings));
  t.formula(fmt::format("corners of the area inside {}: {}", who, e.corners_inside));
}

void tell(Telling& t, const AreaDecide& e) {
  const std::string who = t.piece(e.piece);
  switch (e.what) {
    case AreaCase::background:
      t.say("Case 1: all polygons are disjoint, so the area stays background.");
      break;
    case AreaCase::one_polygon:
      t.say(fmt::format("Case 2: {} alone reaches into the area, so the part of it that lies there is filled.", who));
      break;
    case AreaCase::surrounded:
      t.say(fmt::format(
          "Case 3: {} surrounds the area and nothing else reaches into it, so all of it is filled with {}.", who, who));
      break;
    case AreaCase::front_surrounder: {
      const auto held = held_at_corners(t, e.piece);
      if (held.behind > 0)
        t.contradict(
            fmt::format("The trace says that {} surrounds the area and is in front of all others at its four "
                        "corners, but at one of them another is nearer.",
                        who));
      else if (held.tied > 0)
        t.say(
            fmt::format("Case 4: {} surrounds the area, and none is in front of it at its four corners. Where another "
                        "is exactly as near, {} is the one that is painted, so all of the area is filled with {}.",
                        who, who, who));
      else if (held.nearer > 0)
        t.say(
            fmt::format("Case 4: {} surrounds the area and is in front of all others at its four corners, so all of it "
                        "is filled with {}.",
                        who, who));
      else
        t.say(
            fmt::format("Case 4: {} surrounds the area, and the trace takes it to be in front of all others at its "
                        "four corners, so all of it is filled with {}.",
                        who, who));
      break;
    }
    case AreaCase::pixel:
      if (const auto held = held_at_corners(t, e.piece, true); e.piece >= 0 && held.behind > 0) {
        t.contradict(fmt::format("The trace gives the pixel to {}, but at its centre another is nearer.", who));
        break;
      } else if (e.piece >= 0 && held.tied > 0) {
        t.say(
            fmt::format("A single pixel cannot be quartered. None is nearer than {} at its centre, where another is "
                        "exactly as near, so the pixel becomes {}.",
                        who, who));
        break;
      }
      t.say(
          e.piece < 0
              ? std::string("A single pixel cannot be quartered. No polygon covers its centre, so it stays background.")
              : fmt::format(
                    "A single pixel cannot be quartered. {} is the nearest at its centre, so the pixel becomes {}.",
                    who, who));
      break;
    default:
      t.say(fmt::format("None of the cases holds for area {}: it is quartered, and each quarter is settled by itself.",
                        e.area));
  }
  t.formula("surrounding: " + named(t, Bin::surrounding));
  t.formula(fmt::format("intersecting: {}; contained: {}", named(t, Bin::intersecting), named(t, Bin::contained)));
}

}  // namespace zstep::words
