// The report of one submission as one page: what works, the first wrong step with the pictures of its scene, and a
// table by which the points can be worked out by hand. It has headings, table headers and texts for all pictures, and
// says nothing by colour alone.
#include <algorithm>

#include <fmt/format.h>

#include "sim/homework/report_words.hpp"
#include "sim/homework/reports.hpp"
#include "sim/pages/page.hpp"
#include "sim/pages/pictures.hpp"
#include "sim/words/escaped.hpp"
#include "sim/words/explain.hpp"
#include "traces/scene.hpp"

namespace zstep::homework {

namespace {

std::string field_cell(const std::vector<FieldText>& fields, const std::string& name) {
  for (const FieldText& field : fields) {
    if (field.name != name) continue;
    const std::string formula =
        field.formula.empty() ? "" : fmt::format("<br>{} <code>{}</code>", field.origin(), shown(field.formula));
    return fmt::format("<td><code>{}</code>{}</td>", shown(field.value), formula);
  }
  return fields.empty() ? "<td>no such step</td>" : "<td>as expected</td>";
}

std::string both_sides(const FirstWrong& first) {
  std::vector<std::string> names;
  for (const auto* fields : {&first.expected, &first.found})
    for (const FieldText& field : *fields)
      if (std::find(names.begin(), names.end(), field.name) == names.end()) names.push_back(field.name);
  if (names.empty()) return "";
  std::string rows;
  for (const std::string& name : names)
    rows += fmt::format("<tr><th scope=\"row\">{}</th>{}{}</tr>\n",
                        name.empty() ? "the step" : fmt::format("<code>{}</code>", shown(name)),
                        field_cell(first.expected, name), field_cell(first.found, name));
  return fmt::format(
      "<table>\n<caption>The step in numbers</caption>\n<thead><tr><th scope=\"col\">field</th><th scope=\"col\">"
      "expected</th><th scope=\"col\">yours</th></tr></thead>\n<tbody>{}</tbody>\n</table>\n",
      rows);
}

std::string depth_text(double z) { return z == no_depth ? "none" : number(z); }

/// The pixels that differ, one a row, for who does not see the picture of them.
std::string differing_pixels(const grade::Ends& ends, const Scene& scene) {
  constexpr int most = 8;
  int count = 0;
  std::string rows;
  const auto seen = [&](const Picture& picture, std::size_t at) {
    if (const std::int32_t polygon = picture.polygon[at]; polygon != no_polygon) return polygon_label(scene, polygon);
    const Color color = color_at(picture, scene, at);
    return color == scene.background ? std::string("background")
                                     : fmt::format("{}, {}, {}", color.red, color.green, color.blue);
  };
  for (std::size_t at = 0; at < ends.apart.apart.size(); ++at) {
    if (ends.apart.apart[at] == 0 || ++count > most) continue;
    const std::size_t width = ends.reference.width;
    rows += fmt::format("<tr><th scope=\"row\">({}, {})</th><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                        at % width, at / width, shown(seen(ends.reference, at)), shown(seen(ends.run, at)),
                        depth_text(ends.reference.depth[at]), depth_text(ends.run.depth[at]));
  }
  if (count == 0) return "<p>At the end both pictures are the same, and so are their depths.</p>\n";
  return fmt::format(
      "<table>\n<caption>{} of {} pixels differ at the end{}</caption>\n<thead><tr><th scope=\"col\">pixel (x, y)</th>"
      "<th scope=\"col\">seen, expected</th><th scope=\"col\">seen, yours</th><th scope=\"col\">depth, expected</th>"
      "<th scope=\"col\">depth, yours</th></tr></thead>\n<tbody>{}</tbody>\n</table>\n",
      count, ends.apart.pixels, count > most ? fmt::format("; the first {}", most) : "", rows);
}

std::string pictures(const Graded& task) {
  if (!task.ends) return "";
  const grade::Ends& ends = *task.ends;
  const Scene& scene = task.task->scene;
  const bool y_up = scene.raster.y_up;
  DepthRange range;
  for (const Picture* picture : {&ends.reference, &ends.run}) range.include(*picture);
  const auto frame = [&](const Picture& picture, std::string_view whose) {
    return figure(image_of(picture, scene, 1), fmt::format("The picture, {}", whose),
                  fmt::format("The picture, {}. {}.", whose, picture_in_words(picture, scene)));
  };
  const auto depths = [&](const Picture& picture, std::string_view whose) {
    return figure(depths_of(picture, y_up, range),
                  fmt::format("The depths, {}: the smaller z, the darker; a stroke where nothing was drawn", whose),
                  fmt::format("The depths, {}. {}.", whose, depths_in_words(picture)));
  };
  std::string text = fmt::format("<h2>The end of {}</h2>\n", shown(task.task->name));
  text += frame(ends.reference, "expected") + frame(ends.run, "yours");
  text += figure(map_of(ends.apart.apart, ends.reference.width, ends.reference.height, y_up),
                 "Where they differ, in colour or depth: the darker, the more",
                 fmt::format("The differences: {} pixels of another colour, {} of another depth, of {}.",
                             ends.apart.colors, ends.apart.depths, ends.apart.pixels));
  if (range.least <= range.most) text += depths(ends.reference, "expected") + depths(ends.run, "yours");
  return text + differing_pixels(ends, scene);
}

/// The likely mistake: its name, what to ask oneself, and where it is taught.
std::string mistake_html(const FirstWrong& first) {
  std::string text;
  for (const std::string& line : mistake_lines(first)) text += (text.empty() ? "" : "<br>") + shown(line);
  return text.empty() ? "" : "<p>" + text + "</p>\n";
}

std::string first_wrong(const Graded& task, const std::string& command, const std::string& steps_page) {
  const FirstWrong& first = *task.first;
  const std::string link = steps_page.empty() ? ""
                                              : fmt::format("<p><a href=\"{}\">{}</a>, in this browser.</p>\n",
                                                            percent_encoded(steps_page, "-_.~/"), steps_link);
  const std::string to_see = task.from_picture ? ""  // it has no steps that a window could show
                                               : fmt::format(
                                                     " To see both runs at this step: "
                                                     "<code class=\"command\">{} --scene {} --view</code>",
                                                     shown(command), shown(shell_word(task.task->name)));
  return fmt::format(
      "<h2>Look at this first</h2>\n<p>In {}{}: <strong>{}{}</strong></p>\n<p>{}</p>\n{}{}{}"
      "<p>Later mistakes can follow from this one: mend it, then grade again.{}</p>\n{}",
      shown(task.task->name), first.where.empty() ? "" : ", " + shown(first.where), shown(first.step),
      first.subject.empty() ? "" : ", " + shown(first.subject), shown(first.what), both_sides(first),
      mistake_html(first), link, to_see, pictures(task));
}

std::string what_works(const Assessment& all) {
  const Homework& homework = *all.homework;
  std::string items;
  for (const Graded& task : all.tasks) {
    if (task.state != Graded::State::judged) continue;
    std::string names;
    std::size_t count = 0;
    for (std::size_t part = 0; part < homework.parts.size(); ++part) {
      if (!task.counts[part].lost.empty()) continue;
      names += (names.empty() ? "" : ", ") + homework.parts[part].name;
      ++count;
    }
    if (count == homework.parts.size()) names = "everything";
    if (count > 0) items += fmt::format("<li>{}: {}</li>\n", shown(task.task->name), shown(names));
  }
  if (items.empty()) return "<p>No part is wholly right yet. The first step to mend comes next.</p>\n";
  return "<h2>What works</h2>\n<ul>\n" + items + "</ul>\n";
}

/// "12/15 × 5 = 4"
std::string share_cell(std::int64_t of, std::int64_t count, double most) {
  if (most <= 0) return "<td class=\"n\"></td>";
  if (count == 0) return fmt::format("<td class=\"n\">nothing to do: {}</td>", points_text(most));
  const double share = ratio(of, count);
  return fmt::format("<td class=\"n\">{}/{} × {} = {}</td>", of, count, points_text(most), points_text(share * most));
}

/// Colours and depths, each half of the points: "(60 + 30)/120 × 5 = 3.75"
std::string halves_cell(const grade::PartCount& count, double most) {
  if (most <= 0 || count.all() == 0) return share_cell(count.same, count.all(), most);
  const std::int64_t both = count.halves->colors + count.halves->depths;
  if (both == 2 * count.same) return share_cell(count.same, count.all(), most);
  return fmt::format("<td class=\"n\">({} + {})/{} × {} = {}</td>", count.halves->colors, count.halves->depths,
                     2 * count.all(), points_text(most), points_text(ratio(both, 2 * count.all()) * most));
}

std::string task_table(const Assessment& all, const Graded& task) {
  const Homework& homework = *all.homework;
  double points = 0, most = 0;
  for (std::size_t part = 0; part < homework.parts.size(); ++part)
    points += all.points(task, part), most += all.most(task, part);
  std::string text = fmt::format(
      "<h3>{}{}: {}{} points</h3>\n", shown(task.task->name), task.task->hidden ? " (a hidden scene)" : "",
      task.state == Graded::State::judged ? points_text(points, most) + " of " : "no grade, of ", points_text(most));
  if (task.state == Graded::State::missing)
    return text + fmt::format("<p>Nothing was handed in: {}.</p>\n", shown(task.why));
  if (const std::string why = task.shown(); !why.empty()) {
    const char* begin = task.state == Graded::State::unreadable ? "<p>This cannot be graded:</p>\n"
                        : task.state == Graded::State::stopped  ? ""
                                                                : "<p>Note:</p>\n";
    text += fmt::format("{}<pre>{}</pre>\n", begin, shown(why));
  }
  if (!task.note.empty()) text += fmt::format("<p>{}</p>\n", shown(task.note));
  if (task.state != Graded::State::judged) return text;
  const double share = homework.share(*task.task);
  std::string rows;
  for (std::size_t index = 0; index < homework.parts.size(); ++index) {
    const grade::Part& part = homework.parts[index];
    const grade::PartCount& count = task.counts[index];
    rows += fmt::format("<tr><th scope=\"row\">{}</th>", shown(part.name));
    if (!task.task->hidden)
      rows += share_cell(count.computed, count.all(), share * part.computation) +
              (count.halves ? halves_cell(count, share * part.value)
                            : share_cell(count.same, count.all(), share * part.value));
    const double earned = all.points(task, index), possible = all.most(task, index);
    const std::string lost = losses_text(homework, count, task.task->hidden);
    rows += fmt::format("<td class=\"n\">{} of {}</td><td>{}</td></tr>\n", points_text(earned, possible),
                        points_text(possible), lost.empty() ? "all right" : shown(lost));
  }
  const char* columns = task.task->hidden ? ""
                                          : "<th scope=\"col\" class=\"n\">for computation: c/n</th>"
                                            "<th scope=\"col\" class=\"n\">for values: v/n</th>";
  return text + fmt::format(
                    "<div class=\"wide\"><table>\n<thead><tr><th scope=\"col\">part</th>{}<th scope=\"col\" "
                    "class=\"n\">points</th><th scope=\"col\">state</th></tr></thead>\n<tbody>{}</tbody>\n"
                    "<tfoot><tr><th scope=\"row\">together</th>{}<td class=\"n\">{} of {}</td><td></td></tr>"
                    "</tfoot>\n</table></div>\n",
                    columns, rows, task.task->hidden ? "" : "<td></td><td></td>", points_text(points),
                    points_text(most));
}

std::string points_by_part(const Assessment& all) {
  std::string text =
      "<h2>Points by part</h2>\n<p>Of each part, n are the steps that the right run has and those that yours has "
      "besides; "
      "c of them are there and follow from the numbers that your run itself has; v of them are there with the right "
      "numbers. Of a picture, n counts pixels.</p>\n";
  for (const Graded& task : all.tasks) text += task_table(all, task);
  return text;
}

}  // namespace

std::string report_html(const Assessment& all, const std::string& command, const std::string& steps_page) {
  const Homework& homework = *all.homework;
  std::string page = page_begin(homework.title + ": " + all.submission);
  page += fmt::format("<h1>{}: {}</h1>\n", shown(homework.title), shown(all.submission));
  page +=
      all.gradable()
          ? fmt::format("<p><strong>{} of {} points</strong></p>\n", points_text(all.points(), all.most()),
                        points_text(all.most()))
          : "<p><strong>Nothing here could be graded, so there are no points yet; why is said below.</strong></p>\n";
  if (const std::string first = said_first_text(all); !first.empty() && all.gradable())
    page += fmt::format("<h2>Before all else</h2>\n<pre>{}</pre>\n", shown(first));
  if (homework.left_out > 0) page += "<p>The hidden scenes are not here; their points are not counted.</p>\n";
  if (all.gradable()) page += what_works(all);
  if (const Graded* wrong = first_to_mend(all)) page += first_wrong(*wrong, command, steps_page);
  else if (all_right(all)) page += "<p>Every step is right.</p>\n";
  else if (const std::string next = next_part_text(all); !next.empty()) page += "<p>" + shown(next) + "</p>\n";
  return (page + points_by_part(all)).append(page_end);
}

}  // namespace zstep::homework
