#include "tests/laws/decisions/decisions.hpp"

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "traces/formulas/walk.hpp"
#include "traces/oracle/errors.hpp"
#include "tests/laws/decisions/judges.hpp"

namespace zstep::oracle {

namespace {

using formulas::Situation;

class DecisionJudge {
 public:
  explicit DecisionJudge(const Trace& trace) : common_(trace) {}
  template <class E>
  void step(std::int64_t position, const E& e, const Situation& at) {
    common_.step = position;
    if (at.method().pass == Pass::light) return;
    std::apply([&](auto&... judges) { (ask(judges, e, at), ...); }, judges_);
    common_.vertices.step(e, at);
  }
  Decisions& decisions() { return common_.decisions; }

 private:
  template <class One, class E>
  void ask(One& one, const E& e, const Situation& at) {
    if constexpr (requires { one.judge(e, at); }) {
      try {
        one.judge(e, at);
      } catch (const std::domain_error&) {    // not finite
      } catch (const std::overflow_error&) {  // divided by 0
      }
    }
  }
  deciding::Common common_;
  std::tuple<deciding::PolygonJudge, deciding::PieceJudge, deciding::PlaneJudge, deciding::RayJudge,
             deciding::CurveJudge>
      judges_{common_, common_, common_, common_, common_};
};

}  // namespace

const PredicateText& text_of(Predicate which) {
  static constexpr ByEnum<Predicate, PredicateText> texts{{{
      {"side of a facet that the eye sees", "all with culling"},
      {"vertex inside a clipping plane", "all with clipping"},
      {"first and last pixel of a span", "all with spans"},
      {"left and right edge of a span", "all with spans"},
      {"nearer of two interpolated depths", "z-buffer"},
      {"side of a plane: vertex", "bsp"},
      {"side of a plane: piece", "bsp, depth-sort, scan-line"},
      {"side of a plane: eye", "bsp"},
      {"extents overlap", "depth-sort"},
      {"projections overlap", "depth-sort"},
      {"polygon against an area", "warnock"},
      {"nearer of two planes", "warnock, scan-line"},
      {"ray meets a facet from its front", "ray-casting"},
      {"ray meets inside the outline", "ray-casting"},
      {"nearer of two t", "ray-casting"},
      {"ray meets a box", "ray-casting"},
      {"curve against the horizons", "floating-horizon"},
      {"line hidden by a face", "hidden-line"},
  }}};
  return texts[which];
}

std::int64_t Decisions::wrong() const {
  std::int64_t all = 0;
  for (const Decided& decided : of) all += decided.wrong;
  return all;
}

void Decisions::add(const Decisions& other) {
  for (std::size_t i = 0; i < of.size(); ++i) {
    of[i].decisions += other.of[i].decisions, of[i].left_open += other.of[i].left_open;
    of[i].wrong += other.of[i].wrong;
    of[i].worst = std::max(of[i].worst, other.of[i].worst);
  }
}

Decisions decisions_of(const Trace& trace) {
  DecisionJudge judge(trace);
  formulas::walk(
      trace,
      [&](std::int64_t position, const auto& e, const Situation& at) {
        judge.step(position, e, at);
        return true;
      },
      [](std::int64_t, const Impossible&) {});
  if (trace.has(AtPixel::verdict) && trace.has(kind_of<SpanBegin>)) {
    const Errors errors = errors_of(trace);
    Decided& compared = judge.decisions()[Predicate::depth_compare];
    compared.decisions = errors.compares, compared.wrong = errors.all.decided_wrong;
    if (!errors.decisions.empty()) compared.first_wrong = errors.decisions[0].step;
  }
  return judge.decisions();
}

}  // namespace zstep::oracle
