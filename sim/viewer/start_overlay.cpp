// The start page: lessons with how far they were read, methods for the scene at hand, scenes as pictures, and files.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "sim/viewer/app.hpp"
#include "sim/viewer/commands.hpp"
#include "sim/viewer/emblems.hpp"
#include "sim/viewer/lists.hpp"
#include "sim/viewer/overlays.hpp"

namespace zstep::viewer {
namespace {

/// An offer's picture so high, each pixel of it a square.
void paint_offer(Canvas& canvas, const Image& image) {
  for (int y = 0; y < canvas.height(); ++y)
    for (int x = 0; x < canvas.width(); ++x) {
      const auto from = [](int at, int size, int of) { return static_cast<std::size_t>(at * of / size); };
      const std::size_t at = 3 * (from(y, canvas.height(), image.height) * static_cast<std::size_t>(image.width) +
                                  from(x, canvas.width(), image.width));
      canvas.row(y)[x] = opaque({image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]});
    }
}

const char* heading_of(Offer::What what, bool files_alone) {
  if (files_alone) return "Files";
  switch (what) {
    case Offer::What::lesson:
      return "Lessons";
    case Offer::What::method:
      return "Methods, for this scene";
    case Offer::What::scene:
      break;
  }
  return "Scenes, by this method";
}

/// How long a lesson takes, and how far it was read, as a bar and in numbers.
void draw_progress(Ui& ui, const ListRow& row, const Offer& lesson, int seen) {
  const Theme& c = ui.colors();
  const bool begun = seen > 0 && lesson.stops > 0;
  const std::string text = !begun                 ? fmt::format("{:.0f} min", std::max(1.0, lesson.minutes))
                           : seen >= lesson.stops ? "read"
                                                  : fmt::format("{} of {}", seen, lesson.stops);
  const float bar = std::round(ui.em * 3), right = row.end.x - ui.em * 0.6f;
  const float middle = (row.at.y + row.end.y) / 2, thick = std::round(ui.em * 0.3f);
  const float text_end = begun ? right - bar - ui.em * 0.5f : right;
  draw_text(ui, {text_end - text_size(ui, ui.fonts.small, text).x, std::round(middle - ui.fonts.small->FontSize / 2)},
            ui.fonts.small, c.muted, text);
  if (!begun) return;
  ImDrawList* list = ImGui::GetWindowDrawList();
  const ImVec2 from{right - bar, std::round(middle - thick / 2)};
  list->AddRectFilled(from, {right, from.y + thick}, c.head);
  const float share = std::min(1.0f, static_cast<float>(seen) / static_cast<float>(lesson.stops));
  list->AddRectFilled(from, {from.x + std::round(bar * share), from.y + thick}, c.text);
  frame_box(ui, from, {right, from.y + thick}, c.muted);
}

/// A picture of three by four in the row; where the text begins beside it.
float draw_picture(Ui& ui, const Canvas& canvas, float x, const ListRow& row) {
  const ImVec2 at{std::round(x), std::round(row.at.y + 2)};
  const ImVec2 end{at.x + static_cast<float>(canvas.width()), at.y + static_cast<float>(canvas.height())};
  ImGui::GetWindowDrawList()->AddImage(Renderer::image(canvas), at, end);
  frame_box(ui, at, end, ui.colors().rule);
  return x + std::max(std::round((row.end.y - row.at.y) * 1.4f), end.x - at.x) + std::round(ui.em * 0.5f);
}

void draw_choice(App& app, const Offer& offer, const ListRow& row) {
  Ui& ui = app.ui();
  const float height = row.end.y - row.at.y, pad = std::round(ui.em * 0.5f);
  float x = row.at.x + pad;
  const float tall = height - 4;
  if (offer.picture.height > 0) {
    const float wide =
        std::round(tall * static_cast<float>(offer.picture.width) / static_cast<float>(offer.picture.height));
    x = draw_picture(ui,
                     keep_canvas(ui.canvases, "offer " + offer.id, static_cast<int>(wide), static_cast<int>(tall),
                                 paint_offer, offer.picture)
                         ->made,
                     x, row);
  } else if (offer.what == Offer::What::method && has_emblem(offer.id)) {
    x = draw_picture(ui,
                     keep_canvas(ui.canvases, "offer " + offer.id, static_cast<int>(std::round(tall * 4 / 3)),
                                 static_cast<int>(tall), paint_emblem, offer.id, ui.colors())
                         ->made,
                     x, row);
  }
  const bool lesson = offer.what == Offer::What::lesson;
  const std::string title = lesson ? fmt::format("{}. {}", offer.number, offer.title) : offer.title;
  const bool progress = lesson && row.end.x - row.at.x > 21 * ui.em;
  const float room = row.end.x - x - (progress ? ui.em * 8 : 0);
  draw_text(ui, {x, row.at.y + std::round((height - ui.em) / 2) - 1}, ui.fonts.text, ui.colors().text,
            fitted(ui, ui.fonts.text, title, room));
  if (progress) draw_progress(ui, row, offer, app.settings().stops_seen(offer.id));
}

}  // namespace

