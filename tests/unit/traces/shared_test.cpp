// Vectors and lists in shared pieces are vectors and lists: whatever happens to one copy, the others stay as they were.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

#include "tests/unit/traces/some_trace.hpp"
#include "traces/replay/key_frames.hpp"
#include "traces/replay/replay.hpp"
#include "traces/replay/same.hpp"
#include "traces/replay/shared_chunks.hpp"

using namespace zstep;

namespace {

/// So large that a chunk holds few of them.
struct Item {
  int value = 0;
  std::array<char, 8000> rest{};
};
static_assert(SharedChunks<Item>::chunk_size == 4);

struct Copy {
  SharedChunks<Item> shared;
  std::vector<int> plain;
};

bool agree(const Copy& copy) {
  if (copy.shared.size() != copy.plain.size() || copy.shared.empty() != copy.plain.empty()) return false;
  std::size_t i = 0;
  for (const Item& item : copy.shared) {
    if (item.value != copy.plain[i] || copy.shared[i].value != copy.plain[i]) return false;
    ++i;
  }
  return i == copy.plain.size() && (copy.plain.empty() || copy.shared.back().value == copy.plain.back());
}

/// An item of a list: found by its number.
struct Numbered {
  std::int32_t number = 0;
  int value = 0;
  bool operator==(const Numbered&) const = default;
};
using List = SharedList<Numbered, &Numbered::number>;

std::size_t items_beyond(const SharedChunks<Item>& one, const SharedChunks<Item>& other) {
  std::size_t items = 0;
  one.for_each_beyond(other, [&](const std::vector<Item>& chunk) { items += chunk.size(); });
  return items;
}

}  // namespace

TEST_CASE("law: copies of a shared vector are each what a vector would be, after any 4000 changes") {
  std::mt19937 random(1);
  const auto below = [&](std::size_t end) { return static_cast<std::size_t>(random() % end); };
  std::array<Copy, 4> copies;
  for (int change = 0; change < 4000; ++change) {
    Copy& copy = copies[below(copies.size())];
    const int value = change + 1;
    switch (below(8)) {
      case 0:
      case 1:
        copy.shared.push_back(Item{value, {}}), copy.plain.push_back(value);
        break;
      case 2:
        if (!copy.plain.empty()) copy.shared.pop_back(), copy.plain.pop_back();
        break;
      case 3:
      case 4:
        if (!copy.plain.empty()) {
          const std::size_t at = below(copy.plain.size());
          copy.shared.edit(at).value = value, copy.plain[at] = value;
        }
        break;
      case 5: {
        const std::size_t size = below(20);
        copy.shared.resize(size), copy.plain.resize(size);
        break;
      }
      case 6:
        if (below(8) == 0) copy.shared.clear(), copy.plain.clear();
        break;
      default: {
        const Copy& other = copies[below(copies.size())];
        copy = other;
        CHECK(copy.shared.shares_with(other.shared));
        CHECK(items_beyond(copy.shared, other.shared) == 0);
      }
    }
    CAPTURE(change);
    for (const Copy& each : copies) REQUIRE(agree(each));
  }
}

TEST_CASE("shared chunks: what is the same is shared again, and only what differs is counted") {
  SharedChunks<Item> one;
  for (int i = 0; i < 12; ++i) one.push_back(Item{i, {}});
  SharedChunks<Item> other = one;
  for (std::size_t i = 0; i < 12; ++i)
    other.edit(i).value = static_cast<int>(i);  // three chunks of its own, no value new
  other.edit(5).value = 50;
  CHECK(items_beyond(other, one) == 12);
  other.share(one, [](const Item& a, const Item& b) { return a.value == b.value; });
  CHECK(items_beyond(other, one) == 4);
  CHECK(other[5].value == 50);
  CHECK(one[5].value == 5);
}

TEST_CASE("shared chunks: what was never touched takes no memory") {
  SharedChunks<Item> items;
  items.resize(100);
  const SharedChunks<Item> untouched;
  CHECK(items_beyond(items, untouched) == 0);
  CHECK(items[99].value == 0);
  items.edit(50).value = 1;
  CHECK(items_beyond(items, untouched) == 4);
  items.resize(0);
  items.resize(100);
  CHECK(items[50].value == 0);
}

TEST_CASE("shared list: what one copy alone holds is what was changed in it, wherever it stands by now") {
  List one;
  for (int i = 0; i < 3000; ++i) one.insert(one.size(), {i});
  List other = one;
  const auto beyond = [](const List& a, const List& b) {
    std::size_t items = 0;
    a.for_each_beyond(b, [&]<class Item>(const std::vector<Item>& piece) {
      if constexpr (std::is_same_v<Item, Numbered>) items += piece.size();
    });
    return items;
  };
  CHECK(beyond(other, one) == 0);
  CHECK(heap_beyond(other, one) == 0);
  // The first piece becomes others, and the rest moves up.
  for (int i = 0; i < 600; ++i) other.insert(0, {3000 + i});
  CHECK(beyond(other, one) > 600);
  CHECK(beyond(other, one) < 600 + 2 * List::longest);
  CHECK(beyond(one, other) <= List::longest);
  CHECK(heap_beyond(other, one) > beyond(other, one) * sizeof(Numbered) + 3600 * sizeof(std::uint32_t));
}

