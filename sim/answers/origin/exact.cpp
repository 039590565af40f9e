#include "sim/answers/origin/exact.hpp"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

#include "traces/file/header.hpp"
#include "traces/formulas/rounding.hpp"

namespace zstep::answers {

namespace {

using Whole = boost::multiprecision::cpp_int;
using oracle::rounded;

/// A number and how much it gains where one operand gains 1.
struct Slope {
  double value = 0, gain = 0;
  explicit Slope(double v) : value(v) {}
  Slope(double v, double g) : value(v), gain(g) {}
};
Slope operator+(Slope a, Slope b) { return {a.value + b.value, a.gain + b.gain}; }
Slope operator-(Slope a, Slope b) { return {a.value - b.value, a.gain - b.gain}; }
Slope operator-(Slope a) { return {-a.value, -a.gain}; }
Slope operator*(Slope a, Slope b) { return {a.value * b.value, a.gain * b.value + a.value * b.gain}; }
Slope operator/(Slope a, Slope b) { return {a.value / b.value, (a.gain - a.value / b.value * b.gain) / b.value}; }

Rational exact_of(double value) {
  if (!std::isfinite(value)) throw NotExact{"a number that is not finite"};
  return Rational(value);
}

}  // namespace

template <>
struct Functions<Slope> {
  static bool less(const Slope& a, const Slope& b) { return a.value < b.value; }
  static bool equal(const Slope& a, const Slope& b) { return a.value == b.value; }
  static Slope floor(const Slope& a) { return Slope(std::floor(a.value)); }
  static Slope ceil(const Slope& a) { return Slope(std::ceil(a.value)); }
  static Slope round(const Slope& a) { return Slope(std::round(a.value)); }
  static Slope sqrt(const Slope& a) {
    const double root = std::sqrt(a.value);
    return {root, a.gain / (2 * root)};
  }
};

namespace {

/// More digits than float64 has, so that its error shows.
std::string decimals_of(const Rational& exact) { return oracle::decimals_of(exact, 25); }

/// A short fraction as it is, and digits; of a number that float64 holds, its own.
std::string digits_of(const Rational& exact) {
  if (exact == Rational(rounded(exact))) return full_digits(rounded(exact));
  constexpr std::size_t short_enough = 9;
  const std::string above = Whole(abs(numerator(exact))).str(), below = Whole(denominator(exact)).str();
  const std::string digits = decimals_of(exact);
  if (above.size() > short_enough || below.size() > short_enough) return digits;
  return fmt::format("{}{}/{} = {}", exact < 0 ? "\u2212" : "", above, below, digits);
}

/// Goes through a chain, each number once, after what it was made of.
class Exactly {
 public:
  Exactly(const Chain& chain, const Trace& trace)
      : chain_(chain),
        trace_(trace),
        format_(trace.header().conventions.number_format),
        depth_unit_(depth_unit(trace.scene(), trace.header().conventions)) {
    for (const ChainLink& link : chain.links) {
      result_.of.emplace_back(link.values.size());
      found_.emplace_back(link.values.size());
    }
  }

  Exactness run() {
    for (std::size_t link = 0; link < chain_.links.size(); ++link)
      for (std::size_t value = 0; value < chain_.links[link].values.size(); ++value) find({link, value});
    if (!chain_.links.empty() && !chain_.links[0].values.empty() && result_.of[0][0].known) {
      share_out();
      const ChainValue& asked = chain_.links[0].values[0];
      if (is_depth_of(chain_.links[0].step, asked))
        result_.buffer_unit = formulas::last_digit(asked.value, format_, depth_unit_);
    }
    return std::move(result_);
  }

 private:
  using Where = Exactness::Where;
  struct Known {
    bool looked_for = false;
    std::optional<Enclosed> exact{};
    double gain = 0;  ///< of the first number, where this one gains 1
  };
  Known& found_at(Where at) { return found_[at.link][at.value]; }

  /// Is this number one that the depth buffer gets, or is compared with?
  bool is_depth_of(std::int64_t step, const ChainValue& value) const {
    if (step < 1 || value.condition || !value.word.empty()) return false;
    if (depth_buffer(trace_.header()) == DepthBuffer::none) return false;
    return visit_event(
        [&]<class E>(const E& e) {
          if constexpr (has(at_pixel<E>, AtPixel::depth | AtPixel::keeps))
            return e.z == value.value && value.name.starts_with('z');
          else return false;
        },
        trace_.event(step).event);
  }

  const ChainValue& value_at(Where at) const { return chain_.links[at.link].values[at.value]; }
  std::optional<Where> source_of(const Operand& operand) const {
    if (operand.link < 0) return std::nullopt;
    const std::size_t link = operand.link;
    const std::vector<ChainValue>& values = chain_.links[link].values;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i].name == operand.name) return Where{link, i};
    return std::nullopt;
  }

