#include "sim/places/fields.hpp"

#include <array>
#include <vector>

#include "traces/events/slots.hpp"

namespace zstep::places {
namespace {

template <class E, std::size_t I>
double read(const Event& event) {
  return static_cast<double>((*get_if<E>(&event)).*field_at<E, I>.member);
}

template <class E>
std::vector<Field> table_of() {
  std::vector<Field> fields;
  for_each_index<E>([&]<std::size_t I>() {
    const std::string_view name = field_at<E, I>.name;
    fields.push_back({name, *classroom::field_type(kind_of<E>, name), read<E, I>, field_at<E, I>.unit});
  });
  return fields;
}

}  // namespace

std::span<const Field> fields_of_kind(std::uint8_t kind) {
  static const auto tables = [] {
    std::array<std::vector<Field>, kind_count> all;
    for_each_kind([&]<class E>() { all[kind_of<E>] = table_of<E>(); });
    return all;
  }();
  return tables[kind];
}

const Field* field_of_kind(std::uint8_t kind, std::string_view name) {
  for (const Field& field : fields_of_kind(kind))
    if (field.name == name) return &field;
  return nullptr;
}

}  // namespace zstep::places
