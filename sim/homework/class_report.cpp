// A class on one page: what fails most, how the points lie, and all submissions.

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numeric>

#include "sim/homework/batch.hpp"
#include "sim/homework/report_words.hpp"
#include "sim/pages/page.hpp"
#include "traces/text.hpp"

namespace zstep::homework {

// The gradebook of a class as CSV.

namespace {

/// A text in quotes. A table would take one that begins with =, +, - or @ for a formula; an apostrophe in front says
/// that it is a text.
std::string text_cell(const std::string& from) {
  std::string text = printable(from);
  if (!text.empty() && std::string_view("=+-@").find(text.front()) != std::string_view::npos) text.insert(0, "'");
  for (std::size_t at = text.find('"'); at != std::string::npos; at = text.find('"', at + 2)) text.insert(at, "\"");
  return "\"" + text + "\"";
}

/// Points as every table reads them.
std::string plain(double points) { return fmt::format("{:.2f}", points); }

}  // namespace

const char* word_of(Result::State state) {
  switch (state) {
    case Result::State::graded:
      return "graded";
    case Result::State::partly:
      return "partly graded";
    case Result::State::ungradable:
      return "ungradable";
    default:
      return "missing";
  }
}

std::string gradebook_csv(const Homework& homework, const Batch& batch) {
  std::string text = "name,points,of,state,why";
  for (const grade::Part& part : homework.parts) text += "," + text_cell(part.name);
  text += ",first wrong step,likely mistake\r\n";
  for (const Result& result : batch.results) {
    // What has no grade has no points either: an empty cell is no 0.
    text += text_cell(result.name) + ",";
    if (result.has_grade()) text += plain(result.points);
    text += fmt::format(",{},{},{}", plain(batch.share * homework.points()), word_of(result.state),
                        result.why.empty() ? "" : text_cell(result.why));
    for (std::size_t part = 0; part < homework.parts.size(); ++part)
      text += "," + (part < result.parts.size() ? plain(result.parts[part].points) : "");
    text += ",";
    if (result.first)
      text += text_cell(fmt::format("{}{}: {}{}", result.first->scene,
                                    result.first->where.empty() ? "" : ", " + result.first->where, result.first->step,
                                    result.first->subject.empty() ? "" : ", " + result.first->subject));
    text += "," + (result.mistake.empty() ? "" : text_cell(result.mistake)) + "\r\n";
  }
  return text;
}

namespace {

std::string submissions_text(std::size_t count) { return fmt::format("{} submission{}", count, count == 1 ? "" : "s"); }

/// A share as a bar beside its number, for who reads tables by eye.
std::string bar(std::size_t count, std::size_t most) {
  constexpr double wide = 20;
  const double width = most == 0 ? 0 : wide * static_cast<double>(count) / static_cast<double>(most);
  return fmt::format("<td><div style=\"background:#456;height:1em;width:{:.1f}rem\"></div></td>", width);
}

std::string states(const Batch& batch) {
  std::map<Result::State, std::size_t> counts;
  for (const Result& result : batch.results) ++counts[result.state];
  std::string text;
  for (const auto& [state, count] : counts)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, word_of(state));
  return text;
}

/// Their points in ten ranges, and the middle of them.
std::string points_table(double most, const std::vector<const Result*>& graded) {
  constexpr std::size_t ranges = 10;
  std::vector<std::size_t> counts(ranges);
  std::vector<double> points;
  for (const Result* result : graded) {
    const double share = most > 0 ? result->points / most : 0;
    ++counts[std::min(ranges - 1, static_cast<std::size_t>(std::max(0.0, share * ranges)))];
    points.push_back(result->points);
  }
  std::sort(points.begin(), points.end());
  const double mean = std::accumulate(points.begin(), points.end(), 0.0) / static_cast<double>(points.size());
  const double median = (points[(points.size() - 1) / 2] + points[points.size() / 2]) / 2;
  std::string rows;
  for (std::size_t range = 0; range < ranges; ++range) {
    const auto edge = [&](std::size_t at) {
      return points_text(most * static_cast<double>(at) / static_cast<double>(ranges));
    };
    rows += fmt::format("<tr><th scope=\"row\" class=\"n\">{} to {}{}</th><td class=\"n\">{}</td>{}</tr>\n",
                        edge(range), range + 1 == ranges ? "" : "less than ", edge(range + 1), counts[range],
                        bar(counts[range], *std::max_element(counts.begin(), counts.end())));
  }
  return fmt::format(
      "<h2>Points</h2>\n<p>Of {} points the mean is {}, the median {}, of the {} that have a grade.</p>\n"
      "<table>\n<thead><tr><th scope=\"col\" class=\"n\">points</th><th scope=\"col\" class=\"n\">submissions</th>"
      "<th scope=\"col\">as a bar</th></tr></thead>\n<tbody>{}</tbody>\n</table>\n",
      points_text(most), points_text(mean), points_text(median), submissions_text(graded.size()), rows);
}

std::string parts_table(const Homework& homework, double of_all, const std::vector<const Result*>& graded) {
  struct Row {
    std::string name;
    std::size_t failed = 0;
    double share = 0;  ///< of the points of the part, as a mean
  };
  std::vector<Row> all;
  for (std::size_t part = 0; part < homework.parts.size(); ++part) {
    Row row{homework.parts[part].name, 0, 0};
    for (const Result* result : graded) {
      const double points = result->parts[part].points, most = of_all * homework.parts[part].points();
      row.failed += points < most;
      row.share += most > 0 ? points / most / static_cast<double>(graded.size()) : 0;
    }
    all.push_back(std::move(row));
  }
  std::stable_sort(all.begin(), all.end(), [](const Row& a, const Row& b) { return a.failed > b.failed; });
  std::string rows;
  for (const Row& row : all)
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td class=\"n\">{}</td>{}<td class=\"n\">{:.0f} %</td></tr>\n",
                        shown(row.name), row.failed, bar(row.failed, graded.size()), 100 * row.share);
  return fmt::format(
      "<h2>Parts, those that fail most first</h2>\n<table>\n<thead><tr><th scope=\"col\">part</th><th scope=\"col\" "
      "class=\"n\">not all right in</th><th scope=\"col\">as a bar</th><th scope=\"col\" class=\"n\">points, on "
      "average</th></tr></thead>\n<tbody>{}</tbody>\n</table>\n",
      rows);
}

