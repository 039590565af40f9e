#include "sim/viewer/app.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

#include "sim/query/database.hpp"
#include "sim/viewer/commands.hpp"
#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/panes/workspace.hpp"
#include "sim/words/escaped.hpp"
#include "sim/words/link.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {

App::Context::Context() : context(ImGui::CreateContext()) {
  ImGui::SetCurrentContext(context);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;  // what stays is in Settings
  io.LogFilename = nullptr;
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  io.ConfigInputTextCursorBlink = false;  // an idle window draws nothing
  io.DeltaTime = 1.0f / 60;
}

App::Context::~Context() { ImGui::DestroyContext(context); }

App::App(const Trace& trace, const Lesson* lesson, const Settings& settings, int width, int height, float dpi_scale)
    : settings_(settings),
      renderer_(width, height),
      session_(trace, lesson),
      inquiry_(trace),
      places_(session_),
      pixel_overlay_(session_),
      ui_(session_, renderer_),
      dpi_scale_(dpi_scale) {
  if (lesson) check_focus(*lesson, trace.header());
  ui_.places = &places_;
  ui_.depth_range = depth_range(trace);
  field_.connect();
  session_.speed = std::clamp(settings.speed, 0, size32(Session::speeds()) - 1);
  set_dark(settings.dark);
  set_presenter(settings.presenter);
}

App::~App() = default;

void App::resize(int width, int height) {
  if (film_ && (width != renderer_.width() || height != renderer_.height()))
    end_film("The window was made another size, so the film was ended; no file was left.");
  renderer_.resize(width, height);
}

void App::set_dpi_scale(float scale) { dpi_scale_ = scale; }

void App::set_dark(bool dark) {
  settings_.dark = dark;
  ui_.theme = dark ? &dark_theme() : &light_theme();
}

void App::set_presenter(bool presenter) { settings_.presenter = ui_.presenter = presenter; }

void App::turn_laboratory() {
  if (!session_.lesson() && !lesson_waits && !ui_.presenter)
    return say("There is no lesson here: every pane is shown.");
  laboratory_ = !laboratory_;
}

std::string App::lead() const {
  const Lesson* lesson = session_.lesson();
  const int stop = session_.stop();
  const std::string focus = lesson && stop >= 0 ? lesson->stops[stop].focus : "";
  return chosen_lead_ && (chosen_lead_->stop == stop || focus.empty()) ? chosen_lead_->pane : focus;
}

void App::set_lead(const std::string& pane) { chosen_lead_ = {pane, session_.stop()}; }

void App::turn_lead(int direction) {
  const std::vector<std::string> all = leads_to_choose(session_.header());
  const auto now = std::find(all.begin(), all.end(), lead());
  const std::ptrdiff_t count = all.size();
  const std::ptrdiff_t at = now == all.end() ? 0 : now - all.begin();
  set_lead(all[(at + direction + count) % count]);
}

void App::take_settings(const Settings& settings) {
  settings_ = settings;
  session_.speed = std::clamp(settings.speed, 0, size32(Session::speeds()) - 1);
  set_dark(settings.dark);
  set_presenter(settings.presenter);
}

void App::scale_text(float factor) {
  settings_.text_scale = factor == 0 ? 1.0f : std::clamp(settings_.text_scale * factor, 0.5f, 3.0f);
  say(fmt::format("Text at {:.0f} %.", settings_.text_scale * 100));
}

void App::say(std::string message) { session_.message = std::move(message); }

void App::open(Overlay overlay) {
  if (embedded() && overlay != Overlay::none) return;
  const bool covers = overlay_ == Overlay::none, uncovers = overlay == Overlay::none;
  if (covers && uncovers) return;
  if (covers) under_overlay_ = {typed, wrong, picked};
  overlay_ = overlay;
  put(uncovers ? under_overlay_.typed : "");
  wrong = uncovers ? under_overlay_.wrong : "";
  picked = uncovers ? under_overlay_.picked : 0;
}

std::string App::command_line() const { return as_command(place_words()); }

std::optional<std::string> App::link() const {
  std::vector<std::string> words = place_words();
  if (session_.selected) words.push_back(fmt::format("--pixel={},{}", session_.selected->x, session_.selected->y));
  if (!lead().empty()) words.push_back("--lead=" + lead());
  return link_of(words);
}

