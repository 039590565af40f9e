// A field for which there is a formula, as its description says (`As::formula`). That each of these is given is a law
// (tests/laws).
#pragma once

#include <string_view>
#include <type_traits>

#include "traces/events/slots.hpp"

namespace zstep::formulas {

/// A field for which `derive` has a formula. Naming another one does not compile.
template <class E, class Value>
struct Follows {
  Value E::*member;
  std::string_view name = {};
  std::string_view unit = {};
  std::size_t number = 0;                               ///< of the event's fields
  consteval Follows(Value E::*which) : member(which) {  // NOLINT: what is given is a member
    for_each_index<E>([&]<std::size_t I>() {
      if constexpr (std::is_same_v<FieldValue<E, I>, Value>)
        if (field_at<E, I>.member == which) {
          if (!has(field_at<E, I>.as, As::formula)) throw "its description says that it follows from nothing";
          name = field_at<E, I>.name, unit = field_at<E, I>.unit, number = I;
        }
    });
  }
};

/// A kind of event that says something of things which it only names, and for which there is no formula.
template <class E>
inline constexpr bool joins_things = false;

}  // namespace zstep::formulas
