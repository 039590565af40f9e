// A recording that is killed: what its file and its journal tell of it.
#include <doctest/doctest.h>

#if defined(__unix__)

#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "algorithms/catalog/catalog.hpp"
#include "algorithms/scene/load.hpp"
#include "tests/folder.hpp"
#include "tests/golden/golden.hpp"
#include "traces/error.hpp"
#include "tests/unit/traces/some_trace.hpp"
#include "traces/record/journal.hpp"
#include "traces/record/trace_recorder.hpp"

using namespace zstep;

namespace {

namespace fs = std::filesystem;

/// A folder for a trace.
struct TraceFolder : test::Folder {
  fs::path trace = path() / "run.ztrace", journal = journal_of(trace);
};

std::vector<RecordedEvent> events_of(const Trace& trace) {
  std::vector<RecordedEvent> events;
  trace.each(0, trace.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    events.push_back(recorded);
    return true;
  });
  return events;
}

/// The most that may be missing: the pixels of a span that are not in the log yet.
constexpr std::int64_t of_a_span = 4 * codec::run_limit + 3;

/// Records these events in a process of its own, which counts them and kills itself after the last; `meanwhile` is
/// called with the process and its count.
template <class Meanwhile>
std::int64_t record_and_be_killed(const fs::path& to, const Trace& like, const std::vector<RecordedEvent>& events,
                                  Meanwhile&& meanwhile) {
  void* shared = mmap(nullptr, sizeof(std::int64_t), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  REQUIRE(shared != MAP_FAILED);
  volatile std::int64_t& count = *static_cast<std::int64_t*>(shared);
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    TraceRecorder recorder(to, like.header(), like.scene());
    for (const RecordedEvent& event : events) {
      record_any(recorder, event.step, event.event);
      count = count + 1;
    }
    raise(SIGKILL);
  }
  meanwhile(child, count);
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFSIGNALED(status));
  CHECK(WTERMSIG(status) == SIGKILL);
  const std::int64_t counted = count;
  munmap(shared, sizeof(std::int64_t));
  return counted;
}

/// The steps that can be read of what was killed, the first ones of `all`.
std::int64_t steps_kept(const TraceFolder& folder, const std::vector<RecordedEvent>& all) {
  const Trace trace = Trace::open(folder.trace);
  const std::vector<RecordedEvent> kept = events_of(trace);
  REQUIRE(kept.size() <= all.size());
  std::size_t same = 0;
  while (same < kept.size() && kept[same].step == all[same].step && same_bits(kept[same].event, all[same].event))
    ++same;
  CHECK(same == kept.size());
  return trace.size();
}

/// Some five blocks of a run.
Trace long_run() {
  ViewOptions view;
  view.width = 320, view.height = 240;
  return test::recorded_by("z-buffer", look_at_scene(load_scene("teapot:4").scene, view));
}

std::string bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
void put_bytes(const fs::path& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

}  // namespace

TEST_CASE("law: a recording that is killed keeps every step but those of its last span, whatever the method") {
  const TraceFolder folder;
  test::for_each_golden([&](const std::string& name, const Trace& golden) {
    CAPTURE(name);
    const std::vector<RecordedEvent> events = events_of(golden);
    CHECK(record_and_be_killed(folder.trace, golden, events, [](auto...) {}) == golden.size());
    CHECK(steps_kept(folder, events) >= golden.size() - of_a_span);
  });
}

