// The scene as a program draws it that makes a mistake which shows in its pixels alone: with vertices, an inside test,
// depths, a buffer or colours other than they should be. However the program computes, each is the scene's own facet
// (formulas/drawn_facet.hpp), changed.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "traces/formulas/drawn_facet.hpp"
#include "traces/mistakes/mistake.hpp"

namespace zstep::mistakes {

/// A mistake, and which way of making it, where it is made in one way throughout a program: everything one pixel too
/// far to the right, or too far down.
struct Way {
  Mistake mistake{};
  int variant = 0;
};
/// What a mistake changes. Two that change different things are made beside each other.
enum class Changes : std::uint8_t { places, inside, facing, depths, buffer, colours, count };
/// Nothing where it is made with what comes before pixels, as edges and spans.
std::optional<Changes> changes_of(Mistake mistake);
/// All ways of all mistakes that show in pixels, in the order of the catalogue.
std::span<const Way> ways_to_draw();

/// Rows of pixels, one below another.
struct Rows {
  std::int32_t first = 0, end = 0;
  bool has(std::int32_t y) const { return y >= first && y < end; }
};
/// What is drawn, and what the program computes with: its unit roundoff.
struct Given {
  const Scene& scene;
  const Header& header;
  double roundoff;
};

/// A facet as it is drawn.
class Redrawn {
 public:
  using Cover = formulas::DrawnFacet::Cover;
  struct Depths {
    double low, high;
  };

  /// In how many ways these mistakes are made with a facet, as the program may begin with any of its vertices.
  static int choices(std::span<const Way> ways);
  /// Can it be said what these mistakes make of it?
  static bool is_known(const formulas::DrawnFacet& right, std::span<const Way> ways, const Given& given);
  /// Nothing where that is not known, or it is drawn without an area; `right` is the facet as it should be.
  static std::optional<Redrawn> of(const formulas::DrawnFacet& right, std::span<const Way> ways, int choice,
                                   const Given& given);
  /// Do its corners go clockwise as it is seen?
  static bool is_clockwise(const formulas::DrawnFacet& right);
  /// May any pixel of it be in these rows?
  static bool may_meet(const formulas::DrawnFacet& right, std::span<const Way> ways, Rows rows, const Given& given);
  /// Is it left out for how they go round? `cull`: back faces are dropped.
  static bool is_left_out(const formulas::DrawnFacet& right, std::span<const Way> ways, bool cull, const Given& given);

  Cover cover(std::int32_t x, std::int32_t y) const;
  /// visit(x, y, cover) for each pixel that is drawn or may be.
  template <class Visit>
  void each_pixel(Visit&& visit) const {
    inside_.each_pixel([&](std::int32_t x, std::int32_t y, Cover) {
      if (is_turned_) x = width_ - 1 - x, y = height_ - 1 - y;
      if (const Cover found = cover(x, y); found != Cover::outside) visit(x, y, found);
    });
  }
  /// What the depth buffer may be asked about there; all there are where nothing is known.
  Depths depths(std::int32_t x, std::int32_t y) const;
  /// Does it compare weights with a number that nobody knows? Then each pixel around the triangle may be inside, and
  /// least_weight() is what is compared.
  bool has_margin() const { return margin_.has_value(); }
  double least_weight(std::int32_t x, std::int32_t y) const;
  /// visit(x, y) for each pixel that is compared for certain.
  template <class Visit>
  void each_compared(Visit&& visit) const {
    const auto whole = [](double at, std::int32_t size) {
      return static_cast<std::int32_t>(std::clamp<double>(at, -1, size));
    };
    for (std::int32_t y = std::max(0, whole(box_->first_y, height_)); y <= whole(box_->last_y, height_ - 1); ++y)
      for (std::int32_t x = std::max(0, whole(box_->first_x, width_)); x <= whole(box_->last_x, width_ - 1); ++x)
        visit(x, y);
  }

 private:
  enum class After : std::uint8_t { nothing, reciprocal, truncated, rounded };
  /// Which pixels the program goes through at all: for certain, or perhaps.
  struct Box {
    double first_x, last_x, first_y, last_y;
    bool holds(std::int32_t x, std::int32_t y) const {
      return x >= first_x && x <= last_x && y >= first_y && y <= last_y;
    }
  };

  Redrawn(formulas::DrawnFacet right, const Raster& raster)
      : inside_(std::move(right)), width_(raster.width), height_(raster.height) {}
  /// Which pixels an outline has; false where it has no area.
  bool find_inside(const std::vector<formulas::DrawnCorner>& outline, const Way* way, int choice, const Given& given);
  bool find_depths(std::vector<formulas::DrawnCorner> outline, const Way* way, int choice, const Given& given);

  formulas::DrawnFacet inside_;  ///< whose pixels are drawn
  bool is_turned_ = false;       ///< seen from below: its pixels on an edge are those that the other side owns
  std::optional<formulas::DrawnFacet> also_inside_;  ///< the same, turned: pixels must be inside both
  std::optional<Box> box_, box_at_most_;
  struct Margin {
    std::array<formulas::DrawnCorner, 3> corners;
    double divided_by;  ///< of weights, twice the area; of edge functions, its sign
  };
  std::optional<Margin> margin_;
  std::vector<formulas::DrawnFacet> depths_;  ///< by triangle, or all of it
  After after_ = After::nothing;
  std::int32_t width_, height_;
};

/// The depth buffer of a program, asked and written as its mistakes have it.
class Buffer {
 public:
  Buffer(std::span<const Way> ways, const Given& given);

  /// Made afresh with other mistakes, of which none puts a pixel into another row; these rows alone are asked about.
  void begin_again(std::span<const Way> ways, Rows rows);
  void clear() { std::fill(stored_.begin(), stored_.end(), begins_with_); }
  /// Is the depth nearer than what is stored? Nothing where that is not known. Keeps what the program then keeps.
  std::optional<bool> ask(std::int32_t x, std::int32_t y, Redrawn::Depths z);
  /// The same where it is not known whether the program asks at all.
  void may_ask(std::int32_t x, std::int32_t y, Redrawn::Depths z);
  /// May the answer have been this one? Keeps likewise.
  bool may_answer(std::int32_t x, std::int32_t y, Redrawn::Depths z, bool nearer);

 private:
  Redrawn::Depths& stored(std::int32_t x, std::int32_t y);
  std::optional<bool> answer(Redrawn::Depths z, Redrawn::Depths stored) const;
  bool made(Mistake mistake) const;
  Redrawn::Depths first_depths() const;

  std::span<const Way> ways_;
  Comparison comparison_;
  double empty_;
  std::int32_t width_, height_;
  Redrawn::Depths begins_with_{};  ///< all as if the smaller depth were the nearer one
  std::vector<Redrawn::Depths> stored_;
};

}  // namespace zstep::mistakes
