#include "sim/homework/own_scenes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "traces/image/file.hpp"
#include "traces/error.hpp"
#include "traces/events/slots.hpp"
#include "traces/events/vocabulary.hpp"
#include "traces/scene.hpp"
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
      word |= std::uint64_t{byte_of(text[i])} << (8 * (i - begin));
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
  while (!text.empty() && std::isspace(byte_of(text.back()))) text.pop_back();
  const bool digits = std::all_of(text.begin(), text.end(), [](char c) { return std::isxdigit(byte_of(c)) != 0; });
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

namespace {

/// Positions are in quarters of a pixel, depths in 512ths: exact in every format, and some meet centres of pixels.
constexpr std::int64_t quarters = 4, depth_parts = 512;

struct Corner {
  std::int64_t x, y, z;
};

/// Whole numbers of the generator alone, without std::uniform_int_distribution, which differs between libraries.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  std::int64_t roll(Range range) {
    const std::uint64_t count = range.most - range.least + 1;
    return range.least + static_cast<std::int64_t>(engine_() % count);
  }

 private:
  std::mt19937_64 engine_;
};

std::int64_t doubled_area(const std::vector<Corner>& corners) {
  std::int64_t area = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Corner &a = corners[i], &b = corners[(i + 1) % corners.size()];
    area += a.x * b.y - b.x * a.y;
  }
  return area < 0 ? -area : area;
}

std::vector<Corner> triangle(Dice& dice, Range x, Range y) {
  std::vector<Corner> corners;
  for (int i = 0; i < 3; ++i) {
    // Some edges are horizontal, which chance alone would make too rare.
    const bool level = i > 0 && dice.roll({1, 6}) == 1;
    const std::int64_t at_x = dice.roll(x), at_y = level ? corners.back().y : dice.roll(y);
    corners.push_back({at_x, at_y, 8 * dice.roll({8, 56})});
  }
  return corners;
}

/// Corners in the order in which they are seen from the middle: the outline does not cross itself, and may be concave.
/// They lie in one plane.
std::vector<Corner> polygon(Dice& dice, Range x, Range y, std::int64_t count) {
  std::vector<Corner> corners;
  std::int64_t middle_x = 0, middle_y = 0;
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t at_x = dice.roll(x), at_y = dice.roll(y);
    corners.push_back({at_x, at_y, 0});
    middle_x += at_x, middle_y += at_y;
  }
  const auto from_middle = [&](const Corner& c) { return std::array{count * c.x - middle_x, count * c.y - middle_y}; };
  const auto lower_half = [](const auto& d) { return d[1] > 0 || (d[1] == 0 && d[0] < 0); };
  std::sort(corners.begin(), corners.end(), [&](const Corner& a, const Corner& b) {
    const auto to_a = from_middle(a), to_b = from_middle(b);
    if (lower_half(to_a) != lower_half(to_b)) return lower_half(to_b);
    const std::int64_t turn = to_a[0] * to_b[1] - to_a[1] * to_b[0];
    if (turn != 0) return turn > 0;
    return std::array{a.x, a.y} < std::array{b.x, b.y};
  });
  const std::int64_t dz_dx = dice.roll({-3, 3}), dz_dy = dice.roll({-3, 3}), nearest = dice.roll({16, 256});
  std::int64_t least = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    corners[i].z = dz_dx * corners[i].x + dz_dy * corners[i].y;
    least = i == 0 ? corners[i].z : std::min(least, corners[i].z);
  }
  for (Corner& corner : corners) corner.z += nearest - least;
  return corners;
}

}  // namespace

std::string generated_scene(const Generator& generator, const std::string& name, std::uint64_t seed) {
  Dice dice(seed);
  const std::int64_t width = dice.roll(generator.width), height = dice.roll(generator.height);
  std::string text = fmt::format("name = \"{}\"\ncoordinates = \"screen\"\n\n[raster]\nwidth = {}\nheight = {}\n", name,
                                 width, height);
  const Range x{1, quarters * (width - 1) - 1}, y{1, quarters * (height - 1) - 1};
  const std::int64_t count = dice.roll(generator.count), least_area = 2 * (x.most * y.most) / 16;
  for (std::int64_t i = 0; i < count; ++i) {
    std::vector<Corner> corners;
    for (int attempt = 0; attempt < 100 && doubled_area(corners) < least_area; ++attempt)
      corners = generator.what == Generator::What::triangles ? triangle(dice, x, y)
                                                             : polygon(dice, x, y, dice.roll(generator.corners));
    text += fmt::format("\n[[polygon]]\nname = \"{}\"\npoints = [", static_cast<char>('A' + i));
    for (std::size_t k = 0; k < corners.size(); ++k)
      text += fmt::format("{}[{}, {}, {}]", k == 0 ? "" : ", ", ratio(corners[k].x, quarters),
                          ratio(corners[k].y, quarters), ratio(corners[k].z, depth_parts));
    text += "]\n";
  }
  return text;
}

