// Goes to what is typed: a step, a percentage, a polygon, a scan line, a pixel, a bookmark.
#include <cmath>

#include <fmt/format.h>

#include "sim/classroom/expression.hpp"
#include "sim/viewer/app.hpp"
#include "sim/viewer/model/typed_place.hpp"
#include "sim/viewer/words/numbers.hpp"

namespace zstep::viewer {
namespace {

/// To the next place where work on this scan line begins, or to the last one before the reader where there is no next.
void go_to_scan_line(App& app, std::int64_t line) {
  Session& s = app.session();
  const auto begins = [line](const ScanLineBegin& event) { return event.y == line; };
  if (!s.trace().has(kind_of<ScanLineBegin>)) return app.say("No scan line begins in this trace.");
  if (const auto next = s.trace().next<ScanLineBegin>(s.position(), begins)) return s.go_to(*next, Unit::scan_line);
  const auto last = s.trace().previous<ScanLineBegin>(s.position() + 1, begins);
  if (!last) return app.say(fmt::format("Scan line {} does not begin in this trace.", line));
  s.go_to(*last, Unit::scan_line);
  app.say(fmt::format("Scan line {} does not begin later; here it began last.", line));
}

}  // namespace

void App::go_to_typed() {
  using Kind = TypedPlace::Kind;
  const std::string text(classroom::trim(typed));
  open(Overlay::none);
  for (const places::Bookmark& mark : places_.bookmarks())
    if (mark.name == text) return session_.go_to(mark.step);
  const TypedPlace place = read_place(text);
  switch (place.kind) {
    case Kind::step:
      session_.go_to(place.number);
      if (place.number > session_.size()) say(fmt::format("This trace has {} steps; this is its end.", grouped(session_.size())));
      return;
    case Kind::percent: return session_.go_to(std::llround(place.percent / 100 * static_cast<double>(session_.size())));
    case Kind::polygon:
      for (const PolygonMark& mark : session_.trace().polygons())
        if (mark.polygon == place.number) return session_.go_to(mark.position, Unit::polygon);
      return say(fmt::format("Polygon {} is not in this trace.", place.number));
    case Kind::scan_line: return go_to_scan_line(*this, place.number);
    case Kind::pixel: {
      const Raster& raster = session_.scene().raster;
      if (place.number >= raster.width || place.row >= raster.height) return say(fmt::format("The raster is {} by {}.", raster.width, raster.height));
      session_.select(Cell{static_cast<std::int32_t>(place.number), static_cast<std::int32_t>(place.row)});
      return say("Selected; F runs to the next step that touches it.");
    }
    case Kind::none: break;
  }
  say(what_to_type);
}

}  // namespace zstep::viewer
