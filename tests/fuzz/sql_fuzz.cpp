// libFuzzer target: SQL that anybody may type. It must be answered, refused in one line, or stopped by its limits; and
// it can write no file and change nothing.
#include <cstdint>
#include <string>

#include "sim/query/database.hpp"
#include "tests/unit/traces/some_trace.hpp"
#include "traces/error.hpp"

using namespace zstep;

namespace {

const Trace& small_trace() {
  static const Trace trace = [] {
    std::vector<RecordedEvent> events;
    const auto add = [&]<class E>(const E& event) { events.push_back({step_of(kind_of<E>), event}); };
    for (std::int32_t k = 0; k < 500; ++k) {
      if (k % 50 == 0) add(PolygonBegin{k % 2, k % 2});
      if (k % 10 == 0) add(ScanLineBegin{k % 12});
      add(DepthCompare{k % 16, k % 12, k / 7.0, k % 3 == 0});
      add(PixelWrite{k % 16, k % 12, k % 2});
    }
    return record_events(events);
  }();
  return trace;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static query::Database database(small_trace());
  query::Limits limits;
  limits.seconds = 0.2;
  std::int64_t rows = 0;
  try {
    database.run(
        std::string(reinterpret_cast<const char*>(data), size), limits, [](const auto&) {},
        [&](auto) { return ++rows < 1000; });
  } catch (const InputError&) {
  } catch (const query::Stopped&) {
  }
  return 0;
}