Difficulty difficulty_of(const Trace& run) {
  Difficulty found;
  found.steps = run.size();
  const Raster& raster = run.scene().raster;
  std::vector<bool> drawn(pixel_count(raster.width, raster.height));
  bool wins = false, loses = false;
  const auto end_span = [&] {
    found.crossing += wins && loses;
    wins = loses = false;
  };
  run.each(0, run.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    const Event& event = recorded.event;
    found.kinds.insert(static_cast<std::uint8_t>(event.index()));
    if (holds<SpanBegin>(event)) end_span();
    visit_event(
        [&]<class E>(const E& e) {
          if constexpr (has(at_pixel<E>, AtPixel::verdict)) {
            found.losing += !e.nearer;
            loses = loses || !e.nearer;
            wins = wins || (e.nearer && drawn.at(pixel_at(e.x, e.y, raster.width)));
          }
          if constexpr (std::is_same_v<E, PixelWrite>) drawn.at(pixel_at(e.x, e.y, raster.width)) = true;
        },
        event);
    return true;
  });
  end_span();
  return found;
}

namespace {

/// So many hashes are kept of a run; a run has as many entries in the index by which like ones are found.
constexpr std::size_t kept_hashes = 128, indexed_hashes = 16;
/// Runs are alike from this share on; scenes are different up to that one.
constexpr double alike_from = 0.8, different_to = 0.2;
/// Fewer steps or numbers can be the same by chance: of a program that was hardly begun, say.
constexpr std::int64_t fewest_telling = 20;

std::uint64_t mixed_bits(std::uint64_t value) {  // the finalizer of SplitMix64 (G. L. Steele et al., 2014)
  value += 0x9e3779b97f4a7c15;
  value = (value ^ value >> 30) * 0xbf58476d1ce4e5b9;
  value = (value ^ value >> 27) * 0x94d049bb133111eb;
  return value ^ value >> 31;
}

/// The number to about 12 bits. Where it goes to the next one lies off the numbers of few bits, which scenes have.
double number_of_few_bits(double value) {
  constexpr int bits = 12;
  constexpr double off = 0.3;
  int exponent = 0;
  const double part = std::frexp(value, &exponent);
  return std::ldexp(std::floor(std::ldexp(part, bits) + 0.5 + off), exponent - bits);
}

struct OwnItem {
  std::size_t who = 0;
  bool right = false;  ///< the right run of the student's scene; else what the student handed in
  const OwnRun* of = nullptr;
  const Sketch& sketch() const { return right ? of->right : of->run; }
};

/// Who belongs together; each set is known by one of its members.
class JoinedSets {
 public:
  explicit JoinedSets(std::size_t count) : up_(count) { std::iota(up_.begin(), up_.end(), std::size_t{0}); }
  std::size_t of(std::size_t one) {
    while (up_[one] != one) one = up_[one] = up_[up_[one]];
    return one;
  }
  void join(std::size_t a, std::size_t b) {
    a = of(a), b = of(b);
    up_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> up_;
};

bool is_telling(const Sketch& sketch) { return sketch.steps >= fewest_telling && sketch.numbers >= fewest_telling; }

class AlikeFinder {
 public:
  explicit AlikeFinder(std::vector<OwnItem> items) : items_(std::move(items)), sets_(items_.size()) { compare(); }

  /// The sets of runs that are alike.
  std::vector<AlikeRuns> found(const std::vector<HandedIn>& all) {
    std::map<std::size_t, std::vector<const OwnItem*>> by_set;
    std::map<std::size_t, std::set<std::string>> right_for;
    for (std::size_t i = 0; i < items_.size(); ++i)
      if (!items_[i].right) by_set[sets_.of(i)].push_back(&items_[i]);
    for (const auto& [run, right] : answers_) right_for[sets_.of(run)].insert(all[items_[right].who].name);
    std::vector<AlikeRuns> found;
    for (const auto& [set, runs] : by_set) {
      const std::set<std::string>& whose = right_for[set];
      if (runs.size() < 2 && whose.empty()) continue;
      AlikeRuns one;
      one.scene = runs.front()->of->scene;
      one.steps = runs.front()->sketch().steps;
      for (const OwnItem* run : runs) {
        one.names.push_back(all[run->who].name);
        one.same = one.same && run->sketch().whole == runs.front()->sketch().whole;
        one.share = std::min(one.share, in_common(run->sketch(), runs.front()->sketch()));
      }
      one.right_for.assign(whose.begin(), whose.end());
      found.push_back(std::move(one));
    }
    return found;
  }

