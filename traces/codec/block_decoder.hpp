// Unpacks a block. Throws MalformedBytes for anything an encoder could not have written.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include "traces/codec/block_encoder.hpp"
#include "traces/codec/columns.hpp"
#include "traces/codec/foreteller.hpp"
#include "traces/codec/runs.hpp"
#include "traces/file/header.hpp"

namespace zstep {

/// What the ids of steps mean in a trace.
inline constexpr std::uint8_t unknown_kind = 0xff;
struct StepMeanings {
  explicit StepMeanings(const Page& page);
  std::array<std::uint8_t, 128> kind{};  ///< which each records; `unknown_kind` for ids that the trace does not use
  codec::RowSteps row;
};

class BlockDecoder {
 public:
  BlockDecoder(std::span<const std::uint8_t> packed, std::uint32_t count, const StepMeanings& meanings,
               const codec::SceneGeometry& facts);

  /// Calls visit(step, event) for each event in turn; stops early when it returns false. True when all were visited.
  /// A visit that can also be called as visit(run), with a Row, a FragmentRun or a PaintRun, gets runs whole.
  template <class Visit>
  bool visit_all(Visit&& visit) {
    using Take = bool (*)(BlockDecoder&, std::uint8_t, bool, Visit&);
    static constexpr auto take = []<std::size_t... K>(std::index_sequence<K...>) {
      return std::array<Take, kind_count>{
          [](BlockDecoder& self, std::uint8_t step, bool missed, Visit& function) -> bool {
            return function(step, self.take_one<KindAt<K>>(step, missed));
          }...};
    }
    (std::make_index_sequence<kind_count>{});
    for (const std::uint8_t token : tokens_) {
      const std::uint8_t step = token & static_cast<std::uint8_t>(~missed_bit);
      if (step >= codec::row_token) {
        const bool go_on = step == codec::fragments_token ? give(take_fragments(token), visit)
                           : step == codec::row_token     ? give(take_row(token), visit)
                                                          : give(take_paints(token), visit);
        if (!go_on) return false;
        continue;
      }
      const std::uint8_t kind = meanings_.kind[step];
      if (kind == unknown_kind) throw MalformedBytes("a step that is not in the step table");
      count_down(1);
      if (!take[kind](*this, step, (token & missed_bit) != 0, visit)) return false;
    }
    if (left_ != 0) throw MalformedBytes("a block with fewer events than it says");
    return true;
  }

 private:
  template <class Run, class Visit>
  static bool give(const Run& run, Visit& visit) {
    if constexpr (requires { visit(run); }) return visit(run);
    else return run.expand(visit);
  }

  void count_down(std::uint32_t events) {
    if (events > left_) throw MalformedBytes("a block with more events than it says");
    left_ -= events;
  }
  const codec::Row& take_row(std::uint8_t token);
  codec::FragmentRun take_fragments(std::uint8_t token);
  codec::PaintRun take_paints(std::uint8_t token);
  /// How many pixels a run has; moves the register x to the last of them.
  std::uint32_t take_count(std::uint8_t token);

  /// The next event; for every kind compiled once, in the .cpp.
  template <class E>
  E take_one(std::uint8_t step, bool missed);

  codec::Foreteller foreteller_;
  codec::RunSteps steps_;
  const StepMeanings& meanings_;
  codec::Row row_;
  std::uint32_t left_;  ///< events still to come
  std::span<const std::uint8_t> tokens_;
  std::array<ByteReader, codec::column_count> columns_;
};

}  // namespace zstep
