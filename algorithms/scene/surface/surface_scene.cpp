#include "algorithms/scene/surface/surface_scene.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <muParser.h>
#include <optional>
#include <utility>

#include "algorithms/scene/files/tokens.hpp"
#include "algorithms/scene/mesh.hpp"
#include "traces/error.hpp"
#include "traces/math/portable_math.hpp"
#include "traces/scene.hpp"

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
      // An operator that has no left side: the token is all that follows it.
      if (const std::string_view text = trimmed(error.GetToken()); text.find_first_of("*/^") == 0)
        return in_quotes(text.substr(0, 1)) + " stands in a wrong place";
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
  // Operators too, as muParser's own ^ is std::pow. A sign binds less than ^ and as much as *, as in muParser.
  parser.EnableBuiltInOprt(false);
  const auto between = [&](const char* name, Of2 function, mu::EOprtPrecedence binds, mu::EOprtAssociativity from) {
    parser.DefineOprt(name, function, static_cast<unsigned>(binds), from);
  };
  between(
      "+", [](double a, double b) { return a + b; }, mu::prADD_SUB, mu::oaLEFT);
  between(
      "-", [](double a, double b) { return a - b; }, mu::prADD_SUB, mu::oaLEFT);
  between(
      "*", [](double a, double b) { return a * b; }, mu::prMUL_DIV, mu::oaLEFT);
  between(
      "/", [](double a, double b) { return a / b; }, mu::prMUL_DIV, mu::oaLEFT);
  between("^", portable::pow, mu::prPOW, mu::oaRIGHT);
  one("sqrt", [](double a) { return std::sqrt(a); });
  one("abs", [](double a) { return std::abs(a); });
  one("sign", [](double a) { return a > 0 ? 1.0 : a < 0 ? -1.0 : 0.0; });
  one("exp", portable::exp);
  one("ln", portable::log);
  one("log10", portable::log10);
  one("sin", portable::sin);
  one("cos", portable::cos);
  one("tan", portable::tan);
  one("asin", portable::asin);
  one("acos", portable::acos);
  one("atan", portable::atan);
  one("sinh", portable::sinh);
  one("cosh", portable::cosh);
  one("tanh", portable::tanh);
  one("floor", [](double a) { return std::floor(a); });
  one("ceil", [](double a) { return std::ceil(a); });
  two("min", [](double a, double b) { return std::min(a, b); });
  two("max", [](double a, double b) { return std::max(a, b); });
  two("atan2", portable::atan2);
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

namespace {

double at(double low, double high, std::int32_t i, std::int32_t count) {
  return i == count - 1 && i > 0 ? high : count > 1 ? low + (high - low) * i / (count - 1) : low;
}

}  // namespace

PolygonSoup sample(const Surface& surface, Formula& formula, const std::string& where) {
  const std::int32_t columns = surface.columns, rows = surface.rows;
  const auto place = [&] { return where; };
  PolygonSoup soup;
  for (std::int32_t row = 0; row < rows; ++row) {
    const double z = at(surface.z_min, surface.z_max, row, rows);
    for (std::int32_t column = 0; column < columns; ++column) {
      const double x = at(surface.x_min, surface.x_max, column, columns);
      soup.add_point({x, z, formula.at(x, z)}, 0, place);
    }
  }
  for (std::int32_t row = 0; row + 1 < rows; ++row)
    for (std::int32_t column = 0; column + 1 < columns; ++column) {
      const std::int32_t corner = row * columns + column;
      for (const std::int32_t index : {corner, corner + 1, corner + columns + 1, corner + columns})
        soup.add_corner(index, place);
      soup.close_outline(0, std::nullopt, place);
    }
  return soup;
}

SceneFile surface_scene(Surface surface, const std::string& where, SceneFile file, const SceneBuilder::Style& style) {
  Formula formula(surface.formula, where);
  surface.formula = formula.text();
  SceneBuilder builder(std::move(file));
  PolygonSoup samples = sample(surface, formula, where);
  if (style.line > 0) samples.point_lines.assign(samples.points.size(), style.line);
  builder.add(std::move(samples), where, style);
  SceneFile result = builder.finish();
  result.scene.surface = std::move(surface);
  return result;
}

SceneFile formula_scene(const std::string& formula) {
  SceneFile file;
  Camera& camera = file.scene.camera;
  camera.rho = 0;  // from the extent
  camera.theta = -70;
  camera.phi = 60;
  camera.d = 4;
  file.scene.raster = {640, 480, false};
  file.conventions.cull = false;
  Surface surface = default_surface();
  surface.formula = formula;
  SceneFile result = surface_scene(std::move(surface), in_quotes(formula), std::move(file),
                                   {{}, SceneBuilder::Bare::shaded, clay, 0, {}, true});
  result.scene.name = "y = " + result.scene.surface->formula;
  result.scene.source = "a formula";
  return result;
}

}  // namespace zstep::scene
