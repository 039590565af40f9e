#include "sim/homework/handout.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "algorithms/catalog/catalog.hpp"
#include "sim/classroom/markdown.hpp"
#include "sim/homework/asked_text.hpp"
#include "sim/homework/assess.hpp"
#include "sim/pages/page.hpp"
#include "sim/pages/pictures.hpp"
#include "traces/replay/replay.hpp"

namespace zstep::homework {

namespace {

std::string runs_html(const std::vector<TextRun>& runs) {
  std::string html;
  for (const TextRun& run : runs) {
    std::string text = shown(run.text);
    for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 4))
      text.replace(at, 1, "<br>");
    const auto put_in = [&](bool wanted, const char* element) {
      if (wanted) text = fmt::format("<{0}>{1}</{0}>", element, text);
    };
    put_in(run.code, "code");
    put_in(run.italic, "em");
    put_in(run.bold, "strong");
    html += text;
  }
  return html;
}

/// Lists come flat, with their depths; in a page they lie in each other.
class Lists {
 public:
  /// Closes those that are deeper.
  std::string down_to(std::size_t depth) {
    std::string html;
    while (open_.size() > depth) {
      html += fmt::format("</li></{}>\n", open_.back());
      open_.pop_back();
    }
    return html;
  }
  std::string item(const TextBlock& block) {
    const char* element = block.number != 0 ? "ol" : "ul";
    const auto depth = static_cast<std::size_t>(std::max(1, block.depth));
    std::string html = down_to(depth);
    if (open_.size() == depth && std::string_view(open_.back()) != element) html += down_to(depth - 1);
    if (open_.size() == depth) html += "</li>\n";
    for (; open_.size() < depth; open_.push_back(element))
      html += block.number > 1 ? fmt::format("<ol start=\"{}\">\n", block.number) : fmt::format("<{}>\n", element);
    return html + "<li>";
  }

 private:
  std::vector<const char*> open_;
};

std::string markdown_html(std::string_view markdown) {
  using Kind = TextBlock::Kind;
  std::string html;
  Lists lists;
  for (const TextBlock& block : parse_markdown(markdown)) {
    if (block.kind == Kind::item) {
      html += lists.item(block) + runs_html(block.runs);
      continue;
    }
    html += lists.down_to(static_cast<std::size_t>(block.depth));
    switch (block.kind) {
      case Kind::heading:
        html += fmt::format("<h{0}>{1}</h{0}>\n", block.level, runs_html(block.runs));
        break;
      case Kind::code:
        html += fmt::format("<pre>{}</pre>\n", shown(block.runs.empty() ? "" : block.runs.front().text));
        break;
      case Kind::quote:
        html += fmt::format("<blockquote><p>{}</p></blockquote>\n", runs_html(block.runs));
        break;
      case Kind::rule:
        html += "<hr>\n";
        break;
      default:
        html += fmt::format("<p>{}</p>\n", runs_html(block.runs));
        break;
    }
  }
  return html + lists.down_to(0);
}

std::string size_of(const Task& task, const Picture& picture, bool curves) {
  const auto count = [](auto number, const char* one) {
    return fmt::format("{} {}{}", number, one, number == 1 ? "" : "s");
  };
  return fmt::format("{} × {} pixels, ", picture.width, picture.height) +
         (curves ? count(task.scene.surface->rows, "curve") + " of " + count(task.scene.surface->columns, "sample")
                 : count(task.scene.polygons.size(), "polygon"));
}

std::string scene_html(const Method& method, const Task& task, const Trace& reference) {
  Replay replay(reference);
  replay.go_to(reference.size());
  const Picture& picture = replay.state().picture;
  DepthRange range;
  range.include(picture);
  const bool curves = method.needs == Needs::surface;
  const std::string picture_alone =
      fmt::format("<h3>{}</h3>\n<p>{}.</p>\n", shown(task.name), size_of(task, picture, curves)) +
      figure(image_of(picture, task.scene, 1), "The picture", picture_in_words(picture, task.scene) + ".");
  if (method.gives == Gives::lines) return picture_alone;
  return picture_alone + figure(depths_of(picture, task.scene.raster.y_up, range),
                                "The depths: the smaller z, the darker; a stroke where nothing is drawn",
                                depths_in_words(picture) + ".");
}

}  // namespace

std::string handout_html(const Homework& homework, std::string_view markdown) {
  std::string html = page_begin(homework.title) + markdown_html(without_block_lines(markdown));
  const References references(homework);
  std::string scenes;
  for (const Task& task : homework.tasks)
    if (const auto reference = references.find(task, task.conventions); reference && !task.hidden)
      scenes += scene_html(*homework.method, task, *reference);
  if (!scenes.empty()) html += "<h2>What a right program draws</h2>\n" + scenes;
  return html.append(page_end);
}

}  // namespace zstep::homework