std::vector<std::string> App::place_words() const {
  std::vector<std::string> words = opening_words();
  const std::vector<std::string> place =
      race_shown_ ? race_place() : std::vector<std::string>{"--at", std::to_string(session_.position())};
  words.insert(words.end(), place.begin(), place.end());
  return words;
}

std::vector<std::string> App::opening_words() const {
  // Not every command that shows a run has a race.
  const bool races = !opened_by.empty() && (opened_by[0] == "view" || opened_by[0] == "lesson");
  if (!opened_by.empty() && (races || !race_shown_)) return opened_by;
  if (session_.lesson()) return {"lesson", session_.lesson()->id};
  const std::string& name = session_.trace().name();
  std::error_code error;
  if (std::filesystem::is_regular_file(name, error)) return {"view", name};
  // Recorded on the spot: the scene, and the options that it was recorded with.
  const Scene& scene = session_.scene();
  std::vector<std::string> words = {"view",
                                    std::filesystem::is_regular_file(scene.source, error) ? scene.source : name};
  const auto say = [&](const char* option, std::string value) {
    words.insert(words.end(), {option, std::move(value)});
  };
  if (session_.header().algorithm != "z-buffer") say("--algorithm", session_.header().algorithm);
  for (const auto& [option, value] : session_.header().conventions.options) say("--option", option + "=" + value);
  if (const Camera& camera = scene.camera; camera.kind != Camera::Kind::screen) {
    say("--size", fmt::format("{}x{}", scene.raster.width, scene.raster.height));
    if (camera.polar) {
      const auto number = [&](const char* option, double value) { say(option, fmt::format("{}", value)); };
      number("--rho", camera.rho), number("--theta", camera.theta), number("--phi", camera.phi);
      number("--d", camera.d), number("--window", camera.window);
    }
    if (camera.kind == Camera::Kind::orthographic) words.emplace_back("--ortho");
  }
  for (const Changed::Made& made : changed_.made) say("--change", made.change.name + " = " + made.change.value);
  return words;
}

/// Body text: 16 px in a window of 1280 x 720. A lesson's grows with its window, as its pictures do; else half of what
/// a window is larger goes into the text, the other half into room. A screen with more pixels to the inch gets at least
/// its own scale. Presenter mode begins at 24 px.
void App::update_fonts() {
  const float larger = std::min(to_float(renderer_.width()) / 1280, to_float(renderer_.height()) / 720);
  const bool lesson = !ui_.laboratory && !ui_.presenter;
  const float grown = std::max(dpi_scale_, 1 + (std::max(larger, 1.0f) - 1) * (lesson ? 1.0f : 0.5f));
  const float pixels =
      std::clamp(std::round((ui_.presenter ? 24.0f : 16.0f) * grown * settings_.text_scale), 9.0f, 96.0f);
  if (pixels == built_for_) return;
  built_for_ = ui_.em = pixels;
  ui_.thin = std::max(1.0f, std::round(ui_.presenter ? pixels / 16 : grown));
  ui_.fonts.load(pixels);
  renderer_.take_fonts();
}

void App::put(const std::string& text) {
  typed = text;
  field_.put(text);
}

void App::draw_field(const std::string& hint) {
  if (!field_.draw(*this, hint)) return;
  wrong.clear();
  picked = drawer_has_keys() && drawer_ == Drawer::until ? -1 : 0;
}

void App::draw_drawer_field(const std::string& hint) {
  if (drawer_has_keys()) draw_field(hint);
  else Field::draw_idle(ui_, typed, hint);
}

void App::frame() {
  if (film_) film_on();
  ImGui::SetCurrentContext(context_.context);
  if (!acts_.empty()) act_by_fingers();
  const bool given = typing() && field_.waits();
  draw();
  // A field gets the keyboard only after a frame that asked for it, and what is typed next must not be lost.
  for (int more = 0; more < 3 && typing() && !field_.active() && !ImGui::IsMouseDown(ImGuiMouseButton_Left); ++more)
    draw();
  field_.after_frame();
  if (given) draw();  // which sees the key go up, so that the same key can go down again
}

void App::hold(const Command& command) {
  command.run(*this);
  if (black_) return;  // which ends by itself at the next key or click
  held_ = &command;
  say("Until the next key or click; with " + key_names(command) + " as long as it is held.");
}

