// How an event is foretold from the scene and from the events of its block before it (docs/trace-format.md, "Guesses").
//
// Encoder and decoder walk an event's fields in order. What is guessed right is not stored. A guess may use what the
// file's header and scene state and what the block's earlier events told, and nothing else, so that each block is read
// without the others.
//
// The guesses themselves stand in foretell.hpp, foretell_rows.hpp and foretell_triangles.hpp,
// to be compiled into the loops that ask for them: encoder and decoder include foretell.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "traces/codec/runs.hpp"
#include "traces/codec/scene_geometry.hpp"
#include "traces/events/areas.hpp"
#include "traces/events/half_space.hpp"
#include "traces/events/slots.hpp"
#include "traces/formulas/edge_functions.hpp"
#include "traces/record/event_log.hpp"

namespace zstep::codec {

// What a block has told of pieces by their numbers, as far as it is remembered.

/// A Value for each piece that was told of: an open hash table.
template <class Value>
class ByPiece {
 public:
  /// nullptr where the block has not told of the piece.
  const Value* find(std::int32_t piece) const {
    if (entries_.empty()) return nullptr;
    const std::size_t place = place_of(piece);
    return index_[place] != 0 ? &entries_[index_[place] - 1u].value : nullptr;
  }
  /// Makes room for a piece, unless so many are remembered that no more will be.
  Value& take(std::int32_t piece) {
    if (index_.empty()) index_.resize(places);
    const std::size_t place = place_of(piece);
    if (index_[place] != 0) return entries_[index_[place] - 1u].value;
    if (entries_.size() == most) return beyond_ = Value{};
    entries_.push_back({piece, Value{}});
    index_[place] = static_cast<std::uint16_t>(entries_.size());
    return entries_.back().value;
  }
  void clear() {
    if (!entries_.empty()) entries_.clear(), index_.clear();
  }

 private:
  static constexpr std::size_t most = 4096, places = 2 * most;
  struct Entry {
    std::int32_t piece;
    Value value;
  };

  /// Where the index names this piece, or has room for it.
  std::size_t place_of(std::int32_t piece) const {
    std::size_t place = (static_cast<std::uint32_t>(piece) * 0x9e3779b1u) >> 19;  // of 8192
    while (index_[place] != 0 && entries_[index_[place] - 1u].piece != piece) place = (place + 1) % places;
    return place;
  }

  std::vector<Entry> entries_;        ///< in the order in which they were told of
  std::vector<std::uint16_t> index_;  ///< numbers of entries, from 1; 0 is none
  Value beyond_{};                    ///< one that is forgotten at once
};

// Warnock's areas, as far as a block has told of them: which pieces an area will be asked about, and in which order.
// The quarters of an area are asked about the same pieces: those that surround it, and then those that lie in it
// partly.

class KnownAreas {
 public:
  void clear() {
    around_.clear();
    told_whole_ = false;
    forget_bins();
  }

  /// The area at work; false where the block has not told of its beginning.
  bool at_work() const { return told_whole_; }
  const AreaBegin& area() const { return area_; }
  /// The piece whose bin will be told next; -1 where that is not known.
  std::int32_t next_piece() const {
    const bool known = told_whole_ && asked_.size() < around_.back().pieces.size();
    return known ? around_.back().pieces[asked_.size()] : -1;
  }
  /// Is it one that surrounded the area around this one already?
  bool surrounded_before() const { return told_whole_ && asked_.size() < around_.back().surrounding; }
  /// Those of the area at work that are not disjoint from it, in the order in which their depths are compared.
  std::size_t piece_count() const { return surrounding_.size() + partly_.size(); }
  std::int32_t piece(std::size_t place) const {
    return place < surrounding_.size() ? surrounding_[place] : partly_[place - surrounding_.size()];
  }

