// What the link of a step is called.

#include "sim/answers/origin/fields.hpp"

#include <algorithm>
#include <array>

#include "sim/answers/origin/work.hpp"
#include "traces/events/fields.hpp"

namespace zstep::answers {
namespace {

/// A number that names something: what that is, and where it comes from.
void tell_name(Datum& datum, Work& work, std::string_view field, std::int32_t number, std::string_view meaning) {
  const auto at = static_cast<std::size_t>(number);
  const bool vertex = field.starts_with("vertex");
  if (number < 0) return datum.note("none");
  if (field == "polygon" || field == "owner")
    return datum.at_source(work.source_of_polygon(number)), datum.note(work.label(number));
  if (field.find("facet") != std::string_view::npos) {
    if (at >= work.scene.facets.size()) return;
    const std::int32_t polygon = work.scene.facets[at].polygon;
    datum.at_source(work.source_of_polygon(polygon));
    return datum.note("of " + work.label(polygon));
  }
  if (vertex && at < work.scene.points.size())
    return datum.comes_of("vertex " + work.vertex_name(number),
                          {work.world(number, Axis3::x), work.world(number, Axis3::y), work.world(number, Axis3::z)});
  if (vertex) {
    const Step made = work.steps_of(number).made;
    return datum.comes_of("a vertex that cutting made", {work.field(made, "t", 0)});
  }
  if (field.find("edge") != std::string_view::npos) {
    const Step row = step_of_edge(work.trace, work.machine(), work.at(), number);
    if (row) return datum.comes_of("a row of the edge table", {work.field(row, "x_edge", 0)});
  }
  if ((field == "piece" || field == "other" || field == "plane_of") && at < work.machine().pieces.size()) {
    datum.at_source(work.source_of_polygon(work.machine().pieces[at].polygon));
    return datum.note(work.piece(number));
  }
  datum.note(std::string(meaning));
}

}  // namespace

std::optional<double> field_number(const Event& event, std::string_view name) {
  const FieldOfKind* const field = field_of_kind(event.index(), name);
  return field ? std::optional(field->read(event)) : std::nullopt;
}

std::string field_word(const Event& event, std::string_view name) {
  const FieldOfKind* const field = field_of_kind(event.index(), name);
  return field && field->type == FieldOfKind::Type::word ? std::string(field->word_in(event)) : "";
}

std::string shown_name(const Event& event, std::string_view name, const std::string& depth) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 24> names{
      {{"x_left", "x_L"},  {"x_right", "x_R"}, {"z_left", "z_L"}, {"z_right", "z_R"}, {"dx_dy", "1/m"},
       {"dz_dy", "dz/dy"}, {"dz_dx", "dz/dx"}, {"x_edge", "x"},   {"plane_a", "A"},   {"plane_b", "B"},
       {"plane_c", "C"},   {"plane_d", "D"},   {"y_curve", "y"},  {"x_at", "x"},      {"y_at", "y"},
       {"x_cut", "x"},     {"y_cut", "y"},     {"z_cut", "z"},    {"dir_x", "dX_x"},  {"dir_y", "dX_y"},
       {"dir_z", "dX_z"},  {"r8", "red"},      {"g8", "green"},   {"b8", "blue"}}};
  if (name == "z" || name == "z_edge") return depth;
  if (name == "z_cut" && holds<SplitVertex>(event) && get<SplitVertex>(event).space == Space::raster) return depth;
  for (const auto& [field, shown] : names)
    if (field == name) return std::string(shown);
  return std::string(name);
}

void tell_field(Datum& datum, Work& work, std::int64_t step, const Event& event, std::string_view name) {
  using Type = FieldOfKind::Type;
  const FieldOfKind* const field = field_of_kind(event.index(), name);
  if (!field) return;
  if (field->type == Type::truth) datum.holds_if("", {});
  if (field->type == Type::word) datum.word(std::string(field->word_in(event)));
  if (field->type == Type::whole && field->unit == "index")
    return tell_name(datum, work, name, field->whole_in(event), field->meaning);
  if (work.tell_derived(datum, step, event, name)) return;
  for (TellTheme* tell : {tell_boxes, tell_curves, tell_light, tell_orders, tell_pixels, tell_planes, tell_polygons,
                          tell_rays, tell_sweep, tell_vertices})
    tell(datum, work, step, event, name);
  if (!datum.told()) datum.note(std::string(field->meaning));
}

std::vector<std::string> fields_in(const Event& event) {
  std::vector<std::string> names;
  for (const FieldOfKind& field : fields_of_kind(event.index())) names.emplace_back(field.name);
  return names;
}

std::vector<std::string> real_fields_in(const Event& event) {
  std::vector<std::string> names;
  for (const FieldOfKind& field : fields_of_kind(event.index()))
    if (field.type == FieldOfKind::Type::real) names.emplace_back(field.name);
  return names;
}

std::string main_field(const Event& event) {
  const std::span<const FieldOfKind> fields = fields_of_kind(event.index());
  for (const char* wanted : {"attribute", "z", "t", "y_curve", "value", "x_edge", "z_left", "distance", "z_light",
                             "view_dot_normal", "t_enter", "nearer"})
    for (const FieldOfKind& field : fields)
      if (field.name == wanted) return wanted;
  for (const FieldOfKind& field : fields)
    if (field.type == FieldOfKind::Type::real) return std::string(field.name);
  return fields.empty() ? "" : std::string(fields.front().name);
}

namespace {

std::string named(const Work& work, const Event& event, std::string_view field) {
  if (field == "scan_line") return fmt::format("{}", work.machine().scan_line.value_or(0));
  const auto number = static_cast<std::int32_t>(field_number(event, field).value_or(0));
  if (const FieldOfKind* described = field_of_kind(event.index(), field)) {
    if (described->thing == Thing::vertex) return work.vertex_name(number);
    if (described->thing == Thing::edge) return fmt::format("e{}", number);
    if (described->thing == Thing::piece) return work.piece(number);
  }
  if (field == "polygon") return work.label(number);
  if (field == "upper") return number != 0 ? "upper" : "lower";
  const auto facet = static_cast<std::size_t>(number);
  if (field == "facet" && facet < work.scene.facets.size()) return work.label(work.scene.facets[facet].polygon);
  if (field == "facet") return fmt::format("facet {}", number);
  const std::string word = field_word(event, field);
  return word.empty() ? fmt::format("{}", number) : word;
}

}  // namespace

std::string what_happens(const Work& work, const Event& event) {
  const Description& description = description_of_kind(event.index());
  std::string_view pattern = description.called.empty() ? description.meaning : description.called;
  if (holds<DepthInterpolate>(event) && !work.machine().span) pattern = "depth at pixel ({x}, {y})";
  std::string text;
  std::size_t from = 0;
  for (std::size_t open = pattern.find('{'); open != pattern.npos; open = pattern.find('{', from)) {
    const std::size_t close = pattern.find('}', open);
    text.append(pattern.substr(from, open - from));
    text += named(work, event, pattern.substr(open + 1, close - open - 1));
    from = close + 1;
  }
  return text.append(pattern.substr(from));
}

}  // namespace zstep::answers