const std::vector<Offer>& App::offers() {
  if (offers_.empty() && ask_for_offers_) offers_ = ask_for_offers_();
  return offers_;
}

std::vector<const Offer*> App::choices() {
  const std::string part = lower(typed);
  std::vector<const Offer*> found;
  for (const Offer& offer : offers())
    if (lower(offer.id + "\n" + offer.title).find(part) != std::string::npos) found.push_back(&offer);
  for (const Offer* file : own_files_.find(typed)) found.push_back(file);
  return found;
}

void App::see_file() {
  std::error_code error;
  if (opened_by.size() < 2 || opened_by[0] != "view" || !std::filesystem::is_regular_file(opened_by[1], error)) return;
  const std::filesystem::path whole = std::filesystem::absolute(opened_by[1], error);
  if (!error) settings_.see_file(whole.lexically_normal().string());
}

void App::open_start() {
  own_files_.look_for(settings_.files);
  open(Overlay::start);
  const std::vector<const Offer*> all = choices();
  for (std::size_t k = 0; k < all.size() && !settings_.lessons.empty(); ++k)
    if (all[k]->what == Offer::What::lesson && all[k]->id == settings_.lessons.back().first)
      picked = static_cast<int>(k);
  scroll_to_picked = true;
}

void App::turn_key_sheet() {
  if (overlay_ != Overlay::keys) {
    keys_over_start_ = overlay_ == Overlay::start;
    return open(Overlay::keys);
  }
  open(Overlay::none);
  if (std::exchange(keys_over_start_, false)) open_start();
}

void App::open_start(Offer::What what) {
  open_start();
  const std::vector<const Offer*> all = choices();
  const auto shown = [&](const Offer& offer) {
    return offer.id == session_.header().algorithm || offer.id == session_.scene().name ||
           (session_.lesson() && offer.id == session_.lesson()->id);
  };
  for (std::size_t k = all.size(); k-- > 0;)
    if (all[k]->what == what && !shown(*all[k])) picked = static_cast<int>(k);
}

void App::open_offer(const Offer& offer) {
  wrong.clear();
  if (is_folder(offer)) {
    put(std::string(offer.id));
    picked = 0;
    return;
  }
  requests.open = offer;
}

void App::take_file(const std::string& path) {
  if (drawer_ == Drawer::compare && overlay_ == Overlay::none) {
    put(path);
    return compare_typed();
  }
  open_offer({Offer::What::scene, path, {}, {}});
}

void App::say_on_start(const std::string& why) {
  if (overlay_ != Overlay::start) open_start();
  wrong = why;
}

bool App::pick_offer(SDL_Keycode code) {
  // With a clicker one goes through the rows by its two keys, and opens by the third, before a class. What that one
  // typed before is nothing that is looked for.
  const bool turns = code == SDLK_PAGEUP || code == SDLK_PAGEDOWN, clicker = std::exchange(clicker_, turns);
  if (turns && (typed == "b" || typed == ".")) put("");
  const std::vector<const Offer*> all = choices();
  const int count = static_cast<int>(all.size());
  const bool opens = clicker && (code == SDLK_PERIOD || code == SDLK_b);
  if (code == SDLK_RETURN || opens) {
    if (picked >= count) return true;
    requests.for_class = opens;
    open_offer(*all[static_cast<std::size_t>(picked)]);
    return true;
  }
  const auto what = [&](int k) { return all[static_cast<std::size_t>(k)]->what; };
  int to = picked;
  if (code == SDLK_UP || code == SDLK_DOWN) to += code == SDLK_DOWN ? 1 : -1;
  else if (code == SDLK_PAGEUP || code == SDLK_PAGEDOWN) to += code == SDLK_PAGEDOWN ? 1 : -1;
  else if (code == SDLK_TAB) {  // to the next column, and from the last to the first
    while (to < count && what(to) == what(picked)) ++to;
    if (to >= count) to = 0;
  } else return false;
  picked = std::clamp(to, 0, std::max(0, count - 1));
  scroll_to_picked = true;
  return true;
}

