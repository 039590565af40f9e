#include "algorithms/catalog/changes.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "algorithms/scene/builder.hpp"
#include "algorithms/scene/files/tokens.hpp"
#include "algorithms/scene/load.hpp"
#include "traces/error.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/scene.hpp"

namespace zstep {
namespace {

constexpr std::size_t most_vertices = 1000;  ///< that are listed

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string_view::npos ? std::string_view() : text.substr(first, last + 1 - first);
}

/// The words of a text, parted by spaces or commas.
std::vector<std::string> words_in(std::string_view text) {
  std::vector<std::string> words;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t from = text.find_first_not_of(" ,\t", at);
    if (from == std::string_view::npos) break;
    at = std::min(text.find_first_of(" ,\t", from), text.size());
    words.emplace_back(text.substr(from, at - from));
  }
  return words;
}

std::string begun(const std::string& who) { return who.empty() ? "" : who + " "; }

struct Place {
  const Change& change;
  const std::string& who;

  [[noreturn]] void refuse(const std::string& what, const std::string& remedy) const {
    throw InputError(begun(who) + fmt::format("{} = {}", change.name, change.value), what, remedy);
  }
  double number(const std::string& word) const {
    const std::optional<double> value = scene::parse_number(word);
    if (!value || !(std::abs(*value) <= scene::largest_coordinate))
      refuse(fmt::format("{} is no number for it", word), "give a number of ordinary size, as 0.5");
    return *value;
  }
};

// --- The camera

struct CameraNumber {
  std::string_view name, meaning;
  double Camera::*now;
  std::optional<double> ViewOptions::*then;
  double nudge;  ///< of angles in degrees; of lengths 0: a twentieth of what it is
};
constexpr std::array<CameraNumber, 7> camera_numbers{{
    {"rho", "from the origin to the eye", &Camera::rho, &ViewOptions::rho, 0},
    {"theta", "degrees round the z axis, from x", &Camera::theta, &ViewOptions::theta, 5},
    {"phi", "degrees down from the z axis", &Camera::phi, &ViewOptions::phi, 5},
    {"d", "from the eye to the window", &Camera::d, &ViewOptions::d, 0},
    {"window", "half the height of the window", &Camera::window, &ViewOptions::window, 0},
    {"near", "z_v of the near plane", &Camera::near, &ViewOptions::near, 0},
    {"far", "z_v of the far plane", &Camera::far, &ViewOptions::far, 0},
}};

/// The angles and the distance of the eye are those of a camera that is given by them.
bool has(const Scene& scene, const CameraNumber& number) {
  const Camera& camera = scene.camera;
  const bool polar = number.name == "rho" || number.name == "theta" || number.name == "phi";
  return camera.kind != Camera::Kind::screen && (camera.polar || !polar) &&
         (number.name != "d" || camera.kind == Camera::Kind::perspective) &&
         !(camera.matrices && (number.name == "d" || number.name == "window"));
}

/// Whether the clipping planes stand where a scene gets them that states none: then they go with it.
bool planes_follow(Scene scene) {
  if (scene.camera.kind == Camera::Kind::screen) return false;
  const double near = std::exchange(scene.camera.near, 0), far = std::exchange(scene.camera.far, 0);
  const Camera camera = look_at_scene(std::move(scene), {}).camera;
  return camera.near == near && camera.far == far;
}

/// A twentieth, as a round number.
double nudge_of(double value) {
  if (value == 0) return 0.1;
  const double power = portable::pow(10, std::floor(portable::log10(std::abs(value) / 20)));
  const double digit = std::abs(value) / 20 / power;
  return power * (digit < 2 ? 1 : digit < 5 ? 2 : 5);
}

// --- Vertices and polygons

std::string text_of(const glm::dvec3& point) { return fmt::format("{} {} {}", point.x, point.y, point.z); }

