// Goes to what is typed: a step, a percentage, a polygon, a scan line, a stop, a pixel, a bookmark.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sim/viewer/app.hpp"
#include "sim/viewer/panes/workspace.hpp"
#include "sim/viewer/pictures.hpp"
#include "sim/viewer/stage.hpp"
#include "sim/words/link.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"
#include "traces/text.hpp"

namespace zstep::viewer {

places::Place App::place_typed() const {
  return places::find_place({session_.trace(), places_.marks(), session_.lesson(), session_.position()}, typed,
                            "go to");
}

void App::go_to_typed() {
  places::Place place;
  try {
    place = place_typed();
  } catch (const InputError& error) {
    wrong = error.what();  // what was typed stays, to be mended
    return;
  }
  open(Overlay::none);
  go_to(place);
}

void App::go_to(const places::Place& place) {
  if (place.pixel) {
    session_.select(Cell{place.pixel->x, place.pixel->y});
    return say("Selected; F runs to the next step that touches it.");
  }
  if (place.stop) return session_.to_stop(*place.stop);
  session_.go_to(place.step, place.unit);
  if (place.step > session_.size())
    say(fmt::format("This trace has {} steps; this is its end.", grouped(session_.size())));
  if (!place.note.empty()) say(place.note);
}

bool App::go_to_link(const std::string& link) {
  std::vector<std::string> opens, at, pixel, lead;
  for (const std::string& word : words_of_link(link)) {
    const auto is = [&](std::string_view option) { return word.starts_with(option); };
    const std::string value = word.substr(word.find('=') + 1);
    if (is("--at=")) at.push_back(value);
    else if (is("--pixel=")) pixel.push_back(value);
    else if (is("--lead=")) lead.push_back(value);
    else opens.push_back(word);
  }
  if (at.size() != 1 || racing() || link_of(opens) != link_of(opening_words())) return false;
  const places::Place place =
      places::find_place({session_.trace(), places_.marks(), session_.lesson(), session_.position()}, at[0], "link");
  open(Overlay::none);
  session_.select(std::nullopt);
  set_lead("");
  if (place.stop) session_.to_stop(*place.stop);
  else session_.go_to(place.step, place.unit);
  std::optional<Trace::Pixel> selected;
  if (!pixel.empty())
    selected = places::find_place({session_.trace(), places_.marks(), nullptr, 0}, pixel[0], "link").pixel;
  look_at(selected, lead.empty() ? "" : lead[0]);
  return true;
}

void App::look_at(std::optional<Trace::Pixel> pixel, const std::string& lead) {
  if (pixel) session_.select(Cell{pixel->x, pixel->y});
  if (lead.empty()) return;
  std::string id = lead;
  std::replace(id.begin(), id.end(), '-', '_');
  const std::vector<std::string> all = leads_to_choose(session_.header());
  if (std::find(all.begin(), all.end(), id) == all.end()) {
    std::string names =
        fmt::format("{}", fmt::join(all.begin() + 1, all.end(), ", "));  // the first is the method's own
    std::replace(names.begin(), names.end(), '_', '-');
    throw InputError("--lead", fmt::format("no pane '{}' can lead here", printable(lead)),
                     "those that can are " + names);
  }
  set_lead(id);
}

void go_to_start(App& app, const ViewerOptions& options) {
  Session& s = app.session();
  if (options.stop) s.to_stop(*options.stop);
  else if (options.at >= 0) go_to_or_throw(s, options.at);
  else if (app.opens_at_cause()) app.to_first_cause();
  else if (const auto place = place_to_go_on(app.settings(), s.trace(), options.lesson)) s.go_to(*place);
  else if (options.lesson && !options.lesson->stops.empty()) s.to_stop(0);
  app.look_at(options.pixel, options.lead);
  if (!options.note.empty()) app.say(options.note);
}

}  // namespace zstep::viewer
