#include "traces/diff/moved.hpp"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include "traces/diff/identity.hpp"
#include "traces/events/slots.hpp"

namespace zstep::diff {

namespace {

/// The edge of this number at a step, by its polygon and vertices.
using Edge = std::tuple<std::int32_t, std::int32_t, std::int32_t>;
std::optional<Edge> edge_at(const Trace& trace, std::int64_t step, std::int32_t number) {
  const auto made = trace.previous(step, [&](const RecordedEvent& recorded) {
    const auto* insert = get_if<EdgeTableInsert>(&recorded.event);
    return insert && insert->edge == number;
  });
  if (!made) return std::nullopt;
  const auto entry = get<EdgeTableInsert>(trace.event(*made).event);
  const auto [from, to] = std::minmax(entry.vertex_0, entry.vertex_1);
  const auto points = static_cast<std::int32_t>(trace.scene().points.size());
  if (to >= points) return std::nullopt;  // vertices that clipping made have other numbers in another run
  return Edge{entry.polygon, from, to};
}

/// Are both about the same, as far as their own fields say?
template <class E>
bool same_step(const Trace& a, std::int64_t step_a, const E& of_a, const Trace& b, std::int64_t step_b, const E& of_b) {
  bool same = true, any = false;
  for_each_index<E>([&]<std::size_t I>() {
    constexpr const auto& field = field_at<E, I>;
    if constexpr (has(field.as, As::subject) && !std::is_same_v<FieldValue<E, I>, double>) {
      any = true;
      constexpr Thing thing = field.thing;
      const auto one = of_a.*field.member, other = of_b.*field.member;
      if constexpr (thing == Thing::edge) {
        const auto edge = edge_at(a, step_a, one);
        same = same && edge && edge == edge_at(b, step_b, other);
      } else {
        same = same && one == other && (thing == Thing::none || thing == Thing::vertex);
      }
    }
  });
  return any && same;
}

}  // namespace

void join_moved(const Trace& a, const Trace& b, DiffReport& report) {
  std::vector<Cause>& causes = report.causes;
  for (std::size_t i = 0; i < causes.size(); ++i) {
    const Difference first = causes[i].first;
    if (!first.only_a() && !first.only_b()) continue;
    const auto other =
        std::find_if(causes.begin() + static_cast<std::ptrdiff_t>(i) + 1, causes.end(), [&](const Cause& cause) {
          if (cause.first.kind != first.kind || cause.part != causes[i].part) return false;
          if (first.only_a() ? !cause.first.only_b() : !cause.first.only_a()) return false;
          const std::int64_t step_a = first.only_a() ? first.a : cause.first.a,
                             step_b = first.only_a() ? cause.first.b : first.b;
          const Event of_a = a.event(step_a).event, of_b = b.event(step_b).event;
          return visit_event(
              [&]<class E>(const E& e) {
                const E* its = get_if<E>(&of_b);
                return its && same_step(a, step_a, e, b, step_b, *its);
              },
              of_a);
        });
    if (other == causes.end()) continue;
    causes[i].elsewhere = first.only_a() ? other->first.b : other->first.a;
    causes[i].again += other->again, causes[i].symptoms += other->symptoms, causes[i].pixels += other->pixels;
    causes.erase(other);
  }
}

}  // namespace zstep::diff
