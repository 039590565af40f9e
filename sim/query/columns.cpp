#include "sim/query/columns.hpp"

#include <algorithm>
#include <array>

#include "traces/events/fields.hpp"

namespace zstep::query {

namespace {

constexpr auto named_by = [] {
  std::array<Names, kind_count> names{};
  for_each_kind([&]<class E>() { names[kind_of<E>] = names_polygon<E>; });
  return names;
}();

Table table_of(std::size_t kind) {
  const bool facet = named_by[kind] == Names::facet, piece = named_by[kind] == Names::piece;
  Table table{std::string(description_of_kind(kind).name), std::string(description_of_kind(kind).meaning), {}};
  table.columns = {{"step", "the step, counted from 1"},
                   {"name", "the line of pseudo-code that recorded it"},
                   {"polygon", facet   ? "the polygon of its facet"
                               : piece ? "the polygon of its piece"
                                       : "the polygon at work; NULL where none is"},
                   {"scan_line", "the scan line at work; NULL before the first"}};
  table.named_by_facet = facet, table.named_by_piece = piece;
  for (const FieldOfKind& field : fields_of_kind(kind)) {
    if (field.name == "polygon") {
      table.own_polygon = true;
      table.columns[polygon_column] = {"polygon", std::string(field.meaning), &field};
      continue;
    }
    if (field.name == "x") table.x = static_cast<int>(table.columns.size());
    if (field.name == "y") table.y = static_cast<int>(table.columns.size());
    table.columns.push_back({std::string(field.name), std::string(field.meaning), &field});
  }
  if (table.x < 0 || table.y < 0) table.x = table.y = -1;
  return table;
}

}  // namespace

Cell Column::of(const Event& event) const {
  switch (field->type) {
    case FieldOfKind::Type::real:
      return field->read(event);
    case FieldOfKind::Type::word:
      return field->word_in(event);
    default:
      return std::int64_t{field->whole_in(event)};
  }
}

const std::vector<Table>& all_tables() {
  static const std::vector<Table> tables = [] {
    std::vector<Table> all;
    for (std::size_t kind = 0; kind < kind_count; ++kind) all.push_back(table_of(kind));
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
