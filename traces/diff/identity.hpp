// The same thing under another number: what a run calls edge 7 is known by the vertices that it joins. Until the other
// run has it too, its steps wait.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "traces/events/slots.hpp"
#include "traces/file/trace.hpp"
#include "traces/formulas/spans_ahead.hpp"

namespace zstep::diff {

// What is known of things by their numbers.

/// Numbers that a run gives one after another are looked up in a vector, any others in a map. What was never set is
/// T{}.
template <class T>
class ByNumber {
 public:
  T operator[](std::int32_t number) const {
    if (is_dense(number)) return dense_[index(number)];
    if (sparse_.empty()) return T{};
    const auto found = sparse_.find(number);
    return found == sparse_.end() ? T{} : found->second;
  }
  T& edit(std::int32_t number) {
    if (is_dense(number)) return dense_[index(number)];
    if (number < 0 || index(number) > 2 * dense_.size() + few) return sparse_[number];
    dense_.resize(index(number) + 1);
    std::erase_if(sparse_, [&](const auto& entry) {
      const bool moves = is_dense(entry.first);
      if (moves) dense_[index(entry.first)] = entry.second;
      return moves;
    });
    return dense_[index(number)];
  }

 private:
  static constexpr std::size_t few = 4096;
  static std::size_t index(std::int32_t number) { return number; }
  bool is_dense(std::int32_t number) const { return number >= 0 && index(number) < dense_.size(); }

  std::vector<T> dense_;
  std::unordered_map<std::int32_t, T> sparse_;
};

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
    bool ahead = false;  ///< or one of them: spans of several polygons before any pixel
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
  /// The polygon that a step is part of: mostly the one at work.
  template <class E>
  std::int32_t polygon_of(const E& e) const;

  std::size_t points_;
  ByEnum<Thing, ByNumber<Key>> names_;  ///< 0: none
  ByEnum<Thing, std::unordered_map<Key, std::int32_t>> numbers_;
  std::unordered_map<Key, std::int32_t> made_;  ///< how many things were made that look alike
  ByNumber<Edge> edges_;
  std::int32_t polygon_ = no_polygon, scan_line_ = -1;
  std::optional<formulas::SpansAhead> ahead_;  ///< says of which polygon a pixel is, where not of the one at work
  Pass pass_ = Pass::eye;
  Key area_ = 0, ray_ = 0, curve_ = 0, node_ = 0, triangle_ = 0;
  Key drawn_ = 0;            ///< the piece, where both runs say which
  std::int32_t active_ = 0;  ///< edges of the polygon at work that have entered its list and not left it
  bool turns_ = true;        ///< polygons are worked on one after another
  bool compares_ = false;    ///< pieces are compared: what enters the list now was in it before, or is a part
  Told told_;
  const Trace* trace_;
};

// Steps of a run that wait for their partner in the other one.

/// A step, and what it is about.
struct Keyed {
  Identity::Known known;
  std::int64_t position = 0;
  RecordedEvent event;
};

/// First come, first served: a chain of places for each thing that they are about.
class Waiting {
 public:
  bool empty() const { return chains_.empty(); }
  std::size_t size() const { return steps_.size() - free_.size(); }
  bool has(Identity::Key key) const { return chains_.contains(key); }
  /// Can a step of this kind with this hint be among them? Mostly not, and then nothing else needs to be asked.
  bool may_have(std::uint8_t kind, Identity::Hint hint) const { return of_kind_[kind] != 0 && hinted_[hint]; }
  void put(const Keyed& step) {
    if (++put_ > few + 2 * size()) {
      put_ = 0;
      hinted_.reset();
      each([&](const Keyed& other) { hinted_.set(other.known.hint); });
    }
    hinted_.set(step.known.hint);
    ++of_kind_[step.event.event.index()];
    std::uint32_t place = 0;
    if (free_.empty()) {
      place = static_cast<std::uint32_t>(steps_.size());
      steps_.push_back({step, end});
    } else {
      place = free_.back();
      free_.pop_back();
      steps_[place] = {step, end};
    }
    const auto [chain, fresh] = chains_.try_emplace(steps_[place].step.known.about, Chain{place, place});
    if (fresh) return;
    steps_[chain->second.last].next = place;
    chain->second.last = place;
  }
  std::optional<Keyed> take(Identity::Key key) {
    const auto chain = chains_.find(key);
    if (chain == chains_.end()) return std::nullopt;
    const std::uint32_t place = chain->second.first;
    free_.push_back(place);
    --of_kind_[steps_[place].step.event.event.index()];
    if (place == chain->second.last) chains_.erase(chain);
    else chain->second.first = steps_[place].next;
    return steps_[place].step;
  }
  template <class Visit>
  void each(Visit&& visit) const {
    for (const auto& [key, chain] : chains_)
      for (std::uint32_t place = chain.first; place != end; place = steps_[place].next) visit(steps_[place].step);
  }

 private:
  static constexpr std::uint32_t end = 0xffffffff;
  static constexpr std::size_t few = 4096;
  struct Place {
    Keyed step;
    std::uint32_t next = end;
  };
  struct Chain {
    std::uint32_t first = 0, last = 0;
  };
  std::vector<Place> steps_;
  std::vector<std::uint32_t> free_;
  std::unordered_map<Identity::Key, Chain> chains_;
  std::array<std::uint32_t, kind_count> of_kind_{};
  std::bitset<std::size_t{std::numeric_limits<Identity::Hint>::max()} + 1> hinted_;  ///< also of some that have left
  std::size_t put_ = 0;                                                              ///< since those were forgotten
};

}  // namespace zstep::diff
