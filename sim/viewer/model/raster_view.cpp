
#include "sim/viewer/model/raster_view.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "sim/words/numbers.hpp"
#include "traces/error.hpp"

namespace zstep::viewer {

using answers::Count;

namespace {

constexpr std::chrono::milliseconds time_a_frame{4};  // of a frame's sixteen

bool names_polygons(Count count) { return count == Count::first || count == Count::last; }

}  // namespace

std::string PixelOverlay::name(Count count) {
  switch (count) {
    case Count::writes:
      return "overdraw";
    case Count::failed:
      return "compares failed";
    case Count::first:
      return "first writer";
    case Count::last:
      return "last writer";
    case Count::work:
      return "work";
    case Count::covers:
      return "depth complexity";
  }
  return "";
}

std::string PixelOverlay::meaning(Count count) {
  switch (count) {
    case Count::writes:
      return "colours written";
    case Count::failed:
      return "fragments not nearer";
    case Count::first:
      return "whose colour it took first";
    case Count::last:
      return "whose colour it took last";
    case Count::work:
      return "steps that name it";
    case Count::covers:
      return "polygons that reached it";
  }
  return "";
}

void PixelOverlay::show(std::optional<Count> count) {
  shown_ = count;
  painted_at_ = -1;
  if (count && !counts_) counts_ = std::make_unique<answers::PixelCounts>(session_.trace());
  if (!count) counts_.reset();  // it may hold much
}

void PixelOverlay::turn(int direction) {
  constexpr int count = static_cast<int>(answers::count_kinds) + 1;  // with none, the last
  const int now = shown_ ? static_cast<int>(*shown_) : count - 1, next = (now + direction + count) % count;
  show(next == count - 1 ? std::nullopt : std::optional(static_cast<Count>(next)));
}

bool PixelOverlay::look_on() {
  if (!shown_ || painted_at_ == session_.position()) return false;
  try {
    const bool there = counts_->count_to(session_.position(), time_a_frame);
    if (!there) return false;  // what was painted stays until the new one is whole
    paint();
    painted_at_ = session_.position();
    return true;
  } catch (const InputError& error) {
    show(std::nullopt);
    session_.message = error.what();
    return true;
  }
}

void PixelOverlay::take_picture(std::optional<HeatMap>& shown) {
  if (!shown) shown.emplace();
  std::swap(*shown, picture_);
}

void PixelOverlay::paint() {
  const bool polygons = names_polygons(*shown_);
  const std::vector<std::int32_t>& values = counts_->of(*shown_);
  picture_.name = name(*shown_);
  picture_.meaning = meaning(*shown_);
  picture_.polygons = polygons;
  picture_.until = counts_->position();
  picture_.values.resize(values.size());
  const std::int32_t none = polygons ? no_polygon : 0;
  double least = std::numeric_limits<double>::infinity(), most = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    picture_.values[i] = values[i] == none ? std::nan("") : values[i];
    if (values[i] != none) least = std::min<double>(least, values[i]), most = std::max<double>(most, values[i]);
  }
  picture_.least = std::min(least, most), picture_.most = most;
}

std::string PixelOverlay::behind() const {
  if (!shown_ || counts_->position() == session_.position()) return "";
  return fmt::format("counting: step {} of {}", grouped(counts_->position()), grouped(session_.position()));
}

}  // namespace zstep::viewer
