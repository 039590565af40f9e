#include "traces/mistakes/in_pixels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "traces/check/check.hpp"
#include "traces/formulas/rounding.hpp"
#include "traces/formulas/walk.hpp"

namespace zstep::mistakes {

using formulas::DrawnFacet, formulas::Situation;
using enum Mistake;

namespace {

constexpr std::int64_t most_pixels_gone_through = 4'000'000;

/// All single ways, and with `pairs` all two that change different things, one after another: visit(ways), until it
/// returns false.
template <class Visit>
void each_together(bool pairs, Visit&& visit) {
  const std::span<const Way> ways = ways_to_draw();
  for (const Way& one : ways) {
    if (!pairs) {
      if (!visit(Together{one})) return;
      continue;
    }
    for (const Way& other : ways)
      if (*changes_of(one.mistake) < *changes_of(other.mistake) && !visit(Together{one, other})) return;
  }
}

// What a run has.

struct Asked {
  std::int32_t x, y;
  double z;
  bool nearer;
};
struct Painted {
  std::int32_t x, y, polygon;
};
struct Kept {
  std::int32_t x, y;
  double z;
};
template <class Item>
struct Range {
  std::size_t first = 0, end = 0;
  std::span<const Item> of(const std::vector<Item>& all) const { return std::span(all).subspan(first, end - first); }
};

/// From one polygon_begin to the next, or what empties the buffers.
struct Turn {
  bool clears = false;
  std::int32_t facet = -1, polygon = no_polygon;
  std::optional<DrawnFacet> right{};
  Range<Asked> asked{};
  Range<Painted> painted{};
  Range<Kept> kept{};
};

struct RunInPixels {
  std::vector<Turn> turns;
  std::vector<Asked> asked;
  std::vector<Painted> painted;
  std::vector<Kept> kept;
  bool paints = false, keeps = false, whole = true;
  double relative = 0, absolute = 0;
};

RunInPixels pixels_of_run(const Trace& run, const Precision& precision) {
  RunInPixels pixels;
  pixels.paints = run.has(kind_of<PixelWrite>), pixels.keeps = run.has(kind_of<DepthWrite>);
  if (!precision.every_digit) pixels.relative = precision.relative, pixels.absolute = precision.largest_amount();
  std::int64_t corners = 0;
  const auto end_turn = [&](const Situation& at) {
    if (pixels.turns.empty()) return;
    Turn& turn = pixels.turns.back();
    turn.asked.end = pixels.asked.size(), turn.painted.end = pixels.painted.size(), turn.kept.end = pixels.kept.size();
    if (turn.clears || turn.right) return;
    Situation here = at;
    hold(here, precision);
    turn.right = here.draw_facet();
    if (turn.right) corners += std::ssize(turn.right->outline()) + turn.right->pixels_inside();
    pixels.whole = pixels.whole && corners <= most_pixels_gone_through;
  };
  const auto begin_turn = [&](Turn turn) {
    turn.asked.first = pixels.asked.size(), turn.painted.first = pixels.painted.size();
    turn.kept.first = pixels.kept.size();
    pixels.turns.push_back(std::move(turn));
  };
  const State end = formulas::walk(
      run,
      [&]<class E>(std::int64_t, const E& e, const Situation& at) {
        if constexpr (std::is_same_v<E, PolygonBegin>) {
          end_turn(at);
          begin_turn({.facet = e.facet, .polygon = e.polygon});
        } else if constexpr (std::is_same_v<E, BuffersClear>) {
          end_turn(at);
          begin_turn({.clears = true});
        } else if constexpr (has(at_pixel<E>, AtPixel::verdict)) {
          pixels.asked.push_back({e.x, e.y, e.z, e.nearer});
        } else if constexpr (std::is_same_v<E, PixelWrite>) {
          pixels.painted.push_back({e.x, e.y, e.polygon});
        } else if constexpr (std::is_same_v<E, DepthWrite>) {
          pixels.kept.push_back({e.x, e.y, e.z});
        }
        return pixels.whole && std::ssize(pixels.asked) <= most_pixels_gone_through;
      },
      [&](std::int64_t, const Impossible&) { pixels.whole = false; });
  end_turn(formulas::situation_of(run, end));
  pixels.whole = pixels.whole && end.position == run.size();
  return pixels;
}

/// Which turn drew a pixel last, of all that were looked at.
struct DrawnBy {
  std::vector<std::uint32_t> turn_of;  ///< by pixel
  std::uint32_t turn = 0;
};

/// Is a run as a program prints it that makes these mistakes?
class Explains {
 public:
  Explains(const RunInPixels& pixels, const Given& given, const Together& ways, DrawnBy& drawn_by)
      : pixels_(pixels), given_(given), ways_(ways), drawn_by_(drawn_by) {}