  /// Of a fixed-point number: x and y count parts of a pixel, other numbers those of a depth.
  double unit_of(const ChainValue& value) const {
    const bool position = value.name.starts_with('x') || value.name.starts_with('y');
    return depth_unit_ > 0 && position ? 1 / fixed_positions_a_pixel : depth_unit_;
  }

  void find(Where at) {
    if (std::exchange(found_at(at).looked_for, true)) return;
    const ChainValue& value = value_at(at);
    Exact& found = result_.of[at.link][at.value];
    try {
      const Enclosed enclosed = computed(at, value);
      found_at(at).exact = enclosed;  // what follows from it may be known where it is not
      if (!enclosed.is_narrow()) throw NotExact{"so close to 0 that the digits of square roots cancel"};
      const Rational exact = enclosed.middle(), error = exact_of(value.value) - exact;
      if (!std::isfinite(rounded(exact))) throw NotExact{"a number too large for float64"};
      found.known = true;
      found.enclosed = !enclosed.is_fraction();
      found.digits = found.enclosed ? decimals_of(exact) : digits_of(exact);
      found.error = rounded(error);
      found.ulps = found.error / formulas::last_digit(rounded(exact), format_, unit_of(value));
    } catch (const NotExact& reason) {
      found.why = reason.why;
    } catch (const std::overflow_error&) {
      found.why = "a division by 0";
    }
    order_.push_back(at);
  }

  Enclosed computed(Where at, const ChainValue& value) {
    if (chain_.links[at.link].given) return Enclosed(exact_of(value.value));
    if (value.formula.empty()) throw NotExact{value.name + ", which is taken as recorded"};
    return Evaluation<Enclosed>(value,
                                [&](const Operand& operand) {
                                  const auto from = source_of(operand);
                                  if (!from) return Enclosed(exact_of(operand.value));
                                  find(*from);
                                  const std::string& why = result_.of[from->link][from->value].why;
                                  if (!found_at(*from).exact) throw NotExact{why.empty() ? operand.name : why};
                                  return *found_at(*from).exact;
                                })
        .run();
  }

  /// By how much a number is off what its formula gives of its own operands.
  static double added_at(const ChainValue& value) {
    try {
      const auto recorded = [](const Operand& operand) { return Enclosed(exact_of(operand.value)); };
      return rounded(exact_of(value.value) - Evaluation<Enclosed>(value, recorded).run().middle());
    } catch (const NotExact&) {
      return 0;  // it is the operands that square roots leave open
    } catch (const std::overflow_error&) {
      return 0;  // its operands are 0 where the exact ones are not
    }
  }

  /// How much of the first number's error comes in at each step: what rounding adds there, times how much the first
  /// number gains from it.
  void share_out() {
    found_at({0, 0}).gain = 1;
    for (auto at = order_.rbegin(); at != order_.rend(); ++at) {
      const double gain = found_at(*at).gain;
      const ChainValue& value = value_at(*at);
      Exact& found = result_.of[at->link][at->value];
      if (gain == 0 || !found.known || chain_.links[at->link].given || value.formula.empty()) continue;
      found.brought = added_at(value) * gain;
      for (const Operand& operand : value.operands) {
        const auto from = source_of(operand);
        if (!from) continue;
        const Slope slope = Evaluation<Slope>(value, [&](const Operand& other) {
                              return Slope(other.value, other.symbol == operand.symbol ? 1 : 0);
                            }).run();
        found_at(*from).gain += gain * slope.gain;
      }
      if (found.brought != 0 &&
          (!result_.most ||
           std::abs(found.brought) > std::abs(result_.of[result_.most->link][result_.most->value].brought)))
        result_.most = *at;
    }
  }

  const Chain& chain_;
  const Trace& trace_;
  NumberFormat format_;
  double depth_unit_;  ///< of fixed-point depths, else 0
  Exactness result_;
  std::vector<std::vector<Known>> found_;  ///< by link and value
  std::vector<Where> order_;               ///< each after what it was made of
};

}  // namespace

Exactness exactness_of(const Chain& chain, const Trace& trace) { return Exactly(chain, trace).run(); }

std::string roughly(double value) { return with_minus_signs(fmt::format("{:.2g}", value)); }

std::string exact_text(const ChainValue& value, const Exact& exact) {
  if (!exact.known) return "not exact here: " + exact.why;
  if (value.condition)
    return exact.error == 0 ? "so without rounding, too" : "without rounding it is the other way round";
  if (exact.error == 0) return "exact";
  return fmt::format("exactly {}; error {}, {} ulp", exact.digits, roughly(exact.error), roughly(exact.ulps));
}

}  // namespace zstep::answers
