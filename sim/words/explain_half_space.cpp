// A triangle as three half-planes: setup, edge functions, the tests of tiles and pixels, weights.
#include <array>
#include <bit>
#include <utility>

#include "sim/words/explain_parts.hpp"
#include "sim/answers/seen_point.hpp"
#include "traces/formulas/of_half_space.hpp"

namespace zstep::words {
namespace {

constexpr std::array<const char*, 3> value_fields{"e_0", "e_1", "e_2"};

std::string vertices_text(const Telling& t, const TriangleSetup& e) {
  return fmt::format("{}, {}, {}", vertex_label(t.scene, e.vertex_0), vertex_label(t.scene, e.vertex_1),
                     vertex_label(t.scene, e.vertex_2));
}

/// "columns 3 to 5, rows 0 to 7".
template <class E>
std::string pixels_text(const E& e) {
  const auto range = [](const char* one, const char* many, std::int32_t first, std::int32_t end) {
    return end - first == 1 ? fmt::format("{} {}", one, first) : fmt::format("{} {} to {}", many, first, end - 1);
  };
  return range("column", "columns", e.first_column, e.end_column) + ", " + range("row", "rows", e.first_row, e.end_row);
}

/// The value of E_i at the corner of the tile that is farthest inside it, or farthest outside; none where its vertices
/// are not on the raster.
struct AtCorner {
  std::int32_t x = 0, y = 0;
  std::optional<formulas::Rounded> value;
};
AtCorner at_corner(const Telling& t, const TileTest& e, std::size_t i, bool farthest_inside) {
  const EdgeFunction& edge = t.machine.triangle.edges[i];
  AtCorner corner{(edge.edge_a > 0) == farthest_inside ? e.end_column - 1 : e.first_column,
                  (edge.edge_b > 0) == farthest_inside ? e.end_row - 1 : e.first_row,
                  {}};
  formulas::detail::Plainly plainly;
  corner.value = formulas::detail::edge_value_at(plainly, t.at, i, corner.x, corner.y);
  return corner;
}

}  // namespace

void tell(Telling& t, const TriangleSetup& e) {
  const bool empty = e.first_column >= e.end_column || e.first_row >= e.end_row;
  const std::string who = fmt::format("Triangle {} of {}", vertices_text(t, e), t.here());
  if (e.twice_area == 0) t.say(who + " has no area on the raster: no pixel of it is tested.");
  else if (empty) t.say(fmt::format("{} has no pixel's {} in its bounding box.", who, seen_point(t.scene.raster)));
  else t.say(fmt::format("{}: the pixels of its bounding box are {}.", who, pixels_text(e)));
  t.derive(e);
  t.follows("area2", "twice_area", e.twice_area);
  t.whole("first column", "first_column", e.first_column);
  t.whole("end column", "end_column", e.end_column);
  t.whole("first row", "first_row", e.first_row);
  t.whole("end row", "end_row", e.end_row);
}

void tell(Telling& t, const EdgeFunction& e) {
  const std::string from = vertex_label(t.scene, e.vertex_0), to = vertex_label(t.scene, e.vertex_1);
  const char* kind = e.edge_a > 0 ? "It is a left edge" : e.edge_a < 0 ? "It is a right edge" : nullptr;
  if (kind == nullptr) kind = e.edge_b > 0 ? "It is a top edge" : "It is a bottom edge";
  t.say(
      fmt::format("Edge e{} goes from vertex {} to vertex {}: E_{} is positive on the side of the triangle. {}, so a "
                  "{} on it {} to the triangle.",
                  e.edge_function, from, to, e.edge_function, kind, seen_point(t.scene.raster),
                  e.owns ? "belongs" : "does not belong"));
  if (e.owns != formulas::owns_line(e.edge_a, e.edge_b))
    t.doubt(fmt::format("By the top-left rule such a {} {} to it.", seen_point(t.scene.raster),
                        e.owns ? "does not belong" : "belongs"));
  t.derive(e);
  t.follows("A", "edge_a", e.edge_a);
  t.follows("B", "edge_b", e.edge_b);
  t.follows("C", "edge_c", e.edge_c);
  t.value("A", e.edge_a);
  t.value("B", e.edge_b);
  t.value("C", e.edge_c);
}

void tell(Telling& t, const TileTest& e) {
  const std::string where = pixels_text(e);
  switch (e.cover) {
    case TileCover::outside:
      t.say(fmt::format("The tile with {} lies beyond one edge: it is rejected as a whole.", where));
      break;
    case TileCover::inside:
      t.say(
          fmt::format("The tile with {} lies inside all three edges: it is accepted, and none of its pixels needs a "
                      "test.",
                      where));
      break;
    case TileCover::partly:
      t.say(fmt::format(
          "The tile with {} is neither beyond one edge nor inside all three: its pixels are tested one by one.",
          where));
  }
  if (!formulas::detail::has_edges(t.at)) return;
  const bool greatest = e.cover == TileCover::outside;
  for (std::size_t i = 0; i < 3; ++i)
    if (const AtCorner corner = at_corner(t, e, i, greatest); corner.value)
      t.formula(fmt::format("{} of E_{} at its corners: E_{}({}, {}) = {}", greatest ? "greatest" : "least", i, i,
                            corner.x, corner.y, number(corner.value->value)));
  if (const auto right = formulas::detail::cover_of(e, t.at, e.cover); right && *right != e.cover)
    t.contradict(fmt::format("The trace says of the tile with {}: {}. By the edge functions at its corners it is: {}.",
                             where, word_of(e.cover), word_of(*right)));
}

void tell(Telling& t, const TileDepthTest& e) {
  const auto [nearest, farthest] = tell_apart(e.z_nearest, e.z_farthest);
  const Comparison& comparison = t.trace.header().comparison;
  const bool numbers_say = comparison.wins(e.z_nearest, e.z_farthest);
  if (numbers_say != e.nearer)
    t.contradict(fmt::format("The trace says {} of the tile with {}, although {} {} {} is {}.",
                             e.nearer ? "nearer" : "not nearer", pixels_text(e), nearest, comparison.sign(), farthest,
                             numbers_say ? "true" : "false"));
  else if (e.nearer)
    t.say(
        fmt::format("In the tile with {} the triangle may be seen: its nearest depth there, {}, is nearer than the "
                    "farthest stored one, {}.",
                    pixels_text(e), nearest, farthest));
  else
    t.say(
        fmt::format("In the tile with {} nothing of the triangle is seen: its nearest depth there, {}, is not nearer "
                    "than the farthest stored one, {}. The tile is rejected.",
                    pixels_text(e), nearest, farthest));
  t.derive(e);
  t.follows("nearest " + t.z, "z_nearest", e.z_nearest);
  t.formula(fmt::format("nearest {0} {1} farthest {0}:  {2} {1} {3}  is {4}", t.z, comparison.sign(), nearest, farthest,
                        numbers_say ? "true" : "false"));
  t.value("nearest " + t.z, e.z_nearest);
  t.value("farthest " + t.z, e.z_farthest);
}

void tell(Telling& t, const InsideTest& e) {
  const std::array<double, 3> values{e.e_0, e.e_1, e.e_2};
  const std::string point = seen_point(t.scene.raster),
                    centre = fmt::format("The {} of pixel ({}, {})", point, e.x, e.y);
  const auto& edges = t.machine.triangle.edges;
  const bool known = formulas::detail::has_edges(t.at);
  bool inside = true;
  std::string beyond, on, borders;
  for (std::size_t i = 0; i < 3; ++i) {
    const bool owns = !known || edges[i].owns;
    inside = inside && formulas::is_on_side(values[i], owns);
    if (values[i] < 0 && beyond.empty()) beyond = fmt::format("lies on the wrong side of e{}", i);
    if (values[i] == 0 && !owns && on.empty()) on = fmt::format("lies on e{}, which the triangle does not own", i);
    if (values[i] == 0 && owns) borders += fmt::format("{}e{}", borders.empty() ? "" : " and ", i);
  }
  if (inside != e.inside)
    t.contradict(fmt::format("The trace says {} of pixel ({}, {}), although {}.", e.inside ? "inside" : "outside", e.x,
                             e.y,
                             "its " + point + " " +
                                 (inside           ? "is on the right side of all three edges"
                                  : beyond.empty() ? on
                                                   : beyond)));
  else if (!inside) t.say(fmt::format("{} {}: outside.", centre, beyond.empty() ? on : beyond));
  else if (borders.empty()) t.say(fmt::format("{} lies on the inner side of all three edges: inside.", centre));
  else
    t.say(fmt::format("{} lies on {}, which the triangle owns, and not beyond another edge: inside.", centre, borders));
  t.derive(e);
  for (std::size_t i = 0; i < 3; ++i) {
    t.follows(fmt::format("E_{}", i), value_fields[i], values[i]);
    t.value(fmt::format("E_{}", i), values[i]);
  }
}

void tell(Telling& t, const BarycentricWeights& e) {
  t.say(fmt::format("At pixel ({}, {}) the weights of the three vertices are {}, {} and {}.", e.x, e.y, number(e.w_0),
                    number(e.w_1), number(e.w_2)));
  if (const auto& test = t.machine.triangle.test; test && test->x == e.x && test->y == e.y && !test->inside)
    t.doubt(fmt::format("Its {} was not found inside the triangle.", seen_point(t.scene.raster)));
  t.derive(e);
  t.follows("w_0", "w_0", e.w_0);
  t.follows("w_1", "w_1", e.w_1);
  t.follows("w_2", "w_2", e.w_2);
  t.value("w_0", e.w_0);
  t.value("w_1", e.w_1);
  t.value("w_2", e.w_2);
}

void tell(Telling& t, const SampleTest& e) {
  const std::array<double, 3> values{e.s_0, e.s_1, e.s_2};
  const auto& edges = t.machine.triangle.edges;
  const bool known = formulas::detail::has_edges(t.at);
  bool inside = true;
  for (std::size_t i = 0; i < 3; ++i) inside = inside && formulas::is_on_side(values[i], !known || edges[i].owns);
  const std::string who = fmt::format("ample {} of pixel ({}, {})", e.sample, e.x, e.y);
  if (inside != e.inside)
    t.contradict(fmt::format("The trace says {} of s{}, although by its edge functions it is {}.",
                             e.inside ? "inside" : "outside", who, inside ? "inside" : "outside"));
  else t.say(fmt::format("S{} lies {} the triangle.", who, e.inside ? "in" : "outside"));
  t.derive(e);
  for (std::size_t i = 0; i < 3; ++i) {
    t.follows(fmt::format("S_{}", i), fmt::format("s_{}", i), values[i]);
    t.value(fmt::format("S_{}", i), values[i]);
  }
}

void tell(Telling& t, const SampleDepth& e) {
  const auto& before = t.machine.triangle.before;
  const double stored = before.polygon == no_polygon ? t.trace.header().empty_depth() : before.z;
  const auto [z, kept] = tell_apart(e.z, stored);
  const Comparison& comparison = t.trace.header().comparison;
  const bool numbers_say = comparison.wins(e.z, stored);
  const std::string at = fmt::format("sample {} of pixel ({}, {})", e.sample, e.x, e.y);
  if (numbers_say != e.nearer)
    t.contradict(fmt::format("The trace says {} at {}, although {} {} {} is {}.", e.nearer ? "nearer" : "not nearer",
                             at, z, comparison.sign(), kept, numbers_say ? "true" : "false"));
  else if (e.nearer) t.say(fmt::format("At {} {} is nearer than what is there, and takes the sample.", at, t.here()));
  else t.say(fmt::format("At {} {} is not nearer than what is there: the sample keeps what it has.", at, t.here()));
  t.derive(e);
  t.follows(t.z, "z", e.z);
  t.formula(fmt::format("{} {} stored:  {} {} {}  is {}", t.z, comparison.sign(), z, comparison.sign(), kept,
                        numbers_say ? "true" : "false"));
  t.value(t.z, e.z);
  t.value("stored", stored);
}

void tell(Telling& t, const SampleMask& e) {
  const std::uint32_t samples = formulas::samples_of(e);
  t.say(
      fmt::format("Of the 32 samples of pixel ({}, {}), {} lie in the triangle. They are kept with the depth in their "
                  "middle, {}.",
                  e.x, e.y, std::popcount(samples), number(e.z)));
  t.derive(e);
  t.follows(t.z, "z", e.z);
  for (std::int32_t row = 0; row < formulas::mask_rows; ++row) {
    std::string bits;
    for (std::int32_t column = 0; column < formulas::mask_columns; ++column)
      bits += samples >> (row * formulas::mask_columns + column) & 1 ? "1 " : "0 ";
    t.formula(fmt::format("row {}: {}", row, bits));
  }
  t.value(t.z, e.z);
}

}  // namespace zstep::words
