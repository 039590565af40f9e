// The fields of events by name, from the vocabulary's own descriptions.
#include <array>
#include <type_traits>

#include "sim/classroom/names.hpp"
#include "traces/events/vocabulary.hpp"

namespace zstep::classroom {
namespace {

template <class V>
constexpr Quantity::Type type_of(std::string_view name) {
  if constexpr (std::is_same_v<V, bool>) return Quantity::Type::truth;
  else if constexpr (std::is_enum_v<V>) return Quantity::Type::word;
  else return name == "polygon" ? Quantity::Type::polygon : Quantity::Type::number;
}

template <class V>
std::span<const std::string_view> words_of_type() {
  if constexpr (std::is_enum_v<V>) return {words_of<V>.data(), words_of<V>.size()};
  else return {};
}

template <class V>
Quantity value_of(std::string_view name, V value) {
  if constexpr (std::is_same_v<V, bool>) return Quantity::of_truth(value);
  else if constexpr (std::is_enum_v<V>) return Quantity::of_word(words_of<V>[static_cast<std::size_t>(value)]);
  else if constexpr (std::is_same_v<V, double>) return Quantity::of(value);
  else return name == "polygon" ? Quantity::of_polygon(value) : Quantity::of(static_cast<double>(value));
}

template <class Visit>
void for_fields_of_kind(std::uint8_t kind, Visit&& visit) {
  for_each_kind([&]<class E>() {
    if (kind_of<E> == kind) for_each_field<E>(visit);
  });
}

}  // namespace

std::optional<FieldType> field_type(std::uint8_t kind, std::string_view name) {
  std::optional<FieldType> found;
  for_fields_of_kind(kind, [&](const auto& field) {
    using V = typename std::decay_t<decltype(field)>::value_type;
    if (field.name == name) found = FieldType{type_of<V>(name), words_of_type<V>()};
  });
  return found;
}

std::string field_names(std::uint8_t kind) {
  std::string names;
  for_fields_of_kind(kind, [&](const auto& field) {
    if (!names.empty()) names += ", ";
    names += field.name;
  });
  return names;
}

std::optional<Quantity> field_value(const Event& event, std::string_view name) {
  std::optional<Quantity> found;
  visit_event(
      [&](const auto& known) {
        using E = std::decay_t<decltype(known)>;
        for_each_field<E>([&](const auto& field) {
          if (field.name == name) found = value_of(name, known.*(field.member));
        });
      },
      event);
  return found;
}

}  // namespace zstep::classroom
