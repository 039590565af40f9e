#include "sim/answers/origin/fields.hpp"

#include <algorithm>
#include <array>
#include <type_traits>

namespace zstep::answers {
namespace {

template <class E>
concept Told = requires(Datum& datum, Work& work, const E& event) { tell(datum, work, std::int64_t{}, event, std::string_view{}); };

/// Calls visit(field, value) for the field of this name.
template <class Visit>
void with_field(const Event& event, std::string_view name, Visit&& visit) {
  std::visit(
      [&](const auto& known) {
        using E = std::decay_t<decltype(known)>;
        for_each_field<E>([&](const auto& field) {
          if (field.name == name) visit(field, known.*(field.member));
        });
      },
      event);
}

/// A number that names something: what that is, and where it comes from.
void tell_name(Datum& datum, Work& work, std::string_view field, std::int32_t number, std::string_view meaning) {
  const auto at = static_cast<std::size_t>(number);
  const bool vertex = field.starts_with("vertex");
  if (number < 0) return datum.note("none");
  if (field == "polygon" || field == "owner") return datum.at_source(work.source_of_polygon(number)), datum.note(work.label(number));
  if (field.find("facet") != std::string_view::npos) {
    if (at >= work.scene.facets.size()) return;
    const std::int32_t polygon = work.scene.facets[at].polygon;
    datum.at_source(work.source_of_polygon(polygon));
    return datum.note("of " + work.label(polygon));
  }
  if (vertex && at < work.scene.points.size()) return datum.comes_of("vertex " + work.vertex_name(number), {work.world(number, Axis3::x), work.world(number, Axis3::y), work.world(number, Axis3::z)});
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
  std::optional<double> number;
  with_field(event, name, [&](const auto&, const auto& value) { number = static_cast<double>(value); });
  return number;
}

std::string shown_name(const Work& work, const Event& event, std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 24> names{{
      {"x_left", "x_L"}, {"x_right", "x_R"}, {"z_left", "z_L"}, {"z_right", "z_R"}, {"dx_dy", "1/m"}, {"dz_dy", "dz/dy"},
      {"dz_dx", "dz/dx"}, {"x_edge", "x"}, {"plane_a", "A"}, {"plane_b", "B"}, {"plane_c", "C"}, {"plane_d", "D"},
      {"y_curve", "y"}, {"x_at", "x"}, {"y_at", "y"}, {"x_cut", "x"}, {"y_cut", "y"}, {"z_cut", "z"},
      {"dir_x", "dX_x"}, {"dir_y", "dX_y"}, {"dir_z", "dX_z"}, {"r8", "red"}, {"g8", "green"}, {"b8", "blue"}}};
  if (name == "z" || name == "z_edge") return work.depth_name();
  if (name == "z_cut" && std::holds_alternative<SplitVertex>(event) && std::get<SplitVertex>(event).space == Space::raster) return work.depth_name();
  for (const auto& [field, shown] : names)
    if (field == name) return std::string(shown);
  return std::string(name);
}

void tell_field(Datum& datum, Work& work, std::int64_t step, const Event& event, std::string_view name) {
  with_field(event, name, [&](const auto& field, const auto& value) {
    using V = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<V, bool>) datum.holds_if("", {});
    if constexpr (std::is_enum_v<V>) datum.word(std::string(words_of<V>[static_cast<std::size_t>(value)]));
    if constexpr (std::is_same_v<V, std::int32_t>)
      if (field.unit == "index") return tell_name(datum, work, name, value, field.meaning);
    std::visit(
        [&](const auto& known) {
          if constexpr (Told<std::decay_t<decltype(known)>>) tell(datum, work, step, known, name);
        },
        event);
    if (!datum.told()) datum.note(std::string(field.meaning));
  });
}

std::vector<std::string> fields_in(const Event& event) {
  std::vector<std::string> names;
  std::visit([&](const auto& known) { for_each_field<std::decay_t<decltype(known)>>([&](const auto& field) { names.emplace_back(field.name); }); }, event);
  return names;
}

std::string main_field(const Event& event) {
  const std::vector<std::string> names = fields_in(event);
  for (const char* wanted : {"z", "t", "y_curve", "value", "x_edge", "z_left", "distance", "z_light", "view_dot_normal", "t_enter", "nearer"})
    if (std::find(names.begin(), names.end(), wanted) != names.end()) return wanted;
  std::string real;
  std::visit(
      [&](const auto& known) {
        for_each_field<std::decay_t<decltype(known)>>([&](const auto& field) {
          if constexpr (std::is_same_v<typename std::decay_t<decltype(field)>::value_type, double>)
            if (real.empty()) real = field.name;
        });
      },
      event);
  if (!real.empty()) return real;
  return names.empty() ? "" : names.front();
}

}  // namespace zstep::answers
