#include "tests/unit/traces/some_trace.hpp"

#include <limits>
#include <random>

#include "traces/error.hpp"
#include "traces/events/slots.hpp"
#include "traces/file/check_events.hpp"
#include "traces/record/trace_recorder.hpp"

namespace zstep {

Header some_header() {
  Header header;
  header.writer = "tests";
  header.algorithm = "z-buffer";
  header.title = "Z-buffer";
  for_each_kind([&]<class E>() {
    header.page.push_back({step_of(kind_of<E>), kind_of<E>, 1, "tests", std::string(description_of<E>.name),
                           "a line of pseudo-code: ∞ ≤ φ"});
  });
  return header;
}

Scene some_scene() {
  Scene scene;
  scene.name = "some";
  scene.source = "tests";
  scene.points = {{0, 0, 1}, {10.5, 0, 1.0 / 3}, {0, 9, -1e300}};
  scene.polygons = {{"A", {1, 2, 3}, 4}, {"", {255, 0, 7}, 0}};
  scene.facets = {{0, 0, 3}, {1, 3, 3}};
  scene.corners = {0, 1, 2, 2, 1, 0};
  scene.camera.near = 0.1;
  scene.camera.far = 10;
  scene.raster = {16, 12, false};
  return scene;
}

bool same_bits(const Event& a, const Event& b) {
  if (a.index() != b.index()) return false;
  return visit_event(
      [&]<class E>(const E& left) {
        const E& right = get<E>(b);
        bool same = true;
        for_each_field<E>([&](const auto& field) {
          if constexpr (std::is_same_v<typename std::remove_cvref_t<decltype(field)>::value_type, double>)
            same = same && bits_of(left.*field.member) == bits_of(right.*field.member);
          else same = same && left.*field.member == right.*field.member;
        });
        return same;
      },
      a);
}

std::vector<RecordedEvent> random_events(std::size_t count, unsigned seed) {
  std::mt19937_64 random(seed);
  const double special[] = {0.0,
                            -0.0,
                            1.0,
                            no_depth,
                            -no_depth,
                            std::numeric_limits<double>::quiet_NaN(),
                            std::numeric_limits<double>::denorm_min(),
                            std::numeric_limits<double>::max(),
                            0.1,
                            -1.0 / 3};
  const auto real = [&] {
    return random() % 4 == 0 ? special[random() % 10]
                             : static_cast<double>(static_cast<std::int64_t>(random())) * 1e-15;
  };
  std::vector<RecordedEvent> events;
  while (events.size() < count) {
    const auto wanted = static_cast<std::uint8_t>(random() % kind_count);
    for_each_kind([&]<class E>() {
      if (kind_of<E> != wanted) return;
      E event{};
      for_each_index<E>([&]<std::size_t I>() {
        using Value = FieldValue<E, I>;
        constexpr std::string_view name = field_at<E, I>.name;
        auto& value = event.*field_at<E, I>.member;
        if constexpr (std::is_same_v<Value, double>) value = real();
        else if constexpr (std::is_same_v<Value, bool>) value = random() % 2 == 0;
        else if constexpr (std::is_enum_v<Value>) value = static_cast<Value>(random() % words_of<Value>.size());
        else if constexpr (name == "x" || name == "x_shadow") value = static_cast<std::int32_t>(random() % 16);
        else if constexpr (name == "y" || name == "y_shadow") value = static_cast<std::int32_t>(random() % 12);
        else if constexpr (name == "polygon" || name == "facet" || name == "nearest_facet" || name == "left_facet" ||
                           name == "right_facet" || name == "owner")
          value = static_cast<std::int32_t>(random() % 2);
        else if constexpr (name == "first" || name == "last") value = static_cast<std::int32_t>(random() % 19) - 2;
        else if constexpr (name == "first_row" || name == "end_row") value = static_cast<std::int32_t>(random() % 13);
        else if constexpr (name == "first_column" || name == "end_column")
          value = static_cast<std::int32_t>(random() % 17);
        else if constexpr (name.substr(0, 7) == "outside")
          value = static_cast<std::int32_t>(static_cast<std::uint32_t>(random()));
        else value = static_cast<std::int32_t>(random() % 50);
      });
      events.push_back({step_of(kind_of<E>), event});
    });
  }
  return events;
}

std::vector<std::uint8_t> recorded_bytes(const std::vector<RecordedEvent>& events) {
  const Scene scene = some_scene();
  TraceRecorder recorder(some_header(), scene);
  for (const RecordedEvent& event : events) record_any(recorder, event.step, event.event);
  recorder.finish();
  return recorder.take_bytes();
}

Trace record_events(const std::vector<RecordedEvent>& events) {
  return Trace::from_bytes(recorded_bytes(events), "in memory");
}

}  // namespace zstep
