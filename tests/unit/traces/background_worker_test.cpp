// Work beside the caller's own: in order, all of it, and what throws is told once.
#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include "traces/record/journal.hpp"

using namespace zstep;

TEST_CASE("background worker: every piece is done, in order, whether it was to begin at once or with others") {
  for (const std::size_t most : {1u, 2u, 3u, 9u}) {
    CAPTURE(most);
    std::vector<int> done;  // by one thread, read once it has done all
    {
      BackgroundWorker worker(most);
      for (int piece = 0; piece < 2000; ++piece) {
        worker.wait_for_room();
        const auto work = [&done, piece] { done.push_back(piece); };
        if (piece % 7 == 3) worker.begin(work);
        else worker.begin_with_others(work);
        if (piece % 500 == 499) {
          worker.wait();
          REQUIRE(done.size() == static_cast<std::size_t>(piece) + 1);
        }
      }
      for (int piece = 2000; piece < 2000 + static_cast<int>(most); ++piece)
        worker.begin_with_others([&done, piece] { done.push_back(piece); });
    }
    REQUIRE(done.size() == 2000 + most);  // also what waited for others when it ended
    for (std::size_t i = 0; i < done.size(); ++i) REQUIRE(done[i] == static_cast<int>(i));
  }
}

TEST_CASE("background worker: a piece that is to begin at once is not kept waiting for others") {
  std::atomic<bool> done = false;
  BackgroundWorker worker(9);
  worker.begin([&] { done = true; });
  for (int waited = 0; waited < 20'000 && !done; ++waited) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  CHECK(done);
}

TEST_CASE("background worker: what a piece throws is told once, and no other is done before") {
  int done = 0;
  BackgroundWorker worker(5);
  worker.begin([&] { ++done; });
  worker.begin_with_others([] { throw std::runtime_error("full"); });
  worker.begin_with_others([&] { ++done; });
  CHECK_THROWS_AS(worker.wait(), std::runtime_error);
  CHECK(done == 1);
  CHECK_NOTHROW(worker.wait());
  worker.begin_with_others([&] { ++done; });
  worker.wait();
  CHECK(done == 2);
}
