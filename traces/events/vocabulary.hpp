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

#include <cstdint>
#include <variant>

#include "traces/events/areas.hpp"
#include "traces/events/curves.hpp"
#include "traces/events/orders.hpp"
#include "traces/events/pieces.hpp"
#include "traces/events/pixels.hpp"
#include "traces/events/polygons.hpp"
#include "traces/events/rays.hpp"
#include "traces/events/scan_conversion.hpp"
#include "traces/events/sweep.hpp"
#include "traces/events/vertices.hpp"

namespace zstep {

// --- All of them

// X(Kind) for every kind, in the order of their numbers. What follows is made from it without recursion: nearly every
// file includes this. clang-format off
#define ZSTEP_EVERY_KIND(X) \
  X(BuffersClear) X(ViewTransform) X(Projection) X(ViewportTransform) X(PolygonBegin) X(FacingTest) \
  X(PolygonReject) X(ClipTest) X(ClipVertex) X(ClipCross) X(OutlineVertex) X(EdgeTableInsert) X(EdgeTableSkip) \
  X(ScanLineBegin) X(EdgeEnter) X(EdgeRetire) X(EdgeStep) X(EdgeSwap) X(SpanBegin) X(DepthInterpolate) \
  X(DepthCompare) X(DepthWrite) X(PixelWrite) X(PixelPaint) X(ColorWrite) X(ColorBlend) X(PassBegin) \
  X(ShadowCompare) X(TablesBegin) X(PieceMake) X(PlaneEquation) X(Extent) X(PlaneDepth) X(VertexSide) \
  X(SideTest) X(ExtentTest) X(OverlapTest) X(SplitVertex) X(PieceDraw) X(Saved) X(ListInsert) X(ListRemove) \
  X(ListMark) X(PairBegin) X(RootCandidate) X(NodeMake) X(NodeAdd) X(EyeSide) X(NodeSkip) X(FlagFlip) \
  X(SpanFlags) X(ImpliedEdge) X(SpanWinner) X(CoverageAdd) X(AreaBegin) X(AreaBin) X(AreaDecide) X(BoxMake) \
  X(BoxHold) X(GridMake) X(CellHold) X(RayBegin) X(CellVisit) X(BoxTest) X(RayPlane) X(RayHit) X(RayEnd) \
  X(CurveBegin) X(CurveSegment) X(HorizonTest) X(HorizonMove) X(HorizonCross) X(LineBegin) X(LineAgainst) \
  X(LineCross) X(LineHide) X(LinePiece)
// clang-format on


namespace detail {

#define ZSTEP_NAME_KIND(E) E,
enum class KindNumber : std::uint8_t { ZSTEP_EVERY_KIND(ZSTEP_NAME_KIND) count };
#undef ZSTEP_NAME_KIND

#define ZSTEP_LIST_KIND(E) , E
template <class, class... Kinds>
struct AnyOf {
  using type = std::variant<Kinds...>;
};
using AnyKind = AnyOf<void ZSTEP_EVERY_KIND(ZSTEP_LIST_KIND)>::type;
#undef ZSTEP_LIST_KIND

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

/// Any one event. The index of the alternative is the kind's number inside this program; files know kinds by name.
using Event = detail::AnyKind;

inline constexpr std::size_t kind_count = static_cast<std::size_t>(detail::KindNumber::count);

/// The kind of a number.
template <std::size_t number>
using KindAt = typename detail::KindAt<number>::type;

/// The number of an event's kind: its index in Event.
template <class E>
inline constexpr std::uint8_t kind_of = E::is_no_event;
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

}  // namespace zstep
