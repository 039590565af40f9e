#include "sim/answers/origin/fields.hpp"

#include <algorithm>
#include <array>
#include <type_traits>

namespace zstep::answers {
namespace {

/// A field's value without its type: what is needed of it here.
struct Described {
  std::string_view name, unit, meaning, word;
  double number = 0;
  bool choice = false, whole = false, real = false;
};

template <class V>
Described described(std::string_view name, std::string_view unit, std::string_view meaning, V value) {
  Described field{name,
                  unit,
                  meaning,
                  "",
                  static_cast<double>(value),
                  std::is_same_v<V, bool>,
                  std::is_same_v<V, std::int32_t>,
                  std::is_same_v<V, double>};
  if constexpr (std::is_enum_v<V>) field.word = words_of<V>[static_cast<std::size_t>(value)];
  return field;
}

using AllFields = std::vector<Described>;
void add(AllFields& all, const Described& field) { all.push_back(field); }

/// All of them; the one place that goes through the fields of every kind, as that takes long to compile.
AllFields described_fields(const Event& event) {
  AllFields all;
  void (*const keep)(AllFields&, const Described&) = add;  // one call a field
  visit_event(
      [&](const auto& known) {
        for_each_field<std::decay_t<decltype(known)>>([&](const auto& field) {
          keep(all, described(field.name, field.unit, field.meaning, known.*(field.member)));
        });
      },
      event);
  return all;
}

std::optional<Described> field_of(const Event& event, std::string_view name) {
  for (const Described& field : described_fields(event))
    if (field.name == name) return field;
  return std::nullopt;
}

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
  const auto field = field_of(event, name);
  return field ? std::optional(field->number) : std::nullopt;
}

std::string field_word(const Event& event, std::string_view name) {
  const auto field = field_of(event, name);
  return field ? std::string(field->word) : "";
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
  const auto field = field_of(event, name);
  if (!field) return;
  if (field->choice) datum.holds_if("", {});
  if (!field->word.empty()) datum.word(std::string(field->word));
  if (field->whole && field->unit == "index")
    return tell_name(datum, work, name, static_cast<std::int32_t>(field->number), field->meaning);
  if (work.tell_derived(datum, step, event, name)) return;
  for (TellTheme* tell : {tell_boxes, tell_curves, tell_light, tell_orders, tell_pixels, tell_planes, tell_polygons,
                          tell_rays, tell_sweep, tell_vertices})
    tell(datum, work, step, event, name);
  if (!datum.told()) datum.note(std::string(field->meaning));
}

std::vector<std::string> fields_in(const Event& event) {
  std::vector<std::string> names;
  for (const Described& field : described_fields(event)) names.emplace_back(field.name);
  return names;
}

std::vector<std::string> real_fields_in(const Event& event) {
  std::vector<std::string> names;
  for (const Described& field : described_fields(event))
    if (field.real) names.emplace_back(field.name);
  return names;
}

std::string main_field(const Event& event) {
  const std::vector<Described> fields = described_fields(event);
  for (const char* wanted : {"attribute", "z", "t", "y_curve", "value", "x_edge", "z_left", "distance", "z_light",
                             "view_dot_normal", "t_enter", "nearer"})
    for (const Described& field : fields)
      if (field.name == wanted) return wanted;
  for (const Described& field : fields)
    if (field.real) return std::string(field.name);
  return fields.empty() ? "" : std::string(fields.front().name);
}

}  // namespace zstep::answers