  bool all() {
    std::vector<bool> begun(given_.scene.facets.size());
    for (const Turn& turn : pixels_.turns) {
      is_last_ = &turn == &pixels_.turns.back();
      if (turn.clears) continue;
      if (turn.facet >= 0 && static_cast<std::size_t>(turn.facet) < begun.size()) begun[turn.facet] = true;
      if (!pixels_are_right(turn)) return false;
    }
    // Where most depths are unknown, nothing is explained.
    if (10 * known_ < 9 * std::ssize(pixels_.asked) || !no_facet_is_missing(begun)) return false;
    // A number that separates the weights inside from those outside, and that is not 0.
    constexpr double nothing = 1e-6;
    if (made(inside_margin) && (!(outside_ < inside_) || (outside_ < nothing && inside_ > -nothing))) return false;
    Buffer buffer(ways_, given_);
    for (const Turn& turn : pixels_.turns) {
      is_last_ = &turn == &pixels_.turns.back();
      if (turn.clears) buffer.clear();
      else if (!answers_are_right(turn, buffer) || !writes_are_right(turn)) return false;
    }
    return true;
  }

 private:
  bool made(Mistake mistake) const {
    return std::any_of(ways_.begin(), ways_.end(), [&](const Way& way) { return way.mistake == mistake; });
  }
  bool culls() const { return given_.header.conventions.cull && given_.header.declares(Convention::cull); }

