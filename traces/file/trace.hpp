// An opened trace: header, scene, and its events by position.
//
// A position counts events: position p is the moment after the first p events, from 0 (nothing has happened) to size().
// "Step p" on screen and on the command line is the event that led to position p, so steps count from 1.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "traces/events/vocabulary.hpp"
#include "traces/file/header.hpp"
#include "traces/file/source_places.hpp"
#include "traces/scene.hpp"

namespace zstep {

/// One recorded step: which line of the pseudo-code, and what it did.
struct RecordedEvent {
  std::uint8_t step = 0;  ///< id in the header's page
  Event event;
};

/// Where work on a polygon begins.
struct PolygonMark {
  std::int64_t position = 0;  ///< of the PolygonBegin event: the state just after it
  std::int32_t polygon = 0;
};

/// Where a polygon was dropped, and why.
struct RejectMark {
  std::int64_t position = 0;
  std::int32_t polygon = 0;
  Reject reason = Reject::back_facing;
};

/// How an event says which polygon it is about; `nothing`: only by what is at work.
enum class Names : std::uint8_t { nothing, polygon, facet, piece };
template <class E>
inline constexpr Names names_polygon = [] {
  if constexpr (requires(const E& event) { event.polygon; }) return Names::polygon;
  else if constexpr (requires(const E& event) { event.facet; }) return Names::facet;
  else if constexpr (requires(const E& event) { event.piece; }) return Names::piece;
  else return Names::nothing;
}();

class Trace {
 public:
  /// Opens a .ztrace file, whole or cut off. Reads header, scene and index; events are read when they are asked for.
  /// Throws InputError for what is no trace, is damaged where it cannot be missed, or comes from a newer zstep.
  static Trace open(const std::filesystem::path& path);
  /// The same from memory (a recording that was never a file). `cut`: what is said of a recording without its end, in
  /// place of the usual.
  static Trace from_bytes(std::vector<std::uint8_t> bytes, const std::string& name, const std::string& cut = "");

  Trace(Trace&&) noexcept;
  Trace& operator=(Trace&&) noexcept;
  ~Trace();

  const Header& header() const;
  const Scene& scene() const;
  const std::string& name() const;  ///< the path it was opened from, or the name given
  std::int64_t size() const;        ///< number of events
  /// Does it have all that was recorded? What the warnings say may concern something else, as an index that was made
  /// anew.
  bool whole() const;
  const std::vector<std::string>& warnings() const;  ///< "the recording was cut off; 12 041 events could be read", …
  /// The place in the program's source that printed a step, "raster.cpp:417"; empty where the run does not say. The
  /// second for who has the step at hand; the first asks for the event.
  std::string_view printed_at(std::int64_t position) const;
  std::string_view printed_at(std::int64_t position, std::uint8_t step) const;
  bool has_places() const;  ///< whether it says so of any step
  /// The line of the JSON Lines that a step was read from; 0 where the trace was read from none.
  std::int64_t line_of(std::int64_t position) const;
  void lines_are(StepLines lines);
  std::span<const PolygonMark> polygons() const;  ///< all of them, by position
  std::span<const RejectMark> rejects() const;    ///< likewise; they are read when they are first asked for
  std::span<const std::int64_t> clears() const;   ///< where the buffers are cleared; likewise
  /// The polygon that is worked on at a position: the last that was begun, until what follows is about all of them (a
  /// tree, a list, areas, rays, lines, scan lines of one table); then none, and later those whose pieces are drawn.
  std::int32_t polygon_at_work(std::int64_t position) const;
  std::int64_t end_of_turns()
      const;  ///< the position at which it is none any more; size() + 1 where that does not come
  /// The polygon that an event names, by its number, its facet or its piece, no_polygon where that does not exist;
  /// nothing if it names none.
  std::optional<std::int32_t> polygon_named(const Event& event) const;
  std::int32_t polygon_of_piece(
      std::int32_t piece) const;      ///< by the piece_make events; no_polygon where there is none
  bool has(std::uint8_t kind) const;  ///< whether some event is of this kind
  bool has(AtPixel any) const;        ///< whether some event does any of this
  /// Of what the run prints several spans before any of their pixels, as the first ones show: of a polygon at most; of
  /// the polygons of a scan line, whose edges stand in one table; of all polygons.
  enum class SpansAtOnce : std::uint8_t { of_polygon, of_line, of_all };
  SpansAtOnce spans_at_once() const;

