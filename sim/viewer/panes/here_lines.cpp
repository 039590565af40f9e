#include "sim/viewer/panes/here_lines.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "sim/words/explain.hpp"

namespace zstep::viewer {

std::vector<HereLine> lines_of_polygon(const Session& s, std::int32_t polygon) {
  std::vector<HereLine> lines;
  std::optional<std::int64_t> earlier, later;
  for (const PolygonMark& mark : s.trace().polygons()) {
    if (mark.polygon != polygon) continue;
    if (mark.position < s.position()) earlier = mark.position;
    if (mark.position > s.position() && !later) later = mark.position;
  }
  const auto go = [](std::int64_t position) { return [position](Session& session) { session.go_to(position); }; };
  const std::string name = polygon_label(s.scene(), polygon);
  if (later) lines.push_back({fmt::format("On to where work on polygon {} begins", name), "", go(*later)});
  if (earlier) lines.push_back({fmt::format("Back to where work on polygon {} began", name), "", go(*earlier)});
  const std::int32_t line = s.scene().polygons[static_cast<std::size_t>(polygon)].source_line;
  const std::string place = fmt::format("{}:{}", s.scene().source, line);
  if (line > 0) lines.push_back({.text = "Copy where the file has its polygon: " + place, .copies = place});
  return lines;
}

std::vector<HereLine> lines_of_part(const Session& s, const ScenePart& part) {
  const std::string name = name_of(s.scene(), part);
  const auto go = [part, name](int direction) {
    return [part, name, direction](Session& session) {
      const auto about = [&](const RecordedEvent& event) { return is_about(event.event, part); };
      session.pick(part);
      const auto step = direction > 0 ? session.trace().next(session.position(), about)
                                      : session.trace().previous(session.position(), about);
      if (step) session.go_to(*step);
      else session.message = fmt::format("No {} step is about {}.", direction > 0 ? "later" : "earlier", name);
    };
  };
  std::vector<HereLine> lines{
      {fmt::format("On to the next step about {}", name), "", go(1)},
      {fmt::format("Back to the last step about {}", name), "", go(-1)},
      {part.vertex ? "Move it: by its handle, or type where to" : "Move its vertices: by their handles", "what-if",
       [part](Session& session) { session.pick(part); }},
  };
  if (const std::string place = place_in_file(s.scene(), part); !place.empty())
    lines.push_back({.text = "Copy where the file has it: " + place, .copies = place});
  const std::vector<std::int32_t> polygons = polygons_with(s.scene(), part);
  constexpr std::size_t few = 3;
  for (std::size_t k = 0; k < std::min(few, polygons.size()); ++k)
    for (HereLine& line : lines_of_polygon(s, polygons[k])) lines.push_back(std::move(line));
  return lines;
}

std::vector<HereLine> lines_of_pixel(const Session& s, Cell cell, const std::optional<answers::Question>& depth) {
  const auto select = [cell](Session& session) { session.select(cell); };
  std::vector<HereLine> lines{
      {fmt::format("All that happened to pixel ({}, {})", cell.x, cell.y), "history", select},
      {"Why a polygon is not seen here", "why-not", select},
      {"On to the next step that touches it", "next-touch", select},
      {"Back to the last one", "previous-touch", select},
      {"Run until something is so there", "run-until", select},
      {"Compare this run with another", "compare", select},
      {"Zoom to it", "center", select},
  };
  if (depth) lines.push_back({.text = "Where its depth comes from", .asks = depth});
  const Picture& shown = s.picture();
  const std::int32_t polygon = shown.polygon[shown.at(cell.x, cell.y)];
  if (polygon == no_polygon) return lines;
  for (HereLine& line : lines_of_polygon(s, polygon)) lines.push_back(std::move(line));
  return lines;
}

}  // namespace zstep::viewer