  void begin(const AreaBegin& event) {
    while (!around_.empty() && around_.back().area != event.parent) around_.pop_back();
    if (around_.empty()) around_.push_back({event.parent, 0, {}});
    area_ = event;
    told_whole_ = true;
    forget_bins();
  }
  void bin(const AreaBin& event) {
    asked_.push_back(event.piece);
    if (event.bin == Bin::surrounding) surrounding_.push_back(event.piece);
    else if (event.bin != Bin::disjoint) partly_.push_back(event.piece);
    if (surrounding_.size() == asked_.size()) ++leading_;
  }
  void decide() {
    if (!told_whole_) return;
    told_whole_ = false;
    // What the area around it was is told by its first quarter.
    if (Area& parent = around_.back(); parent.pieces.empty()) parent = {parent.area, leading_, asked_};
    Area decided{area_.area, surrounding_.size(), std::move(surrounding_)};
    decided.pieces.insert(decided.pieces.end(), partly_.begin(), partly_.end());
    around_.push_back(std::move(decided));
    forget_bins();
  }

 private:
  struct Area {
    std::int32_t area;
    std::size_t surrounding;           ///< how many of them surround it
    std::vector<std::int32_t> pieces;  ///< that its quarters are asked about
  };
  void forget_bins() { asked_.clear(), surrounding_.clear(), partly_.clear(), leading_ = 0; }

  std::vector<Area> around_;  ///< the area at work, from the outermost inwards, and maybe one beside it
  AreaBegin area_{};
  bool told_whole_ = false;
  std::vector<std::int32_t> asked_, surrounding_, partly_;  ///< of the area at work
  std::size_t leading_ = 0;                                 ///< that were found to surround it before any that does not
};

// The scan-line method's sweep, as far as a block has told of it: the pieces whose flag is true, in the order in which
// they became so.

class KnownSweep {
 public:
  void clear() { inside_.clear(); }

  std::size_t count() const { return inside_.size(); }
  /// -1 where the block has not told which it is.
  std::int32_t piece(std::size_t place) const { return inside_[place]; }
  bool is_inside(std::int32_t piece) const { return std::find(inside_.begin(), inside_.end(), piece) != inside_.end(); }

  void flip(std::int32_t piece, bool inside) {
    if (inside) {
      if (inside_.size() < most) inside_.push_back(piece);
      return;
    }
    auto gone = std::find(inside_.begin(), inside_.end(), piece);
    if (gone == inside_.end()) gone = std::find(inside_.begin(), inside_.end(), -1);
    if (gone != inside_.end()) inside_.erase(gone);
  }
  /// So many are inside: those that the block has not told of became so before the others.
  void expect(std::int32_t count) {
    const auto wanted = std::min(static_cast<std::size_t>(std::max(count, 0)), most);
    if (wanted > inside_.size()) inside_.insert(inside_.begin(), wanted - inside_.size(), -1);
    else inside_.erase(inside_.begin(), inside_.end() - wanted);
  }
  /// The one at this place is this piece.
  void learn(std::size_t place, std::int32_t piece) {
    if (place < inside_.size()) inside_[place] = piece;
  }

 private:
  static constexpr std::size_t most = 4096;
  std::vector<std::int32_t> inside_;
};

// The edge table and the active edge list, as far as the events of a block have told them.

struct KnownEdge : EdgeLine {
  std::int32_t first_row = 0, end_row = 0;
  double x = 0, z = 0;  ///< where it met the last scan line that told of it
  double dx_dy = 0, dz_dy = 0;
  bool entered = false;
};

class KnownEdges {
 public:
  /// The table is empty, and the list.
  void clear();

  /// An edge of the table; nullptr when this block has not told of it.
  const KnownEdge* at(std::int32_t number) const {
    const std::int64_t place = std::int64_t{number} - base_;
    return place >= 0 && place < std::ssize(edges_) ? &edges_[place] : nullptr;
  }
  KnownEdge* at(std::int32_t number) { return const_cast<KnownEdge*>(std::as_const(*this).at(number)); }
  void insert(std::int32_t number, const KnownEdge& edge);
  /// The number that the next edge will have if the table goes on as it does.
  std::int32_t next_number() const;
  /// The smallest first row of the edges in the table; -1 when there are none.
  std::int32_t first_row() const { return edges_.empty() ? -1 : first_row_; }