 private:
  /// Those with a hash of the least in common are held against the first few of them that are not alike.
  void compare() {
    std::vector<std::pair<std::uint64_t, std::size_t>> index;
    for (std::size_t i = 0; i < items_.size(); ++i) {
      const std::vector<std::uint64_t>& least = items_[i].sketch().least;
      for (std::size_t k = 0; k < std::min(indexed_hashes, least.size()); ++k) index.emplace_back(least[k], i);
    }
    std::sort(index.begin(), index.end());
    constexpr std::size_t few = 8;
    std::vector<std::size_t> first;
    for (std::size_t at = 0; at < index.size(); ++at) {
      if (at == 0 || index[at].first != index[at - 1].first) first.clear();
      const std::size_t item = index[at].second;
      bool known = false;
      for (const std::size_t other : first) known = look_at(other, item) || known;
      if (!known && first.size() < few) first.push_back(item);
    }
  }
  /// Whether they are two runs that are alike.
  bool look_at(std::size_t a, std::size_t b) {
    const OwnItem &one = items_[a], &other = items_[b];
    if (one.who == other.who || (one.right && other.right)) return false;
    if (in_common(one.sketch(), other.sketch()) < alike_from) return false;
    if (in_common(one.of->right, other.of->right) > different_to) return false;  // their scenes explain it
    if (one.right || other.right) {
      answers_.emplace_back(one.right ? b : a, one.right ? a : b);
      return false;
    }
    sets_.join(a, b);
    return true;
  }

  std::vector<OwnItem> items_;
  JoinedSets sets_;
  std::vector<std::pair<std::size_t, std::size_t>> answers_;  ///< runs, and the right runs of others that they are
};

}  // namespace

Sketch sketch_of(const Trace& run, const std::vector<grade::Part>& parts) {
  std::set<std::size_t> kinds;
  for (const grade::Part& part : parts) kinds.insert(part.kinds.begin(), part.kinds.end());
  std::vector<std::uint64_t> hashes, numbers;
  run.each(0, run.size(), [&](std::int64_t, const RecordedEvent& recorded) {
    if (!kinds.contains(recorded.event.index())) return true;
    std::uint64_t hash = mixed_bits(recorded.event.index());
    bool holds_number = false;
    visit_event(
        [&]<class E>(const E& event) {
          for_each_field<E>([&](const auto& field) {
            using Value = typename std::remove_cvref_t<decltype(field)>::value_type;
            if constexpr (std::is_same_v<Value, double>) {
              const double value = event.*field.member;
              const bool tells = std::isfinite(value) && value != 0;
              const auto bits = std::bit_cast<std::uint64_t>(tells ? number_of_few_bits(value) : 0.0);
              if (tells) numbers.push_back(bits);
              holds_number = holds_number || tells;
              hash = mixed_bits(hash ^ bits);
            } else {
              hash = mixed_bits(hash ^ static_cast<std::uint64_t>(event.*field.member));
            }
          });
        },
        recorded.event);
    if (holds_number) hashes.push_back(hash);
    return true;
  });
  for (auto* of : {&hashes, &numbers}) {
    std::sort(of->begin(), of->end());
    of->erase(std::unique(of->begin(), of->end()), of->end());
  }
  Sketch sketch;
  sketch.steps = std::ssize(hashes);
  sketch.numbers = std::ssize(numbers);
  sketch.whole = std::accumulate(hashes.begin(), hashes.end(), std::uint64_t{0});
  hashes.resize(std::min(hashes.size(), kept_hashes));
  sketch.least = std::move(hashes);
  return sketch;
}

double in_common(const Sketch& a, const Sketch& b) {
  std::size_t both = 0, either = 0;
  auto in_a = a.least.begin(), in_b = b.least.begin();
  // The least of what either has: as far as one is known to its end, or both are.
  while (either < kept_hashes && (in_a != a.least.end() || in_b != b.least.end())) {
    const bool from_a = in_b == b.least.end() || (in_a != a.least.end() && *in_a <= *in_b);
    const bool from_b = in_a == a.least.end() || (in_b != b.least.end() && *in_b <= *in_a);
    both += from_a && from_b, ++either;
    in_a += from_a, in_b += from_b;
  }
  return either == 0 ? 0 : ratio(both, either);
}

std::vector<AlikeRuns> alike_runs(const std::vector<HandedIn>& all, const std::vector<Sketch>& right_public) {
  std::map<std::string, std::vector<OwnItem>> by_scene;
  for (std::size_t who = 0; who < all.size(); ++who)
    for (const OwnRun& run : all[who].runs) {
      const bool is_public = std::any_of(right_public.begin(), right_public.end(),
                                         [&](const Sketch& right) { return in_common(run.run, right) >= alike_from; });
      if (is_telling(run.run) && !is_public) by_scene[run.scene].push_back({who, false, &run});
      if (is_telling(run.right)) by_scene[run.scene].push_back({who, true, &run});
    }
  std::vector<AlikeRuns> found;
  for (auto& [scene, items] : by_scene)
    for (AlikeRuns& one : AlikeFinder(std::move(items)).found(all)) found.push_back(std::move(one));
  return found;
}

}  // namespace zstep::homework
