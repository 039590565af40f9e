// The law of depth sort: its order of drawing never contradicts what hides what. Wherever two pieces are drawn at one
// pixel, the later one is the nearer there, or as near to 1e-5.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "algorithms/depth_sort/depth_sort.hpp"
#include "algorithms/depth_sort/painter.hpp"
#include "tests/laws/agreement/scenes.hpp"
#include "traces/record/recorder.hpp"

using namespace zstep;
using namespace zstep::test;

namespace {

struct Judged {
  int pieces = 0, overlaps = 0, contradictions = 0;
};

// Holds each painted pixel against all that was painted there before.
Judged judge(const CollectRecorder& record, const Raster& raster) {
  Judged judged;
  const auto width = static_cast<std::size_t>(raster.width);
  std::vector<double> nearest(width * static_cast<std::size_t>(raster.height), no_depth);
  for (const CollectedEvent& collected : record.events) {
    judged.pieces += holds<PieceDraw>(collected.event);
    const PixelPaint* paint = get_if<PixelPaint>(&collected.event);
    if (paint == nullptr) continue;
    double& before = nearest[static_cast<std::size_t>(paint->y) * width + static_cast<std::size_t>(paint->x)];
    if (before != no_depth) {
      ++judged.overlaps;
      judged.contradictions += paint->z > before + 1e-5 * std::max(1.0, std::abs(before));
    }
    before = std::min(before, paint->z);
  }
  return judged;
}

template <class Run>
Judged judge(const AgreementScene& subject, Run run) {
  Conventions conventions;
  conventions.cull = subject.cull;
  CollectRecorder record;
  run(subject.scene, conventions, record);
  return judge(record, subject.scene.raster);
}

}  // namespace

TEST_CASE("law: depth sort never draws what is farther over what is nearer, the painter's algorithm does") {
  Judged sorted, naive;
  for (const AgreementScene& subject : agreement_scenes()) {
    CAPTURE(subject.name);
    const Judged one = judge(subject, depth_sort::run<CollectRecorder>);
    CHECK(one.contradictions == 0);
    sorted.pieces += one.pieces, sorted.overlaps += one.overlaps;

    const Judged other = judge(subject, painter::run<CollectRecorder>);
    naive.contradictions += other.contradictions;
    if (subject.name == "intersecting" || subject.name == "cyclic") CHECK(other.contradictions > 0);
  }
  MESSAGE("depth sort drew ", sorted.pieces, " pieces and painted over ", sorted.overlaps,
          " pixels, rightly each time; the painter wrongly over ", naive.contradictions);
  CHECK(sorted.overlaps > 10'000);
}
