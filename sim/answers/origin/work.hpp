// How a chain grows: each number asks for those it was made of. For sim/answers/explain_value.cpp and the files beside
// this one.
#pragma once

#include <deque>
#include <functional>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "sim/answers/origin/chain.hpp"
#include "sim/answers/origin/find.hpp"
#include "traces/file/trace.hpp"
#include "traces/replay/replay.hpp"

namespace zstep::answers {

/// A number and the link that tells where it comes from.
struct Number {
  double value = 0;
  std::int32_t link = -1;
  std::string name = {};
  Number(double plain) : value(plain) {}
  Number(double v, std::int32_t l, std::string n) : value(v), link(l), name(std::move(n)) {}
};

struct Given {
  std::string symbol;
  Number number;
};

/// Numbers of the chain as operands of a formula of traces/formulas.
class Operands {
 public:
  Formula operator()(const std::string& symbol, const Number& number) {
    given_.push_back({symbol, number});
    return Formula(Formula::Operand{symbol, number.value});
  }
  /// Those that the formula has, in the order in which they were named.
  std::vector<Given> in(const Formula& formula) const;

 private:
  std::vector<Given> given_;
};

enum class Axis3 { x, y, z };
inline constexpr Axis3 all_axes[]{Axis3::x, Axis3::y, Axis3::z};
constexpr int operator+(Axis3 axis) { return static_cast<int>(axis); }
/// What a field of an axis is called: "z_max".
inline std::string axis_name(Axis3 axis, const char* rest = "") { return std::string(1, "xyz"[+axis]) + rest; }
/// Of a field: "x_w", "z_max", "dir_y".
inline Axis3 axis_of(std::string_view field) {
  const char letter = field[field.starts_with("dir_") ? 4 : 0];
  return letter == 'x' ? Axis3::x : letter == 'y' ? Axis3::y : Axis3::z;
}

inline constexpr std::size_t most_corners = 6;  ///< of an outline that are shown one by one

inline constexpr const char* channel_names[]{"red", "green", "blue"};
inline double channel(Color color, int which) { return which == 0 ? color.red : which == 1 ? color.green : color.blue; }

class Work;

/// One value of a link while it is being told.
class Datum {
 public:
  Datum(Work& work, std::size_t link, std::size_t place) : work_(work), link_(link), place_(place) {}
  const std::string& name() const;
  double number() const;
  /// It was computed so; see ChainValue.
  void is(std::string formula, std::vector<Given> operands, bool exact = true);
  void is(const Formula& formula, const Operands& operands, bool exact = true) {
    is(formula.text(), operands.in(formula), exact);
  }
  /// It was taken over as it was.
  void same_as(const std::string& symbol, const Number& number);
  /// Says nothing of how it was computed, but what it depends on.
  void comes_of(std::string note, const std::vector<Number>& numbers = {});
  void note(std::string text);
  /// It is a choice between true and false, of this name.
  void holds_if(std::string formula, std::vector<Given> operands);
  /// It is one of several words.
  void word(std::string one);
  /// Was anything said of it?
  bool told() const;
  /// The link's numbers are the scene's own: without rounding all follows from them.
  void given();
  /// The step's own line of the mesh file.
  void at_source(std::string source);

 private:
  ChainValue& value() const;
  Work& work_;
  std::size_t link_, place_;
};

class Work {
 public:
  Work(const Trace& trace_, Replay& replay)
      : trace(trace_),
        scene(trace_.scene()),
        conventions(trace_.header().conventions),
        replay_(replay),
        now_{replay.position()} {}

  const Trace& trace;
  const Scene& scene;
  const Conventions& conventions;
  Chain chain;

  /// The state in which numbers are looked for: that of the step that was asked about, of a later question of the
  /// chain, or of a span or an edge of other work, while it is told of. Its buffers are empty; see buffers().
  const State& state() const;
  /// A state that has the operands of a step's formulas.
  const State& operands_of(std::int64_t step, const Event& event);
  const MethodState& machine() const { return state().machine; }
  /// Do all polygons share an edge table? Pieces have one each, as they are drawn.
  bool has_one_table() const { return machine().keeps_all && machine().piece < 0; }
  /// The same state with its buffers. It moves while a number is followed back, so what is needed of it afterwards is
  /// to be copied.
  const State& buffers() const {
    replay_.go_to(now_.at);
    return replay_.state();
  }
  std::int64_t at() const { return now_.at; }
  std::string depth_name() const;
  std::string label(std::int32_t polygon) const;
  const std::string& piece(std::int32_t number) const;
  std::string step_name(std::int64_t step) const;

