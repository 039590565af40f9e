#include "sim/homework/seeds.hpp"

#include <algorithm>
#include <bit>
#include <cctype>
#include <random>
#include <set>

#include <fmt/format.h>

#include "sim/image/file.hpp"
#include "traces/error.hpp"
#include "traces/text.hpp"

namespace zstep::homework {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_name = 100, most_names = 20'000;

std::string small_file(const fs::path& path) {
  const std::vector<std::uint8_t> bytes = read_file(path, std::uintmax_t{4} << 20);
  return {bytes.begin(), bytes.end()};
}

}  // namespace

std::uint64_t keyed_number(const Key& key, std::string_view text) {
  std::uint64_t a = key[0] ^ 0x736f6d6570736575, b = key[1] ^ 0x646f72616e646f6d, c = key[0] ^ 0x6c7967656e657261,
                d = key[1] ^ 0x7465646279746573;
  const auto mix = [&](int rounds) {
    while (rounds-- > 0) {
      a += b, b = std::rotl(b, 13) ^ a, a = std::rotl(a, 32);
      c += d, d = std::rotl(d, 16) ^ c;
      a += d, d = std::rotl(d, 21) ^ a;
      c += b, b = std::rotl(b, 17) ^ c, c = std::rotl(c, 32);
    }
  };
  // Eight bytes at a time, the lowest first; the last ones end in the text's length.
  for (std::size_t begin = 0; begin <= text.size(); begin += 8) {
    std::uint64_t word = begin + 8 > text.size() ? std::uint64_t{text.size() & 255} << 56 : 0;
    for (std::size_t i = begin; i < std::min(begin + 8, text.size()); ++i)
      word |= std::uint64_t{static_cast<unsigned char>(text[i])} << (8 * (i - begin));
    d ^= word;
    mix(2);
    a ^= word;
  }
  c ^= 255;
  mix(4);
  return a ^ b ^ c ^ d;
}

std::optional<Key> key_of(const fs::path& folder) {
  const fs::path path = folder / key_file;
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return std::nullopt;
  std::string text = small_file(path);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
  const bool digits =
      std::all_of(text.begin(), text.end(), [](char c) { return std::isxdigit(static_cast<unsigned char>(c)) != 0; });
  if (text.size() != 32 || !digits)
    throw InputError(path.string() + ":1", "is no key",
                     "a key is 32 hexadecimal digits; zstep homework seed makes one");
  return Key{std::stoull(text.substr(0, 16), nullptr, 16), std::stoull(text.substr(16), nullptr, 16)};
}

Key new_key(const std::string& from) {
  if (!from.empty()) return {keyed_number({0, 0}, from), keyed_number({0, 1}, from)};
  std::random_device device;
  Key key{};
  for (std::uint64_t& half : key) half = std::uint64_t{device()} << 32 | device();
  return key;
}

void write_key(const fs::path& folder, const Key& key) {
  const std::string text = fmt::format("{:016x}{:016x}\n", key[0], key[1]);
  write_file(folder / key_file, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

std::string why_no_name(std::string_view name) {
  if (name.empty()) return "is empty";
  if (name.size() > longest_name) return fmt::format("is longer than {} bytes", longest_name);
  if (name.front() == '.' || name.front() == '-') return fmt::format("begins with '{}'", name.front());
  if (name.find_first_of("/\\:*?\"<>|") != std::string_view::npos) return "has a sign that no folder's name may have";
  if (printable(std::string(name)) != name) return "has signs that cannot be printed";
  return "";
}

std::vector<std::string> names_in(const fs::path& file) {
  const std::string text = small_file(file);
  std::vector<std::string> names;
  std::set<std::string> seen;
  std::size_t line = 0;
  for (std::size_t begin = 0; begin < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string name = text.substr(begin, end - begin);
    begin = end + 1;
    while (!name.empty() && (name.back() == ' ' || name.back() == '\r' || name.back() == '\t')) name.pop_back();
    if (name.empty()) continue;
    const std::string at = fmt::format("{}:{}", file.string(), line + 1);
    if (const std::string why = why_no_name(name); !why.empty())
      throw InputError(at, fmt::format("'{}' {}", printable(name), why), "give names of folders, one a line");
    if (!seen.insert(name).second)
      throw InputError(at, fmt::format("'{}' is there twice", name), "give each student another name");
    if (names.size() == most_names)
      throw InputError(at, fmt::format("there are more than {} names", most_names), "give fewer");
    names.push_back(name);
  }
  if (names.empty()) throw InputError(file.string(), "has no names", "write a student's name on each line");
  return names;
}

}  // namespace zstep::homework
