// The table of fields says of every kind what the vocabulary says.
#include <doctest/doctest.h>

#include <algorithm>
#include <type_traits>

#include "traces/events/fields.hpp"
#include "traces/events/slots.hpp"

using namespace zstep;

TEST_CASE("the table of fields reads and writes what the events hold, of every kind") {
  for_each_kind([]<class E>() {
    CAPTURE(description_of<E>.name);
    CHECK(description_of_kind(kind_of<E>).meaning == description_of<E>.meaning);
    CHECK(kind_names()[kind_of<E>] == description_of<E>.name);
    CHECK(event_of_kind(kind_of<E>).index() == kind_of<E>);
    REQUIRE(fields_of_kind(kind_of<E>).size() == field_count<E>);
    for_each_index<E>([]<std::size_t I>() {
      using Value = FieldValue<E, I>;
      const FieldOfKind& field = fields_of_kind(kind_of<E>)[I];
      CAPTURE(field.name);
      CHECK(field_of_kind(kind_of<E>, field.name) == &field);
      Event event = event_of_kind(kind_of<E>);
      const double value = std::is_same_v<Value, double> ? 0.1 : 1;
      field.write(event, value);
      CHECK(field.read(event) == value);
      CHECK(event.as<E>().*field_at<E, I>.member == static_cast<Value>(value));
      if constexpr (std::is_enum_v<Value>) CHECK(field.word_in(event) == words_of<Value>[1]);
    });
  });
  CHECK(field_of_kind(kind_of<DepthCompare>, "depht") == nullptr);
}
