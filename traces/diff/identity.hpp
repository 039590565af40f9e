// The same thing under another number: what a run calls edge 7 is known by the vertices that it joins.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>

#include "traces/diff/by_number.hpp"
#include "traces/events/slots.hpp"
#include "traces/file/trace.hpp"

namespace zstep::diff {

/// Is the field a result: neither what the step is about, nor a number that the run gives to something new, nor what
/// two runs may differ in?
template <class E, std::size_t I>
inline constexpr bool is_result = !has(field_at<E, I>.as, As::subject | As::made | As::aside);

template <class E>
constexpr std::size_t things_among_results() {
  std::size_t count = 0;
  for_each_index<E>([&]<std::size_t I>() { count += is_result<E, I> && field_at<E, I>.thing != Thing::none; });
  return count;
}

/// The field with the number of what the event makes; field_count<E> where it makes nothing.
template <class E>
constexpr std::size_t number_made() {
  std::size_t found = field_count<E>;
  for_each_index<E>([&]<std::size_t I>() { found = has(field_at<E, I>.as, As::made) ? I : found; });
  return found;
}

/// Does a step of this kind say which polygon the next ones are about? It is taken note of where only one run has it,
/// if the other one's method says that by other steps.
template <class E>
inline constexpr bool says_whose_turn = std::is_same_v<E, PieceDraw>;

/// Does a run say of pixels which polygon's turn it is?
bool says_turns(const Trace& trace);

/// Follows one run and says of each step what it is about.
class Identity {
 public:
  using Key = std::uint64_t;
  using Hint = std::uint16_t;
  struct Known {
    Key about = 0;
    std::array<Key, 3> results{};  ///< the names of the things among the step's results, in the order of its fields
    Hint hint = 0;
  };

  /// What both runs say.
  struct Told {
    bool edges = true;   ///< which edges they have; else an edge is not known by its number
    bool draws = false;  ///< which piece they draw
  };
  explicit Identity(const Trace& trace, const Told& told);
  explicit Identity(const Trace& trace) : Identity(trace, Told{}) {}

  /// A number for what the step is about: the same for the same in two runs of a scene, whatever they number and in
  /// whatever order they work. Steps must be asked for one after another.
  Known of(const Event& event);
  /// The same for who need not know.
  template <class E>
  void take_note_of(const E& e);

  /// Is this step, which comes next, about the same as the one that comes next in the other run?
  template <class E>
  bool same_about(const E& e, Identity& other, const E& its);
  /// The same of pixels of the polygon at work, if they are at the same place.
  bool same_pixels(const Identity& other) const {
    return polygon_ == other.polygon_ && pass_ == other.pass_ && drawn_ == other.drawn_;
  }
  /// What `of` will say of the step that comes next.
  template <class E>
  Known known(const E& e);
  /// Found faster: steps of a kind about the same have the same. Of a pixel it is that of its scan line.
  template <class E>
  Hint hint(const E& e);
  /// Another trace's, whose run has done the same up to here.
  Identity of_same_run(const Trace& trace) const;

  /// The same for a thing, by its number in this run, and back.
  Key name_of(Thing thing, std::int32_t number) const;
  std::optional<std::int32_t> number_of(Thing thing, Key name) const;
  /// What a painted pixel is about, whichever piece of its polygon it is of.
  static Key of_any_piece(const PixelPaint& e);
  /// The scan line that an active edge moves to next.
  std::int32_t next_row(std::int32_t edge) const;

 private:
  struct Edge {
    std::int32_t next_row = 0;  ///< the scan line that it moves to next
    std::int32_t beyond = 0;    ///< the scan line after the last one that it was used on
    bool in_span = false;       ///< it was used by a span with pixels, which all programs have
    std::int32_t polygon = no_polygon;
    std::int32_t end_row = 0;    ///< as the edge table has it
    std::int32_t moved_to = -1;  ///< the scan line at work when it moved or entered last
  };
  template <class E>
  auto parts(const E& e);
  template <class E, std::size_t I>
  Key name_in(const E& e) const;
  template <class E>
  void take_note(const E& e, Key key);
  void edge_used(std::int32_t edge, std::int32_t row);
  void edge_enters(std::int32_t edge);
  std::int32_t row_of_span(const SpanBegin& e, std::int32_t edge) const;

  std::size_t points_;
  std::array<ByNumber<Key>, static_cast<std::size_t>(Thing::count)> names_;  ///< 0: none
  std::array<std::unordered_map<Key, std::int32_t>, static_cast<std::size_t>(Thing::count)> numbers_;
  std::unordered_map<Key, std::int32_t> made_;  ///< how many things were made that look alike
  ByNumber<Edge> edges_;
  std::int32_t polygon_ = no_polygon, scan_line_ = -1;
  Pass pass_ = Pass::eye;
  Key area_ = 0, ray_ = 0, curve_ = 0, node_ = 0;
  Key drawn_ = 0;            ///< the piece, where both runs say which
  std::int32_t active_ = 0;  ///< edges of the polygon at work that have entered its list and not left it
  bool turns_ = true;        ///< polygons are worked on one after another
  bool compares_ = false;    ///< pieces are compared: what enters the list now was in it before, or is a part
  Told told_;
  const Trace* trace_;
};

}  // namespace zstep::diff
