#include "traces/events/document.hpp"

#include <string_view>

#include <fmt/format.h>

#include "traces/formulas/follows.hpp"

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

std::string_view origin_text(formulas::Origin origin) {
  return origin == formulas::Origin::formula ? "formula" : origin == formulas::Origin::input ? "input" : "recorded";
}

template <class Value>
std::string type_text() {
  if constexpr (std::is_same_v<Value, double>) return "float64";
  else if constexpr (std::is_same_v<Value, bool>) return "true or false";
  else if constexpr (std::is_enum_v<Value>) return fmt::format("one of {}", fmt::join(words_of<Value>, ", "));
  else return "int32";
}

}  // namespace

std::string vocabulary_markdown() {
  std::string out;
  for_each_kind([&]<class E>() {
    out += fmt::format(
        "\n### {}\n{}.\n\n| field | type | unit | guess | follows from | meaning |\n|---|---|---|---|---|---|\n",
        kind_text<E>.name, kind_text<E>.meaning);
    for_each_index<E>([&]<std::size_t I>() {
      constexpr auto field = field_at<E, I>;
      out +=
          fmt::format("| {} | {} | {} | {} | {} | {} |\n", field.name, type_text<FieldValue<E, I>>(), field.unit,
                      guess_text(field.guess), origin_text(formulas::origin_of(kind_of<E>, field.name)), field.meaning);
    });
  });
  return out;
}

}  // namespace zstep
