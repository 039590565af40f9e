#include "sim/viewer/pictures.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "sim/viewer/app.hpp"
#include "sim/viewer/charts/sheet.hpp"
#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/notes.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"
#include "traces/scene.hpp"

namespace zstep {

using namespace viewer;

namespace {

/// "edge-table" and "edge_table" are the same pane.
std::string pane_id(std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

std::vector<std::string> wrapped(const Sheet& sheet, const std::string& text, float width, std::size_t most) {
  std::vector<std::string> lines{""};
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string word = text.substr(at, end - at),
                      longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (lines.back().empty() || sheet.text_width(longer) <= width) lines.back() = longer;
    else if (lines.size() == most) return lines.back() += " \u2026", lines;
    else lines.push_back(word);
    at = end + 1;
  }
  return lines;
}

}  // namespace

struct Pictures::Impl {
  Impl(const Trace& trace, const PictureOptions& options, const Settings& settings)
      : notes(options.notes),
        finished(options.finished),
        app(trace, options.lesson, settings, options.width, options.height) {
    if (options.checked) app.show_findings(*options.checked);
    if (options.against) app.show_against(*options.against);
    look_at = [this, pixel = options.pixel, lead = options.lead] { app.look_at(pixel, lead); };
    if (options.run_by) app.allow_changes(options.run_by);
    if (options.offers) app.offer(options.offers);
    if (options.race) app.open_race(options.race);
  }
  const bool notes, finished;
  App app;
  std::function<void()> look_at;  ///< as was asked, after each place that is gone to
};

std::vector<std::string> pane_names(const Trace& trace, bool with_lesson) {
  std::vector<std::string> names;
  for (const Pane& pane : App::all_panes(trace.header(), with_lesson)) {
    names.emplace_back(pane.id);
    std::replace(names.back().begin(), names.back().end(), '_', '-');
  }
  return names;
}

Pictures::Pictures(const Trace& trace, const PictureOptions& options) {
  Settings settings;  // never the reader's own: the same command gives the same picture everywhere
  settings.dark = options.dark;
  settings.presenter = options.presenter;
  settings.embedded = options.embed;
  impl_ = std::make_unique<Impl>(trace, options, settings);
  if (options.pane.empty() || impl_->app.show_only(pane_id(options.pane))) return;
  throw InputError("--pane", fmt::format("this trace has no pane '{}'", options.pane),
                   fmt::format("its panes are {}", fmt::join(pane_names(trace, options.lesson != nullptr), ", ")));
}

Pictures::~Pictures() = default;

void go_to_or_throw(viewer::Session& session, std::int64_t position) {
  session.go_to(position);
  if (session.position() < std::min(position, session.size())) throw InputError({session.message});
}

Image Pictures::at(std::int64_t position, bool before_impossible) {
  Session& session = impl_->app.session();
  if (position >= 0 && before_impossible) session.go_to(position);
  else if (position >= 0) go_to_or_throw(session, position);
  else if (impl_->app.opens_at_cause()) impl_->app.to_first_cause();
  else if (session.lesson() && !session.lesson()->stops.empty()) session.to_stop(0);
  else if (impl_->finished) session.to_finished_picture();
  return settled();
}

Image Pictures::at_stop(int stop) {
  impl_->app.session().to_stop(stop);
  return settled();
}

Image Pictures::settled() {
  impl_->look_at();
  if (impl_->notes) {
    Notes notes(impl_->app.renderer().width(), impl_->app.renderer().height());
    notes.follow(impl_->app, "");  // the same at any time of day
    return {notes.renderer().width(), notes.renderer().height(), notes.renderer().rgb()};
  }
  impl_->app.settle();
  return {impl_->app.renderer().width(), impl_->app.renderer().height(), impl_->app.renderer().rgb()};
}

Pictures::Caption Pictures::caption(std::int64_t position) {
  go_to_or_throw(impl_->app.session(), position);
  return caption_of(impl_->app.session());
}

Pictures::Caption caption_of(const Session& session) {
  const RecordedEvent* event = session.event();
  if (!event) return {"step 0", "Before the first step."};
  const StepInfo* step = find_step(session.header().page, event->step);
  return {fmt::format("step {}{}", grouped(session.position()), step ? " \u00b7 " + step->name : ""),
          explain(session.trace(), session.state(), *event).sentence};
}

Image contact_sheet(const Trace& trace, const std::vector<std::int64_t>& positions, const PictureOptions& options,
                    int columns) {
  std::vector<Image> images;
  std::vector<Pictures::Caption> captions;
  {
    Pictures pictures(trace, options);  // gone before the sheet is begun: Dear ImGui has one of them at a time
    for (const std::int64_t position : positions) {
      images.push_back(pictures.at(position));
      captions.push_back(pictures.caption(position));
    }
  }
  constexpr float text_pixels = 15;
  constexpr std::size_t most_lines = 3;
  constexpr int margin = 24, gap = 20;
  const int rows = (size32(positions) + columns - 1) / columns, line = 20, head = 44;
  const int below = static_cast<int>(most_lines + 1) * line + 10;
  Sheet sheet(2 * margin + columns * options.width + (columns - 1) * gap,
              2 * margin + head + rows * (options.height + below) + (rows - 1) * gap, text_pixels);
  const Theme& theme = sheet.theme();
  const Scene& scene = trace.scene();
  sheet.text(margin, margin,
             fmt::format("{} \u00b7 {}", trace.header().title.empty() ? trace.header().algorithm : trace.header().title,
                         scene.name.empty() ? trace.name() : scene.name),
             theme.text, Sheet::Side::left, true);
  sheet.text(sheet.width() - margin, margin, fmt::format("{} of {} steps", positions.size(), grouped(trace.size())),
             theme.muted, Sheet::Side::right);
  for (std::size_t i = 0; i < images.size(); ++i) {
    const int column = index32(i) % columns, row = index32(i) / columns;
    const int x = margin + column * (options.width + gap), y = margin + head + row * (options.height + below + gap);
    sheet.image(x, y, images[i]);
    float text_y = to_float(y + options.height + 8);
    sheet.text(to_float(x), text_y, captions[i].place, theme.text, Sheet::Side::left, true);
    for (const std::string& words : wrapped(sheet, captions[i].sentence, to_float(options.width), most_lines))
      sheet.text(to_float(x), text_y += to_float(line), words, theme.text);
  }
  return sheet.picture();
}

}  // namespace zstep
