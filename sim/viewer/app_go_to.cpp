// What "go to" makes of what is typed: a step, a percentage, a polygon, a pixel.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>

#include "sim/viewer/app.hpp"
#include "sim/viewer/words/numbers.hpp"

namespace zstep::viewer {

void App::go_to_typed() {
  std::string text = typed;
  open(Overlay::none);
  const auto numbers = [&text] {
    std::vector<std::int64_t> found;
    std::string digits;
    for (const char c : text + " ") {
      if (std::isdigit(static_cast<unsigned char>(c))) digits += c;
      else if (!digits.empty()) found.push_back(std::strtoll(std::exchange(digits, {}).substr(0, 18).c_str(), nullptr, 10));
    }
    return found;
  }();
  const bool pixel = text.find(',') != std::string::npos;
  if (pixel && numbers.size() == 2) {
    const Raster& raster = session_.scene().raster;
    if (numbers[0] >= raster.width || numbers[1] >= raster.height) return say(fmt::format("The raster is {} by {}.", raster.width, raster.height));
    session_.select(Cell{static_cast<std::int32_t>(numbers[0]), static_cast<std::int32_t>(numbers[1])});
    return say("Selected; F runs to the next step that touches it.");
  }
  if (!pixel && text.find('%') != std::string::npos && !numbers.empty()) {
    const double share = std::clamp(std::strtod(text.c_str(), nullptr), 0.0, 100.0) / 100;
    return session_.go_to(std::llround(share * static_cast<double>(session_.size())));
  }
  if (text.find_first_of("pP") != std::string::npos && numbers.size() == 1) {
    for (const PolygonMark& mark : session_.trace().polygons())
      if (mark.polygon == numbers[0]) return session_.go_to(mark.position, Unit::polygon);
    return say(fmt::format("Polygon {} is not in this trace.", numbers[0]));
  }
  if (!numbers.empty() && !pixel) {
    std::int64_t step = 0;
    std::string digits;
    for (const char c : text)
      if (std::isdigit(static_cast<unsigned char>(c))) digits += c;
    step = std::strtoll(digits.substr(0, 18).c_str(), nullptr, 10);
    if (step > session_.size()) {
      session_.go_to(session_.size());
      return say(fmt::format("This trace has {} steps; this is its end.", grouped(session_.size())));
    }
    return session_.go_to(step);
  }
  say("Type a step (12041), a percentage (25 %), a polygon (p 3) or a pixel (9, 17).");
}

}  // namespace zstep::viewer
