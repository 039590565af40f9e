// What the answers for the families of methods share. For why_not*.cpp only.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "sim/answers/origin/chain.hpp"
#include "sim/answers/origin/find.hpp"
#include "sim/answers/pixel_history.hpp"
#include "sim/answers/visits.hpp"
#include "sim/answers/why_not.hpp"
#include "sim/truth/sight.hpp"
#include "sim/words/explain.hpp"
#include "sim/words/numbers.hpp"
#include "traces/replay/replay.hpp"

namespace zstep::answers {

/// A depth with the digits that tell depths apart, and with a real minus sign.
inline std::string told(double z) { return with_minus_signs(depth_text(z)); }
/// Two of them, with more digits where these are the same and the depths are not.
inline std::pair<std::string, std::string> told_apart(double a, double b) {
  std::pair<std::string, std::string> texts{told(a), told(b)};
  return a == b || texts.first != texts.second ? texts : tell_apart(a, b);
}
/// "Δz = z of A − z of B = 2 − (−1) = 3".
inline std::string difference(const std::string& symbol, const std::string& one, const std::string& other, double a,
                              double b) {
  const auto [first, second] = told_apart(a, b);
  return fmt::format("\u0394{0} = {0} of {1} \u2212 {0} of {2} = {3} \u2212 {4} = {5}", symbol, one, other, first,
                     b < 0 ? "(" + second + ")" : second, told(a - b));
}

/// A question: this polygon at this pixel.
struct Asked {
  const Trace& trace;
  const Scene& scene;
  std::int32_t polygon;
  Trace::Pixel pixel;
  std::string name;   ///< the polygon's label
  std::string where;  ///< "at pixel (3, 4)"
  std::string z;      ///< what depths are called

  /// `at_hand`: a replay of the trace that may be moved, or none.
  Asked(const Trace& asked, Replay* at_hand, std::int32_t of, Trace::Pixel at);

  std::string label(std::int32_t other) const { return polygon_label(scene, other); }
  std::vector<std::int32_t> facets() const;  ///< the polygon's
  /// From now on verdicts are about the whole picture, and have no pixel.
  void ask_anywhere() { where = "anywhere", anywhere_ = true; }

  /// "A is not seen at pixel (3, 4): " and the reason; of what is seen, how.
  Verdict verdict(Why kind, std::int64_t step, const std::string& reason) const;
  template <class First, class... More>
  Verdict verdict(Why kind, std::int64_t step, fmt::format_string<First, More...> reason, First&& first,
                  More&&... more) const {
    return verdict(kind, step, fmt::format(reason, std::forward<First>(first), std::forward<More>(more)...));
  }
  /// Adds what the words say of a step of a polygon in numbers to the verdict's formulas; of one at a pixel by what
  /// came to the pixel there.
  void add_formulas(Verdict& verdict, std::int64_t step, std::int32_t of, const Visit* visit = nullptr);
  void add_formulas(Verdict& verdict, std::int64_t step) { add_formulas(verdict, step, polygon); }
  void add_formulas(Verdict& verdict, const Visit& visit) { add_formulas(verdict, visit.step, visit.polygon, &visit); }
  Replay* replay() { return at_hand_ != nullptr ? at_hand_ : own_ ? &*own_ : nullptr; }
  /// By a replay: dear in a long trace, so only for what single events cannot tell.
  const State& state_at(std::int64_t step);