TEST_CASE(
    "key frames: all that they hold counts, also lists that each has for itself, and no more of them stay than the "
    "budget bears") {
  const Trace trace = record_events({});
  const Beginning beginning(trace);
  constexpr std::size_t budget = 4'000'000, entries = 10'000, each = entries * sizeof(ActiveEdge);
  KeyFrames frames(beginning, 1000, 1, budget);
  State state = beginning.state();
  state.machine.active.resize(entries);
  std::int64_t stored = 0;
  for (std::int64_t position = 1; position <= 1000; ++position) {
    if (frames.next_due() > position) continue;
    state.position = position;
    state.machine.active[0].edge = static_cast<std::int32_t>(position);
    frames.add(state);
    ++stored;
    REQUIRE(frames.bytes() <= budget);
  }
  CHECK(stored >= static_cast<std::int64_t>(budget / each));
  CHECK(frames.bytes() > budget / 4);
  State found = beginning.state();
  for (const std::int64_t wanted : {1, 300, 999}) {
    frames.restore_before(wanted, found);
    CHECK(found.position == frames.before(wanted));
    if (found.position > 0) CHECK(found.machine.active[0].edge == found.position);
  }
}

TEST_CASE("law: copies of a shared list are each what a vector would be, after any 6000 changes") {
  std::mt19937 random(2);
  const auto below = [&](std::size_t end) { return static_cast<std::size_t>(random() % end); };
  struct Both {
    List shared;
    std::vector<Numbered> plain;
  };
  std::array<Both, 3> copies;
  std::size_t longest = 0;
  for (int change = 0; change < 6000; ++change) {
    Both& copy = copies[below(copies.size())];
    std::vector<Numbered>& plain = copy.plain;
    const std::size_t what = below(200);
    const std::size_t at = plain.empty() ? 0 : below(plain.size());
    const auto place = plain.begin() + static_cast<std::ptrdiff_t>(at);
    if (what == 0) {
      const Both& other = copies[below(copies.size())];
      copy = other;
      CHECK(copy.shared.shares_with(other.shared));
    } else if (what < 20 && !plain.empty()) {
      const std::int32_t number = place->number;
      copy.shared.erase(at), plain.erase(place);
      CHECK(!copy.shared.contains(number));
    } else if (what < 40 && !plain.empty()) {
      copy.shared.edit(at).value = change, place->value = change;
    } else {
      const std::size_t before = below(plain.size() + 1);
      const Numbered item{change, -change};
      copy.shared.insert(before, item);
      plain.insert(plain.begin() + static_cast<std::ptrdiff_t>(before), item);
    }
    longest = std::max(longest, plain.size());
    CAPTURE(change);
    for (const Both& each : copies) {
      REQUIRE(each.shared.size() == each.plain.size());
      REQUIRE(std::equal(each.shared.begin(), each.shared.end(), each.plain.begin(), each.plain.end()));
      if (each.plain.empty()) continue;
      const std::size_t some = below(each.plain.size());
      REQUIRE(each.shared[some] == each.plain[some]);
      REQUIRE(each.shared.contains(each.plain[some].number));
      REQUIRE(each.shared.place_of(each.plain[some].number) == some);
      REQUIRE(!each.shared.contains(6000));
      REQUIRE(!each.shared.contains(-1));
    }
  }
  CHECK(longest > 2 * List::longest);  // it came in several pieces
}

/// Seconds of processor time that replaying as many moves in a list of so many pieces takes.
double seconds_of_moves(std::int32_t pieces) {
  std::vector<RecordedEvent> events;
  const auto record = [&]<class E>(const E& event) { events.push_back({step_of(kind_of<E>), event}); };
  record(TablesBegin{});
  for (std::int32_t piece = 0; piece < pieces; ++piece) record(PieceMake{piece, 0, -1});
  for (std::int32_t piece = 0; piece < pieces; ++piece) record(ListInsert{piece, piece});
  std::mt19937 random(3);
  for (std::int32_t move = 0; move < pieces; ++move) {
    const auto piece = static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(pieces));
    record(ListRemove{piece});
    record(ListInsert{piece, static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(pieces))});
    record(ListMark{piece});
  }
  const Trace trace = record_events(events);
  Replay replay(trace);
  const std::clock_t begin = std::clock();
  replay.go_to(trace.size());
  for (int k = 0; k < 100; ++k) replay.step_back();
  CHECK(replay.state().machine.list.size() >= static_cast<std::size_t>(pieces) - 1);
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

TEST_CASE("a move in a long list costs little more than in a short one") {
  // Sixteen times as many moves would take 256 times as long if each went through the list.
  CHECK(seconds_of_moves(48'000) < 80 * seconds_of_moves(3'000));
}

TEST_CASE("a piece is in the list at most once, and only a piece is") {
  const auto refused = [](const std::vector<RecordedEvent>& events) {
    const Trace trace = record_events(events);
    Replay replay(trace);
    try {
      replay.go_to(trace.size());
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const RecordedEvent make{step_of(kind_of<PieceMake>), PieceMake{0, 0, -1}};
  const RecordedEvent insert{step_of(kind_of<ListInsert>), ListInsert{0, 0}};
  const RecordedEvent remove{step_of(kind_of<ListRemove>), ListRemove{0}};
  CHECK(refused({make, insert, remove, insert}) == "");
  CHECK(refused({make, insert, insert}).find("piece 0 is in the list already") != std::string::npos);
  CHECK(refused({make, insert, remove, remove}).find("piece 0 is not in the list") != std::string::npos);
  CHECK(refused({insert}).find("there is no piece 0") != std::string::npos);
}
