// Where the reader is in the lesson: its stops, its questions, what was answered.
#include <algorithm>
#include <utility>

#include "sim/viewer/model/session.hpp"

namespace zstep::viewer {

void Session::to_stop(int index) {
  if (!lesson_ || lesson_->stops.empty()) return;
  index = std::clamp(index, 0, static_cast<int>(lesson_->stops.size()) - 1);
  unit_ = Unit::event;
  replay_.go_to(lesson_->stops[static_cast<std::size_t>(index)].position);
  stop_ = index;
  selected_edge.reset();
  arrived();
}

bool Session::next_stop(int direction) {
  if (!lesson_ || lesson_->stops.empty()) {
    message = "There is no lesson here; Ctrl+O opens one.";
    return true;
  }
  const int count = static_cast<int>(lesson_->stops.size());
  int target = stop_ + direction;
  // Going back from between two stops returns to the one that is still shown.
  if (direction < 0 && stop_ >= 0 && position() > lesson_->stops[static_cast<std::size_t>(stop_)].position)
    target = stop_;
  if (target < 0 || target >= count) {
    message = direction > 0 ? "This was the last stop of the lesson." : "This is the first stop of the lesson.";
    const bool again = direction > 0 && told_end_;
    told_end_ = direction > 0;
    return !again;
  }
  told_end_ = false;
  to_stop(target);
  return true;
}

bool Session::question_open() const {
  if (stop_ < 0) return false;
  const auto& question = lesson_->stops[static_cast<std::size_t>(stop_)].question;
  if (!question) return false;
  const auto given = chosen(stop_);
  return !given || !question->answers[static_cast<std::size_t>(*given)].right;
}

bool Session::nudged() const {
  return question_open() && !chosen(stop_) &&
         (told_to_answer_ || position() > lesson_->stops[static_cast<std::size_t>(stop_)].position);
}

void Session::answer(int choice) {
  if (stop_ < 0) return;
  if (const Marking* asked = marking(); asked && asked->kind == Marking::Kind::order) {
    const std::vector<std::int32_t> choices = choices_of(*asked);
    if (choice >= 0 && choice < static_cast<int>(choices.size())) mark(choices[static_cast<std::size_t>(choice)]);
    return;
  }
  const auto& question = lesson_->stops[static_cast<std::size_t>(stop_)].question;
  if (!question || choice < 0 || choice >= static_cast<int>(question->answers.size())) return;
  chosen_[static_cast<std::size_t>(stop_)] = choice;
}

void Session::show_answer() {
  if (!question_open()) return;
  const std::vector<Answer>& answers = lesson_->stops[static_cast<std::size_t>(stop_)].question->answers;
  const auto right = std::find_if(answers.begin(), answers.end(), [](const Answer& one) { return one.right; });
  if (right != answers.end()) answer(static_cast<int>(right - answers.begin()));
}

// --- Playing

}  // namespace zstep::viewer
