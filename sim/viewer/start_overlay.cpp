// The start page: lessons with how far they were read, methods for the scene at hand, scenes as pictures, and files.

#include "sim/viewer/start_overlay.hpp"

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/vec2.hpp>

#include "algorithms/scene/mesh.hpp"
#include "sim/viewer/app.hpp"
#include "sim/viewer/commands.hpp"
#include "sim/viewer/draw/canvas.hpp"
#include "sim/viewer/lists.hpp"
#include "sim/viewer/overlays.hpp"
#include "traces/math/whole.hpp"
#include "traces/scene.hpp"
#include "traces/text.hpp"

namespace zstep::viewer {
namespace {

/// On a ground of 24 by 18, marks parted by "/", in the order in which they are painted. A letter, then points: o, s
/// and h fill an outline in orange, sky blue and grey, x what both have; O and S do without its border. l is a line, m
/// one of a grid, n what is at work, d dashed. p is a dot and b a ball, with their radius.
constexpr std::pair<std::string_view, const char*> emblems[] = {
    {"z-buffer",
     "S 9 0 24 0 24 12 9 12 / O 9 3 12 3 12 6 9 6 / O 6 6 15 6 15 9 6 9 / O 3 9 15 9 15 12 3 12 / "
     "O 3 12 18 12 18 15 3 15 / m 3 0 3 18 / m 6 0 6 18 / m 9 0 9 18 / m 12 0 12 18 / m 15 0 15 18 / m 18 0 18 18 / "
     "m 21 0 21 18 / m 0 3 24 3 / m 0 6 24 6 / m 0 9 24 9 / m 0 12 24 12 / m 0 15 24 15"},
    {"half-space",
     "o 6 14 12 4 19 12 / n 4.2 17 13.8 1 / n 9.4 1 22.5 16 / n 1 14.8 23 11.4 / p 9 12 1 / p 12 9 1 / p 15 12 1 / "
     "p 12 12 1"},
    {"scan-line", "s 11 3 22 5 20 15 9 12 / o 2 15 9 2 15 13 / n 0 9 24 9 / p 5.3 9 1.2 / p 13 9 1.2 / p 21 9 1.2"},
    {"painter", "h 2 2 14 2 14 11 2 11 / s 6 5 18 5 18 14 6 14 / o 10 8 22 8 22 17 10 17"},
    {"depth-sort",
     "o 2 2 10 2 10 16 2 16 / s 14 2 22 2 22 16 14 16 / n 6 7 18 7 / n 15.5 4.5 18 7 15.5 9.5 / n 18 12 6 12 / "
     "n 8.5 9.5 6 12 8.5 14.5"},
    {"bsp",
     "l 12 3 6 9 / l 12 3 18 9 / l 6 9 3 15 / l 6 9 9 15 / l 18 9 21 15 / b 12 3 2 / b 6 9 2 / b 18 9 2 / b 3 15 2 / "
     "b 9 15 2 / b 21 15 2"},
    {"warnock",
     "o 3 16 9 5 20 12 / l 1 1 23 1 23 17 1 17 1 1 / l 12 1 12 17 / l 1 9 23 9 / l 6.5 1 6.5 9 / l 1 5 12 5 / "
     "l 17.5 9 17.5 17 / l 12 13 23 13"},
    {"ray-casting", "o 15 3 22 7 15 15 / l 8 2 8 16 / n 2 9 15.5 5.2 / n 2 9 15 9 / n 2 9 15 13.5 / p 2 9 1.4"},
    {"ray-tracing", "s 14 16 17 16 23 3 20 3 / b 6 5 3.5 / n 1.5 15 17 10 / n 17 10 9 6.3 / p 1.5 15 1.4"},
    {"floating-horizon", "l 1 16 6 13 11 15 17 11 23 14 / l 1 12 6 7 11 10 17 5 23 9 / l 1 9 5 4 10 7 16 2 23 5"},
    {"wireframe",
     "l 3 6 14 6 14 17 3 17 3 6 / l 9 1 20 1 20 12 9 12 9 1 / l 3 6 9 1 / l 14 6 20 1 / l 14 17 20 12 / l 3 17 9 12"},
    {"hidden-line",
     "l 3 6 14 6 14 17 3 17 3 6 / l 3 6 9 1 20 1 20 12 14 17 / l 14 6 20 1 / d 9 1 9 12 / d 9 12 20 12 / d 3 17 9 12"},
    {"shadow-buffer", "h 9 14 15 14 23 17 15 17 / o 9 5 15 5 15 14 9 14 / d 3 3 9 5 / d 3 3 9 14 / b 3 3 2"},
    {"transparency", "o 2 2 15 2 15 12 2 12 / s 9 6 22 6 22 16 9 16 / x 9 6 15 6 15 12 9 12"},
};

constexpr double ground_width = 24, ground_height = 18;

const char* marks_of(std::string_view method) {
  for (const auto& [id, marks] : emblems)
    if (id == method) return marks;
  return nullptr;
}

class Painter {
 public:
  Painter(Canvas& canvas, const Theme& theme)
      : canvas_(canvas),
        theme_(theme),
        scale_(std::min(canvas.width() / ground_width, canvas.height() / ground_height)) {
    canvas_.fill(to_pixel(theme_.pane));
  }

