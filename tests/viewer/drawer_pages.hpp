// Opens each page of the drawer, with something on it.
#pragma once

#include <string>
#include <vector>

#include "sim/viewer/app.hpp"

namespace zstep::test {

inline std::vector<viewer::Drawer> all_pages() {
  using viewer::Drawer;
  return {Drawer::history,       Drawer::why_ask,   Drawer::why,   Drawer::explain, Drawer::until,  Drawer::query,
          Drawer::name_bookmark, Drawer::bookmarks, Drawer::range, Drawer::compare, Drawer::what_if};
}

/// The pixel that a polygon reached first.
inline viewer::Cell a_drawn_pixel(viewer::App& app) {
  const Trace& trace = app.session().trace();
  for (std::int64_t step = 1; step <= trace.size(); ++step)
    if (holds<PixelWrite>(trace.event(step).event) || holds<PixelPaint>(trace.event(step).event))
      if (const auto pixel = pixel_of(trace.event(step).event)) return {pixel->x, pixel->y};
  return {0, 0};
}

inline void open_page(viewer::App& app, viewer::Drawer page, viewer::Cell cell) {
  using viewer::Drawer;
  app.session().select(cell);
  if (page == Drawer::history) return app.open_history();
  if (page == Drawer::why_ask) return app.open_why();
  if (page == Drawer::why) {
    app.open_why();
    return app.ask_why(0);
  }
  if (page == Drawer::explain) {
    for (std::int64_t step = app.session().position(); step > 0 && app.drawer() != page; --step) {
      app.session().go_to(step);
      app.explain_step();
    }
    if (app.drawer() == page) return;  // else the selected pixel has no depth yet
    app.session().go_to(app.session().size());
    return app.explain_step();
  }
  app.open(page);
  if (page != Drawer::query) return;
  const bool writes = app.tables().find("pixel_write") != std::string::npos;
  app.put(std::string("select step, x, y, polygon from ") + (writes ? "pixel_write" : "pixel_paint"));
  app.frame();
  app.ask_now();
}

}  // namespace zstep::test
