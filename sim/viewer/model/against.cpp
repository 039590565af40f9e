#include "sim/viewer/model/against.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "sim/words/derived.hpp"
#include "sim/words/numbers.hpp"
#include "traces/diff/buffers.hpp"
#include "traces/events/fields.hpp"
#include "traces/formulas/walk.hpp"

namespace zstep::viewer {

BeforeChange::BeforeChange(const Session& now, std::shared_ptr<const Trace> before)
    : now_(now),
      trace_(std::move(before)),
      both_(diff::align(now.trace(), *trace_, nullptr, diff::Way::fast, 0)),
      session_(*trace_, nullptr) {}

void BeforeChange::follow() { session_.go_to(moment_in_b(both_, now_.position(), now_.size(), session_.size())); }

std::int64_t moment_in_b(const diff::Alignment& both, std::int64_t at, std::int64_t size_a, std::int64_t size_b) {
  if (at == 0) return 0;
  if (at == size_a) return size_b;
  const std::int64_t partner = both.in_b(at);
  return partner != 0 ? partner : both.before_in_b(at);
}

Against::Against(Session& a, const AgainstRun& with)
    : a_(a), report_(*with.report), b_(*with.trace, nullptr), marks_a_(*this, true), marks_b_(*this, false) {}

Against::Place Against::place_of(const diff::Difference& difference) const {
  const diff::Alignment& both = report_.alignment;
  return {difference.only_b() ? both.before_in_a(difference.b) : difference.a,
          difference.only_a() ? both.before_in_b(difference.a) : difference.b};
}

void Against::follow() {
  const std::int64_t at = a_.position();
  b_.selected = a_.selected;
  if (followed_ == at) return;
  followed_ = at;
  b_.go_to(moment_in_b(report_.alignment, at, a_.size(), b_.size()));
}

void Against::go_to(const Place& place) {
  a_.go_to(place.a);
  b_.go_to(place.b);
  followed_ = a_.position();
}

void Against::follow_second() {
  const std::int64_t at = b_.position();
  const diff::Alignment& both = report_.alignment;
  const std::int64_t partner = at == 0 ? 0 : at == b_.size() ? a_.size() : both.in_a(at);
  a_.playing = false;
  go_to({partner != 0 || at == 0 ? partner : both.before_in_a(at), at});
}

namespace {

/// The nearest of these that lies beyond a place.
template <class Places, class PlaceOf>
auto beyond(const Places& places, const Against::Place& here, int direction, PlaceOf&& place_of) {
  std::optional<Against::Place> best;
  for (const auto& one : places) {
    const Against::Place place = place_of(one);
    if (direction > 0 ? place > here && (!best || place < *best) : place < here && (!best || place > *best))
      best = place;
  }
  return best;
}

}  // namespace

std::optional<Against::Place> Against::next_cause(int direction) const {
  return beyond(causes_, here(), direction, [](const Place& place) { return place; });
}

std::optional<Against::Place> Against::next_difference(int direction) const {
  const Place now = here();
  if (direction > 0) {
    const auto next = std::upper_bound(parted_.begin(), parted_.end(), now,
                                       [](const Place& place, const Parted& one) { return place < one.place; });
    return next == parted_.end() ? std::nullopt : std::optional(next->place);
  }
  const auto next = std::lower_bound(parted_.begin(), parted_.end(), now,
                                     [](const Parted& one, const Place& place) { return one.place < place; });
  return next == parted_.begin() ? std::nullopt : std::optional(std::prev(next)->place);
}

std::optional<Against::Alike> Against::next_alike(int direction) {
  if (alike_at_ != here()) {
    const Parted* parted = parted_here();
    if (!parted) return std::nullopt;
    alike_ = parted->number;
  }
  const std::vector<diff::Difference>& all = report_.alignment.differences;
  const diff::Difference& like = all[alike_];
  Alike found{here(), fields_of(like), 0, 0};
  bool beyond_here = false;
  for (const Parted& one : parted_) {
    const diff::Difference& other = all[one.number];
    if (other.kind != like.kind || (like.fields == 0 ? other.fields != 0 : (other.fields & like.fields) == 0)) continue;
    ++found.all;
    const bool before = one.place<here(), after = one.place> here();
    const bool take = direction > 0 ? after && !beyond_here : before;
    if (take || (found.number == 0 && one.place == here())) found.place = one.place, found.number = found.all;
    beyond_here = beyond_here || after;
  }
  alike_at_ = found.place;
  return found;
}

std::string Against::fields_of(const diff::Difference& difference) const {
  std::string fields;
  const std::span<const FieldOfKind> all = fields_of_kind(difference.kind);
  for (std::size_t i = 0; i < all.size(); ++i)
    if ((difference.fields >> i & 1) != 0) fields += (fields.empty() ? "" : ", ") + std::string(all[i].name);
  const Trace& trace = difference.only_a() ? a_.trace() : b_.trace();
  const StepInfo* step = find_step(trace.header().page, difference.line);
  const std::string name = step ? step->name : "the step";
  return fields.empty() ? name + " in one run alone" : fields + " of " + name;
}

const Against::Parted* Against::parted_here() const {
  const Place now = here();
  const auto found = std::lower_bound(parted_.begin(), parted_.end(), now,
                                      [](const Parted& one, const Place& place) { return one.place < place; });
  return found != parted_.end() && found->place == now ? &*found : nullptr;
}

const std::vector<PixelMark>& Against::pixels() {
  if (pixels_at_ == here()) return pixels_;
  pixels_at_ = here();
  pixels_.clear();
  const Picture &a = a_.state().picture_of_pass(), &b = b_.state().picture_of_pass();
  if (a.width != b.width || a.height != b.height) return pixels_;  // the one is at what the light sees
  const diff::BufferDifference found =
      diff::compare_pictures(diff::buffers_of(a_.trace(), a), diff::buffers_of(b_.trace(), b), report_.precision);
  for (std::size_t i = 0; i < found.apart.size(); ++i) {
    if (!(found.apart[i] > 0)) continue;
    const bool colored = a.polygon[i] != b.polygon[i] || (!a.ink.empty() && !b.ink.empty() && a.ink[i] != b.ink[i]);
    pixels_.push_back({static_cast<std::int64_t>(i), colored});
  }
  return pixels_;
}

const std::optional<Against::PixelApart>& Against::first_pixel_apart() {
  if (looked_for_pixel_) return pixel_apart_;
  looked_for_pixel_ = true;
  std::optional<std::int64_t> first;
  a_.look_elsewhere([&](Replay& end_a) {
    b_.look_elsewhere([&](Replay& end_b) {
      end_a.go_to(a_.size());
      end_b.go_to(b_.size());
      const Picture &a = end_a.state().picture, &b = end_b.state().picture;
      first =
          diff::compare_pictures(diff::buffers_of(a_.trace(), a), diff::buffers_of(b_.trace(), b), report_.precision)
              .first;
    });
  });
  if (!first) return pixel_apart_;
  const auto width = a_.scene().raster.width;
  const Cell cell{static_cast<std::int32_t>(*first % width), static_cast<std::int32_t>(*first / width)};
  pixel_apart_ = PixelApart{cell, std::nullopt};
  for (const Parted& parted : parted_) {
    const diff::Difference& difference = report_.alignment.differences[parted.number];
    const Trace& trace = difference.only_b() ? b_.trace() : a_.trace();
    const auto pixel = pixel_of(trace.event(difference.only_b() ? difference.b : difference.a).event);
    if (!pixel || pixel->x != cell.x || pixel->y != cell.y) continue;
    pixel_apart_->place = parted.place;
    break;
  }
  return pixel_apart_;
}

// ---- What is marked and said of either run ------------------------------------------------------------------------

Against::Marks::Marks(Against& of, bool first) : of_(of), first_(first) {
  constexpr std::size_t most = 4'000'000;  // later differences are not marked
  const std::vector<diff::Difference>& differences = of.report_.alignment.differences;
  if (first) {
    of.parted_.reserve(std::min(most, differences.size()));
    for (std::size_t i = 0; i < std::min(most, differences.size()); ++i)
      of.parted_.push_back({of.place_of(differences[i]), i});
    std::stable_sort(of.parted_.begin(), of.parted_.end(),
                     [](const Parted& one, const Parted& other) { return one.place < other.place; });
    for (const diff::Cause& cause : of.report_.causes) of.causes_.push_back(of.place_of(cause.first));
  }
  for (const Parted& parted : of.parted_) steps_.push_back(first ? parted.place.a : parted.place.b);
  std::sort(steps_.begin(), steps_.end());
  for (const Place& cause : of.causes_) causes_.push_back(first ? cause.a : cause.b);
}

std::string Against::Marks::name_of(std::size_t number) const {
  const diff::Cause& cause = of_.report_.causes[number];
  const Trace& trace = cause.first.only_a() ? of_.a_.trace() : of_.b_.trace();
  return fmt::format("Cause {} of {}, {}", number + 1, causes_.size(), step_and_subject(trace, cause.first.line, ""));
}

bool Against::Marks::any_follows(std::int64_t first, std::int64_t last) const {
  const auto found = std::lower_bound(steps_.begin(), steps_.end(), first);
  return found != steps_.end() && *found <= last;
}

const StepMarks::Told& Against::Marks::told(Session& session) {
  if (told_at_ == of_.here()) return told_;
  told_at_ = of_.here();
  told_ = {};
  const std::int64_t step = session.position();
  const char* other = first_ ? "B" : "A";
  const Parted* parted = of_.parted_here();
  if (!parted) {
    const diff::Alignment& both = of_.report_.alignment;
    if (!first_ && of_.a_.position() > 0 && of_.a_.position() < of_.a_.size() && both.in_b(of_.a_.position()) != step)
      told_.note = "B has no such step as A's. This is its last one before it.";
    return told_;
  }
  const diff::Difference& difference = of_.report_.alignment.differences[parted->number];
  const bool has = first_ ? !difference.only_b() : !difference.only_a();
  std::string subject;
  if (has) {
    const Event event = session.trace().event(step).event;
    session.look_elsewhere([&](Replay& replay) {
      formulas::look_before(session.trace(), replay, step, [&](const formulas::Situation& before) {
        subject = subject_of(event, before);
        if (!difference.only_a() && !difference.only_b()) told_.lines = field_texts(event, before, difference.fields);
      });
    });
  }
  std::string cause;
  for (std::size_t i = 0; i < of_.causes_.size() && cause.empty(); ++i)
    if (of_.report_.causes[i].first.a == difference.a && of_.report_.causes[i].first.b == difference.b) {
      const std::string follows = what_follows(of_.report_.causes[i]);
      cause = fmt::format("{}{}: {}{}.", name_of(i), subject.empty() ? "" : ", " + subject,
                          why_cause(of_.report_.causes[i]), follows.empty() ? "" : "; " + follows);
    }
  if (!has)
    told_.note = fmt::format("{} has a step here that this run does not have. This is the last one before it.", other);
  else if (!cause.empty()) told_.note = cause;
  else if (difference.only_a() || difference.only_b()) told_.note = fmt::format("{} has no such step.", other);
  else told_.note = fmt::format("This step is not as {} has it.", other);
  return told_;
}

}  // namespace zstep::viewer