std::string names_of(const std::vector<const Result*>& results) {
  constexpr std::size_t named = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(named, results.size()); ++i)
    text += (i == 0 ? "" : ", ") + shown(results[i]->name);
  return results.size() > named ? text + fmt::format(", and {} more", results.size() - named) : text;
}

/// Where submissions first go wrong, the most common first.
std::string first_steps_table(const std::vector<const Result*>& graded) {
  std::map<std::pair<std::string, std::string>, std::vector<const Result*>> by_step;
  for (const Result* result : graded)
    if (result->first) by_step[{result->first->step, result->first->scene}].push_back(result);
  if (by_step.empty()) return "<h2>First wrong steps</h2>\n<p>No submission has a wrong step.</p>\n";
  std::vector<std::pair<std::pair<std::string, std::string>, std::vector<const Result*>>> all(by_step.begin(),
                                                                                              by_step.end());
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.second.size() > b.second.size(); });
  std::string rows;
  for (const auto& [step, results] : all)
    rows += fmt::format(
        "<tr><th scope=\"row\"><code>{}</code></th><td>{}</td><td class=\"n\">{}</td><td>{}</td><td>{}</td></tr>\n",
        shown(step.first), shown(step.second), results.size(), shown(results.front()->first->what), names_of(results));
  return fmt::format(
      "<h2>First wrong steps, the most common first</h2>\n<div class=\"wide\"><table>\n<thead><tr><th scope=\"col\">"
      "step</th><th scope=\"col\">scene</th><th scope=\"col\" class=\"n\">submissions</th><th scope=\"col\">one of them"
      "</th><th scope=\"col\">who</th></tr></thead>\n<tbody>{}</tbody>\n</table></div>\n",
      rows);
}

/// The likely mistakes, where any is known.
std::string mistakes_table(const std::vector<const Result*>& graded) {
  std::map<std::string, std::vector<const Result*>> by_name;
  for (const Result* result : graded)
    if (!result->mistake.empty()) by_name[result->mistake].push_back(result);
  if (by_name.empty()) return "";
  std::vector<std::pair<std::string, std::vector<const Result*>>> all(by_name.begin(), by_name.end());
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.second.size() > b.second.size(); });
  std::string rows;
  for (const auto& [name, results] : all)
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td class=\"n\">{}</td><td>{}</td></tr>\n", shown(name),
                        results.size(), names_of(results));
  return fmt::format(
      "<h2>Likely mistakes, the most common first</h2>\n<table>\n<thead><tr><th scope=\"col\">mistake</th>"
      "<th scope=\"col\" class=\"n\">submissions</th><th scope=\"col\">who</th></tr></thead>\n<tbody>{}</tbody>\n"
      "</table>\n",
      rows);
}