/// Cuts facets that a moved vertex has bent, puts together those that it has made flat, and puts all of them into the
/// order of their polygons: as if the scene had been read so. `before`: where the points were.
void cut_anew(Scene& scene, const std::vector<glm::dvec3>& before, const Place& place) {
  std::vector<int> facets_of(scene.polygons.size(), 0);
  for (const Facet& facet : scene.facets) ++facets_of[facet.polygon];
  std::vector<Facet> old = std::exchange(scene.facets, {});
  const std::vector<std::int32_t> corners = std::exchange(scene.corners, {});
  std::stable_sort(old.begin(), old.end(), [](const Facet& a, const Facet& b) { return a.polygon < b.polygon; });
  scene::EarClipper clipper;
  for (std::size_t at = 0; at < old.size(); ++at) {
    const Facet& facet = old[at];
    const auto corners_of = [&](const Facet& one) {
      const auto first = corners.begin() + one.first_corner;
      return std::vector<std::int32_t>(first, first + one.corner_count);
    };
    std::vector<std::int32_t> ring = corners_of(facet), triangles;
    bool whole = facets_of[facet.polygon] == 1;
    if (const bool first = at == 0 || old[at - 1].polygon != facet.polygon; first && !whole) {
      for (std::size_t k = at; k < old.size() && old[k].polygon == facet.polygon; ++k)
        for (const std::int32_t corner : corners_of(old[k])) triangles.push_back(corner);
      std::vector<std::int32_t> outline = scene::outline_of(before, triangles);
      whole = !outline.empty();
      if (whole) ring = std::move(outline), at += triangles.size() / 3 - 1;
    }
    std::vector<std::int32_t> pieces = ring;
    std::size_t size = pieces.size();
    if (whole && !scene::is_planar(scene.points, ring)) {
      pieces.clear();
      size = 3;
      if (!clipper.cut(scene.points, ring, pieces))
        place.refuse("it bends a polygon of too many corners to cut it into triangles", "move another vertex");
    }
    for (std::size_t from = 0; from < pieces.size(); from += size) {
      scene.facets.push_back({facet.polygon, size32(scene.corners), index32(size)});
      const auto first = pieces.begin() + from;
      scene.corners.insert(scene.corners.end(), first, first + size);
    }
  }
}

void move_vertex(const Place& place, Scene& scene) {
  if (scene.surface)
    place.refuse("the vertices of a surface follow from its formula",
                 "open another formula: zstep view \"y = sin(x)\"");
  const std::vector<std::string> name = words_in(place.change.name), numbers = words_in(place.change.value);
  std::size_t vertex = 0;
  const auto [end, error] = std::from_chars(name[1].data(), name[1].data() + name[1].size(), vertex);
  if (error != std::errc{} || end != name[1].data() + name[1].size() || vertex >= scene.points.size())
    place.refuse(fmt::format("there is no vertex {}", name[1]),
                 scene.points.empty() ? "there is none" : fmt::format("there are 0 to {}", scene.points.size() - 1));
  if (numbers.size() != 3)
    place.refuse("a vertex is at three numbers", fmt::format("for example {} = 1 0 2.5", place.change.name));
  const std::vector<glm::dvec3> before = scene.points;
  scene.points[vertex] =
      glm::dvec3(place.number(numbers[0]), place.number(numbers[1]), place.number(numbers[2])) + 0.0;  // -0 becomes 0
  // No file says any more where it is.
  scene.point_lines.clear(), scene.file_points.clear(), scene.placements.clear(), scene.fit.reset();
  cut_anew(scene, before, place);
}

/// Whether each polygon has a name of its own, and there are few enough to be put in order by hand.
bool named_one_by_one(const Scene& scene) {
  std::set<std::string_view> names;
  for (const Polygon& polygon : scene.polygons)
    if (polygon.name->empty() || polygon.name->find_first_of(" ,=\t") != std::string::npos ||
        !names.insert(*polygon.name).second)
      return false;
  return scene.polygons.size() <= 26;
}

std::optional<std::size_t> polygon_called(const Scene& scene, std::string_view name) {
  for (std::size_t at = 0; at < scene.polygons.size(); ++at)
    if (*scene.polygons[at].name == name) return at;
  return std::nullopt;
}

std::string names_of(const Scene& scene) {
  std::string all;
  for (const Polygon& polygon : scene.polygons) all += (all.empty() ? "" : " ") + *polygon.name;
  return all;
}

void put_in_order(const Place& place, Scene& scene) {
  const std::vector<std::string> names = words_in(place.change.value);
  std::vector<std::int32_t> place_of(scene.polygons.size(), -1);
  std::int32_t next = 0;
  for (const std::string& name : names) {
    const auto at = polygon_called(scene, name);
    if (!at || place_of[*at] >= 0)
      place.refuse(at ? fmt::format("{} stands in it twice", name) : fmt::format("there is no polygon {}", name),
                   "give each once: " + names_of(scene));
    place_of[*at] = next++;
  }
  if (names.size() != scene.polygons.size())
    place.refuse("not all polygons stand in it", "give each once: " + names_of(scene));
  scene::put_in_order(scene, place_of);
}

