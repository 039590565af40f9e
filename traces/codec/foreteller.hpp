// How an event is foretold from the scene and from the events of its block before it (docs/trace-format.md, "Guesses").
//
// Encoder and decoder walk an event's fields in order. What is guessed right is not stored. A guess may use what the
// file's header and scene state and what the block's earlier events told, and nothing else, so that each block is read
// without the others.
//
// The guesses themselves stand in foretell_polygons.hpp, foretell_rows.hpp, foretell_pieces.hpp and foretell_areas.hpp,
// to be compiled into the loops that ask for them: encoder and decoder include foretell.hpp.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "traces/codec/by_piece.hpp"
#include "traces/codec/depths_along.hpp"
#include "traces/codec/scene_geometry.hpp"
#include "traces/codec/known_areas.hpp"
#include "traces/codec/known_edges.hpp"
#include "traces/codec/known_sweep.hpp"
#include "traces/events/slots.hpp"
#include "traces/record/event_log.hpp"

namespace zstep::codec {

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
    return ways[static_cast<std::size_t>(static_cast<int>(I) + step)];
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
  std::vector<Cut> cuts_;                                 ///< vertices that cutting made, in the space where it cut
  ByPiece<std::array<std::optional<Range>, 3>> extents_;  ///< by axis, where they are not those of the scene
  std::array<Range, 2> extents_guessed_{};                ///< of the extent test at work
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
