// What is marked by hand before the run does it: which steps say what is right, and how far marks agree with them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sim/classroom/lesson.hpp"
#include "traces/record/recorder.hpp"
#include "traces/replay/replay.hpp"

namespace zstep::classroom {

/// Checks the names of what a marking says is right against a method's page. Throws InputError.
void check_marking(const Marking& marking, const Page& page, const std::string& file);

/// Finds what is right in the steps after a position. Throws InputError where nothing is, or more than can be marked:
/// one scan line, two to four polygons in an order.
void resolve_marking(Marking& marking, Replay& replay, std::int64_t after, const std::string& file);

}  // namespace zstep::classroom

namespace zstep {

/// How far marks agree with what is right.
struct MarksJudged {
  std::vector<std::int32_t> wrong;  ///< in the order in which they were made; in an order: what stands at a wrong place
  std::vector<std::int32_t> missing;  ///< right, and not marked
  bool done() const { return wrong.empty() && missing.empty(); }
};
/// The polygons of an order as they are offered: by number, so that they give nothing away.
std::vector<std::int32_t> choices_of(const Marking& marking);
MarksJudged judge_marks(const Marking& marking, std::span<const std::int32_t> marks);

}  // namespace zstep
