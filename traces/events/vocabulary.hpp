// The vocabulary of traces: every kind of event that a run can leave behind.
//
// One vocabulary serves all methods, so that one pixel can be followed through all of them. An event carries the
// operands of its computation and the result; what a replay already knows at that point (the stored depth before a
// compare, a vertex's world coordinates) is not stored again. A new kind needs two methods that use it, or proof that
// none of these says it (docs/adding-an-algorithm.md).
//
// "depth" as a unit means the buffer's own numbers: pseudodepth, z_v or the scene's z, as the trace's conventions say.
//
// The kinds stand by theme in the headers below; here is the list of them all.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <new>
#include <type_traits>

#include "traces/events/areas.hpp"
#include "traces/events/curves.hpp"
#include "traces/events/half_space.hpp"
#include "traces/events/orders.hpp"
#include "traces/events/pieces.hpp"
#include "traces/events/pixels.hpp"
#include "traces/events/polygons.hpp"
#include "traces/events/rays.hpp"
#include "traces/events/scan_conversion.hpp"
#include "traces/events/sweep.hpp"

namespace zstep {

// --- All of them

// X(Kind) for every kind, in the order of their numbers. What follows is made from it without recursion: nearly every
// file includes this.
// clang-format off
#define ZSTEP_EVERY_KIND(X) \
  X(BuffersClear) X(ViewTransform) X(Projection) X(ViewportTransform) X(PolygonBegin) X(FacingTest) \
  X(PolygonReject) X(ClipTest) X(ClipVertex) X(ClipCross) X(OutlineVertex) X(EdgeTableInsert) X(EdgeTableSkip) \
  X(ScanLineBegin) X(EdgeEnter) X(EdgeRetire) X(EdgeStep) X(EdgeSwap) X(PlaneSlopes) X(SpanBegin) X(DepthInterpolate) \
  X(DepthCompare) X(DepthWrite) X(PixelWrite) X(AttributeInterpolate) X(PixelPaint) X(ColorWrite) X(ColorBlend) \
  X(PassBegin) X(ShadowCompare) X(TablesBegin) X(PieceMake) X(PlaneEquation) X(Extent) X(PlaneDepth) X(VertexSide) \
  X(SideTest) X(ExtentTest) X(OverlapTest) X(SplitVertex) X(PieceDraw) X(Saved) X(ListInsert) X(ListRemove) \
  X(ListMark) X(PairBegin) X(RootCandidate) X(NodeMake) X(NodeAdd) X(EyeSide) X(NodeSkip) X(FlagFlip) \
  X(SpanFlags) X(ImpliedEdge) X(SpanWinner) X(CoverageAdd) X(AreaBegin) X(AreaBin) X(AreaDecide) X(BoxMake) \
  X(BoxHold) X(GridMake) X(CellHold) X(RayBegin) X(CellVisit) X(BoxTest) X(RayPlane) X(RayHit) X(RayEnd) \
  X(CurveBegin) X(CurveSegment) X(HorizonTest) X(HorizonMove) X(HorizonCross) X(LineBegin) X(LineAgainst) \
  X(LineCross) X(LineHide) X(LinePiece) X(TriangleSetup) X(EdgeFunction) X(TileTest) X(TileDepthTest) X(InsideTest) \
  X(BarycentricWeights) X(ShadowBias) X(ShadowNeighbour) X(LightShare) X(SampleTest) X(SampleDepth) X(SampleMask)
// clang-format on

namespace detail {

#define ZSTEP_NAME_KIND(E) E,
enum class KindNumber : std::uint8_t { ZSTEP_EVERY_KIND(ZSTEP_NAME_KIND) count };
#undef ZSTEP_NAME_KIND

template <std::size_t number>
struct KindAt;
#define ZSTEP_NUMBER_KIND(E)                               \
  template <>                                              \
  struct KindAt<static_cast<std::size_t>(KindNumber::E)> { \
    using type = E;                                        \
  };
ZSTEP_EVERY_KIND(ZSTEP_NUMBER_KIND)
#undef ZSTEP_NUMBER_KIND

}  // namespace detail

inline constexpr std::size_t kind_count = static_cast<std::size_t>(detail::KindNumber::count);

/// The kind of a number.
template <std::size_t number>
using KindAt = typename detail::KindAt<number>::type;

/// The number of an event's kind: its index in Event.
template <class E>
inline constexpr std::uint8_t kind_of = 255;
#define ZSTEP_NUMBER_KIND(E) \
  template <>                \
  inline constexpr std::uint8_t kind_of<E> = static_cast<std::uint8_t>(detail::KindNumber::E);
ZSTEP_EVERY_KIND(ZSTEP_NUMBER_KIND)
#undef ZSTEP_NUMBER_KIND

/// Calls `function.template operator()<E>()` for every kind of event, in order.
template <class Function>
constexpr void for_each_kind(Function&& function) {
  [&]<std::size_t... I>(std::index_sequence<I...>) { (function.template operator()<KindAt<I>>(), ...); }
  (std::make_index_sequence<kind_count>{});
}

namespace detail {
#define ZSTEP_SIZE(E) , sizeof(E)
[[noreturn]] void wrong_kind();
inline constexpr std::size_t largest_kind = std::max({std::size_t{0} ZSTEP_EVERY_KIND(ZSTEP_SIZE)});
#undef ZSTEP_SIZE
}  // namespace detail

/// Any one event: what a std::variant of all kinds is, but compiled in no time, and copied as bytes. The index is the
/// kind's number inside this program; files know kinds by name.
class Event {
 public:
  Event() : Event(BuffersClear{}) {}
  template <class E>
  requires(kind_of<E> < kind_count) Event(const E& event) : kind_(kind_of<E>) {  // NOLINT: an event is any event
    static_assert(std::is_trivially_copyable_v<E> && alignof(E) <= alignof(double));
    ::new (static_cast<void*>(bytes_)) E(event);
  }
  std::size_t index() const { return kind_; }

