#include "traces/diff/causes.hpp"

#include <algorithm>
#include <map>
#include <tuple>

namespace zstep::diff {

namespace {

/// Where each difference comes from in the end.
class Roots {
 public:
  Roots(const std::vector<Finding>& in_a, const std::vector<Finding>& in_b) : in_a_(in_a), in_b_(in_b) {
    root_.assign(in_a.size(), no_difference);
  }
  std::int32_t of(std::int32_t difference) {
    std::vector<std::int32_t> way;
    std::int32_t at = difference;
    while (root_[index(at)] == no_difference) {
      root_[index(at)] = on_the_way;
      way.push_back(at);
      const std::int32_t next = from(at);
      if (next == no_difference) break;
      at = next;
    }
    std::int32_t root = root_[index(at)] >= 0 ? root_[index(at)] : at;
    // Where the orders of the two runs part, the way may lead round in a circle: then the first of all is the root.
    if (const auto circle = std::find(way.begin(), way.end(), at); circle != way.end() && from(at) != no_difference)
      root = *std::min_element(circle, way.end());
    for (const std::int32_t one : way) root_[index(one)] = root;
    return root;
  }
  bool wrong_a(std::int32_t d) const { return in_a_[index(d)].wrong; }
  bool wrong_b(std::int32_t d) const { return in_b_[index(d)].wrong; }
  bool by_rounding(std::int32_t d, const Difference& difference) const {
    return (difference.only_b() || in_a_[index(d)].rounding) && (difference.only_a() || in_b_[index(d)].rounding);
  }

 private:
  static constexpr std::int32_t on_the_way = -2;
  static std::size_t index(std::int32_t d) { return static_cast<std::size_t>(d); }
  std::int32_t from(std::int32_t d) const {
    const Finding &a = in_a_[index(d)], &b = in_b_[index(d)];
    if (a.wrong != b.wrong) return no_difference;  // one of the two computes it wrongly
    return b.comes_from != no_difference ? b.comes_from : a.comes_from;
  }

  const std::vector<Finding>&in_a_, &in_b_;
  std::vector<std::int32_t> root_;
};

/// Steps that right programs do or leave out: to begin a polygon or a scan line where there is nothing to do, to change
/// neighbours on the way to a list in order. They count where something follows.
bool may_be_missing(const Difference& difference) {
  return (difference.only_a() || difference.only_b()) &&
         (difference.kind == kind_of<PolygonBegin> || difference.kind == kind_of<ScanLineBegin> ||
          difference.kind == kind_of<EdgeSwap>);
}

bool writes_pixel(std::uint8_t kind) {
  return kind == kind_of<PixelWrite> || kind == kind_of<PixelPaint> || kind == kind_of<ColorWrite> ||
         kind == kind_of<ColorBlend>;
}

}  // namespace

void find_causes(DiffReport& report, const std::vector<Finding>& in_a, const std::vector<Finding>& in_b) {
  const auto& differences = report.alignment.differences;
  Roots roots(in_a, in_b);
  // By what parts: several of one sort are one cause that comes again.
  using Sort = std::tuple<std::uint8_t, std::uint16_t, bool, bool, Part>;
  std::map<Sort, std::size_t> known;
  std::vector<std::size_t> cause_of(differences.size());
  std::vector<bool> followed(differences.size());
  for (std::size_t i = 0; i < differences.size(); ++i)
    if (const std::int32_t root = roots.of(static_cast<std::int32_t>(i)); root != static_cast<std::int32_t>(i))
      followed[static_cast<std::size_t>(root)] = true;
  for (const bool symptoms : {false, true}) {
    for (std::size_t i = 0; i < differences.size(); ++i) {
      const auto d = static_cast<std::int32_t>(i);
      const Difference& difference = differences[i];
      const std::int32_t root = roots.of(d);
      if ((root != d) != symptoms) continue;
      const bool needed = in_a[i].needed || in_b[i].needed;
      if (!symptoms && !needed && (may_be_missing(difference) || in_a[i].idle || in_b[i].idle) && !followed[i]) {
        report.kinds[difference.kind].idle_a += difference.only_a();
        report.kinds[difference.kind].idle_b += difference.only_b();
        continue;
      }
      if (!symptoms) {
        const Part part = roots.by_rounding(d, difference) ? Part::rounding : Part::different;
        const Sort sort{difference.kind, difference.fields, difference.only_a(), difference.only_b(), part};
        const auto [found, fresh] = known.try_emplace(sort, report.causes.size());
        if (fresh) report.causes.push_back({difference, part, roots.wrong_a(d), roots.wrong_b(d), 0, 0, 0});
        else ++report.causes[found->second].again;
        cause_of[i] = found->second;
      } else {
        cause_of[i] = cause_of[static_cast<std::size_t>(root)];
        ++report.causes[cause_of[i]].symptoms;
      }
      Cause& cause = report.causes[cause_of[i]];
      cause.pixels += writes_pixel(difference.kind);
      if (!difference.only_a() && !difference.only_b()) {
        KindDifference& kind = report.kinds[difference.kind];
        ++(cause.part == Part::rounding ? kind.rounding : kind.different);
      }
    }
  }
  std::stable_sort(report.causes.begin(), report.causes.end(),
                   [](const Cause& one, const Cause& other) { return one.part < other.part; });
}

}  // namespace zstep::diff