  /// The first two active edges; nullptr where the block has not told of both.
  std::pair<const KnownEdge*, const KnownEdge*> first_two() const {
    if (active_.size() < 2) return {};
    const KnownEdge *one = at(active_[0]), *other = at(active_[1]);
    return one != nullptr && other != nullptr ? std::pair{one, other} : std::pair<const KnownEdge*, const KnownEdge*>{};
  }
  std::int32_t number(const KnownEdge& edge) const { return base_ + static_cast<std::int32_t>(&edge - edges_.data()); }

  void begin_row();

  // --- Which edge an event will be about; -1 when that is not known.
  std::int32_t to_enter(std::int32_t row) const;
  std::int32_t place_for(const KnownEdge& edge) const;  ///< by x and then by slope
  std::int32_t to_retire(std::int32_t row) const;
  std::int32_t to_step() const { return active_at(step_); }
  std::int32_t to_begin_span(std::size_t side) const { return active_at(span_ + side); }

  // --- What events do
  void enter(std::int32_t number, std::int32_t place);
  void retire(std::int32_t number);
  void step() { ++step_; }
  void swap(std::int32_t place);
  void span() { span_ += 2; }

 private:
  std::int32_t active_at(std::size_t place) const { return place < active_.size() ? active_[place] : -1; }

  std::int32_t base_ = 0;  ///< the number of the first edge in the table
  std::vector<KnownEdge> edges_;
  std::int32_t first_row_ = 0;
  std::vector<std::int32_t> active_;
  std::size_t step_ = 0, span_ = 0, retire_ = 0;  ///< places in the list that come next
  std::size_t enter_ = 0;                         ///< place in the table after the edge that entered last
};

/// The triangle at work.
struct KnownTriangle {
  struct Edge {
    double a = 0, b = 0, x = 0, y = 0;  ///< E = a (column - x) + b (row - y)
    bool owns = false;
  };
  std::size_t of_polygon = 0;  ///< how many of its polygon the block holds
  std::array<std::int32_t, 3> vertices{};
  std::array<glm::dvec3, 3> corners{};  ///< (x_s, y_s, depth) of these
  bool known = false;                   ///< all of them
  bool told = false;                    ///< the block holds its edges; else it began within the triangle
  double twice_area = 0;
  TileTest box{}, walked{};  ///< its bounding box; the part of it in which pixels come one after another
  bool in_tiles = false;     ///< the block holds one of its tiles
  std::array<Edge, 3> edges{};
  InsideTest test{-1, -1, 0, 0, 0, false}, test_before{-1, -1, 0, 0, 0, false};  ///< the last one, and the one before
  DepthInterpolate depth{-1, -1, 0}, depth_before{-1, -1, 0};
  BarycentricWeights weights{-1, -1, 0, 0, 0};
  SampleTest sample{-1, -1, 0, 0, 0, 0, false};

  /// The edge opposite the i-th corner, as the corners say.
  Edge edge(std::size_t i) const {
    const glm::dvec3 &from = corners[(i + 1) % 3], &to = corners[(i + 2) % 3];
    const bool first = formulas::is_first_end(from.x, from.y, to.x, to.y);
    return {from.y - to.y, to.x - from.x, first ? from.x : to.x, first ? from.y : to.y};
  }
};

struct Row;

class Foreteller {
 public:
  /// `facts` must live as long as this does.
  explicit Foreteller(const SceneGeometry& facts) : facts_(&facts) {}
  /// All that the events of a block told.
  void forget();

