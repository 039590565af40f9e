#include "algorithms/scene/surface/formula.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <muParser.h>

#include "algorithms/scene/files/number.hpp"
#include "algorithms/scene/files/tokens.hpp"
#include "traces/error.hpp"
#include "traces/limits.hpp"

namespace zstep::scene {

namespace {

constexpr std::string_view blanks = " \t";
// Nothing that assigns, compares, chooses or quotes: muParser knows "=", "?:" and texts, a surface needs none of them.
constexpr std::string_view allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.,+-*/^() \t";
constexpr std::string_view help =
    "it may have x, z, numbers, pi, e, + - * / ^ ( ) and sqrt, abs, sign, exp, ln, log10, sin, cos, tan, asin, acos, "
    "atan, sinh, cosh, tanh, floor, ceil, min(a, b), max(a, b), atan2(a, b)";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// What stands behind "y ="; nothing where there is no "y =".
std::optional<std::string_view> right_side(std::string_view text) {
  text = trimmed(text);
  if (text.empty() || text.front() != 'y') return std::nullopt;
  text = trimmed(text.substr(1));
  if (text.empty() || text.front() != '=') return std::nullopt;
  return trimmed(text.substr(1));
}

std::string what_is_wrong(const mu::ParserError& error) {
  const std::string token = in_quotes(trimmed(error.GetToken()));
  switch (error.GetCode()) {
    case mu::ecUNASSIGNABLE_TOKEN:
      return token + " is not known";
    case mu::ecUNEXPECTED_EOF:
      return "the formula ends too early";
    case mu::ecMISSING_PARENS:
      return "a closing parenthesis is missing";
    case mu::ecUNEXPECTED_PARENS:
      return fmt::format("the parenthesis {} stands in a wrong place", token);
    case mu::ecTOO_MANY_PARAMS:
      return fmt::format("{} is given too many numbers", token);
    case mu::ecTOO_FEW_PARAMS:
      return fmt::format("{} is given too few numbers", token);
    case mu::ecUNEXPECTED_VAR:
    case mu::ecUNEXPECTED_VAL:
    case mu::ecUNEXPECTED_FUN:
      return fmt::format("an operator is missing before {}", token);
    default:
      return error.GetToken().empty() ? "it cannot be read" : fmt::format("{} stands in a wrong place", token);
  }
}

void define_functions(mu::Parser& parser) {
  using Of1 = double (*)(double);
  using Of2 = double (*)(double, double);
  const auto one = [&](const char* name, Of1 function) { parser.DefineFun(name, function); };
  const auto two = [&](const char* name, Of2 function) { parser.DefineFun(name, function); };
  one("sqrt", [](double a) { return std::sqrt(a); });
  one("abs", [](double a) { return std::abs(a); });
  one("sign", [](double a) { return a > 0 ? 1.0 : a < 0 ? -1.0 : 0.0; });
  one("exp", [](double a) { return std::exp(a); });
  one("ln", [](double a) { return std::log(a); });
  one("log10", [](double a) { return std::log10(a); });
  one("sin", [](double a) { return std::sin(a); });
  one("cos", [](double a) { return std::cos(a); });
  one("tan", [](double a) { return std::tan(a); });
  one("asin", [](double a) { return std::asin(a); });
  one("acos", [](double a) { return std::acos(a); });
  one("atan", [](double a) { return std::atan(a); });
  one("sinh", [](double a) { return std::sinh(a); });
  one("cosh", [](double a) { return std::cosh(a); });
  one("tanh", [](double a) { return std::tanh(a); });
  one("floor", [](double a) { return std::floor(a); });
  one("ceil", [](double a) { return std::ceil(a); });
  two("min", [](double a, double b) { return std::min(a, b); });
  two("max", [](double a, double b) { return std::max(a, b); });
  two("atan2", [](double a, double b) { return std::atan2(a, b); });
}

}  // namespace

struct Formula::Parser {
  double x = 0, z = 0;
  mu::Parser muparser;
};

Formula::Formula(std::string_view text, const std::string& where) : where_(where), parser_(new Parser) {
  text_ = std::string(right_side(text).value_or(trimmed(text)));
  const auto fail = [&](std::string_view what, std::string_view mend) {
    throw InputError(where_, fmt::format("in the formula {}: {}", in_quotes(text_), what), mend);
  };
  if (text_.empty()) throw InputError(where_, "the formula is empty", "write for example y = sin(x) * cos(z)");
  if (text_.size() > longest_formula)
    fail(fmt::format("it has {} characters", text_.size()), fmt::format("write at most {}", longest_formula));
  if (const std::size_t bad = text_.find_first_not_of(allowed); bad != std::string::npos)
    fail(fmt::format("character {}, {}, has no meaning", bad + 1, in_quotes(std::string_view(text_).substr(bad, 1))),
         help);

  mu::Parser& parser = parser_->muparser;
  try {
    parser.EnableOptimizer(false);
    parser.ClearFun();
    parser.ClearConst();
    define_functions(parser);
    parser.DefineConst("pi", 3.14159265358979323846);
    parser.DefineConst("e", 2.71828182845904523536);
    parser.DefineVar("x", &parser_->x);
    parser.DefineVar("z", &parser_->z);
    parser.SetExpr(text_);
    parser.Eval();
    if (parser.GetNumResults() != 1) fail("it gives more than one number", "leave out the comma");
  } catch (const mu::ParserError& error) {
    const std::string what = what_is_wrong(error);
    fail(error.GetPos() < 0 ? what : fmt::format("at character {}: {}", error.GetPos() + 1, what), help);
  }
}

Formula::~Formula() = default;

double Formula::at(double x, double z) {
  parser_->x = x;
  parser_->z = z;
  double y = std::nan("");
  try {
    y = parser_->muparser.Eval();
  } catch (const mu::ParserError&) {  // a muParser that was built to throw where others give inf
  }
  if (!(std::abs(y) <= largest_coordinate))
    throw InputError(
        where_,
        fmt::format("the formula {} gives {} at x = {}, z = {}", in_quotes(text_),
                    std::isnan(y) ? "no number" : fmt::format("{}", y), x, z),
        "choose ranges of x and z in which it has a value, or numbers of rows and columns that pass the place by");
  return y + 0.0;  // -0 becomes 0: it is going to be read
}

bool is_formula(std::string_view name) { return right_side(name).has_value(); }

}  // namespace zstep::scene
