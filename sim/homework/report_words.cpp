#include "sim/homework/report_words.hpp"

#include <fmt/format.h>

namespace zstep::homework {

using Why = grade::Loss::Why;

std::string_view word_of(Why why) {
  static constexpr ByEnum<Why, std::string_view, 13> words{
      "never",       "missing", "additional", "numbers",   "computation", "order", "unknown_edges",
      "not_reached", "colors",  "depths",     "no_colors", "no_depths",   "beyond"};
  return words[why];
}

std::string steps_of(const Homework& homework, const grade::Loss& loss) {
  if (loss.why == Why::order || loss.why >= Why::colors) return "";
  std::string names;
  for (const StepInfo& step : homework.steps)
    if (step.kind == loss.kind) names += (names.empty() ? "" : ", ") + step.name;
  return names;
}

std::string loss_text(const Homework& homework, const grade::Loss& loss, bool hidden) {
  const std::string names = steps_of(homework, loss), count = hidden ? "some" : fmt::format("{}", loss.count);
  const std::string pixels = hidden ? "some pixels" : fmt::format("{} pixel{}", loss.count, loss.count == 1 ? "" : "s");
  switch (loss.why) {
    case Why::never:
      return hidden ? fmt::format("{}: not printed", names) : fmt::format("{}: not printed, {} expected", names, count);
    case Why::missing:
      return fmt::format("{}: {} missing", names, count);
    case Why::additional:
      return fmt::format("{}: {} too many", names, count);
    case Why::numbers:
      return fmt::format("{}: {} with wrong numbers", names, count);
    case Why::computation:
      return fmt::format("{}: {} not following from the run's own numbers", names, count);
    case Why::order:
      return fmt::format("{} in another order than the right one", count);
    case Why::unknown_edges:
      return fmt::format("{}: {} about edges of which no edge table says which they are", names, count);
    case Why::not_reached:
      return fmt::format("{}: {} not among the steps that could be read", names, count);
    case Why::colors:
      return fmt::format("{} of another colour", pixels);
    case Why::depths:
      return fmt::format("{} of another depth", pixels);
    case Why::no_colors:
      return "no picture was handed in, which is half of this part";
    case Why::no_depths:
      return "there are no depths, which are half of this part";
    case Why::beyond:
      return fmt::format("{} drawn that should be empty", pixels);
  }
  return "";
}

std::string losses_text(const Homework& homework, const grade::PartCount& count, bool hidden) {
  std::string text;
  for (const grade::Loss& loss : count.lost) text += (text.empty() ? "" : "; ") + loss_text(homework, loss, hidden);
  return text;
}

}  // namespace zstep::homework
