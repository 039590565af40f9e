// Which numbers follow from something that is wrong: for each place that holds numbers, the cause it goes back to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>

#include "traces/enumeration.hpp"
#include "traces/formulas/half_space.hpp"
#include "traces/formulas/of_pixels.hpp"
#include "traces/formulas/situation.hpp"

namespace zstep {

class Inheritance {
 public:
  static constexpr std::int32_t clean = -1;

  /// Nothing is wrong anywhere, so nothing needs to be looked up.
  bool empty() const { return count_ == 0; }
  std::int32_t of(const formulas::Place& place) const {
    if (empty()) return clean;
    const auto found = wrong_[place.in].find(place.number);
    return found == wrong_[place.in].end() ? clean : found->second;
  }
  void set(const formulas::Place& place, std::int32_t cause) {
    if (cause == clean && empty()) return;
    auto& there = wrong_[place.in];
    count_ -= there.size();
    if (cause != clean) there[place.number] = cause;
    else there.erase(place.number);
    count_ += there.size();
  }
  /// Each place of this sort that holds what follows from a cause.
  template <class Visit>
  void for_each(formulas::Place::In in, Visit&& visit) const {
    for (const auto& [number, cause] : wrong_[in]) visit(formulas::Place{in, number});
  }
  /// A buffer that is cleared holds nothing that is wrong.
  void clear(formulas::Place::In in) {
    count_ -= wrong_[in].size();
    wrong_[in].clear();
  }

 private:
  static constexpr std::size_t sorts = index_of(formulas::Place::In::samples) + 1;  ///< that is the last
  // Each sort has its own: what is cleared often, as the numbers of a triangle, is not to be picked out of all pixels.
  ByEnum<formulas::Place::In, std::unordered_map<std::int64_t, std::int32_t>, sorts> wrong_;
  std::size_t count_ = 0;
};

/// A box is written beside the plane of its piece, and does not make a wrong plane right.
template <class E>
inline constexpr bool adds_to_place = std::is_same_v<E, Extent>;

/// The places that an event writes to.
template <class E, class Set>
void for_each_place_written(const E& e, const formulas::Situation& at, Set&& set) {
  using formulas::Place;
  using In = Place::In;
  if constexpr (requires { e.vertex; } && !std::is_same_v<E, OutlineVertex>) {
    if constexpr (!std::is_same_v<E, ClipVertex> && !std::is_same_v<E, VertexSide>) set(Place{In::vertex, e.vertex});
  }
  if constexpr (std::is_same_v<E, EdgeTableInsert>) set(Place{In::edge_table, e.edge});
  if constexpr (std::is_same_v<E, EdgeEnter> || std::is_same_v<E, EdgeStep>) set(Place{In::active_edge, e.edge});
  if constexpr (std::is_same_v<E, PlaneEquation> || std::is_same_v<E, Extent>) set(Place{In::piece, e.piece});
  if constexpr (std::is_same_v<E, RayBegin> || std::is_same_v<E, RayPlane>) set(Place{In::ray, 0});
  if constexpr (std::is_same_v<E, HorizonMove>) set(Place{In::horizon, e.x});
  if constexpr (std::is_same_v<E, PlaneSlopes>) set(Place{In::plane, 0});
  if constexpr (std::is_same_v<E, SpanBegin>) set(at.place_of_next_span());
  if constexpr (std::is_same_v<E, TriangleSetup>) set(Place{In::triangle, formulas::detail::setup_place});
  if constexpr (std::is_same_v<E, EdgeFunction>) set(Place{In::triangle, e.edge_function});
  if constexpr (std::is_same_v<E, InsideTest>) set(Place{In::triangle, formulas::detail::test_place});
  if constexpr (std::is_same_v<E, BarycentricWeights>) set(Place{In::triangle, formulas::detail::weights_place});
  if constexpr (std::is_same_v<E, SampleTest>) set(Place{In::triangle, formulas::detail::sample_place});
  if constexpr (std::is_same_v<E, SampleDepth>)
    if (e.nearer) set(at.sample_place(e.x, e.y, e.sample));
  if constexpr (is_of_fragment(at_pixel<E>)) set(Place{In::fragment, 0});
  if constexpr (std::is_same_v<E, AttributeInterpolate>)
    set(Place{In::attribute, formulas::detail::component_at_work(
                                 at, formulas::shading_of(at.scene, at.header.conventions), e.x, e.y)});
  if constexpr (has(at_pixel<E>, AtPixel::keeps)) set(at.depth_place(e.x, e.y));
  if constexpr (has(at_pixel<E>, AtPixel::verdict))
    if (e.nearer && at.method().compares_write) set(at.depth_place(e.x, e.y));
  if constexpr (has(at_pixel<E>, AtPixel::colors)) set(Place{In::frame, at.pixel(e.x, e.y)});
}

}  // namespace zstep
