#include "traces/events/document.hpp"

#include <string_view>

#include <fmt/format.h>

#include "traces/events/fields.hpp"

namespace zstep {

namespace {

std::string_view guess_text(Guess guess) {
  switch (guess) {
    case Guess::next:
      return "one more";
    case Guess::told:
      return "told before";
    case Guess::formula:
      return "by formula";
    default:
      return "the same";
  }
}

std::string_view origin_text(As as) {
  return has(as, As::formula) ? "formula" : has(as, As::recorded) ? "recorded" : "input";
}

std::string type_text(const FieldOfKind& field) {
  switch (field.type) {
    case FieldOfKind::Type::real:
      return "float64";
    case FieldOfKind::Type::truth:
      return "true or false";
    case FieldOfKind::Type::word:
      return fmt::format("one of {}", fmt::join(field.words, ", "));
    case FieldOfKind::Type::whole:
      break;
  }
  return "int32";
}

}  // namespace

std::string vocabulary_markdown() {
  std::string out;
  for (std::size_t kind = 0; kind < kind_count; ++kind) {
    out += fmt::format(
        "\n### {}\n{}.\n\n| field | type | unit | guess | follows from | meaning |\n|---|---|---|---|---|---|\n",
        description_of_kind(kind).name, description_of_kind(kind).meaning);
    for (const FieldOfKind& field : fields_of_kind(kind))
      out += fmt::format("| {} | {} | {} | {} | {} | {} |\n", field.name, type_text(field), field.unit,
                         guess_text(field.guess), origin_text(field.as), field.meaning);
  }
  return out;
}

}  // namespace zstep
