#include "traces/codec/block_encoder.hpp"

#include <utility>

#include "traces/codec/columns.hpp"
#include "traces/codec/foretell.hpp"
#include "traces/codec/runs.hpp"

namespace zstep {

using namespace codec;

struct BlockEncoder::State {
  State(const Scene& scene, const Header& header)
      : facts(scene, header), foreteller(facts), row(RowSteps(header.page)) {}

  /// One event by its token, and its fields as far as they were not foretold.
  template <class E>
  void write(std::uint8_t step, const E& event);
  void write(const LoggedRow& logged);
  void write(const LoggedRun& run);
  void write_run(const LoggedRun& run, std::uint32_t count);
  std::uint32_t count_foretold(const LoggedRun& run) const;
  template <class E>
  void write_misses(const E& event);
  void begin();
  void end();
  void put_token(std::uint8_t token) { tokens[token_count++] = token; }

  SceneGeometry facts;
  Foreteller foreteller;
  std::int64_t first_position = 0;  ///< of the block at work
  RunSteps steps;
  Row row;
  Packed packed;
  std::array<std::uint8_t, block_events> tokens;  ///< one for each event or for several
  std::size_t token_count = 0;
  std::array<Bytes, column_count> columns;
};

BlockEncoder::BlockEncoder(const Scene& scene, const Header& header, std::int64_t first_position)
    : state_(std::make_unique<State>(scene, header)) {
  state_->first_position = first_position;
}
BlockEncoder::~BlockEncoder() = default;

namespace {

template <class E>
bool same_fields(const E& one, const E& other) {
  bool same = true;
  for_each_index<E>([&]<std::size_t I>() {
    const auto a = one.*field_at<E, I>.member, b = other.*field_at<E, I>.member;
    if constexpr (std::is_same_v<FieldValue<E, I>, double>) same = same && bits_of(a) == bits_of(b);
    else same = same && a == b;
  });
  return same;
}

}  // namespace

/// What of an event was not as guessed.
template <class E>
void BlockEncoder::State::write_misses(const E& event) {
  std::uint32_t missed = 0;
  std::array<std::uint64_t, field_count<E>> residual;  // written before it is read, where `missed` says so
  E told;
  for_each_index<E>([&]<std::size_t I>() {
    constexpr auto member = field_at<E, I>.member;
    const auto guess = foreteller.guess<E, I>(told);
    if constexpr (std::is_same_v<FieldValue<E, I>, double>)
      residual[I] = difference(bits_of(event.*member), bits_of(guess));
    else
      residual[I] =
          static_cast<std::uint32_t>(static_cast<std::int32_t>(event.*member)) - static_cast<std::uint32_t>(guess);
    told.*member = event.*member;
    missed |= static_cast<std::uint32_t>(residual[I] != 0) << I;
  });
  put_varint(columns[misses_column], missed);
  for_each_index<E>([&]<std::size_t I>() {
    if ((missed >> I & 1u) == 0) return;
    Bytes& column = columns[slot_at<E, I>];
    if constexpr (std::is_same_v<FieldValue<E, I>, double>) put_counted(column, residual[I]);
    else put_varint(column, zigzag(static_cast<std::int32_t>(static_cast<std::uint32_t>(residual[I]))));
  });
}

template <class E>
void BlockEncoder::State::write(std::uint8_t step, const E& event) {
  E guessed;
  const bool foretold = foreteller.guess_all(guessed) && same_fields(guessed, event);
  put_token(foretold ? step : static_cast<std::uint8_t>(step | missed_bit));
  if (!foretold) write_misses(event);
  foreteller.learn(event);
  steps.learn<E>(step);
  packed.info.steps.add(step);
  if constexpr (requires {
                  event.x;
                  event.y;
                }) {
    if (event.x < largest_side) packed.info.touch(event.x, event.x + 1, event.y);
    if constexpr (requires { event.polygon; }) packed.info.name(event.polygon);
  } else if constexpr (std::is_same_v<E, PolygonBegin> || std::is_same_v<E, PieceDraw>) {
    packed.info.marks.push_back({packed.info.count, event.polygon, {}});
  }
  ++packed.info.count;
}

void BlockEncoder::State::write(const LoggedRow& logged) {
  const std::array<std::uint8_t, 4> steps_of_row{row.steps.line, row.steps.edge, row.steps.edge, row.steps.span};
  const bool foretold = logged.steps == steps_of_row && foreteller.guess_row(row) &&
                        same_fields(row.line, logged.line) && same_fields(row.edges[0], logged.edges[0]) &&
                        same_fields(row.edges[1], logged.edges[1]) && same_fields(row.span, logged.span);
  if (!foretold) {
    write(logged.steps[0], logged.line), write(logged.steps[1], logged.edges[0]),
        write(logged.steps[2], logged.edges[1]), write(logged.steps[3], logged.span);
    return;
  }
  put_token(row_token);
  foreteller.learn_row(row);
  for (const std::uint8_t step : steps_of_row) packed.info.steps.add(step);
  packed.info.count += Row::events();
}

// To the bit; what is not a number never is, as which one it is depends on the compiler.
std::uint32_t BlockEncoder::State::count_foretold(const LoggedRun& run) const {
  std::array<double, run_limit> foretold;
  depths_along(foreteller.span(), foreteller.increments(), run.x, run.count, foreteller.real(slot_of("z")),
               foretold.data());
  const auto differs = [&](std::uint32_t k) {
    return (bits_of(run.depth(k)) ^ bits_of(foretold[k])) | static_cast<std::uint64_t>(!(run.depth(k) == foretold[k]));
  };
  std::uint64_t any = 0;
  for (std::uint32_t k = 0; k < run.count; ++k) any |= differs(k);
  if (any == 0) return run.count;
  std::uint32_t first = 0;
  while (differs(first) == 0) ++first;
  return first;
}

void BlockEncoder::State::write(const LoggedRun& run) {
  const std::uint32_t foretold = count_foretold(run);
  if (foretold > 0) write_run(run, foretold);
  // The others one by one.
  const std::int32_t y = foreteller.whole(slot_of("y")), polygon = foreteller.whole(slot_of("polygon"));
  for (std::uint32_t k = foretold; k < run.count; ++k) {
    const std::int32_t x = run.x + static_cast<std::int32_t>(k);
    const double z = run.depth(k);
    if (run.painted) {
      write(steps.paint, PixelPaint{x, y, z, polygon});
      continue;
    }
    const bool nearer = (run.nearer >> k & 1u) != 0;
    write(steps.fragment[0], DepthInterpolate{x, y, z});
    write(steps.fragment[1], DepthCompare{x, y, z, nearer});
    if (!nearer) continue;
    write(steps.fragment[2], DepthWrite{x, y, z});
    write(steps.fragment[3], PixelWrite{x, y, polygon});
  }
}

/// The first pixels of what was logged, as many as were foretold.
void BlockEncoder::State::write_run(const LoggedRun& run, std::uint32_t count) {
  const std::int32_t end = run.x + static_cast<std::int32_t>(count);
  const std::uint64_t nearer = run.nearer & (~std::uint64_t{0} >> (64 - count));
  put_token(run.painted ? paints_token : fragments_token);
  put_u8(columns[counts_column], static_cast<std::uint8_t>(count));
  foreteller.set_whole(slot_of("x"), end - 1);
  foreteller.set_real(slot_of("z"), run.depth(count - 1));
  packed.info.touch(run.x, end, foreteller.whole(slot_of("y")));
  if (run.painted || nearer != 0) packed.info.name(foreteller.whole(slot_of("polygon")));
  if (run.painted) {
    packed.info.steps.add(steps.paint);
    packed.info.count += count;
    return;
  }
  put_low_bytes(columns[nearer_column], nearer, (count + 7) / 8);
  foreteller.set_whole(slot_of("nearer"), static_cast<std::int32_t>(nearer >> (count - 1) & 1u));
  for (std::size_t i = 0; i < (nearer != 0 ? 4u : 2u); ++i) packed.info.steps.add(steps.fragment[i]);
  packed.info.count += 2 * (count + static_cast<std::uint32_t>(std::popcount(nearer)));
}

void BlockEncoder::State::begin() {
  packed.info = BlockInfo{};
  packed.info.first_position = first_position;
  packed.info.tiles = Tiles(facts.scene().raster);
  packed.bytes.clear();
  foreteller.forget();
  steps = RunSteps{};
  token_count = 0;
  for (Bytes& column : columns) column.clear();
}

void BlockEncoder::State::end() {
  first_position += packed.info.count;
  put_varint(packed.bytes, packed.info.count);
  put_varint(packed.bytes, token_count);
  packed.bytes.insert(packed.bytes.end(), tokens.data(), tokens.data() + token_count);
  for (std::size_t column = 0; column < column_count; ++column) {
    const Bytes& bytes = columns[column];
    if (bytes.empty()) continue;
    // Columns go by name, so that a vocabulary with other fields in another order still finds its own.
    put_text(packed.bytes, std::string(column_name(column)));
    put_varint(packed.bytes, bytes.size());
    packed.bytes.insert(packed.bytes.end(), bytes.begin(), bytes.end());
  }
}

const BlockEncoder::Packed& BlockEncoder::pack(const EventLog& log) {
  State& block = *state_;
  block.begin();
  log.for_each([&](const LoggedRow& row) { block.write(row); }, [&](const LoggedRun& run) { block.write(run); },
               [&](std::uint8_t step, const auto& event) { block.write(step, event); });
  block.end();
  return block.packed;
}

}  // namespace zstep
