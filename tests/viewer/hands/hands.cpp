#include "tests/viewer/hands/hands.hpp"

#include <cmath>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "sim/cli/show.hpp"
#include "sim/cli/traces.hpp"
#include "sim/words/escaped.hpp"
#include "tests/viewer/hands/words.hpp"
#include "tests/viewer/letters.hpp"
#include "tests/viewer/words/some_runs.hpp"

namespace zstep::test {
namespace {

using viewer::App;

bool begins(const std::string& text, const std::string& with) { return text.rfind(with, 0) == 0; }

struct KeyName {
  const char *name, *sdl, *real;
};
constexpr KeyName key_names_here[] = {{"Enter", "Return", "Return"},           {"Esc", "Escape", "Escape"},
                                      {"PageDown", "PageDown", "Next"},        {"PageUp", "PageUp", "Prior"},
                                      {"Backspace", "Backspace", "BackSpace"}, {"Space", "Space", "space"}};

Trace first_trace() { return record_run("pyramid"); }

}  // namespace

Hands::Hands(const HandStart& start) {
  opened_ =
      cli::open_offer(first_trace(), {start.lesson ? Offer::What::lesson : Offer::What::scene, start.name, {}, {}});
  if (!start.method.empty()) {
    std::unique_ptr<Opened> by = cli::open_offer(opened_->trace, {Offer::What::method, start.method, {}, {}});
    opened_ = std::move(by);
  }
  options_ = std::make_unique<ViewerOptions>();
  options_->lesson = opened_->lesson ? &*opened_->lesson : nullptr;
  options_->other_method = cli::record_other_method;
  options_->run_changed = cli::run_changed;
  options_->offers = cli::all_offers;
  options_->open = cli::open_offer;
  options_->opened_by = {start.lesson ? "lesson" : "view", start.name};
  if (!start.method.empty()) options_->opened_by.insert(options_->opened_by.end(), {"--algorithm", start.method});
  viewer::Settings settings;
  settings.presenter = start.presenter;
  stage_ = std::make_unique<viewer::Stage>(opened_->trace, *options_, settings, width, height);
  if (start.at >= 0) app().session().go_to(start.at);
  else if (options_->lesson) app().session().to_stop(0);
  rest();
}

/// What the window does with what it is asked, but for files, clipboard and screen, of which it is noted.
void Hands::serve() {
  stage_->serve();
  const viewer::WindowRequests asked = std::exchange(app().requests, {});
  quit_ = quit_ || asked.quit;
  full_screen_ = full_screen_ != asked.toggle_full_screen;
  if (asked.clipboard) clipboard_ = *asked.clipboard;
  if (asked.save_picture) saved_ = *asked.save_picture + ".png";
  if (asked.save_slide) saved_ = *asked.save_slide + ".svg";
  while (app().filming()) app().frame();
  app().settle();
}

void Hands::press(const std::string& chord, bool goes_up) {
  std::uint16_t modifiers = KMOD_NONE;
  std::string key = chord, real;
  for (bool more = true; more;) {
    more = false;
    for (const auto& [name, flag, as] :
         {std::tuple("Ctrl+", KMOD_LCTRL, "ctrl+"), std::tuple("Shift+", KMOD_LSHIFT, "shift+")})
      if (begins(key, name) && key.size() > std::string(name).size()) {
        key = key.substr(std::string(name).size()), real += as, more = true;
        modifiers = static_cast<std::uint16_t>(modifiers | flag);
      }
  }
  std::string sdl = key, as = key.size() == 1 ? std::string(1, static_cast<char>(std::tolower(key[0]))) : key;
  for (const KeyName& known : key_names_here)
    if (key == known.name) sdl = known.sdl, as = known.real;
  if (as == ",") as = "comma";
  if (as == "+") as = "plus";
  const SDL_Keycode code = SDL_GetKeyFromName(sdl.c_str());
  if (code == SDLK_UNKNOWN) throw std::runtime_error("no key is called " + key);
  const bool sign = key.size() == 1 && std::ispunct(static_cast<unsigned char>(key[0])) != 0 && modifiers == KMOD_NONE;
  if (sign) {  // however it is typed on this keyboard
    real_.push_back("type -- " + shell_word(key));
    send_text(app(), key);
  } else {
    real_.push_back((goes_up ? "key " : "keydown ") + real + as);
    test::press(app(), code, modifiers);
    if (goes_up) release(app(), code);
  }
  serve();
}

void Hands::by_keys(const std::string& step) {
  if (begins(step, "type ")) {
    real_.push_back("type -- " + shell_word(step.substr(5)));
    type(app(), step.substr(5));
    return serve();
  }
  if (begins(step, "hold ")) return press(step.substr(5), false);
  const std::size_t times = step.find(" x");
  for (int left = times == std::string::npos ? 1 : std::stoi(step.substr(times + 2)); left > 0; --left)
    press(step.substr(0, times), true);
}

Hands::Found Hands::words(std::string text) {
  const bool at_end = begins(text, "end of ");
  if (at_end) text = text.substr(7);
  std::size_t which = 0;
  for (const auto& [ordinal, number] : {std::pair("1st ", 1u), std::pair("2nd ", 2u), std::pair("3rd ", 3u),
                                        std::pair("4th ", 4u), std::pair("5th ", 5u), std::pair("6th ", 6u)})
    if (begins(text, ordinal)) text = text.substr(4), which = number;
  const std::vector<SeenWords> found = find_words(app(), text);
  if (found.empty() || (which == 0 && found.size() > 1) || which > found.size()) {
    std::string where;
    for (const SeenWords& one : found) where += fmt::format(" ({:.0f}, {:.0f})", one.x, one.y);
    throw std::runtime_error(fmt::format("\"{}\" is seen {} times{}", text, found.size(), where));
  }
  const SeenWords& one = found[which == 0 ? 0 : which - 1];
  return {static_cast<int>(at_end ? one.end_x : one.x), static_cast<int>(one.y)};
}

/// "7 4", in the frame, or "7 4 in depth".
Hands::Found Hands::pixel(const std::string& of) {
  std::istringstream in(of);
  int x = 0, y = 0;
  std::string word, pane = "frame";
  in >> x >> y;
  if (in >> word) in >> pane;
  viewer::Ui& ui = app().ui();
  const auto canvas = ui.canvases.find(pane);
  if (canvas == ui.canvases.end()) throw std::runtime_error("no raster is called " + pane);
  const viewer::Canvas& made = canvas->second.made;
  const auto corner = corner_of(viewer::Renderer::image(made));
  if (!corner) throw std::runtime_error("the pane " + pane + " is not seen");
  const viewer::RasterMap map(app().session().scene().raster, ui.view, made.width(), made.height());
  return {static_cast<int>(corner->x + std::floor(map.px(x))), static_cast<int>(corner->y + std::floor(map.py(y)))};
}

Hands::Found Hands::target(const std::string& what) {
  if (what == "corner") return {1, 1};  // of the window: beside all that lies over it
  if (begins(what, "pixel ")) return pixel(what.substr(6));
  if (begins(what, "place ")) {
    std::istringstream in(what.substr(6));
    Found at{};
    in >> at.x >> at.y;
    return at;
  }
  return words(what);
}

/// "place 640 300 by -75 0", at once: so far a hand moves between two pictures.
void Hands::drag(const std::string& what) {
  const std::size_t by = what.rfind(" by ");
  if (by == std::string::npos) throw std::runtime_error("a drag goes by so much to the right and down");
  std::istringstream in(what.substr(by + 4));
  const Found from = target(what.substr(0, by));
  Found way{};
  in >> way.x >> way.y;
  const Found to{from.x + way.x, from.y + way.y};
  move_mouse(app(), from.x, from.y);
  mouse_button(app(), from.x, from.y, true);
  move_mouse(app(), to.x, to.y);
  mouse_button(app(), to.x, to.y, false);
  for (const auto& [at, does] : {std::pair{from, "mousedown"}, {to, "mouseup"}}) {
    real_.push_back(fmt::format("mousemove {} {}", at.x, at.y));
    real_.push_back(fmt::format("{} 1", does));
  }
}

void Hands::by_mouse(const std::string& step) {
  const std::size_t space = step.find(' ');
  const std::string how = step.substr(0, space);
  std::string what = space == std::string::npos ? "" : step.substr(space + 1);
  if (how == "wheel") {
    const bool up = begins(what, "up ");
    const Found at = target(what.substr(what.find(' ') + 1));
    move_mouse(app(), at.x, at.y);
    SDL_Event event{};
    event.type = SDL_MOUSEWHEEL;
    event.wheel.y = up ? 1 : -1;
    app().handle(event);
    real_.push_back(fmt::format("mousemove {} {}", at.x, at.y));
    real_.push_back(fmt::format("click {}", up ? 4 : 5));
  } else if (how == "drag") {
    drag(what);
  } else if (how == "click" || how == "right") {
    int times = 1;
    if (const std::size_t x = what.rfind(" x"); x != std::string::npos && x + 2 < what.size() &&
                                                what.find_first_not_of("0123456789", x + 2) == std::string::npos)
      times = std::stoi(what.substr(x + 2)), what = what.substr(0, x);
    const Found at = target(what);
    for (; times > 0; --times) {
      test::click(app(), at.x, at.y, how == "click" ? SDL_BUTTON_LEFT : SDL_BUTTON_RIGHT);
      real_.push_back(fmt::format("mousemove {} {}", at.x, at.y));
      real_.push_back(how == "click" ? "click 1" : "click 3");
      serve();
    }
    return;
  } else {
    throw std::runtime_error("the mouse cannot " + how);
  }
  serve();
}

void Hands::rest() {
  move_mouse(app(), width - 1, height - 1);
  real_.push_back(fmt::format("mousemove {} {}", width - 1, height - 1));
  app().settle();
}

bool Hands::holds(const std::string& check) {
  const std::size_t space = check.find(' ');
  const std::string what = check.substr(0, space), of = space == std::string::npos ? "" : check.substr(space + 1);
  const auto has = [&](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  const viewer::Session& s = app().session();
  if (what == "not") return !holds(of);
  if (what == "step") return std::to_string(s.position()) == of;
  if (what == "stop") return std::to_string(s.stop() + 1) == of;
  if (what == "lesson") return s.lesson() && s.lesson()->id == of;
  if (what == "method") return s.header().algorithm == of;
  if (what == "scene") return s.scene().name == of;
  if (what == "lead") return app().lead() == of;
  if (what == "says") return has(s.message, of);
  if (what == "copied") return clipboard_ == of;
  if (what == "saved") return saved_ == of;
  if (what == "file") return std::filesystem::is_regular_file(of);
  if (what == "quit") return quit_;
  if (what == "playing") return s.playing;
  if (what == "repeats") return s.loops();
  if (what == "full-screen") return full_screen_;
  if (what == "dark") return app().settings().dark;
  if (what == "presenter") return app().settings().presenter;
  if (what == "zoomed") return app().ui().view.zoom > 1;
  if (what == "relief") return app().ui().relief;
  if (what == "histogram") return app().ui().histogram;
  if (what == "whole-code") return app().ui().whole_code;
  if (what == "all-vertices") return app().ui().vertices_always;
  if (what == "turned-scene") return app().ui().from_outside.has_value();
  if (what == "walked") return app().ui().look.turn != 0 || app().ui().look.tilt != viewer::Look().tilt;
  if (what == "pen") return app().board().writes();
  if (what == "spotlight") return app().board().lit();
  if (what == "laser") return app().board().points();
  if (what == "racing") return app().racing();
  if (what == "answered") return s.stop() >= 0 && !s.question_open();
  if (what == "before") return s.looking_back;
  if (what == "theta") return fmt::format("{}", s.scene().camera.theta) == of;
  if (what == "black") return app().black();
  if (what == "borders-pulled") return !(app().settings().layout == viewer::Layout());
  if (what == "selected") return s.selected && fmt::format("{} {}", s.selected->x, s.selected->y) == of;
  if (what == "edge") return s.selected_edge && std::to_string(*s.selected_edge) == of;
  if (what == "changed") {
    for (const viewer::Changed::Made& made : app().changed().made)
      if (made.change.name + " = " + made.change.value == of) return true;
    return false;
  }
  if (what == "sees") return !find_words(app(), of).empty();
  throw std::runtime_error("\"" + check + "\" is nothing that can be looked for");
}

std::string Hands::state() {
  const viewer::Session& s = app().session();
  const viewer::Settings& kept = app().settings();
  std::string text = fmt::format(
      "{} stop {} message '{}' overlay {} picked {} typed '{}' selected {} edge {} playing {} loop {} {} speed {} dark "
      "{} "
      "presenter {} black {} text {} reduced {} lead {} zoom {} {} {} look {} {} clipboard '{}' saved '{}' quit {} "
      "full {}",
      app().command_line(), s.stop(), s.message, static_cast<int>(app().overlay()), app().picked, app().typed,
      s.selected ? fmt::format("{},{}", s.selected->x, s.selected->y) : "none", s.selected_edge.value_or(-1), s.playing,
      s.loop_first, s.loop_last, s.speed, kept.dark, kept.presenter, app().black(), kept.text_scale,
      kept.reduced_motion, app().lead(), app().ui().view.zoom, app().ui().view.center_x, app().ui().view.center_y,
      app().ui().look.turn, app().ui().look.tilt, clipboard_, saved_, quit_, full_screen_);
  for (const viewer::Changed::Made& made : app().changed().made)
    text += fmt::format(" {} = {}", made.change.name, made.change.value);
  return text;
}

}  // namespace zstep::test