  /// The last step of a kind at or before this one; with a field and a value, the last one whose field has that value.
  template <class E>
  Step last(std::int64_t step) const {
    return find_last<E>(trace, step, [](const E&) { return true; });
  }
  template <class E, class Value>
  Step last(std::int64_t step, Value E::*field, std::type_identity_t<Value> value) const {
    return find_last<E>(trace, step, [&](const E& e) { return e.*field == value; });
  }

  /// The span that the pixel of a step belongs to.
  struct SpanOfStep {
    SpanBegin span{};
    Step step;
  };
  std::optional<SpanOfStep> span_of(std::int64_t step, const Event& event);

  /// A field of the event at a step, with all that is behind it. Integers and choices are numbers here, too.
  Number field(std::int64_t step, std::string_view name);
  /// The same, plain where the step is not known.
  Number field(const Step& step, std::string_view name, double otherwise);
  /// Explains a field by its formula in traces/formulas; false where it has none.
  bool tell_derived(Datum& datum, std::int64_t step, const Event& event, std::string_view field);
  void tell_formula(Datum& datum, std::int64_t step, const Event& event, std::string_view field,
                    const Formula& formula);
  /// Half the width of a window of this half height, as a number of this name at a step's link.
  Number window_width(std::int64_t step, const std::string& name, double w_y);

  /// A number with a name of its own at a step's link (what an event does not carry), told by `tell(datum)`.
  template <class Tell>
  Number derived(std::int64_t step, const std::string& subject, const std::string& what, const std::string& name,
                 double value, Tell&& tell) {
    const std::int32_t link = link_of(step, subject, what);
    if (link < 0) return value;
    const auto place = place_of(link, name, value);
    if (!place) return {value, link, name};
    Datum datum(*this, static_cast<std::size_t>(link), *place);
    const std::int32_t outer = std::exchange(current_, link);
    tell(datum);
    current_ = outer;
    return {value, link, name};
  }
  /// The same of a number with a formula.
  Number part(std::int64_t step, const std::string& name, const Formula& formula, const Operands& of) {
    return derived(step, "", "", name, formula.value(), [&](Datum& datum) { datum.is(formula, of); });
  }
  /// A number that stands since a step at which the run stood elsewhere: a field of it, told once all else is. `never`
  /// says what it is where there is no such step.
  Number kept(std::int64_t step, const std::string& subject, const std::string& what, const std::string& name,
              double value, const char* field, const std::function<Step()>& since, const char* never = "");
  /// A field of a step at which the run stood elsewhere: told once all else is, and then known to the operand with this
  /// symbol of the link at work.
  void later(std::int64_t step, std::string_view name, const std::string& symbol = "");
  void run_later();
  /// Another number of what was asked about, below it and told once all else is.
  void also(std::int64_t step, std::string_view name);

  // --- What many numbers come from (vertices.cpp, fields.cpp, orders.cpp)

  Number world(std::int32_t vertex, Axis3 axis);  ///< as the scene, or cutting in the world, has it
  Number attribute(std::int32_t vertex,
                   std::string_view component);                ///< a number besides its place, as its file has it
  Number in_scene(std::int32_t vertex, Axis3 axis);            ///< before the scene was fitted
  Number in_file(std::int32_t vertex, Axis3 axis);             ///< before the scene's file placed it
  Number viewed(std::int32_t vertex, Axis3 axis);              ///< x_v, y_v, z_v
  Number on_raster(std::int32_t vertex, Axis3 axis);           ///< x_s, y_s and the depth that is interpolated
  double raster_value(std::int32_t vertex, Axis3 axis) const;  ///< the number alone
  Number cutting(std::int32_t vertex, Axis3 axis);             ///< where pieces are cut: in the world, or on the raster
  Number projected(std::int32_t vertex, std::string_view field);
  Number edge_end(std::int32_t edge, bool lower, Axis3 axis);  ///< x_0, y_0, z_0 of a row of the edge table, or x_1 …
  Number plane(std::int32_t piece, char letter);               ///< 'A' … 'D' of a piece's plane
  Number facet_plane(std::int32_t facet, char letter);         ///< of a facet in the world, as rays meet it
  Number extent(std::int32_t piece, std::string_view field);
  Number color_of(std::int32_t polygon, int which);  ///< 0 to 255, red, green or blue; of no polygon the background's

  const VertexSteps& steps_of(std::int32_t vertex);
  Step step_of_edge(std::int32_t edge);  ///< where it entered the table
  std::string vertex_name(std::int32_t vertex) const;
  std::string source_of_polygon(std::int32_t polygon) const;
  std::string source_of_point(std::int32_t point) const;
  std::string source_line(std::int32_t line) const;
  std::string source_at(std::int32_t point, std::int32_t line) const;  ///< a line of the file that the point is from
  /// The same of a value of an attribute, which stands in the file of the vertex.
  std::string source_of_value(const VertexAttribute& attribute, std::int32_t value, std::int32_t vertex) const;

