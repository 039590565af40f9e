// libFuzzer target: traces, as a file or as JSON Lines. A file is mutated behind its checksums, lines by their words;
// lines become a file now and then. What can be opened is asked everything.
#include <algorithm>
#include <numeric>
#include <string>

#include "tests/fuzz/questions.hpp"
#include "tests/fuzz/trace_mutator.hpp"
#include "traces/file/container.hpp"

using namespace zstep;
using namespace zstep::fuzz;

namespace {

bool is_file(std::span<const std::uint8_t> bytes) {
  return bytes.size() >= trace_signature.size() &&
         std::equal(trace_signature.begin(), trace_signature.end(), bytes.begin());
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  static const TextMutator words({"docs/trace-format.md"});
  Random random(seed + 1);
  const std::span<const std::uint8_t> bytes(data, size);
  if (is_file(bytes)) return give(mutate_trace(bytes, words, random), data, most);
  const std::string text(bytes.begin(), bytes.end());
  if (random() % 2 == 0) {
    Bytes file;
    if (answered([&] { file = bytes_of_lines(text); })) return give(mutate_trace(file, words, random), data, most);
  }
  return give(words(text, random), data, most);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> bytes(data, size);
  answered([&] {
    const Trace trace = is_file(bytes) ? Trace::from_bytes({bytes.begin(), bytes.end()}, "fuzz")
                                       : trace_of_lines({bytes.begin(), bytes.end()});
    ask_everything(trace, std::accumulate(bytes.begin(), bytes.end(), 1u));
  });
  return 0;
}
