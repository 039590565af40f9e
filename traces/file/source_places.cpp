#include "traces/file/source_places.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "traces/text.hpp"

namespace zstep {

namespace {

constexpr std::uint64_t most_bytes = std::uint64_t{256} << 20;

}  // namespace

std::string SourcePlaces::fault_of(std::string_view place) const {
  if (place.empty()) return "is empty";
  if (place.size() > longest) return fmt::format("is longer than {} bytes", longest);
  if (printable(place) != place) return "has characters that cannot be shown";
  if (names_.size() > most_places && !numbers_.contains(place)) return fmt::format("is the {}th place", names_.size());
  if (count_ >= most_changes) return fmt::format("changes for the {}th time", count_);
  return "";
}

void SourcePlaces::add(std::int64_t position, std::uint8_t step, std::string_view place) {
  if (goes_on(step, place)) return;
  auto known = numbers_.find(place);
  if (known == numbers_.end()) {
    known = numbers_.emplace(place, static_cast<std::uint32_t>(names_.size())).first;
    names_.emplace_back(place);
  }
  last_[step] = known->second;
  changes_[step].push_back({position, known->second});
  ++count_;
}

std::string_view SourcePlaces::of(std::int64_t position, std::uint8_t step) const {
  const std::vector<Change>& changes = changes_[step];
  const auto after = std::upper_bound(changes.begin(), changes.end(), position,
                                      [](std::int64_t at, const Change& change) { return at < change.position; });
  return after == changes.begin() ? std::string_view() : names_[std::prev(after)->place];
}

SourcePlaces SourcePlaces::without_paths() const {
  SourcePlaces shorter = *this;
  for (std::string& name : shorter.names_) name = last_part(name);
  return shorter;
}

Bytes SourcePlaces::bytes() const {
  Bytes out;
  put_varint(out, names_.size() - 1);
  for (std::size_t name = 1; name < names_.size(); ++name) put_text(out, names_[name]);
  for (std::size_t step = 0; step < changes_.size(); ++step) {
    if (changes_[step].empty()) continue;
    put_u8(out, static_cast<std::uint8_t>(step));
    put_varint(out, changes_[step].size());
    std::int64_t before = 0;
    for (const Change& change : changes_[step]) {
      put_varint(out, static_cast<std::uint64_t>(change.position - before));
      put_varint(out, change.place);
      before = change.position;
    }
  }
  return out;
}

SourcePlaces::SourcePlaces(std::span<const std::uint8_t> bytes) {
  ByteReader in(bytes);
  const std::size_t names = in.count();
  if (names > most_places) throw MalformedBytes("more places in a program's source than there can be");
  for (std::size_t name = 0; name < names; ++name) {
    std::string text = in.text();
    if (const std::string fault = fault_of(text); !fault.empty())
      throw MalformedBytes("a place in a program's source " + fault);
    names_.push_back(text);
    numbers_.emplace(std::move(text), static_cast<std::uint32_t>(name + 1));
  }
  while (!in.empty()) {
    const std::uint8_t step = in.u8();
    const std::size_t count = in.count(2);
    count_ += count;
    if (count_ > most_changes || !changes_[step].empty()) throw MalformedBytes("steps that are told twice");
    changes_[step].reserve(count);
    std::int64_t position = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint64_t gap = in.varint(), place = in.varint();
      if (gap > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max() - position) || place > names)
        throw MalformedBytes("a place in a program's source that there is not");
      position += static_cast<std::int64_t>(gap);
      changes_[step].push_back({position, static_cast<std::uint32_t>(place)});
    }
    if (count > 0) last_[step] = changes_[step].back().place;
  }
}

void put_places(Bytes& out, const SourcePlaces& places) {
  if (!places.empty()) put_chunk(out, places_tag, compress(places.bytes()));
}

std::optional<ChunkPlace> find_places(const ByteSource& source, std::uint64_t offset) {
  while (const auto chunk = chunk_at(source, offset)) {
    if (chunk->tag == places_tag) return chunk;
    if (chunk->tag != events_tag && chunk->tag != index_tag) break;
    offset = chunk->end();
  }
  return std::nullopt;
}

SourcePlaces take_places(const ByteSource& source, const ChunkPlace& chunk) {
  return SourcePlaces(decompress(read_chunk(source, chunk), most_bytes));
}

std::int64_t StepLines::of(std::int64_t step) const {
  const auto after = std::upper_bound(shifts_.begin(), shifts_.end(), step,
                                      [](std::int64_t at, const auto& shift) { return at < shift.first; });
  return after == shifts_.begin() ? 0 : step + std::prev(after)->second;
}

}  // namespace zstep
