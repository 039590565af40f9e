
#include "sim/viewer/notes.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fmt/format.h>
#include <stdexcept>
#include <utility>

#include "sim/viewer/draw/canvas.hpp"
#include "sim/words/numbers.hpp"
#include "traces/math/whole.hpp"
#include "traces/scene.hpp"

namespace zstep::viewer {
namespace {

constexpr float smallest_type = 13;

std::string minutes_text(double minutes) {
  const auto seconds = nearest_int(minutes * 60);
  return fmt::format("{}:{:02}", seconds / 60, seconds % 60);
}

const Stop* stop_of(const Session& session, int stop) {
  const Lesson* lesson = session.lesson();
  return lesson && stop >= 0 && stop < size32(lesson->stops) ? &lesson->stops[stop] : nullptr;
}

void gap(const Ui& ui, float ems) { ImGui::Dummy({1, std::round(ui.em * ems)}); }

void head_line(Ui& ui, const std::string& text) {
  flow(ui, text, {.color = ui.colors().now, .font = ui.fonts.bold});
  gap(ui, 0.2f);
}

/// What the class is to find out: the right answer, what does the task, or why marks are right.
void draw_solution(Ui& ui, const Stop& stop) {
  if (stop.question)
    for (std::size_t k = 0; k < stop.question->answers.size(); ++k)
      if (const Answer& answer = stop.question->answers[k]; answer.right) {
        head_line(ui, fmt::format("THE ANSWER IS {}", k + 1));
        flow(ui, answer.text, {.font = ui.fonts.bold});
        gap(ui, 0.3f);
        flow_markdown(ui, answer.reply);
      }
  if (stop.task) {
    head_line(ui, "A SOLUTION");
    for (const std::string& change : stop.task->solution) flow(ui, change, {.font = ui.fonts.mono});
    gap(ui, 0.3f);
    for (const std::string& hint : stop.task->hints) flow(ui, hint, {.color = ui.colors().muted});
  }
  if (stop.marking) {
    head_line(ui, "WHY");
    flow_markdown(ui, stop.marking->why);
  }
  if (stop.question || stop.task || stop.marking) gap(ui, 1);
}

}  // namespace

std::string planned(const Lesson& lesson, int stop) {
  double before = 0, here = 0, all = 0;
  for (int k = 0; k < size32(lesson.stops); ++k) {
    const auto& notes = lesson.stops[k].notes;
    const double minutes = notes ? notes->minutes : 0;
    all += minutes;
    if (k < stop) before += minutes;
    if (k == stop) here = minutes;
  }
  if (all == 0) return "";
  return fmt::format("{} to {} of {}", minutes_text(before), minutes_text(before + here), minutes_text(all));
}

Notes::Notes(int width, int height, float dpi_scale)
    : context_(ImGui::CreateContext()), renderer_(width, height), dpi_scale_(dpi_scale) {
  ImGuiContext* const before = ImGui::GetCurrentContext();
  ImGui::SetCurrentContext(context_);
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
  io.DeltaTime = 1.0f / 60;
  ImGui::SetCurrentContext(before);
}

Notes::~Notes() { ImGui::DestroyContext(context_); }

void Notes::resize(int width, int height, float dpi_scale) {
  renderer_.resize(width, height);
  dpi_scale_ = dpi_scale;
}

bool Notes::follow(App& app, const std::string& time) {
  Session& session = app.session();
  Seen now{&session,
           session.position(),
           session.stop(),
           renderer_.width(),
           renderer_.height(),
           app.settings().dark,
           app.settings().text_scale,
           dpi_scale_,
           app.board().clock_runs() ? app.board().clock(app.clock_time) : "",
           time};
  if (now == seen_) return false;
  ImGuiContext* const before = ImGui::GetCurrentContext();
  ImGui::SetCurrentContext(context_);
  if (!ui_ || seen_.session != &session) ui_ = std::make_unique<Ui>(session, renderer_);
  ui_->theme = now.dark ? &dark_theme() : &light_theme();
  seen_ = std::move(now);
  const auto width = to_float(renderer_.width()), height = to_float(renderer_.height());
  const float grown = std::max(dpi_scale_, 1 + (std::max(std::min(width / 1280, height / 720), 1.0f) - 1) / 2);
  float em = std::round(22 * grown * seen_.text_scale);
  // As large as all of it goes into the window.
  while (!(whole_ = draw(em) <= height) && em > smallest_type) em = std::max(smallest_type, std::floor(em * 0.92f));
  ImGui::SetCurrentContext(before);
  return true;
}

void Notes::draw_head(ImVec2 at, float width) {
  Ui& ui = *ui_;
  const Theme& c = ui.colors();
  const Session& s = ui.session;
  const float pad = std::round(ui.em * 0.5f), line = std::round(ui.em * 1.35f), y = at.y + pad;
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + width, at.y + line + 2 * pad}, c.head);
  float right = at.x + width - pad;
  const auto before = [&](const ImFont* font, ImU32 color, const std::string& text) {
    if (text.empty()) return;
    right -= text_size(ui, font, text).x;
    draw_text(ui, {right, y}, font, color, text);
    right -= ui.em * 1.2f;
  };
  before(ui.fonts.text, c.text, seen_.time);
  before(ui.fonts.bold, c.now, seen_.clock.empty() ? "" : "\u25b6 " + seen_.clock);
  if (s.lesson())
    if (const std::string plan = planned(*s.lesson(), s.stop()); !plan.empty())
      before(ui.fonts.text, c.text, "planned " + plan);
  std::string where = fmt::format("step {} of {}", grouped(s.position()), grouped(s.size()));
  if (s.lesson()) where = fmt::format("stop {} of {} \u00b7 {}", s.stop() + 1, s.lesson()->stops.size(), where);
  if (text_size(ui, ui.fonts.bold, where).x <= right - at.x - pad)
    draw_text(ui, {at.x + pad, y}, ui.fonts.bold, c.text, where);
}