  bool pixels_are_right(const Turn& turn) {
    const std::span<const Asked> asked = turn.asked.of(pixels_.asked);
    if (!turn.right) return asked.empty();
    if (Redrawn::is_left_out(*turn.right, ways_, culls(), given_)) return asked.empty();
    // Which of the vertices it is made with is the same for all facets that go round the same way.
    std::uint64_t& may_be = may_be_[Redrawn::is_clockwise(*turn.right)];
    std::int64_t known = 0;
    for (int choice = 0; choice < Redrawn::choices(ways_); ++choice) {
      const std::uint64_t bit = std::uint64_t{1} << choice;
      if ((may_be & bit) == 0) continue;
      const auto drawn = Redrawn::of(*turn.right, ways_, choice, given_);
      const auto depths = drawn ? depths_known(*drawn, asked) : std::nullopt;
      if (depths) known = std::max(known, *depths);
      else may_be &= ~bit;
    }
    known_ += known;
    const std::uint64_t all = (std::uint64_t{1} << Redrawn::choices(ways_)) - 1;
    return (may_be & all) != 0;
  }
  /// Of how many of these pixels the depth is known, where they are the facet's, and all that it has.
  std::optional<std::int64_t> depths_known(const Redrawn& drawn, std::span<const Asked> asked) {
    ++drawn_by_.turn;
    std::int64_t known = 0;
    for (const Asked& one : asked) {
      if (drawn.cover(one.x, one.y) == Redrawn::Cover::outside) return std::nullopt;
      const Redrawn::Depths depths = drawn.depths(one.x, one.y);
      const double off = pixels_.relative * std::abs(one.z) + pixels_.absolute;
      if (!(one.z >= depths.low - off && one.z <= depths.high + off)) return std::nullopt;
      drawn_by_.turn_of[pixel(one.x, one.y)] = drawn_by_.turn, known += std::isfinite(depths.high - depths.low);
    }
    bool all = true;
    if (drawn.has_margin()) {
      for (const Asked& one : asked) inside_ = std::min(inside_, drawn.least_weight(one.x, one.y));
      drawn.each_compared([&](std::int32_t x, std::int32_t y) {
        if (!is_last_ && !was_drawn(x, y)) outside_ = std::max(outside_, drawn.least_weight(x, y));
      });
      if (!(outside_ < inside_)) return std::nullopt;
    }
    if (!is_last_)  // there the run may be cut off
      drawn.each_pixel([&](std::int32_t x, std::int32_t y, Redrawn::Cover cover) {
        all = all && (cover != Redrawn::Cover::inside || was_drawn(x, y));
      });
    return all ? std::optional(known) : std::nullopt;
  }
  bool answers_are_right(const Turn& turn, Buffer& buffer) const {
    const std::span<const Asked> asked = turn.asked.of(pixels_.asked);
    return std::all_of(asked.begin(), asked.end(), [&](const Asked& one) {
      const double off = pixels_.relative * std::abs(one.z) + pixels_.absolute;
      return buffer.may_answer(one.x, one.y, {one.z - off, one.z + off}, one.nearer);
    });
  }
  /// What is written follows the answers, in their order.
  bool writes_are_right(const Turn& turn) const {
    const std::span<const Painted> painted = turn.painted.of(pixels_.painted);
    const std::span<const Kept> kept = turn.kept.of(pixels_.kept);
    auto paint = painted.begin();
    auto keep = kept.begin();
    const Way* beside = nullptr;
    for (const Way& way : ways_)
      if (way.mistake == colour_beside) beside = &way;
    const std::int32_t along = beside ? (beside->variant % 2 == 0 ? 1 : -1) : 0;
    const std::int32_t width = given_.scene.raster.width, height = given_.scene.raster.height;
    const std::int32_t polygons = std::max(1, size32(given_.scene.polygons));
    for (const Asked& one : turn.asked.of(pixels_.asked)) {
      if (pixels_.keeps && (made(depth_always) || (one.nearer && !made(depth_not_written)))) {
        if (keep == kept.end()) return is_last_;
        if (keep->x != one.x || keep->y != one.y || keep->z != one.z) return false;
        ++keep;
      }
      if (!pixels_.paints || made(colour_not_written) || !(one.nearer || made(colour_always))) continue;
      std::int32_t x = one.x, y = one.y;
      if (beside) (beside->variant < 2 ? x : y) += along;
      if (paint == painted.end()) return is_last_;
      const bool beyond = x < 0 || y < 0 || x >= width || y >= height;
      if (beyond && paint->x == one.x && paint->y == one.y) x = one.x, y = one.y;
      const std::int32_t polygon = made(colour_of_next) ? (turn.polygon + 1) % polygons : turn.polygon;
      if (paint->x != x || paint->y != y || paint->polygon != polygon) return false;
      ++paint;
    }
    return paint == painted.end() && keep == kept.end();
  }
  /// A facet that others came after.
  bool no_facet_is_missing(const std::vector<bool>& begun) const {
    std::size_t last = begun.size();
    while (last > 0 && !begun[last - 1]) --last;
    for (std::size_t facet = 0; facet < last; ++facet) {
      if (begun[facet]) continue;
      const auto right = DrawnFacet::from_scene(given_.scene, given_.header, index32(facet), given_.roundoff);
      // Where nothing says that back faces are drawn, they need not be.
      const bool may_cull = culls() || !given_.header.declares(Convention::cull);
      if (!right || Redrawn::is_left_out(*right, ways_, may_cull, given_)) continue;
      bool any = false;
      for (int choice = 0; choice < Redrawn::choices(ways_); ++choice)
        if (const auto drawn = Redrawn::of(*right, ways_, choice, given_))
          drawn->each_pixel(
              [&](std::int32_t, std::int32_t, Redrawn::Cover cover) { any = any || cover == Redrawn::Cover::inside; });
      if (any) return false;
    }
    return true;
  }
  std::size_t pixel(std::int32_t x, std::int32_t y) const { return pixel_at(x, y, given_.scene.raster.width); }
  bool was_drawn(std::int32_t x, std::int32_t y) const { return drawn_by_.turn_of[pixel(x, y)] == drawn_by_.turn; }

