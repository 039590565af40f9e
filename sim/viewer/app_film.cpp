// Making a film: a few of its frames in each frame of the window, and then back to where the reader was.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "sim/film/video.hpp"
#include "sim/viewer/app.hpp"
#include "sim/viewer/system.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"

namespace zstep::viewer {

std::string film_length(std::int64_t frames) {
  return fmt::format("{} {}, {:.1f} s", grouped(frames), frames == 1 ? "frame" : "frames",
                     static_cast<double>(frames) / usual_frames_a_second);
}

void App::open_film() {
  if (against_) return say("A film shows one run, and these are two; open one of them alone.");
  open(overlay_ == Overlay::film ? Overlay::none : Overlay::film);
}

std::vector<FilmRange> App::film_ranges() const {
  std::vector<FilmRange> ranges;
  const std::int64_t here = session_.position(), size = session_.size();
  const auto add = [&](std::string what, std::int64_t first, std::int64_t last) {
    if (first < last) ranges.push_back({std::move(what), first, last});
  };
  if (session_.lesson() && session_.stop() >= 0) {
    const std::vector<Stop>& stops = session_.lesson()->stops;
    const std::int64_t from = stops[static_cast<std::size_t>(session_.stop())].position;
    const auto next = std::find_if(stops.begin(), stops.end(), [&](const Stop& stop) { return stop.position > from; });
    if (next == stops.end()) add("From this stop to the end", from, size);
    else add("From this stop of the lesson to the next", from, next->position);
  }
  if (session_.loops()) add("What playing repeats", session_.loop_first, session_.loop_last);
  const std::span<const PolygonMark> marks = session_.trace().polygons();
  const auto later = std::upper_bound(marks.begin(), marks.end(), here,
                                      [](std::int64_t at, const PolygonMark& mark) { return at < mark.position; });
  if (later != marks.begin()) {
    const PolygonMark& at_work = *std::prev(later);
    add(fmt::format("Work on polygon {}", polygon_label(session_.scene(), at_work.polygon)), at_work.position,
        later == marks.end() ? size : later->position - 1);
  }
  add("From here to the end", here, size);
  add("The whole run", 0, size);
  return ranges;
}

void App::film(std::int64_t first, std::int64_t last) {
  try {
    const std::filesystem::path path = system::film_path(fmt::format("zstep-{}-{}", first, last));
    film_ = std::unique_ptr<Film>(
        new Film{path, film_steps(first, last),
                 system::make_film(path, renderer_.width(), renderer_.height(), usual_frames_a_second), 0, false,
                 session_.position(), session_.unit(), session_.stop(), session_.selected_edge, board_});
  } catch (const InputError& error) {
    open(Overlay::none);
    return say(error.what());
  }
  open(Overlay::none);
  session_.playing = false;
  session_.message.clear();
  session_.selected_edge.reset();  // as at each later step
  // What the mouse points at is none of the film's.
  ImGui::SetCurrentContext(context_.context);
#if IMGUI_VERSION_NUM >= 18700
  ImGui::GetIO().AddMousePosEvent(-1e6f, -1e6f);
#else
  ImGui::GetIO().MousePos = {-1e6f, -1e6f};
#endif
}

/// Draws frames of the film for a part of a second, and puts the file in its place after the last.
void App::film_on() {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point until = Clock::now() + std::chrono::milliseconds(100);
  try {
    for (; film_->made < film_->steps.size(); ++film_->made) {
      if (Clock::now() >= until || !film_->maker->takes_more()) return;
      const std::int64_t step = film_->steps[film_->made];
      session_.go_to(step);
      if (session_.position() != step) return end_film(session_.message);
      session_.message.clear();
      film_->draws = true;
      const bool moved = std::exchange(moves, false);
      for (int k = 0; k < frames_to_settle; ++k) draw();
      moves = moved, film_->draws = false;
      film_->maker->frame({renderer_.width(), renderer_.height(), renderer_.rgb()});
    }
    film_->maker->finish();
  } catch (const InputError& error) {
    return end_film(error.what());
  }
  const std::string what =
      fmt::format("Saved {}: {}.", film_->path.string(), film_length(static_cast<std::int64_t>(film_->steps.size())));
  back_from_film();
  say(what);
}

void App::back_from_film() {
  const std::unique_ptr<Film> film = std::exchange(film_, nullptr);
  session_.go_to(film->position, film->unit);
  if (film->stop != session_.stop() && film->stop >= 0) session_.to_stop(film->stop);
  session_.selected_edge = film->edge;
  board_ = film->board;
}

void App::end_film(std::string why) {
  back_from_film();
  say(std::move(why));
}

/// Nothing but the end: what keys and mouse do otherwise would be in the film.
bool App::handle_filming(const SDL_Event& event) {
  if (event.type == SDL_QUIT) requests.quit = true;
  if (event.type == SDL_DROPFILE) SDL_free(event.drop.file);
  if (event.type == SDL_KEYDOWN && event.key.keysym.sym == SDLK_ESCAPE)
    end_film("The film was ended; no file was left.");
  return false;
}

void App::film_typed() {
  const std::vector<FilmRange> ranges = film_ranges();
  const auto row = static_cast<std::size_t>(std::max(0, picked));
  if (typed.find_first_not_of(' ') == std::string::npos) {
    if (row < ranges.size()) film(ranges[row].first, ranges[row].last);
    return;
  }
  char *first_end = nullptr, *last_end = nullptr;
  const long long first = std::strtoll(typed.c_str(), &first_end, 10), last = std::strtoll(first_end, &last_end, 10);
  const bool two = first_end != typed.c_str() && last_end != first_end &&
                   std::string(last_end).find_first_not_of(' ') == std::string::npos;
  if (two && first >= 0 && first < last && last <= session_.size()) return film(first, last);
  wrong = two ? fmt::format("The first step comes before the last, and the last is at most {}.", session_.size())
              : "Type the first step and the last: 300 420";
}

bool App::pick_film(SDL_Keycode code) {
  if (code == SDLK_RETURN) return film_typed(), true;
  if (code != SDLK_UP && code != SDLK_DOWN) return false;
  const int last = static_cast<int>(film_ranges().size()) - 1;
  picked = std::clamp(picked + (code == SDLK_DOWN ? 1 : -1), 0, std::max(0, last));
  scroll_to_picked = true;
  return true;
}

}  // namespace zstep::viewer
