// Which steps a film shows, and how far it is.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/film/video.hpp"
#include "sim/viewer/lists.hpp"
#include "sim/viewer/overlays.hpp"
#include "sim/words/numbers.hpp"

namespace zstep::viewer {

void draw_film(App& app) {
  Ui& ui = app.ui();
  const std::vector<FilmRange> ranges = app.film_ranges();
  const float line = std::round(ui.em * 1.4f);
  const std::string heading = "Save a film: Enter or a click makes it of",
                    how = fmt::format("A frame a step, but at most {}, as the window looks now.", most_unasked);
  const float width = ui.em * 42;
  begin_overlay(app, "film",
                {width, static_cast<float>(ranges.size()) * line + ui.em * (app.wrong.empty() ? 6.6f : 8.0f)});
  flow(ui, heading, {.font = ui.fonts.bold});
  std::optional<std::size_t> clicked;
  for (std::size_t k = 0; k < ranges.size(); ++k) {
    const ListRow row = list_row(app, k, line);
    if (row.clicked) clicked = k;
    const std::int64_t frames = static_cast<std::int64_t>(film_steps(ranges[k].first, ranges[k].last).size());
    const std::string steps =
        fmt::format("steps {} to {}: {}", grouped(ranges[k].first), grouped(ranges[k].last), film_length(frames));
    const float y = row.at.y + std::round((line - ui.em) / 2) - 1, pad = ui.em * 0.4f,
                wide = text_size(ui, ui.fonts.text, steps).x;
    draw_text(ui, {row.end.x - pad - wide, y}, ui.fonts.text, ui.colors().muted, steps);
    draw_text(ui, {row.at.x + pad, y}, ui.fonts.text, ui.colors().text,
              fitted(ui, ui.fonts.text, ranges[k].what, row.end.x - row.at.x - wide - 4 * pad));
  }
  app.scroll_to_picked = false;
  ImGui::Dummy({1, ui.em * 0.4f});
  app.draw_field("or the first step and the last: 300 420");
  if (app.wrong.empty()) flow(ui, how, {.color = ui.colors().muted});
  else say_wrong(ui, app.wrong);
  ImGui::End();
  if (clicked) app.film(ranges[*clicked].first, ranges[*clicked].last);
}

void draw_filming(App& app) {
  const Film& film = *app.filming();
  const double share = static_cast<double>(film.made) / static_cast<double>(film.steps.size());
  draw_progress(app, fmt::format("filming: frame {} of {}", film.made, film.steps.size()), share, "Esc ends it");
}

}  // namespace zstep::viewer
