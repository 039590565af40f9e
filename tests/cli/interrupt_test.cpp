// Recordings that end before their run does: Ctrl-C and a full disk. What is left can be opened.
#include <doctest/doctest.h>

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "tests/cli/program.hpp"
#include "tests/where.hpp"

using namespace zstep::test;

namespace {

namespace fs = std::filesystem;

// Under sanitizers a program takes its time to start. Linux tells when it has a handler for SIGINT, bit 1 of SigCgt;
// elsewhere a second must do.
void wait_until_it_listens(pid_t child) {
  const auto deadline =
      std::chrono::steady_clock::now() + std::chrono::seconds(fs::exists("/proc/self/status") ? 30 : 1);
  while (std::chrono::steady_clock::now() < deadline) {
    std::ifstream status("/proc/" + std::to_string(child) + "/status");
    for (std::string line; std::getline(status, line);)
      if (line.rfind("SigCgt:", 0) == 0 && (std::stoull(line.substr(7), nullptr, 16) & 2U) != 0) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

}  // namespace

TEST_CASE("Ctrl-C ends a recording with exit code 130 and a trace that can be read") {
  const Folder folder;
  // Some thirty million steps if nobody stopped it.
  const pid_t child = start(folder, {"record", "teapot", "--size", "6400x4800", "-o", "big.ztrace"});
  REQUIRE(child > 0);
  std::error_code ignored;
  int status = 0;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  const auto size = [&] {
    const std::uintmax_t bytes = fs::file_size(folder / "big.ztrace", ignored);
    return ignored ? 0 : bytes;
  };
  while (size() < 200000 && waitpid(child, &status, WNOHANG) == 0 && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  REQUIRE(size() >= 200000);
  kill(child, SIGINT);
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 130);
  const std::string err = text_of(folder / "err");
  CHECK(err.find("big.ztrace: stopped by Ctrl-C after ") != std::string::npos);

  // "… after 1 234 steps; …": info counts as many, and has nothing to complain about.
  const std::size_t after = err.find("after ") + 6;
  const std::string steps = err.substr(after, err.find(" steps") - after);
  const Outcome info = run(folder, "info big.ztrace");
  CHECK(info.code == 0);
  CHECK(info.err.empty());
  CHECK(info.out.find(steps + " steps") != std::string::npos);
}

TEST_CASE("Ctrl-C ends a comparison at once with exit code 130") {
  const Folder folder;
  const pid_t child = start(folder, {"compare-methods", "teapot:64", "--size", "8192x4096", "--methods", "z-buffer"});
  REQUIRE(child > 0);
  wait_until_it_listens(child);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  const auto start_of_end = std::chrono::steady_clock::now();
  kill(child, SIGINT);
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(std::chrono::steady_clock::now() - start_of_end < std::chrono::seconds(10));
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 130);
  CHECK(text_of(folder / "err").find("stopped by Ctrl-C") != std::string::npos);
}

TEST_CASE("a recording that is killed at any moment can be opened, up to its last whole block") {
  const Folder folder;
  std::mt19937 random(3);
  int with_steps = 0;
  for (int round = 0; round < 40; ++round) {
    fs::remove(folder / "big.ztrace");
    const pid_t child = start(folder, {"record", "teapot", "--size", "6400x4800", "-o", "big.ztrace"});
    REQUIRE(child > 0);
    // At some size, as a machine's speed is not known; and then some microseconds later, within a write or between two.
    const std::uintmax_t enough = round < 8 ? 0 : random() % 150'000;
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    std::error_code missing;
    const auto size = [&] {
      const std::uintmax_t now = fs::file_size(folder / "big.ztrace", missing);
      return missing ? 0 : now;
    };
    while (size() < enough && std::chrono::steady_clock::now() < deadline)
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 20'000));
    kill(child, SIGKILL);
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    if (!fs::exists(folder / "big.ztrace")) continue;  // killed before it began
    const Outcome info = run(folder, "info big.ztrace");
    CAPTURE(info.err);
    REQUIRE(info.code == 3);
    // "size  1 234 steps in …": those of whole blocks, and the last of them is there.
    std::string digits;
    const std::size_t at = info.out.find("size ");
    for (const char c : info.out.substr(at, info.out.find(" steps", at) - at))
      if (c >= '0' && c <= '9') digits += c;
    const long steps = std::stol("0" + digits);
    with_steps += steps > 0;
    if (steps > 0) CHECK(run(folder, "dump big.ztrace --from " + std::to_string(steps)).code == 3);
  }
  CHECK(with_steps > 12);
}

TEST_CASE("a disk that fills up ends a recording in one line, and what is there can be read") {
  const Folder folder;
  // A limit on the size of files stands for the disk; its signal ignored, writing fails like on a full one.
  const Outcome outcome =
      shell(folder, "trap '' XFSZ; ulimit -f 256; \"$zstep\" record teapot --size 2000x1500 -o big.ztrace");
  CHECK(outcome.code == 4);
  const std::string said = "\n" + outcome.err;  // notes about the scene, then the one line
  CHECK(times(said, "\n") - 2 == times(said, "\nnote: "));
  CHECK(times(said, "\nbig.ztrace: ") == 1);
  CHECK(outcome.out.empty());
  if (fs::exists(folder / "big.ztrace")) {
    const Outcome info = run(folder, "info big.ztrace");
    CHECK(info.code == 3);
    CHECK(info.out.find(" steps") != std::string::npos);
  }
}
