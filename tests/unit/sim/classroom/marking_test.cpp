// Marks made by hand: what is right is found in the steps, and each mark is held against it.
#include "sim/classroom/marking.hpp"

#include "tests/unit/sim/classroom/small_run.hpp"

namespace zstep::classroom {
namespace {

Marking marking(Marking::Kind kind, const std::string& steps, const std::string& value = "") {
  Marking made;
  made.kind = kind, made.steps = steps, made.value = value, made.steps_line = 7;
  return made;
}

/// What is right of the small run after a position, or why that cannot be asked.
std::string resolved(Marking& made, std::int64_t after) {
  const Trace trace = small_run();
  Replay replay(trace);
  return complaint([&] { resolve_marking(made, replay, after, "t.md"); });
}

using Marks = std::vector<std::int32_t>;

}  // namespace

TEST_CASE("marking: what is right begins with the step after the stop, and ends with the run") {
  Marking pixels = marking(Marking::Kind::pixels, "compare");
  CHECK(resolved(pixels, 0).empty());
  CHECK(pixels.right == Marks{0, 1, 2});
  CHECK(resolved(pixels, 15).empty());  // the compare of pixel 2 is step 15, that of pixel 0 the last
  CHECK(pixels.right == Marks{0});
  CHECK(resolved(pixels, 14).empty());
  CHECK(pixels.right == Marks{0, 2});
  CHECK(contains(resolved(pixels, 19), "no step `compare` after this stop"));
  Marking lost = marking(Marking::Kind::pixels, "compare where not nearer");
  CHECK(resolved(lost, 0).empty());
  CHECK(lost.right == Marks{0, 1});
}

TEST_CASE("marking: one scan line is right, and an order has two to four") {
  // The row is 0 everywhere, so columns stand in for scan lines.
  Marking one = marking(Marking::Kind::scan_line, "compare where x == 2", "x");
  CHECK(resolved(one, 0).empty());
  CHECK(one.right == Marks{2});
  Marking two = marking(Marking::Kind::scan_line, "compare where polygon == \"A\"", "x");
  CHECK(contains(resolved(two, 0), "2 scan lines are right"));
  Marking order = marking(Marking::Kind::order, "polygon", "polygon");
  CHECK(resolved(order, 0).empty());
  CHECK(order.right == Marks{0, 1});
  CHECK(contains(resolved(order, 2), "an order of 1 is asked for"));
}

TEST_CASE("marking: in an order each mark is held to its place, else to what is right at all") {
  Marking made;
  made.right = {3, 1, 2};
  made.kind = Marking::Kind::order;
  CHECK(judge_marks(made, Marks{3, 1, 2}).done());
  CHECK(judge_marks(made, Marks{1, 3, 2}).wrong == Marks{1, 3});
  CHECK(judge_marks(made, Marks{3}).missing == Marks{1, 2});
  CHECK_FALSE(judge_marks(made, Marks{3, 1}).done());
  CHECK(judge_marks(made, Marks{3, 1, 2, 2}).wrong == Marks{2});
  made.kind = Marking::Kind::pixels;
  CHECK(judge_marks(made, Marks{1, 2, 3}).done());
  const MarksJudged some = judge_marks(made, Marks{7, 1, 9});
  CHECK(some.wrong == Marks{7, 9});
  CHECK(some.missing == Marks{3, 2});
}

}  // namespace zstep::classroom