  const RunInPixels& pixels_;
  const Given& given_;
  const Together& ways_;
  DrawnBy& drawn_by_;
  std::array<std::uint64_t, 2> may_be_{~std::uint64_t{0}, ~std::uint64_t{0}};       ///< choices, of either way round
  std::int64_t known_ = 0;                                                          ///< depths
  double outside_ = -std::numeric_limits<double>::infinity(), inside_ = -outside_;  ///< weights
  bool is_last_ = false;
};

}  // namespace

std::vector<Together> that_draw(const Trace& run, const Precision& precision) {
  const Header& header = run.header();
  const bool has_pixels = run.has(kind_of<PolygonBegin>) && run.has(AtPixel::verdict);
  if (!has_pixels || records<PieceDraw>(header) || bits_of(precision.format) > 0) return {};
  const RunInPixels pixels = pixels_of_run(run, precision);
  if (!pixels.whole) return {};
  const Given given{run.scene(), header, precision.format == NumberFormat::float32 ? 0x1p-24 : 0x1p-53};
  DrawnBy drawn_by{std::vector<std::uint32_t>(pixel_count(given.scene.raster.width, given.scene.raster.height))};
  const auto explains = [&](const Together& ways) { return Explains(pixels, given, ways, drawn_by).all(); };
  if (explains({})) return {};
  std::vector<Together> found;
  for (const bool pairs : {false, true}) {
    each_together(pairs, [&](const Together& ways) {
      if (explains(ways)) found.push_back(ways);
      return true;
    });
    if (!found.empty()) break;
  }
  return found;
}

namespace {

/// A picture that a program draws, as far as rounding does not decide it.
class Redrawing {
 public:
  Redrawing(const Scene& scene, Header header, double roundoff)
      : header_(std::move(header)),
        given_{scene, header_, roundoff},
        right_(scene.facets.size()),
        shown_(pixel_count(scene.raster.width, scene.raster.height)),
        buffer_({}, given_) {
    for (std::size_t facet = 0; facet < right_.size(); ++facet)
      right_[facet] = DrawnFacet::from_scene(scene, header_, index32(facet), roundoff);
  }
  Redrawing(const Redrawing&) = delete;