std::string text_of(Color color) { return fmt::format("#{:02x}{:02x}{:02x}", color.red, color.green, color.blue); }

void paint(const Place& place, Scene& scene) {
  const std::string name = words_in(place.change.name)[1];
  const auto at = polygon_called(scene, name);
  if (!at) place.refuse(fmt::format("there is no polygon {}", name), "there are " + names_of(scene));
  std::uint32_t rgb = 0;
  const std::string& text = place.change.value;
  const char* const end = text.data() + text.size();
  const bool right = text.size() == 7 && text[0] == '#' && std::from_chars(text.data() + 1, end, rgb, 16).ptr == end;
  if (!right) place.refuse(fmt::format("{} is no colour", text), "give red, green and blue, as #e69f00");
  scene.polygons[*at].color = {static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8),
                               static_cast<std::uint8_t>(rgb)};
}

void resize(const Place& place, Scene& scene) {
  const std::string& text = place.change.value;
  ViewOptions options;
  int width = 0, height = 0;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, width);
  const bool cross = first.ec == std::errc{} && first.ptr != end && *first.ptr == 'x';
  if (!cross || std::from_chars(first.ptr + 1, end, height).ptr != end || height == 0)
    place.refuse("a size is width x height", "give for example 40x30");
  options.width = width, options.height = height;
  scene = look_at_scene(std::move(scene), options);
}

// --- Conventions and options

/// On the command line and here a convention's key and words have "-" for "_".
std::string dashed(std::string_view text) {
  std::string all(text);
  std::replace(all.begin(), all.end(), '_', '-');
  return all;
}

std::string_view meaning_of(std::string_view convention) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 7> all{
      {{"depth", "what the depth buffer holds"},
       {"interpolation", "how x and z go along edges and spans"},
       {"coverage", "which pixels a polygon owns"},
       {"number_format", "the numbers that are computed with"},
       {"rounding", "of numbers in fixed point"},
       {"positions", "of spans: exact, or whole pixels"},
       {"attribute", "a value that vertices have, interpolated"}}};
  for (const auto& [key, meaning] : all)
    if (key == convention) return meaning;
  return "";
}

bool has(const Method& method, std::string_view convention) {
  const bool of_many = convention == "depth" || convention == "interpolation" || convention == "coverage";
  return method.in_any_way || (method.interpolates && of_many);
}

std::vector<std::string> parts_of(std::string_view words) {
  std::vector<std::string> parts;
  while (!words.empty()) {
    const std::size_t bar = std::min(words.find('|'), words.size());
    parts.emplace_back(words.substr(0, bar));
    words.remove_prefix(std::min(bar + 1, words.size()));
  }
  return parts;
}

/// False where it is none of the method's.
bool change_convention(const Method& method, const Change& change, Conventions& conventions, const Place& place) {
  bool known = false;
  for_each_convention([&]<class E>(std::string_view key, E Conventions::*member) {
    if (dashed(key) != change.name || !has(method, key)) return;
    known = true;
    for (const E value : values_of<E>)
      if (dashed(word_of(value)) == change.value) {
        conventions.*member = value;
        return;
      }
    std::string words;
    for (const std::string_view word : words_of<E>) words += (words.empty() ? "" : ", ") + dashed(word);
    place.refuse(fmt::format("{} is none of its words", change.value), "give one of " + words);
  });
  return known;
}

bool starts_with_word(const std::string& name, std::string_view word) {
  return name.starts_with(word) && words_in(name).size() == 2 && name[word.size()] == ' ';
}

}  // namespace

bool can_change(const Method& method, const Scene& scene, const Conventions& conventions, std::string_view name) {
  if (name.starts_with("vertex ")) return !scene.surface;
  const std::vector<Changeable> all = changeables(method, scene, conventions);
  return std::any_of(all.begin(), all.end(), [&](const Changeable& one) { return one.name == name; });
}

Change read_change(std::string_view text, const std::string& who) {
  const std::size_t equals = text.find('=');
  const Change change{std::string(trimmed(text.substr(0, equals))),
                      equals == std::string_view::npos ? "" : std::string(trimmed(text.substr(equals + 1)))};
  if (change.name.empty() || change.value.empty())
    throw InputError(begun(who) + std::string(text), "is not NAME = VALUE", "give for example \"theta = 60\"");
  return change;
}

