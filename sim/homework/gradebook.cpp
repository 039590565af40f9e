// The gradebook of a class as CSV.
#include <fmt/format.h>

#include "sim/homework/batch.hpp"
#include "traces/text.hpp"

namespace zstep::homework {

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

}  // namespace zstep::homework
