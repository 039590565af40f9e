#include "traces/events/fields.hpp"

#include <array>
#include <string_view>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "traces/events/slots.hpp"

namespace zstep {
namespace {

template <class E, std::size_t I>
double read_field(const Event& event) {
  return static_cast<double>(event.as<E>().*field_at<E, I>.member);
}

template <class E, std::size_t I>
void write_field(Event& event, double value) {
  using Value = FieldValue<E, I>;
  Value& field = event.as<E>().*field_at<E, I>.member;
  if constexpr (std::is_same_v<Value, bool>) field = value != 0;
  else if constexpr (std::is_enum_v<Value>) field = static_cast<Value>(static_cast<std::int32_t>(value));
  else field = static_cast<Value>(value);
}

template <class E, std::size_t I>
constexpr FieldOfKind field_row() {
  using Value = FieldValue<E, I>;
  using Type = FieldOfKind::Type;
  constexpr auto field = field_at<E, I>;
  FieldOfKind row{field.name,  field.unit, field.meaning,    field.thing,      field.as, field.guess,
                  Type::whole, {},         read_field<E, I>, write_field<E, I>};
  if constexpr (std::is_same_v<Value, double>) row.type = Type::real;
  else if constexpr (std::is_same_v<Value, bool>) row.type = Type::truth;
  else if constexpr (std::is_enum_v<Value>) {
    static_assert(!words_of<Value>.back().empty(), "fewer words than values: an array takes a list that is too short");
    row.type = Type::word, row.words = words_of<Value>;
  }
  return row;
}

template <class E>
constexpr auto field_rows = []<std::size_t... I>(std::index_sequence<I...>) {
  return std::array<FieldOfKind, sizeof...(I)>{field_row<E, I>()...};
}
(std::make_index_sequence<field_count<E>>{});

struct KindRow {
  Description description;
  std::span<const FieldOfKind> fields;
};
#define ZSTEP_ROW(E) KindRow{description_of<E>, field_rows<E>},
constexpr std::array<KindRow, kind_count> kinds{{ZSTEP_EVERY_KIND(ZSTEP_ROW)}};
#undef ZSTEP_ROW
#define ZSTEP_NAME(E) description_of<E>.name,
constexpr std::array<std::string_view, kind_count> names{ZSTEP_EVERY_KIND(ZSTEP_NAME)};
#undef ZSTEP_NAME

}  // namespace

std::span<const FieldOfKind> fields_of_kind(std::size_t kind) { return kinds[kind].fields; }

const FieldOfKind* field_of_kind(std::size_t kind, std::string_view name) {
  for (const FieldOfKind& field : fields_of_kind(kind))
    if (field.name == name) return &field;
  return nullptr;
}

const Description& description_of_kind(std::size_t kind) { return kinds[kind].description; }
std::span<const std::string_view, kind_count> kind_names() { return names; }

Event event_of_kind(std::size_t kind) {
#define ZSTEP_MAKE(E) []() -> Event { return E{}; },
  static constexpr std::array<Event (*)(), kind_count> make{ZSTEP_EVERY_KIND(ZSTEP_MAKE)};
#undef ZSTEP_MAKE
  return make[kind]();
}

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
