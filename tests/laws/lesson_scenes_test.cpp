// Each lesson's scene is chosen so that every branch of its method's idea is taken.
#include <string>

#include <doctest/doctest.h>

#include "tests/laws/course.hpp"
#include "traces/replay/replay.hpp"

namespace zstep {
namespace {

using test::course;

/// How often an event of kind E fits in a lesson's run, with the state after it at hand.
template <class E, class Fits>
int happens(const std::string& id, Fits&& fits) {
  int count = 0;
  for (std::size_t i = 0; i < course().told.size(); ++i) {
    if (course().told[i].id != id) continue;
    const Trace& trace = course().traces[i];
    Replay replay(trace);
    for (std::int64_t position = 1; position <= trace.size(); ++position) {
      replay.go_to(position);
      if (const E* event = get_if<E>(&replay.current()->event)) count += fits(*event, replay.state().machine);
    }
  }
  return count;
}

TEST_CASE("each scene takes every branch of its method's idea") {
  const auto facing = [](Facing wanted) {
    return happens<FacingTest>("back-faces",
                               [&](const FacingTest& test, const MethodState&) { return test.facing == wanted; });
  };
  CHECK(facing(Facing::front) > 0);
  CHECK(facing(Facing::back) > 0);
  CHECK(facing(Facing::edge_on) == 1);

  for (const char* id : {"back-faces", "z-buffer", "worked-example"}) {
    CAPTURE(id);
    const auto compares = [&](auto&& fits) {
      return happens<DepthCompare>(id, [&](const DepthCompare& compare, const MethodState& machine) {
        return fits(compare, *machine.fragment);
      });
    };
    CHECK(compares([](const DepthCompare& c, const Fragment& f) { return c.nearer && f.stored == no_depth; }) > 0);
    CHECK(compares([](const DepthCompare& c, const Fragment& f) { return c.nearer && f.stored != no_depth; }) > 0);
    CHECK(compares([](const DepthCompare& c, const Fragment& f) { return !c.nearer && c.z > f.stored; }) > 0);
    const int ties = compares([](const DepthCompare& c, const Fragment& f) { return !c.nearer && c.z == f.stored; });
    CHECK(ties == (std::string(id) == "worked-example" ? 2 : 0));
  }

  const auto spans = [](auto&& fits) {
    return happens<SpanBegin>("edge-table",
                              [&](const SpanBegin& span, const MethodState& machine) { return fits(span, machine); });
  };
  CHECK(spans([](const SpanBegin& s, const MethodState&) { return s.last < s.first; }) > 0);  // empty, at a corner
  CHECK(spans([](const SpanBegin& s, const MethodState&) {
          return s.x_left != static_cast<double>(s.first) && s.first <= s.last;
        }) > 0);                                                                                  // between pixels
  CHECK(spans([](const SpanBegin&, const MethodState& m) { return m.active.size() == 4; }) > 0);  // two pairs
  CHECK(happens<EdgeRetire>("edge-table",
                            [](const EdgeRetire&, const MethodState& m) { return m.active.size() == 2; }) > 0);
  CHECK(happens<EdgeTableSkip>("worked-example", [](const EdgeTableSkip& skip, const MethodState&) {
          return skip.why == EdgeSkip::horizontal;
        }) == 2);

  const auto intervals = [](std::int32_t flags) {
    return happens<SpanFlags>("scan-line", [&](const SpanFlags& s, const MethodState&) { return s.flags == flags; });
  };
  CHECK(intervals(0) > 0);
  CHECK(intervals(1) > 0);
  CHECK(intervals(2) > 0);
  CHECK(happens<EdgeSwap>("scan-line", [](const EdgeSwap&, const MethodState&) { return true; }) > 0);
  CHECK(happens<ImpliedEdge>("scan-line", [](const ImpliedEdge&, const MethodState&) { return true; }) > 0);
  const auto saved = [](Coherence thanks_to) {
    return happens<Saved>("scan-line", [&](const Saved& s, const MethodState&) { return s.coherence == thanks_to; });
  };
  CHECK(saved(Coherence::scan_line) == 1);
  CHECK(saved(Coherence::implied_edge) == 2);

  const auto rays = [](RayRole role) {
    return happens<RayBegin>("ray-tracing", [&](const RayBegin& ray, const MethodState&) { return ray.role == role; });
  };
  CHECK(rays(RayRole::eye) > 0);
  CHECK(rays(RayRole::reflected) > 0);
  CHECK(rays(RayRole::transmitted) > 0);

  CHECK(happens<SideTest>("transparency",
                          [](const SideTest& t, const MethodState&) { return t.side == Side::crossing; }) == 1);
  const auto blended = [](auto&& fits) {
    return happens<ColorBlend>("transparency",
                               [&](const ColorBlend& b, const MethodState& m) { return fits(b, *m.fragment); });
  };
  CHECK(blended([](const ColorBlend& b, const Fragment&) { return b.opacity == 1; }) > 0);
  CHECK(blended([](const ColorBlend& b, const Fragment& f) { return b.opacity < 1 && f.stored == no_depth; }) > 0);
  CHECK(blended([](const ColorBlend& b, const Fragment& f) { return b.opacity < 1 && f.stored != no_depth; }) > 0);
}

}  // namespace
}  // namespace zstep
