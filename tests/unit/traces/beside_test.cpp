// Work beside the caller's own: in order, all of it, and what throws is told once.
#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include "traces/record/beside.hpp"

using namespace zstep;

TEST_CASE("beside: every piece is done, in order, whether it was to begin at once or with others") {
  for (const std::size_t most : {1u, 2u, 3u, 9u}) {
    CAPTURE(most);
    std::vector<int> done;  // by one thread, read once it has done all
    {
      Beside beside(most);
      for (int piece = 0; piece < 2000; ++piece) {
        beside.wait_for_room();
        const auto work = [&done, piece] { done.push_back(piece); };
        if (piece % 7 == 3) beside.begin(work);
        else beside.begin_with_others(work);
        if (piece % 500 == 499) {
          beside.wait();
          REQUIRE(done.size() == static_cast<std::size_t>(piece) + 1);
        }
      }
      for (int piece = 2000; piece < 2000 + static_cast<int>(most); ++piece) beside.begin_with_others([&done, piece] { done.push_back(piece); });
    }
    REQUIRE(done.size() == 2000 + most);  // also what waited for others when it ended
    for (std::size_t i = 0; i < done.size(); ++i) REQUIRE(done[i] == static_cast<int>(i));
  }
}

TEST_CASE("beside: a piece that is to begin at once is not kept waiting for others") {
  std::atomic<bool> done = false;
  Beside beside(9);
  beside.begin([&] { done = true; });
  for (int waited = 0; waited < 20'000 && !done; ++waited) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  CHECK(done);
}

TEST_CASE("beside: what a piece throws is told once, and no other is done before") {
  int done = 0;
  Beside beside(5);
  beside.begin([&] { ++done; });
  beside.begin_with_others([] { throw std::runtime_error("full"); });
  beside.begin_with_others([&] { ++done; });
  CHECK_THROWS_AS(beside.wait(), std::runtime_error);
  CHECK(done == 1);
  CHECK_NOTHROW(beside.wait());
  beside.begin_with_others([&] { ++done; });
  beside.wait();
  CHECK(done == 2);
}
