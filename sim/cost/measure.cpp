#include "sim/cost/measure.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <ctime>
#include <numeric>
#include <stdexcept>
#include <type_traits>

#include "sim/cost/allocation_peak.hpp"
#include "traces/scene.hpp"

namespace zstep::compare {

namespace {

// Of the processor that this process has had so far, so that others on the machine do not count; where that cannot be
// had, seconds as they pass.
double processor_seconds() {
#if defined(CLOCK_PROCESS_CPUTIME_ID)
  timespec now{};
  if (clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now) == 0)
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
#endif
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

constexpr double long_run = 1;  // seconds; after one of these no second is needed
constexpr int least_runs = 3;

// Numbers as bytes, for the way from one process to its copy.
class Writer {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    const auto* from = reinterpret_cast<const std::uint8_t*>(&value);
    bytes.insert(bytes.end(), from, from + sizeof value);
  }
  template <class T>
  void put(const std::vector<T>& values) {
    put(static_cast<std::uint64_t>(values.size()));
    const auto* from = reinterpret_cast<const std::uint8_t*>(values.data());
    bytes.insert(bytes.end(), from, from + values.size() * sizeof(T));
  }
  std::vector<std::uint8_t> bytes;
};

class Reader {
 public:
  explicit Reader(const std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}
  template <class T>
  void get(T& value) {
    take(&value, sizeof value);
  }
  template <class T>
  void get(std::vector<T>& values) {
    std::uint64_t sent = 0;
    get(sent);
    const std::size_t size = sent;
    if (sent > (bytes_.size() - at_) / sizeof(T)) throw std::logic_error("a measurement came cut off");
    values.resize(size);
    if (size > 0) take(values.data(), size * sizeof(T));
  }

 private:
  void take(void* to, std::size_t count) {
    if (count > bytes_.size() - at_) throw std::logic_error("a measurement came cut off");
    std::memcpy(to, bytes_.data() + at_, count);
    at_ += count;
  }
  const std::vector<std::uint8_t>& bytes_;
  std::size_t at_ = 0;
};

double timed(const Method& method, const Scene& scene, const Conventions& conventions, Picture& picture) {
  NullRecorder nothing;
  const double start = processor_seconds();
  picture = method.taught(scene, conventions, nothing);
  return processor_seconds() - start;
}

std::vector<double> time_runs(const Method& method, const Scene& scene, const Conventions& conventions,
                              const MeasureOptions& options, Picture& picture) {
  const double first = timed(method, scene, conventions, picture);
  if (first > long_run) return {first};
  std::vector<double> seconds;  // the first, which finds caches and memory cold, is left out
  double sum = 0;
  const auto runs = [&] { return size32(seconds); };
  while (runs() < std::min(least_runs, options.most_runs) || (sum < options.enough && runs() < options.most_runs)) {
    seconds.push_back(timed(method, scene, conventions, picture));
    sum += seconds.back();
  }
  return seconds;
}

}  // namespace

double Measured::median_seconds() const {
  if (seconds.empty()) return 0;
  std::vector<double> sorted = seconds;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t middle = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

std::int64_t Measured::steps() const { return std::accumulate(count.begin(), count.end(), std::int64_t{0}); }

Measured measure(const Method& method, const Scene& scene, const Conventions& conventions,
                 const MeasureOptions& options, const std::function<void(double)>& tick) {
  const auto work = [&] {
    Writer out;
    Picture picture;
    out.put(time_runs(method, scene, conventions, options, picture));
    out.put(picture.width);
    out.put(picture.height);
    out.put(picture.polygon);
    out.put(picture.depth);
    out.put(picture.ink);

    std::int64_t heap = -1;
    CountRecorder counts;
    if (options.count) {
      const AllocationPeak watch;
      const Picture again = method.count(scene, conventions, counts);
      heap = watch.peak();
    }
    out.put(heap);
    out.put(counts.count);
    return std::move(out.bytes);
  };

  const Apart apart = run_apart(work, options.limit, tick);
  Measured measured;
  measured.method = &method, measured.end = apart.end, measured.what = apart.what;
  if (!measured.done()) return measured;
  Reader in(apart.bytes);
  in.get(measured.seconds);
  in.get(measured.picture.width);
  in.get(measured.picture.height);
  in.get(measured.picture.polygon);
  in.get(measured.picture.depth);
  in.get(measured.picture.ink);
  in.get(measured.heap);
  in.get(measured.count);
  return measured;
}

}  // namespace zstep::compare