void draw_start(App& app) {
  Ui& ui = app.ui();
  const Theme& c = ui.colors();
  const ImVec2 screen = ImGui::GetIO().DisplaySize;
  begin_overlay(app, "start", {screen.x - 3 * ui.em, screen.y - 3 * ui.em}, 0.5f);
  flow(ui, "zstep shows, step by step, how a computer decides what is visible. What do you want to see?",
       {.font = ui.fonts.bold});
  ImGui::Dummy({1, std::round(ui.em * 0.3f)});
  app.draw_field("Type a part of a name, or the path of a file");
  if (button(ui, "Choose a file\u2026 (Ctrl+Shift+O)")) app.requests.choose_file = true;
  const std::vector<const Offer*> all = app.choices();
  const auto picked = static_cast<std::size_t>(app.picked);
  const bool narrow = ImGui::GetContentRegionAvail().x < 34 * ui.em;  // then one list below the other
  const std::string
      told = picked < all.size() ? all[picked]->summary : "",
      how_to = screen.y < 26 * ui.em ? ""  // the lists need the room
               : narrow              ? "A touch or Enter opens it; a touch beside this page, or Esc: back."
                        : "Enter or a click opens it; Tab: the next column; Esc: back. A file can be dropped on the "
                          "window: a mesh, a scene, "
                          "a trace, or the JSON Lines of a program.";
  const Flow muted{.color = c.muted};
  const float gap = std::round(ui.em * 0.7f);
  const float foot = std::ceil(flow_height(ui, app.wrong.empty() ? told : app.wrong, {.font = ui.fonts.bold}) +
                               (how_to.empty() ? 0 : flow_height(ui, how_to, muted)) + gap);
  const ImVec2 at = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
  const float heights[] = {std::round(ui.em * 1.5f), std::round(ui.em * 2.1f), std::round(ui.em * 2.7f)};
  float shares[] = {0.5f, 0.24f, 0.26f};
  float sum = 0;  // of the columns that have something in them
  for (const Offer::What what : {Offer::What::lesson, Offer::What::method, Offer::What::scene}) {
    float& share = shares[static_cast<std::size_t>(what)];
    if (std::none_of(all.begin(), all.end(), [&](const Offer* one) { return one->what == what; })) share = 0;
    sum += share;
  }
  float x = at.x;
  const Offer* clicked = nullptr;
  for (const Offer::What what : {Offer::What::lesson, Offer::What::method, Offer::What::scene}) {
    const auto column = static_cast<std::size_t>(what);
    const float width = narrow ? room.x : std::floor((room.x - 2 * gap) * shares[column] / std::max(0.01f, sum));
    if (!narrow && width <= 0) continue;
    const auto in_column = [what](const Offer* one) { return one->what == what; };
    const auto built_in = [](const Offer* one) { return one->what == Offer::What::scene && one->picture.height > 0; };
    const bool files_alone = what == Offer::What::scene && std::any_of(all.begin(), all.end(), in_column) &&
                             std::none_of(all.begin(), all.end(), built_in);
    const char* const heading = heading_of(what, files_alone);
    if (!narrow || what == Offer::What::lesson) {
      ImGui::SetCursorScreenPos({x, at.y + gap});
      ImGui::BeginChild(heading, {width, std::max(1.0f, room.y - foot - gap)}, false, ImGuiWindowFlags_NoNav);
    } else ImGui::Dummy({1, gap});
    flow(ui, heading, {.color = c.now, .font = ui.fonts.bold});
    const std::string* theme = nullptr;
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (all[k]->what != what) continue;
      if (!all[k]->theme.empty() && (!theme || *theme != all[k]->theme)) flow(ui, all[k]->theme, muted);
      theme = &all[k]->theme;
      const bool has_picture = what == Offer::What::method || all[k]->picture.height > 0;
      const ListRow row = list_row(app, k, has_picture ? heights[column] : heights[0]);
      if (row.clicked) clicked = all[k];
      if (row.visible) draw_choice(app, *all[k], row);
    }
    if (!narrow || what == Offer::What::scene) ImGui::EndChild();
    x += width + gap;
  }
  app.scroll_to_picked = false;
  ImGui::SetCursorScreenPos({at.x, at.y + room.y - foot + std::round(gap / 2)});
  if (!app.wrong.empty()) say_wrong(ui, app.wrong);
  else if (all.empty()) say_empty(ui, "Nothing has this in its name.");
  else if (!told.empty()) flow(ui, told, {});
  if (!how_to.empty()) flow(ui, how_to, muted);
  ImGui::End();
  if (clicked) app.open_offer(*clicked);
}

}  // namespace zstep::viewer