 private:
  bool anywhere_ = false;
  Replay* at_hand_;
  std::optional<Replay> own_;  ///< where none was at hand
};

/// Which of two that are equally near was kept: by the rule of ties that the header declares, where that gives it.
inline std::string kept_in_tie(const Header& header, bool kept_is_first, const char* else_word) {
  const bool by_rule =
      header.declares(Convention::ties) && kept_is_first == (header.comparison.ties == Comparison::Ties::first);
  if (!by_rule) return else_word;
  return kept_is_first ? "comes first in the file" : "comes last in the file";
}

/// One facet of the polygon before the raster: was it drawn, and does it cover the pixel?
struct FacetThere {
  std::int32_t facet = -1;
  std::int64_t mark = 0;               ///< where work on it begins, 0 where that is not recorded
  std::int64_t reject_step = 0;        ///< 0 if it was not rejected
  Reject reason = Reject::degenerate;  ///< if it was
  bool away = false;                   ///< it faces away, and such are not drawn
  std::optional<compare::FacetAt> at;  ///< facing left aside
  std::optional<Trace::Pixel> surely;  ///< whose centre it covers beyond rounding
  std::optional<double> cut_at;        ///< z_v at which it would be seen, were it not before near or beyond far
  bool rejected() const { return reject_step != 0; }
  bool covers() const { return at && at->candidate.covers; }
};
std::vector<FacetThere> facets_there(Asked& q);
/// The trace marks where work on polygons begins, and never does so for this facet.
bool never_begun(const Asked& q, const FacetThere& there);

/// Why the polygon left nothing at the pixel, by its facets: culled, clipped, beside the pixel …
/// nullopt if one that was drawn covers the centre: then the method has to say why.
std::optional<Verdict> why_by_facets(Asked& q, const std::vector<FacetThere>& facets);
/// The same for one facet that does not cover the centre.
std::string beside_text(const Asked& q, const FacetThere& facet);

/// What leaves the pixel out of a facet that is drawn as triangles, each as three half-planes: the edge whose wrong
/// side the centre lies on, or the tile that was rejected. `mark`: where work on the facet begins.
struct LeftOut {
  std::int64_t step = 0;
  std::string text;
};
std::optional<LeftOut> left_out_by_triangles(const Asked& q, std::int64_t mark);
/// It has a share of the pixel, which is mixed in, and another or none has the centre. `step` tells the share.
Verdict mixed_by_share(Asked& q, std::int64_t step, double share);
/// The tile around the pixel was rejected by its farthest depth.
std::optional<Verdict> why_tile_hidden(Asked& q, const std::vector<FacetThere>& facets,
                                       const std::vector<Visit>& visits);

// By families of methods, each with the question whether a trace decides so what is seen at a pixel, by the events that
// it has. `facets` are those of the polygon; none throws for what a foreign trace leaves out.
bool of_curves(const Trace& trace);
bool of_lines(const Trace& trace);
bool of_rays(const Trace& trace);
bool of_areas(const Trace& trace);
bool of_sweep(const Trace& trace);
Verdict why_by_curves(Asked& q);
Verdict why_by_lines(Asked& q);
Verdict why_by_rays(Asked& q, const std::vector<FacetThere>& facets);
Verdict why_by_areas(Asked& q, const std::vector<FacetThere>& facets);
Verdict why_by_sweep(Asked& q, const std::vector<FacetThere>& facets);
Verdict why_by_pixels(Asked& q, const std::vector<FacetThere>& facets);  ///< all others: compared or painted one by one

// Of a polygon on the whole picture.
Verdict curves_anywhere(Asked& q);
Verdict lines_anywhere(Asked& q);
/// The pixel's own verdict, in a sentence that begins with the whole picture.
Verdict with_pixel(const Asked& q, Trace::Pixel pixel, const std::string& whole);
/// "1 edge", "2 edges".
std::string count_text(std::size_t count, const char* one, const char* many);

/// Why one piece was drawn before another: the tree's plane between them, or their places in the list.
void add_order(Asked& q, Verdict& verdict, std::int64_t earlier, std::int64_t later);

/// The first step in (from, end) that gives the pixel a colour; with no end, of all.
std::optional<std::int64_t> next_color(const Asked& q, std::int64_t from, std::int64_t end = 0);
/// It covers the pixel, but the trace says no more.
Verdict not_recorded(const Asked& q);
/// The trace says where work on polygons begins, and of this one it never does.
Verdict not_begun(const Asked& q);
/// It is what is seen: "A is what is seen at pixel (3, 4): how"; `what` the step did where the pixel does not become
/// the polygon's own.
Verdict seen(Asked& q, std::int64_t step, const std::string& how, const std::string& what = "");

}  // namespace zstep::answers
