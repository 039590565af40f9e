// What theory allows the depths of two runs that are compared.
#include "sim/cost/bounds.hpp"

#include <doctest/doctest.h>

#include "tests/zoo/runs.hpp"
#include "traces/diff/buffers.hpp"
#include "traces/diff/diff.hpp"
#include "traces/replay/replay.hpp"

using namespace zstep;

namespace {

/// Depths go through 0, so that in float32 no share of a depth says how far it may be off.
zoo::Task through_zero() {
  zoo::Task task;
  task.width = 40, task.height = 36;
  task.points = {{1.125, 1.375, -0.9}, {38.5, 4.25, 0.95}, {6.75, 33.625, 0.3},
                 {36, 2, 0.8},         {35, 33, -0.7},     {3, 20, 0.1}};
  task.polygons = {{0, {0, 1, 2}}, {1, {3, 4, 5}}};
  return task;
}
Trace drawn(const char* format, double off = 0) {
  zoo::Task task = through_zero();
  task.style = std::string("rows edge_functions weights ") + format;
  for (zoo::Point& point : task.points) point.z += off;
  Conventions conventions;
  conventions.number_format = format == std::string("float32") ? NumberFormat::float32 : NumberFormat::float64;
  conventions.interpolation = Conventions::Interpolation::plane;
  return test::trace_of(test::head("z-buffer", test::scene_of(through_zero()), conventions) + zoo::variants(task));
}

TEST_CASE("diff: depths that agree within the bound of their number format are equal") {
  const Trace exact = drawn("float64"), narrow = drawn("float32"), wrong = drawn("float32", 1e-4);
  const HeldTo held = compare::held_to_bounds(exact, narrow);
  REQUIRE(held.depths);
  const auto compared = [&](const Trace& b, const HeldTo& to) {
    return diff::compare(exact, b, nullptr, diff::Way::fast, to);
  };
  CHECK(compared(narrow, {}).differences() > 0);  // by shares alone it looks wrong
  const diff::DiffReport right = compared(narrow, held);
  CHECK(right.differences() == 0);
  CHECK(right.kinds[kind_of<DepthCompare>].different == 0);
  CHECK(right.kinds[kind_of<DepthCompare>].rounding > 100);
  Replay end_exact(exact), end_narrow(narrow);
  end_exact.go_to(exact.size()), end_narrow.go_to(narrow.size());
  const diff::BufferDifference pictures =
      diff::compare_pictures(diff::buffers_of(exact, end_exact.state().picture),
                             diff::buffers_of(narrow, end_narrow.state().picture), right.precision);
  CHECK(pictures.depths == 0);
  CHECK(pictures.depths_rounded > 100);
  // What is farther off than the bound is not.
  const diff::DiffReport off = compared(wrong, held);
  CHECK(off.differences() > 100);
  CHECK(off.kinds[kind_of<DepthCompare>].rounding == 0);
}

}  // namespace
