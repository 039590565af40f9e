// The planes of pieces.
#include "sim/answers/origin/planes.hpp"

#include <algorithm>
#include <cmath>

#include "algorithms/ray_casting/geometry.hpp"

namespace zstep::answers {

const Piece* piece_at(const Work& work, std::int32_t piece) {
  const auto at = static_cast<std::size_t>(piece);
  return piece >= 0 && at < work.machine().pieces.size() ? &work.machine().pieces[at] : nullptr;
}
namespace {

/// One component of Newell's normal as a formula over p0_x, p0_y …: what the corners' coordinates are called there.
std::string newell(std::size_t count, char u, char v) {
  std::string text;
  for (std::size_t i = 1; i + 1 < count; ++i) {
    if (!text.empty()) text += " + ";
    text += fmt::format("((p{0}_{2} - p0_{2})*(p{1}_{3} - p0_{3}) - (p{1}_{2} - p0_{2})*(p{0}_{3} - p0_{3}))", i, i + 1,
                        u, v);
  }
  return text;
}

std::vector<Given> corners_along(std::size_t count, const Corner& corner, std::initializer_list<Axis3> axes) {
  constexpr const char* names[] = {"x", "y", "z"};
  std::vector<Given> given;
  for (std::size_t i = 0; i < count; ++i)
    for (const Axis3 axis : axes)
      given.push_back({fmt::format("p{}_{}", i, names[static_cast<std::size_t>(axis)]), corner(i, axis)});
  return given;
}

double value_of(const PlaneEquation& plane, char letter) {
  return letter == 'A' ? plane.plane_a : letter == 'B' ? plane.plane_b : letter == 'C' ? plane.plane_c : plane.plane_d;
}

const char* field_of(char letter) {
  return letter == 'A' ? "plane_a" : letter == 'B' ? "plane_b" : letter == 'C' ? "plane_c" : "plane_d";
}

char letter_of(std::string_view field) { return static_cast<char>('A' + (field.back() - 'a')); }

}  // namespace

void tell_plane(Datum& datum, Work& work, std::int64_t step, const std::string& subject, char letter, std::size_t count,
                const Corner& corner) {
  if (count > most_corners || count < 3) {
    std::vector<Number> some;
    for (std::size_t i = 0; i < std::min<std::size_t>(count, 3); ++i)
      for (const Axis3 axis : {Axis3::x, Axis3::y, Axis3::z}) some.push_back(corner(i, axis));
    return datum.comes_of(fmt::format("by Newell's formula over {} vertices, of which three are shown", count), some);
  }
  const auto side = [&](char name, char u, char v, Axis3 first, Axis3 second) {
    const auto n = corners_along(count, corner, {first, second});
    ChainValue computed;
    computed.formula = newell(count, u, v);
    for (const Given& given : n) computed.operands.push_back({given.symbol, given.number.value, -1, {}});
    return work.derived(step, subject, "", fmt::format("n_{}", name), evaluate(computed),
                        [&](Datum& inner) { inner.is(newell(count, u, v), n); });
  };
  const auto along = [&](char name) {
    return name == 'x'   ? side('x', 'y', 'z', Axis3::y, Axis3::z)
           : name == 'y' ? side('y', 'z', 'x', Axis3::z, Axis3::x)
                         : side('z', 'x', 'y', Axis3::x, Axis3::y);
  };
  if (letter != 'D') {
    const char own = static_cast<char>('x' + (letter - 'A'));
    const std::vector<Given> given{{"n_x", along('x')}, {"n_y", along('y')}, {"n_z", along('z')}};
    return datum.is(fmt::format("n_{}/sqrt(n_x*n_x + n_y*n_y + n_z*n_z)", own), given, false);
  }
  std::vector<Given> given;
  std::string text;
  for (const char own : {'A', 'B', 'C'}) {
    const Axis3 axis = static_cast<Axis3>(own - 'A');
    std::string sum;
    for (std::size_t i = 0; i < count; ++i) {
      const std::string symbol = fmt::format("p{}_{}", i, static_cast<char>('x' + (own - 'A')));
      sum += (i ? " + " : "") + symbol;
      given.push_back({symbol, corner(i, axis)});
    }
    text += fmt::format("{}{}*({})/{}", own == 'A' ? "" : " + ", own, sum, count);
  }
  for (const char own : {'A', 'B', 'C'})
    given.push_back({std::string(1, own), subject.empty() ? work.field(step, field_of(own))
                                                          : work.facet_plane(std::stoi(subject.substr(6)), own)});
  datum.is("-(" + text + ")", std::move(given), false);
}

std::vector<Given> plane_at(const std::function<Number(char)>& plane, const std::function<Number(Axis3)>& point) {
  return {{"A", plane('A')}, {"x", point(Axis3::x)}, {"B", plane('B')}, {"y", point(Axis3::y)},
          {"C", plane('C')}, {"z", point(Axis3::z)}, {"D", plane('D')}};
}

Number plane_value(Work& work, std::int64_t step, const char* name, std::int32_t piece,
                   const std::function<Number(Axis3)>& point) {
  std::vector<Given> given = plane_at([&](char letter) { return work.plane(piece, letter); }, point);
  ChainValue value;
  value.formula = "A*x + B*y + C*z + D";
  for (const Given& one : given) value.operands.push_back({one.symbol, one.number.value, -1, {}});
  return work.derived(step, "", "", name, evaluate(value),
                      [&](Datum& datum) { datum.is(value.formula, std::move(given)); });
}

Number Work::plane(std::int32_t number, char letter) {
  const Piece* piece = piece_at(*this, number);
  if (!piece || !piece->plane) return 0;
  const Step step = step_of_plane(machine(), number);
  return field(step, field_of(letter), value_of(*piece->plane, letter));
}

Number Work::facet_plane(std::int32_t facet, char letter) {
  const auto number = static_cast<std::size_t>(facet);
  if (facet < 0 || number >= scene.facets.size()) return 0;
  const ray_casting::Target target = ray_casting::target_of(scene, facet);
  const double value = letter == 'A'   ? target.plane.a
                       : letter == 'B' ? target.plane.b
                       : letter == 'C' ? target.plane.c
                                       : target.plane.d;
  const std::string subject = fmt::format("facet {}", facet),
                    what = "plane of " + label(scene.facets[number].polygon) + ", in the world";
  return derived(0, subject, what, std::string(1, letter), value, [&](Datum& datum) {
    datum.at_source(source_of_polygon(scene.facets[number].polygon));
    const auto first = static_cast<std::size_t>(scene.facets[number].first_corner);
    tell_plane(datum, *this, 0, subject, letter, target.corners.size(),
               [&](std::size_t i, Axis3 axis) { return world(scene.corners[first + i], axis); });
  });
}

static void tell(Datum& datum, Work& work, std::int64_t step, const PlaneEquation& e, std::string_view field) {
  // A part lies in the plane of the whole that it was cut from.
  const Piece* whole = piece_at(work, e.piece);
  while (whole && whole->parent >= 0 && piece_at(work, whole->parent)) whole = piece_at(work, whole->parent);
  if (!whole) return;
  const std::vector<std::int32_t> outline = whole->outline;
  tell_plane(datum, work, step, "", letter_of(field), outline.size(),
             [&](std::size_t i, Axis3 axis) { return work.cutting(outline[i], axis); });
}

void tell_planes(Datum& datum, Work& work, std::int64_t step, const Event& event, std::string_view field) {
  tell_one_of<PlaneEquation>(event, [&](const auto& e) { tell(datum, work, step, e, field); });
}

}  // namespace zstep::answers
