#include "traces/formulas/follows.hpp"

namespace zstep::formulas {
namespace {

constexpr std::size_t words_in(std::string_view list) {
  std::size_t count = 0;
  for_each_word(list, [&](std::string_view) { ++count; });
  return count;
}

/// The table has the fields of this kind, each once, and no others.
template <class E>
struct Complete {
  static constexpr const FollowsOf& row = follows_of[kind_of<E>];
  static_assert(row.kind == kind_text<E>.name, "the table has another kind here");
  static_assert(words_in(row.formula) + words_in(row.input) + words_in(row.recorded) == field_count<E>,
                "the table has another number of fields than this kind");
  template <std::size_t field>
  struct Has {
    static_assert(origin_of(kind_of<E>, field_at<E, field>.name) != Origin::none,
                  "derive this field, or declare it an input");
  };
  template <std::size_t... field>
  static constexpr bool each(std::index_sequence<field...>) {
    return (sizeof(Has<field>) * ... * 1) > 0;
  }
  static constexpr bool value = each(std::make_index_sequence<field_count<E>>{});
};

constexpr bool all_complete() {
  bool all = true;
  for_each_kind([&]<class E>() { all = all && Complete<E>::value; });
  return all;
}
static_assert(all_complete());

}  // namespace
}  // namespace zstep::formulas