  void paint(char what, const std::vector<double>& numbers) {
    if (what == 'p' || what == 'b') return dot(what, numbers);
    std::vector<glm::dvec2> points;
    for (std::size_t k = 0; k + 1 < numbers.size(); k += 2)
      points.push_back(glm::dvec2(numbers[k], numbers[k + 1]) * scale_);
    switch (what) {
      case 'l':
        return lines(points, theme_.text, 1.3);
      case 'm':
        return lines(points, theme_.rule, 1);
      case 'n':
        return lines(points, theme_.now, 1.8);
      case 'd':
        return dashes(points);
      default:
        break;
    }
    fill(points, fill_of(what));
    if (what == 'O' || what == 'S') return;
    points.push_back(points.front());
    lines(points, theme_.text, 1);
  }

 private:
  Pixel32 fill_of(char what) const {
    const Pixel32 orange = opaque(scene::palette[0]), sky = opaque(scene::palette[1]);
    if (what == 'o' || what == 'O') return orange;
    if (what == 's' || what == 'S') return sky;
    return what == 'x' ? mixed(orange, sky, 128) : to_pixel(theme_.rule);
  }

  /// The pixels whose centres it has.
  void fill(const std::vector<glm::dvec2>& outline, Pixel32 color) {
    for (int y = 0; y < canvas_.height(); ++y) {
      std::vector<double> crossings;
      for (std::size_t k = 0; k < outline.size(); ++k) {
        const glm::dvec2 a = outline[k], b = outline[(k + 1) % outline.size()];
        if ((a.y <= y + 0.5) != (b.y <= y + 0.5))
          crossings.push_back(a.x + (y + 0.5 - a.y) / (b.y - a.y) * (b.x - a.x));
      }
      std::sort(crossings.begin(), crossings.end());
      const auto column = [](double x) { return ceil_int(x - 0.5); };
      for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
        canvas_.rectangle(column(crossings[k]), y, column(crossings[k + 1]), y + 1, color);
    }
  }

  void lines(const std::vector<glm::dvec2>& points, ImU32 color, double thickness) {
    for (std::size_t k = 1; k < points.size(); ++k)
      canvas_.line(points[k - 1].x, points[k - 1].y, points[k].x, points[k].y, thickness, to_pixel(color));
  }

  void dashes(const std::vector<glm::dvec2>& points) {
    constexpr int parts = 7;  // every second is drawn
    const auto at = [&](int k) { return points[0] + (points[1] - points[0]) * ratio(k, parts); };
    for (int k = 0; k < parts; k += 2) lines({at(k), at(k + 1)}, theme_.text, 1);
  }

  void dot(char what, const std::vector<double>& numbers) {
    const double x = numbers[0] * scale_, y = numbers[1] * scale_, radius = numbers[2] * scale_;
    canvas_.mark(x, y, radius, 0, to_pixel(theme_.text));
    if (what == 'b') canvas_.mark(x, y, radius - 1, 0, fill_of('o'));
  }

  Canvas& canvas_;
  const Theme& theme_;
  double scale_;
};

}  // namespace

bool has_emblem(std::string_view method) { return marks_of(method) != nullptr; }

void paint_emblem(Canvas& canvas, const std::string& method, const Theme& theme) {
  Painter painter(canvas, theme);
  const char* const marks = marks_of(method);
  std::istringstream in(marks ? marks : "");
  in.imbue(std::locale::classic());
  for (std::string mark; std::getline(in, mark, '/');) {
    std::istringstream words(mark);
    words.imbue(std::locale::classic());
    char what = 0;
    words >> what;
    std::vector<double> numbers;
    for (double number = 0; words >> number;) numbers.push_back(number);
    painter.paint(what, numbers);
  }
}

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
  const float share = std::min(1.0f, to_float(seen) / to_float(lesson.stops));
  list->AddRectFilled(from, {from.x + std::round(bar * share), from.y + thick}, c.text);
  frame_box(ui, from, {right, from.y + thick}, c.muted);
}

/// A picture of three by four in the row; where the text begins beside it.
float draw_picture(Ui& ui, const Canvas& canvas, float x, const ListRow& row) {
  const ImVec2 at{std::round(x), std::round(row.at.y + 2)};
  const ImVec2 end{at.x + to_float(canvas.width()), at.y + to_float(canvas.height())};
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
  const std::string part = lower_case(typed);
  std::vector<const Offer*> found;
  for (const Offer& offer : offers())
    if (lower_case(offer.id + "\n" + offer.title).find(part) != std::string::npos) found.push_back(&offer);
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
    if (all[k]->what == Offer::What::lesson && all[k]->id == settings_.lessons.back().first) picked = index32(k);
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
    if (all[k]->what == what && !shown(*all[k])) picked = index32(k);
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
  const int count = size32(all);
  const bool opens = clicker && (code == SDLK_PERIOD || code == SDLK_b);
  if (code == SDLK_RETURN || opens) {
    if (picked >= count) return true;
    requests.for_class = opens;
    open_offer(*all[picked]);
    return true;
  }
  const auto what = [&](int k) { return all[k]->what; };
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
  const std::size_t picked = app.picked;
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
  ByEnum<Offer::What, float, 3> shares{0.5f, 0.24f, 0.26f};
  float sum = 0;  // of the columns that have something in them
  for (const Offer::What what : {Offer::What::lesson, Offer::What::method, Offer::What::scene}) {
    float& share = shares[what];
    if (std::none_of(all.begin(), all.end(), [&](const Offer* one) { return one->what == what; })) share = 0;
    sum += share;
  }
  float x = at.x;
  const Offer* clicked = nullptr;
  for (const Offer::What what : {Offer::What::lesson, Offer::What::method, Offer::What::scene}) {
    const std::size_t column = index_of(what);
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