  /// As an event of the kind that it is.
  template <class E>
  const E& as() const {
    return *std::launder(reinterpret_cast<const E*>(bytes_));
  }
  template <class E>
  E& as() {
    return *std::launder(reinterpret_cast<E*>(bytes_));
  }

 private:
  alignas(double) std::byte bytes_[detail::largest_kind];
  std::uint8_t kind_;
};

/// Is it one of this kind?
template <class E>
bool holds(const Event& event) {
  return event.index() == kind_of<E>;
}
/// Where it is, the event itself; else nullptr.
template <class E>
const E* get_if(const Event* event) {
  return holds<E>(*event) ? &event->as<E>() : nullptr;
}
template <class E>
E* get_if(Event* event) {
  return holds<E>(*event) ? &event->as<E>() : nullptr;
}
/// The event itself. Throws std::bad_cast where it is of another kind.
template <class E>
const E& get(const Event& event) {
  if (!holds<E>(event)) detail::wrong_kind();
  return event.as<E>();
}
template <class E>
E& get(Event& event) {
  if (!holds<E>(event)) detail::wrong_kind();
  return event.as<E>();
}

/// function(const E&), by what the event is.
template <class Function, class AnyEvent>
requires std::is_same_v<std::remove_const_t<AnyEvent>, Event>
decltype(auto) visit_event(Function&& function, AnyEvent& event) {
  switch (static_cast<detail::KindNumber>(event.index())) {
#define ZSTEP_CASE(E)         \
  case detail::KindNumber::E: \
    return function(event.template as<E>());
    ZSTEP_EVERY_KIND(ZSTEP_CASE)
#undef ZSTEP_CASE
    case detail::KindNumber::count:
      break;
  }
  detail::wrong_kind();
}

/// What an event of a kind does at its pixel, where only running tells the kind.
AtPixel at_pixel_of(std::size_t kind);
inline AtPixel at_pixel_of(const Event& event) { return at_pixel_of(event.index()); }

}  // namespace zstep
