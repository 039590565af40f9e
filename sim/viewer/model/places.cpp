#include "sim/viewer/model/places.hpp"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "traces/error.hpp"
#include "traces/file/header.hpp"
#include "traces/text.hpp"

namespace zstep::viewer {

namespace {

constexpr std::chrono::milliseconds searching_slice{5};  // of a frame's sixteen
constexpr std::size_t most_asked = 3;

}  // namespace

Places::Places(Session& session) : session_(session) { read_bookmarks(); }

void Places::read_bookmarks() {
  trouble_.clear();
  try {
    bookmarks_ = places::Bookmarks(session_.trace(), session_.lesson());
  } catch (const InputError& error) {
    trouble_ = error.what();
  }
}

std::string Places::run_until(const std::string& condition, Way way) {
  try {
    from_ = session_.position();
    search_.emplace(session_.trace(), places::Condition(session_.trace(), condition), from_, way);
  } catch (const InputError& error) {
    search_.reset();
    return error.what();
  }
  const std::string text = search_->condition().text();
  std::erase(asked_, text);
  asked_.insert(asked_.begin(), text);
  if (asked_.size() > most_asked) asked_.pop_back();
  look_on();
  return "";
}

void Places::again(Way way) {
  if (!asked_.empty()) {
    run_until(std::string(asked_.front()), way);
    return;
  }
  session_.message = "Press U and type a condition first; then J runs to the next step that fulfils it.";
}

void Places::look_on() {
  if (!search_) return;
  if (session_.position() != from_) return search_.reset();  // the reader went elsewhere
  using Result = places::Search::Result;
  const std::string text = search_->condition().text();
  const bool forwards = search_->way() == Way::forwards;
  try {
    const Result result = search_->look(searching_slice);
    if (result == Result::not_yet) return;
    const std::int64_t step = search_->step();
    search_.reset();
    if (result == Result::found) session_.go_to(step);
    session_.message = result == Result::found
                           ? fmt::format("Here {} is true; J runs on to the next step where it is.", text)
                           : fmt::format("No {} step fulfils {}.", forwards ? "later" : "earlier", text);
  } catch (const InputError& error) {
    search_.reset();
    session_.message = error.what();
  }
}

void Places::stop() {
  if (!search_) return;
  session_.message = fmt::format("Stopped looking at step {}.", grouped(search_->at()));
  search_.reset();
}

std::string Places::progress() const {
  if (!search_) return "";
  return fmt::format("Looking {} for {}: step {} of {}", search_->way() == Way::forwards ? "forwards" : "backwards",
                     search_->condition().text(), grouped(search_->at()), grouped(session_.size()));
}

std::vector<Places::Suggestion> Places::suggestions() const {
  std::vector<Suggestion> all;
  const auto add = [&](const std::string& condition, const std::string& meaning) {
    if (std::none_of(all.begin(), all.end(), [&](const Suggestion& s) { return s.condition == condition; }))
      all.push_back({condition, meaning});
  };
  for (const std::string& text : asked_) add(text, "asked before");
  const Header& header = session_.header();
  if (records(header, AtPixel::verdict)) add("not nearer", "a compare fails");
  const auto cell = session_.selected ? session_.selected : session_.current_cell();
  if (cell)
    add(fmt::format("changes({}, {})", cell->x, cell->y),
        session_.selected ? "the selected pixel changes" : "the pixel at work changes");
  if (const RecordedEvent* event = session_.event())
    if (const StepInfo* step = find_step(header.page, event->step)) add(step->name, "this line runs");
  if (const std::int32_t polygon = session_.state().machine.polygon; polygon >= 0) {
    const std::string name = polygon_label(session_.scene(), polygon);
    const bool plain =
        places::polygons_called(session_.scene(), name).size() == 1 &&
        std::all_of(name.begin(), name.end(), [](char c) { return is_letter(c) || is_digit(c) || c == '_'; });
    add(fmt::format("polygon_begin where polygon != {}", plain ? name : std::to_string(polygon)),
        "another polygon begins");
  }
  return all;
}

std::string Places::why_no_bookmark() const {
  if (!trouble_.empty()) return trouble_;
  try {
    bookmarks_.check_can_keep();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string Places::bookmark(const std::string& name) {
  if (!trouble_.empty()) return trouble_;
  try {
    bookmarks_.set(session_.position(), name);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string Places::remove_bookmark(std::size_t place) {
  try {
    bookmarks_.remove(place);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace zstep::viewer
