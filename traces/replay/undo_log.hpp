// The old values of what recent events changed in the stores, newest last.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <variant>
#include <utility>
#include <vector>

#include "traces/replay/state.hpp"

namespace zstep {

class UndoLog {
 public:
  /// The position that the next entries lead to.
  void begin(std::int64_t position) { position_ = position; }

  void depth(bool light, std::size_t pixel, double old) { add(Depth{pixel, old, light}); }
  void polygon(bool light, std::size_t pixel, std::int32_t old) { add(Owner{pixel, old, light}); }
  void ink(std::size_t pixel, std::uint32_t old) { add(Ink{pixel, old}); }
  void vertex(std::size_t index, const VertexStages& old) { add(Vertex{index, old}); }
  void vertex_added() { add(VertexAdded{}); }
  /// Those from the `kept`-th on.
  void vertices_dropped(const SharedChunks<VertexStages>& vertices, std::size_t kept) {
    std::vector<VertexStages> old;
    for (std::size_t i = kept; i < vertices.size(); ++i) old.push_back(vertices[i]);
    add(VerticesDropped{std::make_shared<const std::vector<VertexStages>>(std::move(old))});
  }
  void fragment(const std::optional<Fragment>& old) { add(Pixel{old}); }
  void picture(bool light, const Picture& old) {
    pictures_bytes_ += old.depth.size() * (sizeof(double) + 2 * sizeof(std::int32_t));
    add(Whole{std::make_shared<const Picture>(old), light});
  }

  /// What the logged pictures take since the log was last cleared.
  std::size_t pictures_bytes() const { return pictures_bytes_; }

  /// Undoes everything that led to positions after `position`.
  void undo_to(std::int64_t position, State& state) {
    while (!entries_.empty() && entries_.back().position > position) {
      std::visit([&](const auto& old) { restore(old, state); }, entries_.back().old);
      entries_.pop_back();
    }
  }
  /// Forgets what led to positions up to `position`.
  void forget_to(std::int64_t position) {
    while (!entries_.empty() && entries_.front().position <= position) entries_.pop_front();
  }
  void clear() {
    entries_.clear();
    pictures_bytes_ = 0;
  }

 private:
  struct Depth {
    std::size_t pixel;
    double old;
    bool light;
  };
  struct Owner {
    std::size_t pixel;
    std::int32_t old;
    bool light;
  };
  struct Ink {
    std::size_t pixel;
    std::uint32_t old;
  };
  struct Vertex {
    std::size_t index;
    VertexStages old;
  };
  struct VertexAdded {};
  struct VerticesDropped {
    std::shared_ptr<const std::vector<VertexStages>> old;
  };
  struct Pixel {
    std::optional<Fragment> old;
  };
  struct Whole {
    std::shared_ptr<const Picture> old;
    bool light;
  };
  using Old = std::variant<Depth, Owner, Ink, Vertex, VertexAdded, VerticesDropped, Pixel, Whole>;
  struct Entry {
    std::int64_t position;
    Old old;
  };

  void add(Old old) { entries_.push_back(Entry{position_, std::move(old)}); }

  static Picture& picture_of(bool light, State& state) { return light ? state.light : state.picture; }
  static void restore(const Depth& entry, State& state) {
    picture_of(entry.light, state).depth[entry.pixel] = entry.old;
  }
  static void restore(const Owner& entry, State& state) {
    picture_of(entry.light, state).polygon[entry.pixel] = entry.old;
  }
  static void restore(const Ink& entry, State& state) { state.picture.ink[entry.pixel] = entry.old; }
  static void restore(const Vertex& entry, State& state) { state.vertices.edit(entry.index) = entry.old; }
  static void restore(const VertexAdded&, State& state) { state.vertices.pop_back(); }
  static void restore(const VerticesDropped& entry, State& state) {
    for (const VertexStages& way : *entry.old) state.vertices.push_back(way);
  }
  static void restore(const Pixel& entry, State& state) { state.machine.fragment = entry.old; }
  static void restore(const Whole& entry, State& state) { picture_of(entry.light, state) = *entry.old; }

  std::int64_t position_ = 0;
  std::size_t pictures_bytes_ = 0;
  std::deque<Entry> entries_;
};

}  // namespace zstep
