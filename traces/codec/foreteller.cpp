#include "traces/codec/foreteller.hpp"

#include <algorithm>

#include "traces/codec/foretell.hpp"
#include "traces/scene.hpp"

namespace zstep::codec {

namespace {

// Guesses look no farther than this, so that a block with thousands of active edges stays cheap.
constexpr std::size_t look_ahead = 16, list_limit = 4096, places_limit = 64, retire_limit = 1024;

}  // namespace

void KnownEdges::clear() {
  base_ = 0, first_row_ = 0;
  edges_.clear(), active_.clear();
  step_ = span_ = retire_ = enter_ = 0;
}

std::int32_t KnownEdges::next_number() const { return base_ + size32(edges_); }

void KnownEdges::insert(std::int32_t number, const KnownEdge& edge) {
  if (number != next_number() || number < 0) {
    edges_.clear();
    base_ = number;
    enter_ = 0;
  }
  first_row_ = edges_.empty() ? edge.first_row : std::min(first_row_, edge.first_row);
  edges_.push_back(edge);
}

void KnownEdges::begin_row() {
  step_ = span_ = retire_ = 0;
  if (edges_.size() <= look_ahead) enter_ = 0;
}

std::int32_t KnownEdges::to_enter(std::int32_t row) const {
  const std::size_t end = std::min(edges_.size(), enter_ + look_ahead);
  for (std::size_t i = enter_; i < end; ++i)
    if (!edges_[i].entered && edges_[i].first_row == row) return base_ + static_cast<std::int32_t>(i);
  return -1;
}

std::int32_t KnownEdges::place_for(const KnownEdge& edge) const {
  const std::size_t end = std::min(active_.size(), places_limit);
  for (std::size_t place = 0; place < end; ++place) {
    const KnownEdge* other = at(active_[place]);
    if (other == nullptr) continue;
    if (edge.x != other->x ? edge.x < other->x : edge.dx_dy < other->dx_dy) return static_cast<std::int32_t>(place);
  }
  return size32(active_);
}

std::int32_t KnownEdges::to_retire(std::int32_t row) const {
  const std::size_t end = std::min(active_.size(), retire_ + retire_limit);
  for (std::size_t place = retire_; place < end; ++place) {
    const KnownEdge* edge = at(active_[place]);
    if (edge != nullptr && edge->end_row == row) return active_[place];
  }
  return active_at(0);
}

void KnownEdges::enter(std::int32_t number, std::int32_t place) {
  if (KnownEdge* edge = at(number)) {
    edge->entered = true;
    enter_ = static_cast<std::size_t>(number - base_) + 1;
    if (edges_.size() <= look_ahead) enter_ = 0;
  }
  if (active_.size() >= list_limit) active_.clear();
  const std::size_t where = std::min(static_cast<std::size_t>(std::max(place, 0)), active_.size());
  active_.insert(active_.begin() + where, number);
}

void KnownEdges::retire(std::int32_t number) {
  auto found = std::find(active_.begin() + (std::min(retire_, active_.size())), active_.end(), number);
  if (found == active_.end()) found = std::find(active_.begin(), active_.end(), number);
  if (found == active_.end()) return;
  retire_ = static_cast<std::size_t>(found - active_.begin());  // the next one on this row stands no further left
  active_.erase(found);
}

void KnownEdges::swap(std::int32_t place) {
  const std::size_t left = place;
  if (place >= 0 && left + 1 < active_.size()) std::swap(active_[left], active_[left + 1]);
}

void Foreteller::forget() {
  whole_.fill(0);
  real_.fill(0);
  facing_ = Facing::front;
  keeps_all_ = false;
  begin_polygon({});
  last_inserted_ = -1;
  divider_ = {};
  planes_in_world_ = false;
  held_ = -1;
  sides_ = 0;
  cuts_.clear();
  extents_.clear(), followers_.clear();
  pair_ = {-1, -1};
  next_axis_ = Axis::x;
  areas_.clear();
  painted_ = -1;
  sweep_.clear();
  triangle_ = {};
  begin_depths(false, {}, 0);
  ray_from_ = ray_along_ = glm::dvec3(0);
}

}  // namespace zstep::codec
