// A formula in x and z, as a person types it: "sin(x) * cos(z)".
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace zstep::scene {

/// Numbers, x, z, pi, e, + - * / ^ ( ) and a fixed list of functions; angles in radians. Evaluated as it is written, by
/// portable functions, so that the same formula gives the same bits everywhere.
class Formula {
 public:
  /// A "y =" before it is passed over. Throws InputError at `where` (FILE:LINE, or what the command line calls it) that
  /// names the formula and the character at fault.
  Formula(std::string_view text, const std::string& where);
  ~Formula();
  Formula(const Formula&) = delete;
  Formula& operator=(const Formula&) = delete;

  /// f(x, z); throws InputError where that is no finite number of ordinary size.
  double at(double x, double z);

  /// Without "y =" and the blanks around it.
  const std::string& text() const { return text_; }

 private:
  struct Parser;
  std::string text_, where_;
  std::unique_ptr<Parser> parser_;
};

/// Whether a scene's name is a formula: "y = …".
bool is_formula(std::string_view name);

}  // namespace zstep::scene
