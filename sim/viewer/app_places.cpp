// What keys do with conditions, bookmarks and the range of the depths' colours in the drawer.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "sim/viewer/app.hpp"
#include "sim/viewer/commands.hpp"
#include "sim/words/numbers.hpp"

namespace zstep::viewer {

void App::run_until(const std::string& condition, Places::Way way) {
  wrong = places_.run_until(condition, way);
  if (wrong.empty()) open(Drawer::none);
}

void App::keep_bookmark() {
  const bool named = typed.find_first_not_of(' ') != std::string::npos;
  const std::string name = named ? typed : fmt::format("step {}", session_.position());
  wrong = places_.bookmark(name);
  if (!wrong.empty()) return;
  requests.marks_kept = true;
  open(Drawer::none);
  say(fmt::format("Step {} is kept as {}; L lists all bookmarks.", grouped(session_.position()), name));
}

void App::go_to_bookmark(std::size_t place) {
  const auto& all = places_.bookmarks();
  if (place >= all.size()) return;
  const places::Bookmark mark = all[place];
  open(Drawer::none);
  session_.go_to(mark.step);
  say(fmt::format("Bookmark: {}", mark.name));
}

void App::remove_bookmark(std::size_t place) {
  const auto& all = places_.bookmarks();
  if (all.empty()) return;
  const std::string name = all[std::min(place, all.size() - 1)].name;
  const std::string fault = places_.remove_bookmark(place);
  requests.marks_kept = fault.empty();
  say(fault.empty() ? fmt::format("Removed the bookmark {}.", name) : fault);
  picked = std::clamp(static_cast<int>(place), 0, std::max(0, static_cast<int>(places_.bookmarks().size()) - 1));
}

void App::turn_overlay(int direction) {
  if (ui_.heat && !pixel_overlay_.shown()) end_painting();  // a query's
  pixel_overlay_.turn(direction);
  if (!pixel_overlay_.shown()) end_painting();
  say(pixel_overlay_.shown() ? fmt::format("Over the frame: {}, up to the step where you are. O turns on, Esc ends it.",
                                           PixelOverlay::name(*pixel_overlay_.shown()))
                             : "Nothing over the frame.");
}

void App::end_painting() {
  ui_.heat.reset();
  ui_.heat_behind.clear();
  if (pixel_overlay_.shown()) pixel_overlay_.show(std::nullopt);
}

/// Brings what is painted over the frame to the reader's step, as far as its share of a frame's time allows.
void App::follow_overlay() {
  if (pixel_overlay_.look_on()) {
    if (pixel_overlay_.shown()) pixel_overlay_.take_picture(ui_.heat);
    else end_painting();
  }
  ui_.heat_behind = pixel_overlay_.behind();
}

void App::take_range() {
  const char* text = typed.c_str();
  char *first = nullptr, *second = nullptr;
  const double near = std::strtod(text, &first), far = std::strtod(first, &second);
  const bool empty = typed.find_first_not_of(' ') == std::string::npos;
  const DepthRange range = range_between(std::min(near, far), std::max(near, far), session_.header());
  const bool in_order = std::isfinite(near) && std::isfinite(far) && near != far && near == range.near;
  if (!empty && (first == text || second == first || !in_order ||
                 std::string(second).find_first_not_of(' ') != std::string::npos)) {
    wrong = fmt::format("Type two numbers, the {} first: {}", range.named ? "nearer" : "smaller",
                        session_.header().comparison.nearer == Comparison::Nearer::greater ? "0.8 0.2" : "0.2 0.8");
    return;
  }
  open(Drawer::none);
  ui_.range_mode = empty ? Ui::RangeMode::whole : Ui::RangeMode::by_hand;
  ui_.hand_range = range;
  say(empty ? "The colours span all depths of the trace."
            : fmt::format("The colours span {} to {}; R ends that.", number(near), number(far)));
}

bool App::edit_range(SDL_Keycode code, unsigned) { return code == SDLK_RETURN ? take_range(), true : false; }
bool App::name_typed(SDL_Keycode code, unsigned) { return code == SDLK_RETURN ? keep_bookmark(), true : false; }

bool App::edit_until(SDL_Keycode code, unsigned modifiers) {
  if (code == SDLK_RETURN)
    return run_until(typed, (modifiers & Chord::shift) != 0 ? Places::Way::backwards : Places::Way::forwards), true;
  const auto suggestions = places_.suggestions();
  if (!pick_among(suggestions.size(), code)) return false;
  if (!suggestions.empty()) put(suggestions[static_cast<std::size_t>(picked)].condition);
  wrong.clear();
  return true;
}

bool App::pick_bookmark(SDL_Keycode code, unsigned) {
  const auto place = static_cast<std::size_t>(std::max(0, picked));
  if (code == SDLK_RETURN) return go_to_bookmark(place), true;
  if (code == SDLK_DELETE) return remove_bookmark(place), true;
  return pick_among(places_.bookmarks().size(), code);
}

}  // namespace zstep::viewer
