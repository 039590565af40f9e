// What the link of a step is called.
#include "sim/answers/origin/fields.hpp"
#include "sim/answers/origin/work.hpp"
#include "traces/events/fields.hpp"

namespace zstep::answers {
namespace {

std::string named(const Work& work, const Event& event, std::string_view field) {
  if (field == "scan_line") return fmt::format("{}", work.machine().scan_line.value_or(0));
  const auto number = static_cast<std::int32_t>(field_number(event, field).value_or(0));
  if (const FieldOfKind* described = field_of_kind(event.index(), field)) {
    if (described->thing == Thing::vertex) return work.vertex_name(number);
    if (described->thing == Thing::edge) return fmt::format("e{}", number);
    if (described->thing == Thing::piece) return work.piece(number);
  }
  if (field == "polygon") return work.label(number);
  if (field == "upper") return number != 0 ? "upper" : "lower";
  const auto facet = static_cast<std::size_t>(number);
  if (field == "facet" && facet < work.scene.facets.size()) return work.label(work.scene.facets[facet].polygon);
  if (field == "facet") return fmt::format("facet {}", number);
  const std::string word = field_word(event, field);
  return word.empty() ? fmt::format("{}", number) : word;
}

}  // namespace

std::string what_happens(const Work& work, const Event& event) {
  const Description& description = description_of_kind(event.index());
  std::string_view pattern = description.called.empty() ? description.meaning : description.called;
  if (holds<DepthInterpolate>(event) && !work.machine().span) pattern = "depth at pixel ({x}, {y})";
  std::string text;
  std::size_t from = 0;
  for (std::size_t open = pattern.find('{'); open != pattern.npos; open = pattern.find('{', from)) {
    const std::size_t close = pattern.find('}', open);
    text.append(pattern.substr(from, open - from));
    text += named(work, event, pattern.substr(open + 1, close - open - 1));
    from = close + 1;
  }
  return text.append(pattern.substr(from));
}

}  // namespace zstep::answers
