#include "sim/viewer/finder.hpp"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "sim/places/condition.hpp"
#include "sim/viewer/app.hpp"
#include "sim/viewer/commands.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {
namespace {

/// Of polygons and bookmarks, of which a run may have thousands.
constexpr std::size_t most_of_a_kind = 40, most_looked_at = 20000;

std::string step_text(std::int64_t step) { return "step " + grouped(step); }

/// Where the text says exactly where; nothing where it does not.
std::optional<places::Place> place_named(const App& app) {
  try {
    return app.place_typed();
  } catch (const InputError&) {
    return std::nullopt;
  }
}

Found row_of(const places::Place& place, const std::string& typed) {
  const auto go = [place](App& a) { a.go_to(place); };
  if (place.pixel) return {fmt::format("Select pixel ({}, {})", place.pixel->x, place.pixel->y), "", go};
  return {"Go to " + typed, step_text(place.step), go};
}

std::optional<Found> condition_typed(App& app) {
  try {
    places::Condition(app.session().trace(), app.typed);
  } catch (const InputError&) {
    return std::nullopt;
  }
  return Found{"Run until " + app.typed, "forwards",
               [condition = app.typed](App& a) { a.run_until(condition, Places::Way::forwards); }};
}

void add_stops(App& app, const TypedWords& words, std::vector<Found>& found) {
  const Lesson* lesson = app.session().lesson();
  if (!lesson) return;
  for (std::size_t k = 0; k < lesson->stops.size(); ++k) {
    const std::string title = fmt::format("{}. {}", k + 1, lesson->stops[k].heading);
    if (words.all_in("stop " + title))
      found.push_back({title, "stop", [k](App& a) { a.session().to_stop(index32(k)); }});
  }
}

/// But for where what is named exactly leads.
void add_polygons(App& app, const TypedWords& words, std::int64_t named, std::vector<Found>& found) {
  const Trace& trace = app.session().trace();
  std::size_t count = 0, looked_at = 0;
  for (const PolygonMark& mark : trace.polygons()) {
    if (++looked_at > most_looked_at) return;
    const std::string title = "Polygon " + polygon_label(trace.scene(), mark.polygon);
    if (mark.position == named || !words.all_in(title)) continue;
    if (++count > most_of_a_kind) return;
    found.push_back({title, step_text(mark.position), [step = mark.position](App& a) {
                       a.go_to(places::Place{step, Unit::polygon});
                     }});
  }
}

void add_bookmarks(App& app, const TypedWords& words, std::vector<Found>& found) {
  std::size_t count = 0;
  for (const places::Bookmark& mark : app.places().bookmarks())
    if (words.all_in("bookmark " + mark.name) && ++count <= most_of_a_kind)
      found.push_back({mark.name, step_text(mark.step), [step = mark.step](App& a) { a.go_to(places::Place{step}); }});
}

void add_offers(App& app, const TypedWords& words, std::vector<Found>& found) {
  const auto kind = [](Offer::What what) {
    return what == Offer::What::lesson ? "lesson" : what == Offer::What::method ? "method" : "scene";
  };
  for (const Offer& offer : app.offers())
    if (words.all_in(fmt::format("{} {} {}", kind(offer.what), offer.id, offer.title)))
      found.push_back({offer.title, kind(offer.what), [what = offer](App& a) { a.open_offer(what); }});
}

}  // namespace

const std::vector<Found>& Finder::find(App& app) {
  Fingerprint asked_for;
  take(asked_for, app.typed);
  take(asked_for, app.session().position());
  take(asked_for, app.places().bookmarks().size());
  if (std::exchange(found_for_, asked_for.value()) == asked_for.value()) return found_;
  found_.clear();
  const bool asked = app.typed.find_first_not_of(' ') != std::string::npos;
  std::optional<places::Place> named;
  if (asked) {
    if ((named = place_named(app))) found_.push_back(row_of(*named, app.typed));
    if (auto condition = condition_typed(app)) found_.push_back(std::move(*condition));
  }
  for (const Command* command : matching(app.typed))
    found_.push_back({command->title, key_names(*command), [command](App& a) {
                        if (command->release) a.hold(*command);
                        else a.run(*command);
                      }});
  if (!asked) return found_;
  const TypedWords words(app.typed);
  add_stops(app, words, found_);
  add_polygons(app, words, named ? named->step : -1, found_);
  add_bookmarks(app, words, found_);
  add_offers(app, words, found_);
  return found_;
}

}  // namespace zstep::viewer
