#include "traces/codec/block.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "traces/codec/foretell.hpp"
#include "traces/codec/runs.hpp"

namespace zstep {

Tiles::Tiles(const Raster& raster) : width_(raster.width), height_(raster.height) {
  while ((std::max(width_, height_) - 1) >> shift_ >= across) ++shift_;
}

void Tiles::put(Bytes& out) const {
  const int rows = height_ > 0 ? ((height_ - 1) >> shift_) + 1 : 0;
  for (int row = 0; row < rows; ++row) put_u32(out, rows_[row]);
}

void Tiles::take(ByteReader& in) {
  const int rows = height_ > 0 ? ((height_ - 1) >> shift_) + 1 : 0;
  for (int row = 0; row < rows; ++row) rows_[row] = in.u32();
}

namespace {

constexpr std::uint32_t keeps_to_marks_bit = 1u << 31;  ///< in the number of events
static_assert(block_events < keeps_to_marks_bit);

void put_box(Bytes& out, const Box& box) {
  put_varint(out, box.empty() ? 0u : box.right - box.left + 1u);
  if (box.empty()) return;
  put_varint(out, box.left);
  put_varint(out, box.top);
  put_varint(out, static_cast<unsigned>(box.bottom - box.top));
}

Box take_box(ByteReader& in, const Raster& raster) {
  const std::uint64_t width = in.varint();
  Box box;
  if (width == 0) return box;
  const std::uint64_t left = in.varint(), top = in.varint(), down = in.varint();
  const auto columns = static_cast<std::uint64_t>(raster.width), rows = static_cast<std::uint64_t>(raster.height);
  if (left >= columns || width > columns - left || top >= rows || down >= rows - top)
    throw MalformedBytes("a block that reaches beyond the raster");
  box.left = static_cast<std::uint16_t>(left), box.right = static_cast<std::uint16_t>(left + width - 1);
  box.top = static_cast<std::uint16_t>(top), box.bottom = static_cast<std::uint16_t>(top + down);
  return box;
}

}  // namespace

void put_block_info(Bytes& out, const BlockInfo& info) {
  put_u64(out, static_cast<std::uint64_t>(info.first_position));
  put_u32(out, info.count | (info.keeps_to_marks ? keeps_to_marks_bit : 0u));
  for (const std::uint64_t word : info.steps.words()) put_u64(out, word);
  info.tiles.put(out);
  put_box(out, info.lead);
  put_varint(out, info.marks.size());
  std::uint32_t last_offset = 0;
  std::int32_t last_polygon = 0;
  for (const BlockInfo::Mark& mark : info.marks) {
    put_varint(out, mark.offset - last_offset);
    put_varint(out, zigzag(static_cast<std::int32_t>(static_cast<std::uint32_t>(mark.polygon) -
                                                     static_cast<std::uint32_t>(last_polygon))));
    put_box(out, mark.box);
    last_offset = mark.offset;
    last_polygon = mark.polygon;
  }
}

BlockInfo take_block_info(ByteReader& in, const Raster& raster) {
  BlockInfo info;
  info.first_position = static_cast<std::int64_t>(in.u64());
  const std::uint32_t count = in.u32();
  info.count = count & ~keeps_to_marks_bit, info.keeps_to_marks = (count & keeps_to_marks_bit) != 0;
  if (info.count > block_events)
    throw MalformedBytes("a block of more than " + std::to_string(block_events) + " events");
  for (std::uint64_t& word : info.steps.words()) word = in.u64();
  info.tiles = Tiles(raster);
  info.tiles.take(in);
  info.lead = take_box(in, raster);
  const std::size_t marks = in.count(3);
  if (marks > info.count) throw MalformedBytes("more marks than events in a block");
  info.marks.reserve(marks);
  std::uint32_t offset = 0, polygon = 0;
  for (std::size_t i = 0; i < marks; ++i) {
    const std::uint64_t further = in.varint();
    if ((i > 0 && further == 0) || further >= info.count - offset) throw MalformedBytes("a mark outside its block");
    offset += static_cast<std::uint32_t>(further);
    polygon += static_cast<std::uint32_t>(unzigzag(static_cast<std::uint32_t>(in.varint())));
    info.marks.push_back({offset, static_cast<std::int32_t>(polygon), take_box(in, raster)});
  }
  return info;
}

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
    codec::visit_fragment(steps.fragment, x, y, z, nearer, polygon, [&](std::uint8_t step, const auto& event) {
      write(step, event);
      return true;
    });
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

using namespace codec;

namespace {

template <class Value, class Raw>
Value checked(Raw value) {
  if constexpr (std::is_same_v<Value, bool>) {
    if (value != 0 && value != 1) throw MalformedBytes("a truth value that is neither 0 nor 1");
    return value != 0;
  } else if constexpr (std::is_enum_v<Value>) {
    if (value < 0 || static_cast<std::size_t>(value) >= words_of<Value>.size()) throw MalformedBytes("an unknown word");
    return static_cast<Value>(value);
  } else {
    return value;
  }
}

}  // namespace

StepMeanings::StepMeanings(const Page& page) : row(page) {
  kind.fill(unknown_kind);
  for (const StepInfo& step : page) kind[step.id] = step.kind;
}

BlockDecoder::BlockDecoder(std::span<const std::uint8_t> packed, std::uint32_t count, const StepMeanings& meanings,
                           const SceneGeometry& facts)
    : foreteller_(facts), meanings_(meanings), row_(meanings.row), left_(count) {
  ByteReader in(packed);
  if (in.varint() != count) throw MalformedBytes("a block with another number of events than it says");
  tokens_ = in.take(in.count());
  for (std::size_t next = 0; !in.empty();) {
    const std::string name = in.text();
    std::size_t looked = 0;  // they mostly stand in this order
    while (looked < column_count && column_name((next + looked) % column_count) != name) ++looked;
    if (looked == column_count) throw MalformedBytes("a column \"" + name + "\" that no event has");
    next = (next + looked) % column_count;
    columns_[next] = ByteReader(in.take(in.count()));
  }
}

const Row& BlockDecoder::take_row(std::uint8_t token) {
  if ((token & missed_bit) != 0 || !row_.steps.known() || !foreteller_.guess_row(row_))
    throw MalformedBytes("a scan line that cannot be");
  count_down(Row::events());
  foreteller_.learn_row(row_);
  return row_;
}

std::uint32_t BlockDecoder::take_count(std::uint8_t token) {
  const std::uint32_t count = columns_[counts_column].u8();
  const std::int64_t last = std::int64_t{foreteller_.whole(slot_of("x"))} + count;
  if ((token & missed_bit) != 0 || count == 0 || count > run_limit || !foreteller_.in_span() ||
      last > std::numeric_limits<std::int32_t>::max())
    throw MalformedBytes("a run of pixels that cannot be");
  foreteller_.set_whole(slot_of("x"), static_cast<std::int32_t>(last));
  return count;
}

FragmentRun BlockDecoder::take_fragments(std::uint8_t token) {
  FragmentRun run;
  run.count = take_count(token);
  run.x = foreteller_.whole(slot_of("x")) - static_cast<std::int32_t>(run.count) + 1;
  run.y = foreteller_.whole(slot_of("y"));
  run.nearer = columns_[nearer_column].low_bytes((run.count + 7) / 8);
  if (run.count < run_limit && run.nearer >> run.count != 0)
    throw MalformedBytes("an outcome of a compare that was not made");
  run.polygon = foreteller_.whole(slot_of("polygon"));
  run.steps = steps_.fragment;
  for (std::size_t i = 0; i < (run.nearer != 0 ? 4u : 2u); ++i)
    if (run.steps[i] == unknown_step) throw MalformedBytes("a run of pixels before the first pixel");
  count_down(run.events());
  run.span = &foreteller_.span();
  run.increments = foreteller_.increments();
  run.before = foreteller_.real(slot_of("z"));
  foreteller_.set_real(slot_of("z"), run.depth(run.count - 1));
  foreteller_.set_whole(slot_of("nearer"), run.is_nearer(run.count - 1) ? 1 : 0);
  return run;
}

PaintRun BlockDecoder::take_paints(std::uint8_t token) {
  PaintRun run;
  run.count = take_count(token);
  run.x = foreteller_.whole(slot_of("x")) - static_cast<std::int32_t>(run.count) + 1;
  run.y = foreteller_.whole(slot_of("y"));
  run.polygon = foreteller_.whole(slot_of("polygon"));
  run.step = steps_.paint;
  if (run.step == unknown_step) throw MalformedBytes("a run of pixels before the first pixel");
  count_down(run.events());
  run.span = &foreteller_.span();
  run.increments = foreteller_.increments();
  run.before = foreteller_.real(slot_of("z"));
  double z = run.before;
  run.for_each([&](std::uint32_t, std::int32_t, double depth) {
    z = depth;
    return true;
  });
  foreteller_.set_real(slot_of("z"), z);
  return run;
}

template <class E>
E BlockDecoder::take_one(std::uint8_t step, bool missed) {
  const auto mask = missed ? static_cast<std::uint32_t>(columns_[misses_column].varint()) : 0u;
  if (mask >> field_count<E> != 0) throw MalformedBytes("a miss of a field that the event does not have");
  E event;
  for_each_index<E>([&]<std::size_t I>() {
    using Value = FieldValue<E, I>;
    auto value = foreteller_.guess<E, I>(event);
    if ((mask >> I & 1u) != 0) {
      ByteReader& column = columns_[slot_at<E, I>];
      if constexpr (std::is_same_v<Value, double>) {
        value = double_of(undo_difference(take_counted(column), bits_of(value)));
      } else {
        const std::uint32_t residual = unzigzag(static_cast<std::uint32_t>(column.varint()));
        value = static_cast<std::int32_t>(static_cast<std::uint32_t>(value) + residual);
      }
    }
    event.*field_at<E, I>.member = checked<Value>(value);
  });
  foreteller_.learn(event);
  steps_.learn<E>(step);
  return event;
}

#define ZSTEP_INSTANTIATE(E) template E BlockDecoder::take_one<E>(std::uint8_t, bool);
ZSTEP_EVERY_KIND(ZSTEP_INSTANTIATE)
#undef ZSTEP_INSTANTIATE

}  // namespace zstep
