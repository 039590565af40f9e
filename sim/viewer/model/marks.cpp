// What a reader marks by hand, before the run does it.
#include <algorithm>

#include "sim/classroom/marking.hpp"
#include "sim/viewer/model/session.hpp"

namespace zstep::viewer {

const Marking* Session::marking() const {
  if (!lesson_ || stop_ < 0) return nullptr;
  const auto& marking = lesson_->stops[static_cast<std::size_t>(stop_)].marking;
  return marking ? &*marking : nullptr;
}

bool Session::marks_cells() const { return marking() && marking()->kind != Marking::Kind::order; }

void Session::mark(std::int32_t what) {
  if (!marking()) return;
  Marks& marks = marks_[static_cast<std::size_t>(stop_)];
  marks.checked = false;
  if (const auto there = std::find(marks.made.begin(), marks.made.end(), what); there != marks.made.end()) {
    marks.made.erase(there);
  } else {
    if (marking()->kind == Marking::Kind::scan_line) marks.made.clear();
    marks.made.push_back(what);
  }
}

void Session::mark(Cell cell) {
  if (marks_cells())
    mark(marking()->kind == Marking::Kind::scan_line ? cell.y : cell.y * scene().raster.width + cell.x);
}

void Session::check_marks() {
  if (!marking()) return void(message = "Nothing is asked to be marked here.");
  Marks& marks = marks_[static_cast<std::size_t>(stop_)];
  if (marks.made.empty()) message = "Nothing is marked yet.";
  else marks.checked = true;
}

void Session::help_with_marks() {
  if (!marking()) return void(message = "Nothing is asked to be marked here.");
  Marks& marks = marks_[static_cast<std::size_t>(stop_)];
  if (marks.hints < marking()->hints.size()) ++marks.hints;
  else marks.shown = true;
}

}  // namespace zstep::viewer