void Notes::draw_stop() {
  Ui& ui = *ui_;
  const Session& s = ui.session;
  const Stop* stop = stop_of(s, s.stop());
  if (!s.lesson()) return say_empty(ui, "Notes belong to the stops of a lesson, and none is open. Ctrl+O opens one.");
  if (!stop) return say_empty(ui, "The lesson's first stop is still to come: N, or a clicker's Page down.");
  flow(ui, stop->heading, {.font = ui.fonts.bold});
  gap(ui, 0.5f);
  if (stop->notes) flow_markdown(ui, stop->notes->text);
  else say_empty(ui, "There are no notes for this stop.");
  gap(ui, 0.8f);
  head_line(ui, "THE CLASS READS");
  flow_markdown(ui, stop->text);
  if (stop->question) {
    gap(ui, 0.3f);
    flow_markdown(ui, stop->question->text);
    for (std::size_t k = 0; k < stop->question->answers.size(); ++k)
      flow(ui, fmt::format("{}. {}", k + 1, stop->question->answers[k].text), {.indent = ui.em * 1.3f});
  }
  if (stop->task) gap(ui, 0.3f), flow_markdown(ui, stop->task->text);
  if (stop->marking) gap(ui, 0.3f), flow_markdown(ui, stop->marking->text);
}

void Notes::draw_beside() {
  Ui& ui = *ui_;
  const Session& s = ui.session;
  if (const Stop* stop = stop_of(s, s.stop())) draw_solution(ui, *stop);
  if (!s.lesson()) return;
  head_line(ui, "NEXT");
  const Stop* next = stop_of(s, s.stop() + 1);
  if (!next) return say_empty(ui, "This is the last stop.");
  flow(ui, next->heading, {});
  if (next->notes && next->notes->minutes > 0)
    flow(ui, "planned " + minutes_text(next->notes->minutes), {.color = ui.colors().muted});
}

float Notes::draw(float em) {
  Ui& ui = *ui_;
  if (ui.em != em || !ui.fonts.text) {
    ui.em = em;
    ui.thin = std::max(1.0f, std::round(em / 22));
    ui.fonts.load(em);
    renderer_.take_fonts();
  }
  apply_style(ui);
  const ImVec2 size{to_float(renderer_.width()), to_float(renderer_.height())};
  ImGui::GetIO().DisplaySize = size;
  ImGui::NewFrame();
  ImGui::SetNextWindowPos({0, 0});
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleColor(ImGuiCol_WindowBg, ui.colors().pane);
  constexpr ImGuiWindowFlags still = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                                     ImGuiWindowFlags_NoInputs;
  ImGui::Begin("notes", nullptr, still);
  ImGui::PopStyleColor();
  ImGui::PopStyleVar();
  const float pad = std::round(em), head = std::round(em * 2.35f), column = std::floor((size.x - 3 * pad) * 0.63f);
  draw_head({0, 0}, size.x);
  float bottom = 0;
  const auto part = [&](float x, float width, void (Notes::*draw_part)()) {
    ImGui::SetCursorScreenPos({x, head + pad});
    ImGui::BeginChild(x > pad ? "beside" : "stop", {width, std::max(1.0f, size.y - head - pad)}, false, still);
    const float top = ImGui::GetCursorScreenPos().y;
    (this->*draw_part)();
    bottom = std::max(bottom, head + pad + ImGui::GetCursorScreenPos().y - top);
    ImGui::EndChild();
  };
  part(pad, column, &Notes::draw_stop);
  part(2 * pad + column, size.x - 3 * pad - column, &Notes::draw_beside);
  ImGui::End();
  ImGui::Render();
  renderer_.draw(*ImGui::GetDrawData(), to_pixel(ui.colors().pane));
  return bottom + pad / 2;
}

