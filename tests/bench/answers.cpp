#include "tests/bench/answers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <random>

#include "sim/answers/explain_value.hpp"
#include "sim/answers/why_not.hpp"
#include "sim/query/database.hpp"
#include "traces/error.hpp"
#include "traces/file/visit.hpp"

namespace zstep::bench {

namespace {

constexpr int questions = 100;

std::string of(std::vector<double> samples) {
  std::sort(samples.begin(), samples.end());
  const auto at = [&](double share) {
    return samples[static_cast<std::size_t>(share * static_cast<double>(samples.size() - 1))];
  };
  return fmt::format("{:.1f} ms; {:.1f} ms", at(0.5), at(0.99));
}

template <class Ask>
std::string time_of(Ask&& ask) {
  std::vector<double> samples;
  for (int i = 0; i < questions; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    ask();
    samples.push_back(1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  return of(std::move(samples));
}

}  // namespace

std::vector<std::pair<std::string, std::string>> measure_answers(const Trace& trace, Replay& replay) {
  std::mt19937_64 random(2);
  const auto below = [&](std::size_t count) { return static_cast<std::int64_t>(random() % count); };
  const Scene& scene = trace.scene();
  const auto pixel = [&] {
    return Trace::Pixel{static_cast<std::int32_t>(below(static_cast<std::size_t>(scene.raster.width))),
                        static_cast<std::int32_t>(below(static_cast<std::size_t>(scene.raster.height)))};
  };
  std::size_t links = 0;
  const std::int64_t seeks = replay.seeks();
  const std::string steps = time_of([&] {
    links += answers::explain_value(trace, replay, {below(static_cast<std::size_t>(trace.size())) + 1}).links.size();
  });
  const auto seeks_of_steps = static_cast<double>(replay.seeks() - seeks) / questions;
  const std::string pixels = time_of(
      [&] { links += answers::explain_value(trace, replay, answers::of_pixel(trace.size(), pixel())).links.size(); });
  const std::string why = time_of([&] {
    links +=
        answers::why_not(trace, static_cast<std::int32_t>(below(scene.polygons.size())), pixel(), &replay).chain.size();
  });
  // Of a polygon that reached the pixel there is more to tell.
  const std::string there = time_of([&] {
    const Trace::Pixel at = pixel();
    const auto step = trace.previous(
        trace.size() + 1,
        [](const RecordedEvent& recorded) {
          return holds<PixelWrite>(recorded.event) || holds<PixelPaint>(recorded.event);
        },
        at);
    if (!step) return;
    const Event event = trace.event(*step).event;
    const auto* write = get_if<PixelWrite>(&event);
    const std::int32_t polygon = write != nullptr ? write->polygon : get<PixelPaint>(event).polygon;
    if (polygon >= 0) links += answers::why_not(trace, polygon, at, &replay).chain.size();
  });
  if (links == 0) fmt::print(" ");
  return {{"explain a step's value, median; p99", steps},
          {"seeks to explain a step's value, mean", fmt::format("{:.1f}", seeks_of_steps)},
          {"explain a pixel's depth, median; p99", pixels},
          {"why not, any polygon, median; p99", why},
          {"why not, the one that is seen, median; p99", there}};
}

LargestTable largest_table(const Trace& trace) {
  std::array<std::int64_t, kind_count> rows{};
  trace.visit(0, trace.size(), [&]<class E>(std::int64_t, std::uint8_t, const E&) {
    ++rows[kind_of<E>];
    return true;
  });
  const auto most = static_cast<std::uint8_t>(std::max_element(rows.begin(), rows.end()) - rows.begin());
  std::string name, columns;
  int taken = 0;
  for_each_kind([&]<class E>() {
    if (kind_of<E> != most) return;
    name = description_of<E>.name;
    for_each_field<E>([&](const auto& field) {
      if (taken++ < 2) columns += fmt::format(", sum({})", field.name);
    });
  });
  return {name, fmt::format("select count(*){} from {}", columns, name)};
}

std::int64_t scan_by_sql(const Trace& trace, const LargestTable& table) {
  std::int64_t rows = 0;
  query::Database database(trace);
  database.run(
      table.question, {}, [](const std::vector<std::string>&) {},
      [&](std::span<const query::Value> values) {
        if (const auto* count = std::get_if<std::int64_t>(&values[0])) rows = *count;
        return true;
      });
  return rows;
}

}  // namespace zstep::bench
