#include "traces/replay/state.hpp"

#include "traces/events/registers.hpp"

namespace zstep {

namespace {

bool same(double a, double b) { return bits_of(a) == bits_of(b); }

template <class E>
bool same_event(const E& a, const E& b) {
  bool equal = true;
  for_each_field<E>([&](const auto& field) {
    if constexpr (std::is_same_v<typename std::remove_cvref_t<decltype(field)>::value_type, double>)
      equal = equal && same(a.*field.member, b.*field.member);
    else equal = equal && a.*field.member == b.*field.member;
  });
  return equal;
}

template <class E>
bool same_event(const std::optional<E>& a, const std::optional<E>& b) {
  return a.has_value() == b.has_value() && (!a || same_event(*a, *b));
}

bool same_vector(const glm::dvec3& a, const glm::dvec3& b) {
  return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z);
}

bool same_depths(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

}  // namespace

bool VertexWay::operator==(const VertexWay& other) const {
  return stage == other.stage && same_vector(view, other.view) && same_vector(plane, other.plane) &&
         same(raster.x, other.raster.x) && same(raster.y, other.raster.y);
}

bool EdgeRow::operator==(const EdgeRow& other) const { return where == other.where && same_event(entry, other.entry); }

bool ActiveEdge::operator==(const ActiveEdge& other) const {
  return edge == other.edge && same(x, other.x) && same(z, other.z);
}

bool Fragment::operator==(const Fragment& other) const {
  return x == other.x && y == other.y && same(z, other.z) && same(stored, other.stored) &&
         stored_polygon == other.stored_polygon && nearer == other.nearer;
}

bool Machine::operator==(const Machine& other) const {
  return polygon == other.polygon && facet == other.facet && same_event(facing, other.facing) &&
         same_event(clip_test, other.clip_test) && rejected == other.rejected && outline == other.outline &&
         edge_table == other.edge_table && active == other.active && scan_line == other.scan_line &&
         same_event(span, other.span) && fragment == other.fragment;
}

bool State::operator==(const State& other) const {
  return position == other.position && machine == other.machine && picture.width == other.picture.width &&
         picture.height == other.picture.height && picture.polygon == other.picture.polygon &&
         same_depths(picture.depth, other.picture.depth) && vertices == other.vertices;
}

}  // namespace zstep