 private:
  friend class Datum;
  std::int32_t link_of(std::int64_t step, const std::string& subject, const std::string& what);
  /// Where a new value stands; nothing if it is there already.
  std::optional<std::size_t> place_of(std::int32_t link, const std::string& name, double value);

  struct Later {
    std::int64_t step;
    std::string name, symbol;
    std::int32_t parent;
  };
  struct Derived {
    std::vector<Derivation> fields;
    std::optional<SpanOfStep> span;
  };
  const Derived& derivations(std::int64_t step, const Event& event);

  /// Where numbers are looked for, and what was found there.
  struct Moment {
    std::int64_t at = 0;
    std::optional<State> state{};                    ///< kept, as each seek takes milliseconds
    std::map<std::int32_t, VertexSteps> vertices{};  ///< as far as the state has them, and so edges and names of pieces
    std::map<std::int32_t, Step> edges{};
    std::map<std::int32_t, std::string> pieces{};
    std::map<std::int64_t, bool> of_other_work{};  ///< by step
  };
  bool is_of_other_work(std::int64_t step, const Event& event) const;

  Replay& replay_;
  mutable Moment now_;
  std::map<std::int64_t, Derived> derivations_;
  std::map<std::pair<std::int64_t, std::string>, std::int32_t> links_;
  std::deque<Later> later_;
  std::int32_t current_ = -1;
  std::size_t numbers_ = 0;
};

/// Of a colour channel, the shares of a pixel that intervals of a line cover; false where the trace has none.
bool tell_coverage(Datum& datum, Work& work, std::int64_t step, std::int32_t x, std::int32_t y, int which);

/// What the link of a step is called: "depth at x = 9 on the span".
std::string what_happens(Work& work, std::int64_t step, const Event& event);

// --- The fields of events as numbers of a chain.

/// Its value as a number: that of a word is its place among the words, true is 1. Nothing where the event has no such
/// field.
std::optional<double> field_number(const Event& event, std::string_view name);
/// Of a field that is one of several words, the word; else "".
std::string field_word(const Event& event, std::string_view name);
/// What it is called in a chain: "x_L" for x_left, "1/m" for dx_dy. `depth` is what depths are called.
std::string shown_name(const Event& event, std::string_view name, const std::string& depth);
/// Tells where it comes from.
void tell_field(Datum& datum, Work& work, std::int64_t step, const Event& event, std::string_view name);

/// All of an event's fields, by name.
std::vector<std::string> fields_in(const Event& event);
/// Those that are numbers with a point.
std::vector<std::string> real_fields_in(const Event& event);
/// The one that is asked about where none is named; "" where the event has none.
std::string main_field(const Event& event);

// --- Planes of pieces, and planes through corners (orders.cpp).

/// Are pieces cut in the world, as those of a tree are?
bool cuts_in_world(const Work& work);

/// Tells a letter of the plane A x + B y + C z + D = 0 through corners: Newell's normal of length 1, through the mean.
/// The numbers on the way stand at the link of `step` and `subject`. `corner(i, axis)` is a coordinate of the i-th of
/// `count`.
using Corner = std::function<Number(std::size_t, Axis3)>;
void tell_plane(Datum& datum, Work& work, std::int64_t step, const std::string& subject, char letter, std::size_t count,
                const Corner& corner);

/// A x + B y + C z + D at a point.
Formula plane_at(Operands& of, const std::function<Number(char)>& plane, const std::function<Number(Axis3)>& point);
/// The same of a piece's plane, as a number with a name of its own at a step's link.
Number plane_value(Work& work, std::int64_t step, const char* name, std::int32_t piece,
                   const std::function<Number(Axis3)>& point);
/// Where a line is cut by a plane that has these values at its ends.
void tell_cut(Datum& datum, const Number& d_0, const Number& d_1);

// --- Where the fields come from that no formula of traces/formulas gives. What is not listed names something, or
// counts.

/// Explains a field of an event, if it is of one of the kinds of its theme; else it leaves the datum as it is.
using TellTheme = void(Datum& datum, Work& work, std::int64_t step, const Event& event, std::string_view field);
extern TellTheme *const tell_boxes,
    *const tell_curves, *const tell_light, *const tell_lines, *const tell_orders, *const tell_pixels,
                                                                                      *const tell_polygons,
                                                                                          *const tell_rays,
                                                                                              *const tell_sweep,
                                                                                                  *const tell_vertices;

/// A theme of these kinds, each of which has a function `tell` of its own.
template <class... E>
void tell_one_of(Datum& datum, Work& work, std::int64_t step, const Event& event, std::string_view field) {
  (void)((holds<E>(event) && (tell(datum, work, step, event.as<E>(), field), true)) || ...);
}

}  // namespace zstep::answers
