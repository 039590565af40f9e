// Mutations that keep a text's words and lines whole, so that more than a reader's first complaint is reached: words of
// the format in the place of others, numbers at their limits, members and lines that are dropped, doubled and moved.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <random>
#include <string>
#include <vector>

/// libFuzzer's own mutation of some bytes, in place.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace zstep::fuzz {

using Random = std::minstd_rand;
/// From 0 to below `end`.
inline std::size_t pick(Random& random, std::size_t end) { return end == 0 ? 0 : random() % end; }

class TextMutator {
 public:
  /// Its words are those of these files of the checkout.
  explicit TextMutator(std::initializer_list<const char*> files);

  /// One to four mutations.
  std::string operator()(std::string text, Random& random) const;
  /// The same for LLVMFuzzerCustomMutator.
  std::size_t operator()(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) const;

  const std::string& word(Random& random) const { return words_[pick(random, words_.size())]; }

 private:
  void once(std::string& text, Random& random) const;
  std::vector<std::string> words_;
};

/// Puts bytes where a custom mutator wants them; those beyond `most` are left out.
template <class Container>
std::size_t give(const Container& bytes, std::uint8_t* data, std::size_t most) {
  const std::size_t size = bytes.size() < most ? bytes.size() : most;
  for (std::size_t at = 0; at < size; ++at) data[at] = static_cast<std::uint8_t>(bytes[at]);
  return size;
}

/// libFuzzer's own mutation of some bytes or characters, which may grow a little.
template <class Container>
void mutate_bytes(Container& bytes) {
  const std::size_t size = bytes.size();
  bytes.resize(size + 16);
  auto* data = reinterpret_cast<std::uint8_t*>(bytes.data());
  bytes.resize(LLVMFuzzerMutate(data, size, size + 16));
}

}  // namespace zstep::fuzz
