// The names in the bar at the top, as many as there is room for.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/viewer/viewer.hpp"

namespace zstep::viewer {

struct TitleName {
  std::string text;
  int tells = 0;                        ///< how much: where room is scarce, what tells least goes first
  std::optional<Offer::What> offers{};  ///< others, at a click; then a sign behind it says so
  std::string sign() const { return offers ? " \u25be" : ""; }
};

struct TitleMeasures {
  std::function<float(const std::string&)> width;
  std::function<std::string(const std::string&, float)> cut;  ///< to this width, with "\u2026" at its end
  float least = 0;                                            ///< pixels; rather than cut shorter, a name is left out
};

/// "zstep · Hidden lines ▾ · box, plank and card ▾".
std::string joined_names(const std::vector<TitleName>& names);
/// Those that tell most, whole.
std::vector<TitleName> most_telling(std::vector<TitleName> names);
/// One after another goes until the rest fits; what tells most goes last, and is cut before that.
std::vector<TitleName> names_that_fit(std::vector<TitleName> names, float room, const TitleMeasures& measures);

}  // namespace zstep::viewer
