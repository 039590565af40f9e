// Playing: so many steps a second, or a unit a frame, with halts where the lesson speaks and asks.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "sim/viewer/model/session.hpp"

namespace zstep::viewer {

const std::vector<Session::Speed>& Session::speeds() {
  static const std::vector<Speed> all{{"1 step/s", 1, {}},
                                      {"2 steps/s", 2, {}},
                                      {"5 steps/s", 5, {}},
                                      {"10 steps/s", 10, {}},
                                      {"30 steps/s", 30, {}},
                                      {"100 steps/s", 100, {}},
                                      {"500 steps/s", 500, {}},
                                      {"a span a frame", 0, Unit::span},
                                      {"a line a frame", 0, Unit::scan_line},
                                      {"a polygon a frame", 0, Unit::polygon}};
  return all;
}

bool Session::asks_here() const {
  if (stop_ < 0) return false;
  const Stop& stop = lesson_->stops[static_cast<std::size_t>(stop_)];
  return stop.question && !chosen(stop_) && stop.position == position();
}

void Session::say_that_it_asks() {
  told_to_answer_ = true;
  const std::size_t answers = lesson_->stops[static_cast<std::size_t>(stop_)].question->answers.size();
  message =
      fmt::format("Here the lesson asks. Answer first (a key from 1 to {}, or a click), then Space plays on.", answers);
}

void Session::toggle_play() {
  if (playing && waits_ > 0) {
    reading_until_ = -1;  // the reader has read
    return;
  }
  if (!playing && position() == size() && !loops()) {
    message = "This is the end of the trace; Home goes back to its beginning.";
    return;
  }
  if (!playing && asks_here()) return say_that_it_asks();
  playing = !playing;
}

double Session::play(double now) {
  constexpr double frame = 1.0 / 60, words_a_second = 3.5;
  if (played_until_ < 0 || now - played_until_ > 1) played_until_ = now;
  const double passed = now - played_until_;
  played_until_ = now;
  if (!playing) {
    owed_ = 0, waits_ = 0;
    reading_until_ = played_until_ = -1;
    return 3600;
  }
  if (asks_here()) {
    playing = false;
    say_that_it_asks();
    return 3600;
  }
  if (const double left = reading_until_ - now; left > 0) {
    const int whole = static_cast<int>(std::ceil(left));
    if (whole != std::exchange(waits_, whole)) {
      message =
          fmt::format("Time to read this stop: playing goes on in {} s. Space goes on at once, Esc pauses.", whole);
    }
    return std::max(frame, left - (whole - 1));
  }
  if (std::exchange(waits_, 0) > 0) message.clear();
  const Speed& s = speeds()[static_cast<std::size_t>(speed)];
  std::int64_t to = position();
  if (s.unit_a_frame) {
    to = next_unit(trace_, position(), *s.unit_a_frame);
  } else {
    owed_ = std::min(owed_ + passed * s.steps_a_second, s.steps_a_second);
    to = position() + static_cast<std::int64_t>(owed_);
    owed_ -= static_cast<double>(static_cast<std::int64_t>(owed_));
  }
  if (loops()) to = position() >= loop_last || position() < loop_first ? loop_first : std::min(to, loop_last);
  // The lesson has the word: halt where it speaks, for as long as reading takes, or until its question is answered.
  if (lesson_ && to > position())
    for (std::size_t i = 0; i < lesson_->stops.size(); ++i) {
      const Stop& stop = lesson_->stops[i];
      const bool next_here =
          stop.position == position() && static_cast<int>(i) > stop_;  // several may speak at one step
      if (stop.position > to || (stop.position <= position() && !next_here)) continue;
      to_stop(static_cast<int>(i));
      owed_ = 0;
      if (!asks_here())
        reading_until_ =
            now + 2 + static_cast<double>(std::count(stop.text.begin(), stop.text.end(), ' ')) / words_a_second;
      return 0;
    }
  if (to != position()) go_to(to, s.unit_a_frame.value_or(Unit::event));
  if (position() == size() && !loops()) {
    playing = false;
    message = "Played to the end of the trace; Home goes back to its beginning.";
  }
  if (s.unit_a_frame) return frame;
  return std::max(frame, (1 - owed_) / s.steps_a_second);
}

}  // namespace zstep::viewer