/// Whose runs are the same although their scenes are not, and no more than that.
std::string alike_table(const std::vector<AlikeRuns>& all) {
  if (all.empty()) return "";
  const auto list = [](const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + shown(name);
    return text;
  };
  std::string rows;
  for (const AlikeRuns& one : all) {
    std::string what = one.names.size() < 2 ? ""
                       : one.same           ? fmt::format("all {} steps that hold numbers", one.steps)
                                            : fmt::format("about {:.0f} % of {} steps that hold numbers",
                                                          std::floor(100 * one.share), one.steps);
    if (!one.right_for.empty())
      what += fmt::format("{}right on the scene of {}", what.empty() ? "" : "; ", list(one.right_for));
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td><td>{}</td></tr>\n", shown(one.scene), list(one.names),
                        what);
  }
  return fmt::format(
      "<h2>Near-identical runs</h2>\n<p>Each student has a scene of their own, so that right runs are not the same. "
      "These are, although the scenes differ. How that came about the runs do not show; no points depend on it.</p>\n"
      "<table>\n<thead><tr><th scope=\"col\">scene</th><th scope=\"col\">submissions</th><th scope=\"col\">what is "
      "the same</th></tr></thead>\n<tbody>{}</tbody>\n</table>\n",
      rows);
}

/// The beginning of what may be long, up to the end of its first line.
std::string beginning(const std::string& text) {
  constexpr std::size_t most = 100;
  std::size_t end = std::min(text.find('\n'), text.size());
  if (end > most)
    for (end = most; continues_character(text[end]);) --end;
  return text.substr(0, end) + (end < text.size() ? "…" : "");
}

std::string all_table(const Homework& homework, const Batch& batch) {
  std::string head, rows;
  for (const grade::Part& part : homework.parts)
    head += fmt::format("<th scope=\"col\" class=\"n\">{}, of {}</th>", shown(part.name),
                        points_text(batch.share * part.points()));
  for (const Result& result : batch.results) {
    const bool graded = result.state == Result::State::graded;
    rows += fmt::format("<tr><th scope=\"row\">{}</th><td class=\"n\">{}{}{}</td>", shown(result.name),
                        result.has_grade() ? points_text(result.points) : "",
                        graded || !result.has_grade() ? "" : "<br>", graded ? "" : word_of(result.state));
    for (std::size_t part = 0; part < homework.parts.size(); ++part)
      rows +=
          fmt::format("<td class=\"n\">{}</td>", result.parts.empty() ? "–" : points_text(result.parts[part].points));
    const std::string first = result.first
                                  ? fmt::format("{}: {}{}", result.first->scene, result.first->step,
                                                result.first->subject.empty() ? "" : ", " + result.first->subject)
                                  : "";
    rows += fmt::format("<td>{}{}{}</td></tr>\n", shown(result.mistake), result.mistake.empty() ? "" : "<br>",
                        shown(first.empty() ? beginning(result.why) : first));
  }
  return fmt::format(
      "<h2>All submissions</h2>\n<div class=\"wide\"><table>\n<thead><tr><th scope=\"col\">name</th>"
      "<th scope=\"col\" class=\"n\">points</th>{}<th scope=\"col\">likely mistake and "
      "first wrong step, or why there is no grade</th></tr></thead>\n<tbody>{}</tbody>\n</table></div>\n",
      head, rows);
}

}  // namespace

std::string class_html(const Homework& homework, const Batch& batch) {
  std::vector<const Result*> graded;
  for (const Result& result : batch.results)
    if (result.has_grade()) graded.push_back(&result);
  std::string page = page_begin(homework.title + ": the class");
  page += fmt::format("<h1>{}: the class</h1>\n<p>{}{}{}.</p>\n", shown(homework.title),
                      submissions_text(batch.results.size()), batch.results.empty() ? "" : ": ", states(batch));
  if (!graded.empty())
    page += parts_table(homework, batch.share, graded) + first_steps_table(graded) + mistakes_table(graded) +
            points_table(batch.share * homework.points(), graded) + alike_table(batch.alike);
  return (page + all_table(homework, batch)).append(page_end);
}

}  // namespace zstep::homework