  Rows all_rows() const { return {0, given_.scene.raster.height}; }
  /// Of these mistakes, made in one way with facets that go round clockwise, and in one with the others. Counts in
  /// these rows alone, no further than to a pixel more than `most` that differ.
  Likeness like(const Seen& seen, const Together& ways, int clockwise, int counter, std::int64_t most, Rows rows) {
    const Scene& scene = given_.scene;
    const std::int32_t polygons = std::max(1, size32(scene.polygons));
    const std::int32_t width = scene.raster.width, height = scene.raster.height;
    const auto made = [&](Mistake mistake) {
      return std::any_of(ways.begin(), ways.end(), [&](const Way& way) { return way.mistake == mistake; });
    };
    const Way* beside = nullptr;
    for (const Way& way : ways)
      if (way.mistake == colour_beside) beside = &way;
    const bool always = made(colour_always), never = made(colour_not_written), of_next = made(colour_of_next);
    // What is drawn in them may come from elsewhere.
    Rows drawn_rows = made(stride_is_height) ? all_rows() : rows;
    if (beside) drawn_rows = {std::max(0, drawn_rows.first - 1), std::min(height, drawn_rows.end + 1)};
    std::fill(shown_.begin() + std::ptrdiff_t{drawn_rows.first} * width,
              shown_.begin() + std::ptrdiff_t{drawn_rows.end} * width, Shown{});
    buffer_.begin_again(ways, drawn_rows);
    for (std::size_t facet = 0; facet < right_.size(); ++facet) {
      if (!right_[facet]) continue;
      // With a margin that nobody knows each pixel around may be inside.
      if (made(inside_margin) || !Redrawn::is_known(*right_[facet], ways, given_)) return {ways, {}, most + 1, 0};
      if (Redrawn::is_left_out(*right_[facet], ways, given_.header.conventions.cull, given_)) continue;
      if (!Redrawn::may_meet(*right_[facet], ways, drawn_rows, given_)) continue;
      const int choice = Redrawn::is_clockwise(*right_[facet]) ? clockwise : counter;
      const auto drawn = Redrawn::of(*right_[facet], ways, choice, given_);
      if (!drawn) continue;
      const std::int32_t polygon = scene.facets[facet].polygon;
      drawn->each_pixel([&](std::int32_t x, std::int32_t y, Redrawn::Cover cover) {
        if (x < 0 || x >= width || !drawn_rows.has(y)) return;
        const Redrawn::Depths z = drawn->depths(x, y);
        Shown& there = shown_[pixel_at(x, y, width)];
        std::optional<bool> nearer;
        if (cover == Redrawn::Cover::inside) nearer = buffer_.ask(x, y, z);
        else buffer_.may_ask(x, y, z);
        if (!nearer) there.sure = there.deep = false;
        if (nearer && *nearer) there.low = z.low, there.high = z.high, there.deep = true;
        std::int32_t to_x = x, to_y = y;
        if (beside) (beside->variant < 2 ? to_x : to_y) += beside->variant % 2 == 0 ? 1 : -1;
        if (to_x < 0 || to_x >= width || !drawn_rows.has(to_y) || never) return;
        Shown& painted = shown_[pixel_at(to_x, to_y, width)];
        if (!nearer && !always) painted.sure = false;
        else if (always || *nearer)
          painted.polygon = of_next ? (polygon + 1) % polygons : polygon,
          painted.sure = cover == Redrawn::Cover::inside;
      });
    }
    return compare(seen, ways, most, rows);
  }
  /// The fewest rows one below another that have enough of the pixels that differ from what was drawn last, and how
  /// many those are.
  std::pair<Rows, std::int64_t> rows_that_differ(const Seen& seen) const {
    const std::int32_t height = given_.scene.raster.height;
    std::vector<std::int64_t> up_to{0};
    for (std::int32_t y = 0; y < height; ++y)
      up_to.push_back(up_to.back() + compare(seen, {}, any_number, {y, y + 1}).differ);
    constexpr std::int64_t share = 16, least = 64;
    const std::int64_t enough = std::max(up_to.back() / share, std::min(up_to.back(), least));
    Rows best = all_rows(), rows;
    for (; rows.first < height; ++rows.first) {
      while (rows.end < height && up_to[rows.end] - up_to[rows.first] < enough) ++rows.end;
      if (up_to[rows.end] - up_to[rows.first] < enough) break;
      if (rows.end - rows.first < best.end - best.first) best = rows;
    }
    return {best, up_to[best.end] - up_to[best.first]};
  }

  static constexpr std::int64_t any_number = std::numeric_limits<std::int64_t>::max();

 private:
  struct Shown {
    std::int32_t polygon = no_polygon;
    bool sure = true;  ///< of the polygon
    bool deep = true;  ///< of the depth
    double low = std::numeric_limits<double>::infinity(), high = low;
  };