namespace {

constexpr int usual_width = 1100, usual_height = 700;

bool is_pointer(const SDL_Event& event) {
  return event.type == SDL_MOUSEMOTION || event.type == SDL_MOUSEBUTTONDOWN || event.type == SDL_MOUSEBUTTONUP ||
         event.type == SDL_MOUSEWHEEL || event.type == SDL_FINGERDOWN || event.type == SDL_FINGERMOTION ||
         event.type == SDL_FINGERUP;
}

std::uint32_t window_of(const SDL_Event& event) {
  switch (event.type) {
    case SDL_WINDOWEVENT:
      return event.window.windowID;
    case SDL_MOUSEMOTION:
      return event.motion.windowID;
    case SDL_MOUSEWHEEL:
      return event.wheel.windowID;
    case SDL_FINGERDOWN:
    case SDL_FINGERMOTION:
    case SDL_FINGERUP:
      return event.tfinger.windowID;
    default:
      return event.button.windowID;
  }
}

std::string time_of_day() {
  const std::time_t now = std::time(nullptr);
  char text[8] = "";
  if (const std::tm* local = std::localtime(&now)) std::strftime(text, sizeof text, "%H:%M", local);
  return text;
}

}  // namespace

bool notes_open_by_themselves(bool presenter, bool lesson, int screens) { return presenter && lesson && screens > 1; }

void NotesWindow::toggle(App& app) {
  by_itself_ = false;
  if (window_) close();
  else open(app);
}

void NotesWindow::open(App& app) try {
  window_ = std::make_unique<Window>(first_, "zstep \u00b7 speaker's notes", usual_width, usual_height);
  notes_ = std::make_unique<Notes>(window_->surface()->w, window_->surface()->h, window_->dpi_scale());
  exposed_ = true;
} catch (const std::runtime_error& error) {
  close();
  app.say(error.what());
}

void NotesWindow::close() {
  notes_.reset();
  window_.reset();
}

bool NotesWindow::takes(const SDL_Event& event, App& app) {
  if (!window_ || (event.type != SDL_WINDOWEVENT && !is_pointer(event))) return false;
  const bool own = window_of(event) == SDL_GetWindowID(window_->get());
  if (event.type != SDL_WINDOWEVENT) return own;
  const bool closed = event.window.event == SDL_WINDOWEVENT_CLOSE;
  // With two windows the system says that one is closed, and nothing more.
  if (!own && closed) app.requests.quit = true;
  if (!own) return false;
  if (closed) close();
  else exposed_ = true;
  return true;
}

void NotesWindow::follow(App& app) {
  const bool lesson = app.session().lesson() != nullptr;
  const bool before_class = notes_open_by_themselves(app.settings().presenter, lesson, SDL_GetNumVideoDisplays());
  if (std::exchange(before_class_, before_class) != before_class) {
    if (before_class && !window_) open(app), by_itself_ = true;
    else if (!before_class && window_ && by_itself_) close();
  }
  if (!window_) return;
  const SDL_Surface* surface = window_->surface();
  if (surface->w != notes_->renderer().width() || surface->h != notes_->renderer().height())
    notes_->resize(surface->w, surface->h, window_->dpi_scale());
  const bool drawn = notes_->follow(app, time_of_day());
  if (drawn || std::exchange(exposed_, false)) window_->show(notes_->renderer().picture());
}

double NotesWindow::until_due() const { return window_ ? 60 - static_cast<double>(std::time(nullptr) % 60) : 1e9; }

}  // namespace zstep::viewer