std::vector<Changeable> changeables(const Method& method, const Scene& scene, const Conventions& conventions) {
  std::vector<Changeable> all;
  for (const CameraNumber& number : camera_numbers)
    if (const double now = scene.camera.*number.now; has(scene, number))
      all.push_back({std::string(number.name),
                     fmt::format("{}", now),
                     std::string(number.meaning),
                     {},
                     number.nudge != 0 ? number.nudge : nudge_of(now)});
  all.push_back({"size", fmt::format("{}x{}", scene.raster.width, scene.raster.height), "pixels of the raster"});
  if (can_cull(method, scene))
    all.push_back({"cull", conventions.cull ? "on" : "off", "back faces are dropped", {"off", "on"}});
  for_each_convention([&]<class E>(std::string_view key, E Conventions::*member) {
    if (!has(method, key)) return;
    Changeable one{dashed(key), dashed(word_of(conventions.*member)), std::string(meaning_of(key))};
    for (const std::string_view word : words_of<E>) one.choices.push_back(dashed(word));
    all.push_back(std::move(one));
  });
  for (const Option& option : method.options) {
    const auto given = conventions.options.find(std::string(option.name));
    all.push_back({std::string(option.name),
                   given == conventions.options.end() ? std::string(option.standard) : given->second,
                   std::string(option.meaning), parts_of(option.words), option.words.empty() ? 1.0 : 0.0});
  }
  if (named_one_by_one(scene)) {
    if (scene.polygons.size() > 1) all.push_back({"polygons", names_of(scene), "their order"});
    for (const Polygon& polygon : scene.polygons)
      all.push_back({"colour " + *polygon.name, text_of(polygon.color), "red, green and blue, two digits each"});
  }
  if (!scene.surface)
    for (std::size_t at = 0; at < std::min(scene.points.size(), most_vertices); ++at)
      all.push_back({fmt::format("vertex {}", at), text_of(scene.points[at]),
                     scene.camera.kind == Camera::Kind::screen ? "x and y on the raster, z" : "x, y, z in the world"});
  return all;
}

void make_change(const Method& method, const Change& change, Scene& scene, Conventions& conventions,
                 const std::string& who) {
  const Place place{change, who};
  Scene other = scene;
  Conventions others = conventions;
  const bool follow = planes_follow(scene) && change.name != "near" && change.name != "far";
  if (follow) other.camera.near = other.camera.far = 0;
  const auto camera = std::find_if(camera_numbers.begin(), camera_numbers.end(),
                                   [&](const CameraNumber& number) { return number.name == change.name; });
  if (camera != camera_numbers.end() && has(scene, *camera)) {
    ViewOptions options;
    options.*(camera->then) = place.number(change.value);
    other = look_at_scene(std::move(other), options);
  } else if (change.name == "size") {
    resize(place, other);
  } else if (change.name == "cull" && can_cull(method, scene)) {
    if (change.value != "on" && change.value != "off")
      place.refuse(fmt::format("{} is none of its words", change.value), "give on or off");
    others.cull = change.value == "on";
  } else if (starts_with_word(change.name, "vertex")) {
    move_vertex(place, other);
  } else if (change.name == "polygons" && named_one_by_one(scene)) {
    put_in_order(place, other);
  } else if (starts_with_word(change.name, "colour") && named_one_by_one(scene)) {
    paint(place, other);
  } else if (!change_convention(method, change, others, place)) {
    const bool option = std::any_of(method.options.begin(), method.options.end(),
                                    [&](const Option& one) { return one.name == change.name; });
    if (!option) {
      std::string names;
      for (const Changeable& one : changeables(method, scene, conventions))
        if (one.name.find(' ') == std::string::npos) names += one.name + ", ";
      place.refuse(fmt::format("there is no {} to change", change.name),
                   "there are " + names + (scene.surface ? "and no more" : "and vertex 0 to the last"));
    }
    others.options[change.name] = change.value;
    give_normals(other, others);
  }
  if (follow) other = look_at_scene(std::move(other), {});
  check_run(method, other, others, who.empty() ? change.name + " = " + change.value : who);
  scene = std::move(other);
  conventions = std::move(others);
}

}  // namespace zstep