  Likeness compare(const Seen& seen, const Together& ways, std::int64_t most, Rows rows) const {
    Likeness likeness{ways, {}, 0, 0};
    const Raster& raster = given_.scene.raster;
    const Conventions::Depth depth = given_.header.conventions.depth;
    const double range = seen.unit > 0 ? depth_range(given_.scene, depth) : 1,
                 least = seen.unit > 0 ? formulas::least_depth(given_.scene, depth) : 0, off = seen.unit * range;
    for (std::int32_t y = rows.first; y < rows.end && likeness.differ <= most; ++y)
      for (std::int32_t x = 0; x < raster.width; ++x) {
        const Shown& shown = shown_[pixel_at(x, y, raster.width)];
        const std::size_t at = pixel_at(x, raster.y_up ? raster.height - 1 - y : y, raster.width);
        bool sure = false, same = true;
        if (!seen.polygons.empty() && shown.sure) sure = true, same = same && seen.polygons[at] == shown.polygon;
        if (!seen.colors.empty() && shown.sure) {
          const Color color = shown.polygon == no_polygon
                                  ? given_.scene.background
                                  : given_.scene.polygons[static_cast<std::size_t>(shown.polygon)].color;
          sure = true, same = same && seen.colors[at] == color;
        }
        if (!seen.depths.empty() && shown.deep) {
          const bool empty = !std::isfinite(seen.depths[at]) || (seen.empty && seen.depths[at] == *seen.empty);
          const double z = least + range * seen.depths[at];
          sure = true;
          same = same && (std::isinf(shown.low) ? empty : z >= shown.low - off && z <= shown.high + off);
        }
        likeness.sure += sure, likeness.differ += sure && !same;
      }
    return likeness;
  }

  const Header header_;
  const Given given_;
  std::vector<std::optional<DrawnFacet>> right_;
  std::vector<Shown> shown_;
  Buffer buffer_;
};

/// How many pixels may still differ where so many did before, and something is explained.
std::int64_t explained(std::int64_t differ) { return (differ - 1) / 2; }

/// The scene drawn in one way after another, beside a picture that is not the right one.
class Search {
 public:
  Search(const Seen& seen, Redrawing& right_drawing) : seen_(seen) {
    right_ = right_drawing.like(seen, {}, 0, 0, Redrawing::any_number, right_drawing.all_rows());
    if (right_.differ == 0) return;
    std::tie(rows_, differ_in_rows_) = right_drawing.rows_that_differ(seen);
    best_ = explained(right_.differ);
  }
  const Likeness& right() const { return right_; }
  bool is_explained() const { return is_found_ && best_ == 0; }
  /// What is looked for from now on has to be likelier than all that was found.
  void ask_for_more() { best_ -= is_found_; }

  /// Of all choices that there are, the likest, where it is no less like than what was found before.
  std::optional<Likeness> likest(Redrawing& drawing, const Together& ways) {
    const int choices = Redrawn::choices(ways);
    const bool apart = ways.size() < 2;  // of two mistakes both ways round are made with the same vertices
    std::optional<Likeness> likest;
    for (int both = 0; both < choices * (apart ? choices : 1); ++both) {
      const int clockwise = both % choices, counter = apart ? both / choices : both;
      // What leaves more than that in these rows leaves more in all, and what explains little there is not gone into.
      const std::int64_t most_there = std::min(best_, explained(differ_in_rows_) + 1);
      if (drawing.like(seen_, ways, clockwise, counter, most_there, rows_).differ > most_there) continue;
      Likeness one = drawing.like(seen_, ways, clockwise, counter, best_, drawing.all_rows());
      const bool is_known = 10 * one.sure >= 9 * right_.sure;
      if (one.differ <= best_ && is_known && (!likest || one.differ < likest->differ)) likest = std::move(one);
    }
    if (likest) best_ = likest->differ, is_found_ = true;
    return likest;
  }