  /// The event that leads to `position` (1 … size()). Decodes its block when it is not at hand; the reference lives
  /// until events of other blocks are asked for. Not thread-safe.
  const RecordedEvent& event(std::int64_t position) const;

  /// The position from which events on to this one (1 … size()) are read at the least cost: each block is decoded from
  /// its beginning.
  std::int64_t begin_of_block(std::int64_t position) const;

  /// Calls visit(position, step id, const E& event) for the events leading to positions first+1 … last, in order, until
  /// it returns false. Much faster than event() in a loop. Defined in traces/file/visit.hpp.
  template <class Visit>
  void visit(std::int64_t first, std::int64_t last, Visit&& visit) const;

  /// The first position > `from` (or the last < `from`) whose event satisfies the predicate, if any. `among` says which
  /// events are asked at all; blocks that hold none of them are not unpacked. The predicate depends on the event alone,
  /// as it may be asked in any order.
  using Predicate = std::function<bool(const RecordedEvent&)>;
  struct Pixel {
    std::int32_t x, y;
  };
  struct Among {
    std::optional<Pixel> pixel;         ///< events with this x and y
    std::optional<std::uint8_t> kind;   ///< events of this kind
    std::optional<std::int64_t> until;  ///< positions no farther than this one
    Among() = default;
    Among(Pixel pixel_) : pixel(pixel_) {}
    Among(std::optional<Pixel> pixel_, std::optional<std::uint8_t> kind_ = {}, std::optional<std::int64_t> until_ = {})
        : pixel(pixel_), kind(kind_), until(until_) {}
  };
  std::optional<std::int64_t> next(std::int64_t from, const Predicate& predicate, const Among& among = {}) const;
  std::optional<std::int64_t> previous(std::int64_t from, const Predicate& predicate, const Among& among = {}) const;
  /// The same with the position. The predicate must not ask the trace for events.
  using PredicateAt = std::function<bool(std::int64_t, const RecordedEvent&)>;
  std::optional<std::int64_t> next_at(std::int64_t from, const PredicateAt& predicate, const Among& among = {}) const;
  std::optional<std::int64_t> previous_at(std::int64_t from, const PredicateAt& predicate,
                                          const Among& among = {}) const;
  /// All events that are meant, in order, until the visitor returns false. It must not ask the trace for others
  /// meanwhile.
  void scan(const Among& among, const std::function<bool(std::int64_t, const RecordedEvent&)>& visit) const;
  /// Every event from the one after `first` to the `last`, in order, until the visitor returns false. What visit()
  /// does, for who does not go through many: each use of visit() is a reader of its own, which takes seconds to
  /// compile.
  void each(std::int64_t first, std::int64_t last,
            const std::function<bool(std::int64_t, const RecordedEvent&)>& visitor) const;
  /// The other way round: every event from the one that leads to `position` back to the first. For who will soon be
  /// done, and asks again near by: its blocks stay at hand.
  void each_back(std::int64_t position, const std::function<bool(std::int64_t, const RecordedEvent&)>& visitor) const;
  /// next and previous for events of one kind: condition(const E&).
  template <class E, class Condition>
  std::optional<std::int64_t> next(std::int64_t from, Condition&& condition, std::optional<Pixel> pixel = {}) const {
    return next(
        from, [&](const RecordedEvent& recorded) { return condition(get<E>(recorded.event)); },
        Among(pixel, kind_of<E>));
  }
  template <class E, class Condition>
  std::optional<std::int64_t> previous(std::int64_t from, Condition&& condition,
                                       std::optional<Pixel> pixel = {}) const {
    return previous(
        from, [&](const RecordedEvent& recorded) { return condition(get<E>(recorded.event)); },
        Among(pixel, kind_of<E>));
  }

  /// May something be done at a pixel while a polygon is worked on, or be said there to be its own? No more is read
  /// than is needed to tell: where this is false, no event at the pixel is the polygon's.
  bool may_be_of(std::int32_t polygon, Pixel pixel) const;

  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  explicit Trace(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// The pixel an event touches (depth_interpolate, depth_compare, depth_write, pixel_write), if any.
std::optional<Trace::Pixel> pixel_of(const Event& event);

}  // namespace zstep
