// Goes to what is typed: a step, a percentage, a polygon, a scan line, a stop, a pixel, a bookmark.
#include <fmt/format.h>

#include "sim/places/typed_place.hpp"
#include "sim/viewer/app.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"

namespace zstep::viewer {

void App::go_to_typed() {
  places::Place place;
  try {
    place =
        places::find_place({session_.trace(), places_.marks(), session_.lesson(), session_.position()}, typed, "go to");
  } catch (const InputError& error) {
    wrong = error.what();  // what was typed stays, to be mended
    return session_.touch();
  }
  open(Overlay::none);
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

}  // namespace zstep::viewer