 private:
  const Seen& seen_;
  Likeness right_;
  Rows rows_;
  std::int64_t differ_in_rows_ = 0, best_ = 0;
  bool is_found_ = false;
};

using Others = std::vector<const Otherwise*>;

/// A header that has these conventions, as a program's would.
Header with(Header header, const Others& others) {
  const auto is_of_depth = [](const Otherwise* one) { return one->key == "depth"; };
  for (const Otherwise* one : others)
    if (is_of_depth(one)) {
      one->change(header);
      // What is nearer goes with the depth: the buffer has it so.
      header.comparison.nearer =
          greater_is_nearer(header.conventions.depth) ? Comparison::Nearer::greater : Comparison::Nearer::smaller;
    }
  for (const Otherwise* one : others)
    if (!is_of_depth(one)) one->change(header);
  return header;
}

/// Conventions that a picture may show. Rows are counted as its file has them, and numbers besides depths it has none;
/// how they are interpolated shows in what rounding decides.
std::vector<Otherwise> others_in_picture(const Scene& scene, const Header& header) {
  std::vector<Otherwise> others = other_conventions();
  const bool on_screen = scene.camera.kind == Camera::Kind::screen;
  std::erase_if(others, [&](const Otherwise& one) {
    return one.is_of_raster || one.is_of_numbers || one.key == "interpolation" || one.key == "attribute" ||
           one.holds(header, scene.raster) || (on_screen && (one.key == "cull" || one.key == "depth"));
  });
  return others;
}

}  // namespace

std::vector<Likeness> likenesses(const Scene& scene, const Header& header, double roundoff, const Seen& seen,
                                 const std::function<bool(double)>& on_done) {
  Redrawing as_declared(scene, header, roundoff);
  Search search(seen, as_declared);
  std::vector<Likeness> found{search.right()};
  if (found.front().differ == 0) return found;
  const std::vector<Otherwise> others = others_in_picture(scene, header);
  std::int64_t done = 0, all = 0;
  std::array<std::int64_t, 2> count{};
  for (const bool pairs : {false, true}) each_together(pairs, [&](const Together&) { return ++count[pairs] > 0; });
  all = count[0] + count[1] + std::ssize(others) * (count[0] + 1 + std::ssize(others));
  bool goes_on = true;
  const auto draw = [&](Redrawing& drawing, const Together& ways, const Others& conventions) {
    if (auto one = search.likest(drawing, ways)) {
      for (const Otherwise* other : conventions)
        one->conventions.push_back({std::string(other->key), std::string(other->word)});
      found.push_back(std::move(*one));
    }
    return goes_on = !on_done || !on_done(static_cast<double>(++done) / static_cast<double>(all));
  };
  // A convention explains more simply than a mistake does, and one of either more simply than two.
  for (std::size_t i = 0; goes_on && i < others.size(); ++i) {
    Redrawing drawing(scene, with(header, {&others[i]}), roundoff);
    draw(drawing, {}, {&others[i]});
  }
  if (goes_on && !search.is_explained())
    each_together(false, [&](const Together& ways) { return draw(as_declared, ways, {}); });
  if (goes_on && !search.is_explained()) {
    search.ask_for_more();
    for (std::size_t i = 0; goes_on && i < others.size(); ++i) {
      for (std::size_t k = i + 1; goes_on && k < others.size(); ++k) {
        if (others[i].key == others[k].key) continue;
        const Others two{&others[i], &others[k]};
        Redrawing drawing(scene, with(header, two), roundoff);
        draw(drawing, {}, two);
      }
      Redrawing drawing(scene, with(header, {&others[i]}), roundoff);
      if (goes_on) each_together(false, [&](const Together& ways) { return draw(drawing, ways, {&others[i]}); });
    }
    if (goes_on && !search.is_explained())
      each_together(true, [&](const Together& ways) { return draw(as_declared, ways, {}); });
  }
  std::stable_sort(found.begin() + 1, found.end(),
                   [](const Likeness& one, const Likeness& other) { return one.differ < other.differ; });
  return found;
}

}  // namespace zstep::mistakes