  /// The guess for the I-th field of the next event, whose earlier fields are set in `event`. Guesses by formula are
  /// left in `event`, too.
  template <class E, std::size_t I>
  auto guess(E& event) {
    constexpr Guess way = field_at<E, I>.guess;
    using Value = FieldValue<E, I>;
    if constexpr (way == Guess::told || way == Guess::formula) {
      if constexpr (I == 0 || way != way_of_field<E, I>(-1)) {
        if constexpr (way == Guess::told) tell(event);
        else evaluate(event);
      }
      if constexpr (std::is_same_v<Value, double>) return plain(event.*field_at<E, I>.member);
      else return static_cast<std::int32_t>(event.*field_at<E, I>.member);
    } else if constexpr (std::is_same_v<Value, double>) {
      return real_[slot_at<E, I>];
    } else if constexpr (way == Guess::next) {
      return static_cast<std::int32_t>(static_cast<std::uint32_t>(whole_[slot_at<E, I>]) + 1u);
    } else {
      return whole_[slot_at<E, I>];
    }
  }

  /// Takes an event that was written or read.
  template <class E>
  void learn(const E& event) {
    for_each_index<E>([&]<std::size_t I>() {
      const auto value = event.*field_at<E, I>.member;
      if constexpr (std::is_same_v<FieldValue<E, I>, double>) real_[slot_at<E, I>] = value;
      else whole_[slot_at<E, I>] = static_cast<std::int32_t>(value);
    });
    note(event);
  }

  /// Field by field, as the numbers are still at hand: a struct that was just stored by its parts is slow to load.
  template <class E>
  static void keep(E& known, const E& event) {
    for_each_index<E>([&]<std::size_t I>() { known.*field_at<E, I>.member = event.*field_at<E, I>.member; });
  }

  /// The next event wholly as guessed; false when a guess is no value that its field can have.
  template <class E>
  bool guess_all(E& event) {
    bool possible = true;
    for_each_index<E>([&]<std::size_t I>() {
      using Value = FieldValue<E, I>;
      const auto value = guess<E, I>(event);
      if constexpr (std::is_same_v<Value, bool>) possible = possible && (value == 0 || value == 1);
      event.*field_at<E, I>.member = static_cast<Value>(value);
    });
    return possible;
  }

  /// The next scan line as it mostly is; false when the block does not tell enough of it.
  bool guess_row(Row& row) const;
  void learn_row(const Row& row);

  // --- Of the span at work
  bool in_span() const { return in_span_; }
  const SpanBegin& span() const { return span_; }
  bool increments() const { return facts_->increments(); }
  std::int32_t whole(std::size_t slot) const { return whole_[slot]; }
  double real(std::size_t slot) const { return real_[slot]; }
  void set_whole(std::size_t slot, std::int32_t value) { whole_[slot] = value; }
  void set_real(std::size_t slot, double value) { real_[slot] = value; }

 private:
  /// One NaN for all: which one a formula gives depends on the compiler.
  static double plain(double value) { return value == value ? value : std::numeric_limits<double>::quiet_NaN(); }
  /// How the field `step` places from the I-th is guessed.
  template <class E, std::size_t I>
  static constexpr Guess way_of_field(int step) {
    constexpr auto ways = []<std::size_t... K>(std::index_sequence<K...>) {
      return std::array<Guess, sizeof...(K)>{field_at<E, K>.guess...};
    }
    (std::make_index_sequence<field_count<E>>{});
    return ways[static_cast<int>(I) + step];
  }

  // For each kind that has such fields, beside the others of its theme (foretell_….hpp). An encoder may ask twice for
  // what a decoder asks once: to ask changes nothing that another answer depends on, but for what is remembered of the
  // scene.
#define ZSTEP_FORETELL(E)    \
  void tell(E& event) const; \
  void evaluate(E& event);
  ZSTEP_EVERY_KIND(ZSTEP_FORETELL)  // Guess::told: before its other fields are known; Guess::formula
#undef ZSTEP_FORETELL
  template <class E>
  void note(const E&) {}  ///< what the event changes besides its registers

