// A condition on a step, as one types it to run until it holds: `not nearer`, `z < 4.2 && x == 9`, `polygon == B`,
// `compare where y == 3`, `changes(9, 17)`.
//
// The language is that of lessons (sim/classroom/expression.hpp). A condition speaks of the fields of events. A step
// whose event lacks a field that is named neither fulfils what is said of it nor its contrary, as NULL does in SQL:
// `not nearer` is true of compares that fail and of nothing else. What panes write is understood as well: z* or z_v for
// the depths, x_L, e3 beside `edge`. Besides fields there are
//     step              the number of the step
//     polygon           the event's own, or that of its facet or piece, or else the one at work; missing where there is
//     none,
//                       which `polygon == -1` asks for
//     line, scan_line   the y of what happens on that scan line
//     changes(x, y)     the step writes a colour or a depth to this pixel
//     touches(x, y)     its event names this pixel
//     compare, …        steps of the pseudo-code and kinds of events: true of themselves
#pragma once

#include <bitset>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "sim/classroom/expression.hpp"
#include "traces/file/trace.hpp"

namespace zstep::places {

/// What a condition alone tells of the steps that can fulfil it: where it is not worth looking.
struct Bounds {
  std::bitset<kind_count> kinds;                                            ///< of events that can
  std::optional<Trace::Pixel> pixel;                                        ///< that all of them name
  std::optional<std::int32_t> polygon;                                      ///< at work at all of them
  std::int64_t first = 1, last = std::numeric_limits<std::int64_t>::max();  ///< steps, both included
};

class Condition {
 public:
  /// Throws InputError where the text is no condition, or names what no event of this trace has. The trace must outlive
  /// it.
  Condition(const Trace& trace, const std::string& text);

  const std::string& text() const { return text_; }
  const Bounds& bounds() const { return bounds_; }
  /// Is it fulfilled by this step? Asks the trace for no event.
  bool holds(std::int64_t step, const RecordedEvent& event) const;

 private:
  enum class Op : std::uint8_t {
    constant,
    missing,
    field,
    step,
    at_work,
    changes,
    touches,
    among,
    computed,
    both_or_either,
  };
  struct Node {
    Op op = Op::missing;                    ///< missing: the event has no such field
    classroom::Expression::Kind kind = {};  ///< of what is computed
    std::int32_t first = -1, second = -1;   ///< operands, by their place among the nodes
    double number = 0;                      ///< a constant, or the pixel's column
    double row = 0;                         ///< the pixel's row
    double (*read)(const Event&) = nullptr;
    bool none_is_missing = false;  ///< of a polygon: -1 is none
    std::vector<double> set;       ///< of `among`, ordered
  };
  struct Value {
    enum class Is : std::uint8_t { missing, known };
    Is is = Is::known;
    double number = 0;
  };
  class Binder;

  Value evaluate(std::int32_t node, const Event& event, std::int64_t step) const;
  Value both_or_either(const Node& node, const Event& event, std::int64_t step) const;
  void find_bounds(const classroom::Expression& expression);
  void bound_by(const classroom::Expression& comparison, std::optional<double>& x, std::optional<double>& y);

  const Trace* trace_;
  std::string text_;
  std::vector<Node> nodes_;
  std::vector<std::int32_t> root_of_step_;  ///< by step id; -1 where it cannot fulfil the condition
  Bounds bounds_;
};

/// The polygons of a scene that are called this: by their name, in small letters if need be, or P3 for the one of index
/// 3.
std::vector<double> polygons_called(const Scene& scene, const std::string& name);

}  // namespace zstep::places
