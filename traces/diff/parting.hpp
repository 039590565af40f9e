// Which results of a step are not what the other run has for it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "traces/diff/identity.hpp"
#include "traces/formulas/of_rays.hpp"
#include "traces/replay/same.hpp"

namespace zstep::diff {

struct Parting {
  std::uint16_t fields = 0;  ///< bit I: the I-th field differs
  float off = 0;             ///< of the numbers that differ: how far, as a share of the larger one, at most
};

inline double share_apart(double one, double other) {
  const double larger = std::max(std::abs(one), std::abs(other)), apart = std::abs(one - other);
  return std::isfinite(apart) ? apart / larger : std::numeric_limits<double>::infinity();
}

/// Of a field, its bit among Parting::fields.
template <class E>
constexpr std::uint16_t bit_of(std::string_view field) {
  std::uint16_t bit = 0;
  for_each_index<E>([&]<std::size_t I>() {
    if (field_at<E, I>.name == field) bit = static_cast<std::uint16_t>(1u << I);
  });
  return bit;
}

/// Fields that say nothing: the slope of a span without width.
template <class E>
std::uint16_t says_nothing(const E& e) {
  if constexpr (std::is_same_v<E, SpanBegin>)
    if (e.x_left == e.x_right) return bit_of<SpanBegin>("dz_dx");
  return 0;
}

/// Is a number as long as the normal of a plane, which programs make of any length? Those of the plane itself and of a
/// ray that meets it mean the same the other way round, too.
constexpr bool either_way_round(std::string_view field) {
  return field.starts_with("plane_") || field == "numerator" || field == "denominator";
}
constexpr bool as_long_as_normal(std::string_view field) {
  return either_way_round(field) || field == "value" || field == "least" || field == "greatest";
}

/// How many times as long such numbers of b are as those of a, by the largest of them; 1 where that cannot be said.
template <class E>
double times_as_long(const E& a, const E& b) {
  double largest = 0, factor = 1;
  for_each_index<E>([&]<std::size_t I>() {
    if constexpr (std::is_same_v<FieldValue<E, I>, double> && either_way_round(field_at<E, I>.name)) {
      const double mine = a.*field_at<E, I>.member, its = b.*field_at<E, I>.member;
      if (std::abs(mine) > largest && its != 0 && std::isfinite(its / mine))
        largest = std::abs(mine), factor = its / mine;
    }
  });
  return factor;
}

/// `same_thing(n)` says of the n-th number for a thing among the results whether it is the same thing in both runs.
template <class E, class SameThing>
Parting parting(const E& a, const E& b, SameThing&& same_thing) {
  Parting found;
  std::size_t thing = 0;
  const int nothing = says_nothing(a) | says_nothing(b);
  const double factor = times_as_long(a, b), box = std::max(formulas::size_of_box(a), formulas::size_of_box(b));
  for_each_index<E>([&]<std::size_t I>() {
    if constexpr (is_result<E, I>) {
      const auto& mine = a.*field_at<E, I>.member;
      const auto& its = b.*field_at<E, I>.member;
      bool equal = false;
      if constexpr (field_at<E, I>.thing != Thing::none) equal = same_thing(thing++);
      else equal = mine == its || same(mine, its);  // 0 and -0, NaN and NaN
      if (equal) return;
      found.fields = static_cast<std::uint16_t>(found.fields | 1u << I);
      if constexpr (std::is_same_v<FieldValue<E, I>, double>) {
        if ((nothing >> I & 1) != 0) return;
        const double as_long = either_way_round(field_at<E, I>.name) ? mine * factor : mine;
        const double share = box > 0 ? std::abs(mine - its) / box : share_apart(as_long, its);
        found.off = std::max(found.off, static_cast<float>(share));
      }
    }
  });
  return found;
}

/// Do both name the same things by the same numbers, so that no more than numbers that came out can differ?
template <class E>
bool same_names(const E& a, const E& b) {
  bool equal = true;
  for_each_index<E>([&]<std::size_t I>() {
    using Value = FieldValue<E, I>;
    constexpr bool came_out =
        std::is_same_v<Value, double> || (std::is_same_v<Value, bool> && !has(field_at<E, I>.as, As::subject));
    if constexpr (!came_out) equal = equal && a.*field_at<E, I>.member == b.*field_at<E, I>.member;
  });
  return equal;
}

}  // namespace zstep::diff