TEST_CASE("law: a recording that is killed at any moment has lost the steps of its last span, and no more") {
  const TraceFolder folder;
  const Trace run = long_run();
  const std::vector<RecordedEvent> events = events_of(run);
  REQUIRE(events.size() > 4 * block_events);
  std::mt19937 random(5);
  int with_steps = 0;
  for (int round = 0; round < 100; ++round) {
    CAPTURE(round);
    fs::remove(folder.trace);
    // Some once it has come to a random step, which does not depend on how fast the machine is; the others at a random
    // time.
    const bool at_step = round % 4 == 0;
    const auto target = static_cast<std::int64_t>(random() % events.size());
    const auto time = std::chrono::microseconds(random() % 12'000);
    const std::int64_t counted =
        record_and_be_killed(folder.trace, run, events, [&](pid_t child, const volatile std::int64_t& count) {
          if (at_step) {
            const auto deadline =
                std::chrono::steady_clock::now() + std::chrono::minutes(1);  // a child that died would not count on
            while (count < target && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
          } else {
            std::this_thread::sleep_for(time);
          }
          kill(child, SIGKILL);
        });
    CHECK((!at_step || counted >= target));
    if (!fs::exists(folder.trace)) {  // its head was not written yet
      CHECK(counted == 0);
      continue;
    }
    const std::int64_t kept = steps_kept(folder, events);
    CHECK(kept >= counted - of_a_span);
    CHECK(kept <= counted + 1);  // it may have been killed before it counted
    with_steps += kept > 0;
  }
  CHECK(with_steps > 20);
}

TEST_CASE("law: a recording takes the place of the trace that had its name once it can be opened itself") {
  const TraceFolder folder;
  const Scene scene = some_scene();
  TraceRecorder(folder.trace, some_header(), scene).finish();
  Scene large = scene;  // its head takes time
  large.points.resize(200'000);
  const auto begin_another = [&] {
    const pid_t child = fork();
    if (child == 0) {
      const TraceRecorder recorder(folder.trace, some_header(), large);
      pause();
    }
    return child;
  };
  const auto end = [](pid_t child) {
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
  };
  // How long a head takes depends on the machine.
  using Clock = std::chrono::steady_clock;
  const std::uintmax_t size = fs::file_size(folder.trace);
  const auto before = Clock::now();
  const pid_t first = begin_another();
  std::error_code ignored;
  while (fs::file_size(folder.trace, ignored) <= size && Clock::now() - before < std::chrono::seconds(30))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const auto microseconds = std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - before).count();
  end(first);
  CHECK(Trace::open(folder.trace).scene().points.size() == large.points.size());
  TraceRecorder(folder.trace, some_header(), scene).finish();

  std::mt19937 random(11);
  for (int round = 0; round < 30; ++round) {
    CAPTURE(round);
    const pid_t child = begin_another();
    std::this_thread::sleep_for(std::chrono::microseconds(static_cast<std::int64_t>(random()) % (2 * microseconds)));
    end(child);
    const Trace trace = Trace::open(folder.trace);
    const bool is_old = trace.scene().points.size() == scene.points.size();
    CHECK(trace.warnings().size() == (is_old ? 0 : 1));
    if (!is_old) TraceRecorder(folder.trace, some_header(), scene).finish();
  }
}

TEST_CASE("journal: a recording that comes to its end leaves none, nor does one that is given up") {
  const TraceFolder folder;
  const Scene scene = some_scene();
  {
    TraceRecorder recorder(folder.trace, some_header(), scene);
    CHECK(fs::exists(folder.journal));
    recorder.finish();
  }
  CHECK_FALSE(fs::exists(folder.journal));
  { const TraceRecorder given_up(folder.trace, some_header(), scene); }
  CHECK_FALSE(fs::exists(folder.journal));
}

TEST_CASE("journal: a file of that name that is none is left as it is") {
  const TraceFolder folder;
  put_bytes(folder.journal, "Dear diary");
  const Scene scene = some_scene();
  TraceRecorder(folder.trace, some_header(), scene).finish();
  CHECK(bytes_of(folder.journal) == "Dear diary");
  CHECK(Trace::open(folder.trace).warnings().empty());
}

TEST_CASE("journal: it says nothing of another trace, and is not looked at beside a trace that is whole") {
  const TraceFolder folder;
  const std::vector<RecordedEvent> events = random_events(300, 1);
  const Trace like = record_events(events);
  record_and_be_killed(folder.trace, like, events, [](auto...) {});
  REQUIRE(steps_kept(folder, events) > 0);
  const std::string journal = bytes_of(folder.journal);
  Header other = some_header();
  other.writer = "somebody else";
  const Scene scene = some_scene();
  TraceRecorder(folder.trace, other, scene).finish();
  put_bytes(folder.journal, journal);
  CHECK(Trace::open(folder.trace).size() == 0);
  const std::string whole = bytes_of(folder.trace);
  put_bytes(folder.trace, whole.substr(0, whole.size() - 1));  // now it has no end
  const Trace cut = Trace::open(folder.trace);
  CHECK(cut.size() == 0);
  CHECK(cut.warnings().size() == 1);
}

TEST_CASE("journal: damaged or cut anywhere, it tells fewer steps or others, and nothing is read beyond it") {
  const TraceFolder folder;
  const Trace run = long_run();
  std::vector<RecordedEvent> events = events_of(run);
  events.resize(2000);
  record_and_be_killed(folder.trace, run, events, [](auto...) {});
  const std::string journal = bytes_of(folder.journal);
  const auto read = [&] {
    try {
      const Trace trace = Trace::open(folder.trace);
      return static_cast<std::int64_t>(events_of(trace).size());
    } catch (const InputError& error) {
      CHECK(std::string(error.what()).find('\n') == std::string::npos);
      return std::int64_t{-1};
    }
  };
  const std::int64_t all = read();
  REQUIRE(all >= static_cast<std::int64_t>(events.size()) - of_a_span);
  std::mt19937 random(7);
  // Its head, and the log behind it; 8 bytes of the head say where the block is.
  const std::size_t log = 4096 + 3 * ((journal.size() - 4096) / 4);
  int fewer = 0;
  for (int round = 0; round < 400; ++round) {
    std::fstream file(folder.journal, std::ios::binary | std::ios::in | std::ios::out);
    std::vector<std::size_t> places;
    for (std::size_t hits = 1 + random() % 3; hits > 0; --hits) {
      places.push_back(random() % 4 == 0 ? random() % 240 : log + random() % 20'000);
      file.seekp(static_cast<std::streamoff>(places.back())).put(static_cast<char>(random()));
    }
    file.flush();
    fewer += read() < all;
    for (const std::size_t at : places) file.seekp(static_cast<std::streamoff>(at)).put(journal[at]);
  }
  REQUIRE(read() == all);
  CHECK(fewer > 40);
  for (std::size_t size = log + 20'000; size > 0; size -= std::min<std::size_t>(size, size > log ? 1000 : 500'000)) {
    fs::resize_file(folder.journal, size);
    CHECK(read() < all);
  }
}

#endif
