// Why points are missing, in words: made of the counts that the points are made of.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "sim/homework/homework.hpp"
#include "traces/grade/count.hpp"

namespace zstep::homework {

/// "never", "missing", …: for programs.
std::string_view word_of(grade::Loss::Why why);
/// The names of the steps that a loss is about; none of pixels and of orders.
std::string steps_of(const Homework& homework, const grade::Loss& loss);
/// "interpolate_z: not printed, 83 expected". Of a hidden scene nothing is counted.
std::string loss_text(const Homework& homework, const grade::Loss& loss, bool hidden);
/// All of a part; empty where it has all points.
std::string losses_text(const Homework& homework, const grade::PartCount& count, bool hidden);

}  // namespace zstep::homework