  void walk_from(const TileTest& box);
  std::pair<std::int32_t, std::int32_t> next_pixel() const;
  static double carried_on(double last, double before);
  double edge_value(std::size_t i, std::int32_t x, std::int32_t y) const;
  InsideTest tested_at(std::int32_t x, std::int32_t y) const;
  std::array<double, 3> edge_values_beside(std::int32_t x, std::int32_t y, double dx, double dy) const;
  bool is_within(const std::array<double, 3>& e) const;
  double depth_by_edges(double e_1, double e_2) const;
  double depth_by_weights(std::int32_t x, std::int32_t y) const;
  /// All of a span that follows from where its ends are.
  void fill_span(SpanBegin& event, double x_left, double z_left, double x_right, double z_right) const;
  struct Range {
    double low = 0, high = 0;
  };
  Range extent_of(std::int32_t piece, Axis axis) const;
  void learn_extent(std::int32_t piece, Axis axis, Range range, Range guessed);
  /// The piece that comes after this one among those that others are held against; itself where that is not known.
  std::int32_t after(std::int32_t piece) const;
  /// From now on depths are asked for at these points, of pieces inside on a line or of those of an area.
  void begin_depths(bool on_line, const std::array<glm::dvec2, 4>& points, std::size_t count);
  /// Forgets what belongs to the polygon or piece before.
  void begin_polygon(std::span<const std::int32_t> corners);
  /// The ends of the next side of the outline, as far as they are known.
  struct Side {
    std::int32_t from = 0, to = 0;
  };
  Side next_side() const;
  /// A vertex's (x_s, y_s, depth); false when this block does not know it.
  bool find_raster(std::int32_t vertex, glm::dvec3& raster) const;
  /// The facet's corners, gone through viewing, into corner_facts_; false when there are none that could be known.
  bool look_at_corners();

  const SceneGeometry* facts_;
  std::array<std::int32_t, slot_count> whole_{};
  std::array<double, slot_count> real_{};

  Facing facing_ = Facing::front;
  std::span<const std::int32_t> corners_;     ///< of the facet at work, in the scene
  std::vector<std::int32_t> outline_;         ///< as events told it
  std::size_t side_ = 0;                      ///< sides of the outline that went to the edge table or past it
  std::vector<VertexGeometry> made_;          ///< vertices that the block made
  std::vector<VertexGeometry> corner_facts_;  ///< those of the facet at work, once looked at
  bool looked_at_corners_ = false;
  bool keeps_all_ = false;
  KnownEdges edges_;
  std::int32_t last_inserted_ = -1;
  bool in_rows_ = false;  ///< scan lines of the table have begun
  bool in_span_ = false;
  SpanBegin span_{};
  KnownTriangle triangle_;
  FacetPlane divider_;               ///< the plane that the block told of last, by the number of its piece
  bool planes_in_world_ = false;     ///< that is where the block told of it
  FacetPlane of_facet_;              ///< one that it did not tell of; what it is depends on the scene alone
  std::int32_t held_ = -1;           ///< the piece that was last held against it
  std::size_t sides_ = 0;            ///< vertices of the next one that were
  double least_ = 0, greatest_ = 0;  ///< of their values
  struct Cut {
    std::int32_t vertex;
    glm::dvec3 point;
  };
  std::vector<Cut> cuts_;                                ///< vertices that cutting made, in the space where it cut
  ByPiece<ByEnum<Axis, std::optional<Range>>> extents_;  ///< where they are not those of the scene
  std::array<Range, 2> extents_guessed_{};               ///< of the extent test at work
  ByPiece<std::int32_t> followers_;
  PairBegin pair_{-1, -1};    ///< the last one
  Axis next_axis_ = Axis::x;  ///< on which a pair is tested next
  KnownAreas areas_;
  KnownSweep sweep_;
  std::int32_t painted_ = -1;  ///< the piece that an area or an interval was given to
  bool depths_on_line_ = false;
  std::array<glm::dvec2, 4> depth_points_{};
  std::size_t depth_point_count_ = 0;              ///< 0: not known
  std::size_t depth_point_ = 0, depth_place_ = 0;  ///< of the next one: which point, of which piece in the list
  glm::dvec3 ray_from_{0}, ray_along_{0};          ///< X_0 and dX of the ray that the block told of last
};

}  // namespace zstep::codec
