#include "sim/query/columns.hpp"

#include <algorithm>
#include <type_traits>

#include "traces/events/slots.hpp"

namespace zstep::query {

namespace {

template <class E, std::size_t I>
Cell read(const Event& event) {
  const auto value = get<E>(event).*field_at<E, I>.member;
  using Value = std::remove_const_t<decltype(value)>;
  if constexpr (std::is_same_v<Value, double>) return value;
  else if constexpr (std::is_enum_v<Value>) return words_of<Value>[static_cast<std::size_t>(value)];
  else return static_cast<std::int64_t>(value);
}

template <class E>
Table table_of() {
  Table table{std::string(kind_text<E>.name), std::string(kind_text<E>.meaning), {}};
  table.columns = {{"step", "the step, counted from 1"},
                   {"name", "the line of pseudo-code that recorded it"},
                   {"polygon", names_polygon<E> == Names::facet   ? "the polygon of its facet"
                               : names_polygon<E> == Names::piece ? "the polygon of its piece"
                                                                  : "the polygon at work; NULL where none is"},
                   {"scan_line", "the scan line at work; NULL before the first"}};
  table.named_by_facet = names_polygon<E> == Names::facet, table.named_by_piece = names_polygon<E> == Names::piece;
  for_each_index<E>([&]<std::size_t I>() {
    constexpr auto field = field_at<E, I>;
    if (field.name == "polygon") {
      table.own_polygon = true;
      table.columns[polygon_column] = {"polygon", std::string(field.meaning), read<E, I>};
      return;
    }
    if (field.name == "x") table.x = static_cast<int>(table.columns.size());
    if (field.name == "y") table.y = static_cast<int>(table.columns.size());
    table.columns.push_back({std::string(field.name), std::string(field.meaning), read<E, I>});
  });
  if (table.x < 0 || table.y < 0) table.x = table.y = -1;
  return table;
}

}  // namespace

const std::vector<Table>& all_tables() {
  static const std::vector<Table> tables = [] {
    std::vector<Table> all;
    for_each_kind([&]<class E>() { all.push_back(table_of<E>()); });
    return all;
  }();
  return tables;
}

std::vector<std::uint8_t> kinds_in(const Trace& trace) {
  std::vector<std::uint8_t> kinds;
  for (const StepInfo& step : trace.header().page)
    if (std::find(kinds.begin(), kinds.end(), step.kind) == kinds.end()) kinds.push_back(step.kind);
  return kinds;
}

}  // namespace zstep::query