bool App::handle(const SDL_Event& event, float pixels_per_point) {
  ImGui::SetCurrentContext(context_.context);
  if (film_) return handle_filming(event);
  ImGuiIO& io = ImGui::GetIO();
  if (held_ && (event.type == SDL_KEYDOWN || event.type == SDL_MOUSEBUTTONDOWN))
    std::exchange(held_, nullptr)->release(*this);
  const auto mouse = [&](float x, float y) {
#if IMGUI_VERSION_NUM >= 18700
    io.AddMousePosEvent(x, y);
#else
    io.MousePos = {x, y};
#endif
  };
  switch (event.type) {
    case SDL_KEYDOWN:
      motion_.skip();
      ui_.reads = true;
      // The system sends a key and then its text, and one wish must not be granted twice.
      text_taken_ = true;
      if (!key(event.key)) text_taken_ = false;
      return typing() && field_.waits();
    case SDL_KEYUP:
      text_taken_ = false;  // what comes now comes from an input method
      key(event.key);
      return false;
    case SDL_TEXTEDITING:
      text_taken_ = false;
      return false;
    case SDL_TEXTINPUT:
      if (std::exchange(text_taken_, false)) return false;
      // On the start page, where nothing is typed yet, it asks for the keys: no name begins so.
      if (overlay_ == Overlay::start && typed.empty() && std::string_view(event.text.text) == "?") {
        turn_key_sheet();
        return false;
      }
      if (typing()) {
        io.AddInputCharactersUTF8(event.text.text);
        return true;
      }
      if (const Command* command = command_for(event.text.text[0])) {
        session_.message.clear();
        run(*command);
      }
      return false;
    case SDL_FINGERDOWN:
    case SDL_FINGERMOTION:
    case SDL_FINGERUP:
      return event.tfinger.touchId != SDL_MOUSE_TOUCHID && handle_finger(event.tfinger);
    case SDL_MOUSEMOTION:
      if (event.motion.which == SDL_TOUCH_MOUSEID) return false;  // the finger itself has told it
      by_touch_ = false;
      ui_.reads = false;
      mouse(to_float(event.motion.x) * pixels_per_point, to_float(event.motion.y) * pixels_per_point);
      return false;
    case SDL_MOUSEBUTTONDOWN:
    case SDL_MOUSEBUTTONUP: {
      if (event.button.which == SDL_TOUCH_MOUSEID) return false;
      mouse(to_float(event.button.x) * pixels_per_point, to_float(event.button.y) * pixels_per_point);
      const bool down = event.type == SDL_MOUSEBUTTONDOWN;
      if (down && std::exchange(black_, false)) {
        return false;
      }
      if (down) session_.message.clear();
      const int which = event.button.button == SDL_BUTTON_LEFT     ? 0
                        : event.button.button == SDL_BUTTON_RIGHT  ? 1
                        : event.button.button == SDL_BUTTON_MIDDLE ? 2
                                                                   : -1;
      if (which < 0) return false;
      const SDL_Keymod mod = SDL_GetModState();
#if IMGUI_VERSION_NUM >= 18700
      io.AddMouseButtonEvent(which, down);
      io.AddKeyEvent(ImGuiMod_Shift, (mod & KMOD_SHIFT) != 0);
#else
      io.MouseDown[which] = down;
      io.KeyShift = (mod & KMOD_SHIFT) != 0;
#endif
      return true;
    }
    case SDL_MOUSEWHEEL:
#if IMGUI_VERSION_NUM >= 18700
      io.AddMouseWheelEvent(to_float(event.wheel.x), to_float(event.wheel.y));
#else
      io.MouseWheel += to_float(event.wheel.y);
      io.MouseWheelH += to_float(event.wheel.x);
#endif
      return false;
    case SDL_WINDOWEVENT:
      if (event.window.event == SDL_WINDOWEVENT_LEAVE) mouse(-1e6f, -1e6f);
      if (event.window.event == SDL_WINDOWEVENT_FOCUS_LOST) session_.looking_back = false, take_acts(touch_.end());
      return false;
    case SDL_DROPFILE:
      if (event.drop.file) take_file(event.drop.file);
      SDL_free(event.drop.file);
      return false;
    case SDL_QUIT:
      requests.quit = true;
      return false;
    default:
      return false;
  }
}

void App::settle() {
  const bool moved = std::exchange(moves, false);  // to the end of what moves
  for (int i = 0; i < frames_to_settle; ++i) frame();
  moves = moved;
}

}  // namespace zstep::viewer
