// The fields of events by name, from the vocabulary's own descriptions.
#include "sim/classroom/names.hpp"

namespace zstep::classroom {

Quantity::Type type_of(const FieldOfKind& field) {
  switch (field.type) {
    case FieldOfKind::Type::truth:
      return Quantity::Type::truth;
    case FieldOfKind::Type::word:
      return Quantity::Type::word;
    default:
      return field.name == "polygon" ? Quantity::Type::polygon : Quantity::Type::number;
  }
}

std::optional<Quantity> field_value(const Event& event, std::string_view name) {
  const FieldOfKind* const field = field_of_kind(event.index(), name);
  if (!field) return std::nullopt;
  if (field->type == FieldOfKind::Type::word) return Quantity::of_word(field->word_in(event));
  return Quantity{type_of(*field), field->read(event), {}};
}

}  // namespace zstep::classroom
