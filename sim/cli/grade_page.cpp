// The page beside a report in which the reader steps through both runs.
#include <filesystem>
#include <sstream>
#include <vector>

#include "sim/cli/grade.hpp"
#include "sim/cli/publish.hpp"
#include "sim/homework/report_words.hpp"
#include "sim/image/file.hpp"
#include "sim/pages/publish.hpp"
#include "traces/file/jsonl.hpp"
#include "traces/file/without_paths.hpp"

namespace zstep::cli {
namespace {

PublishedFile file_in_page(std::string name, const Trace& trace) {
  std::ostringstream lines;
  write_jsonl(trace, lines);
  const std::string text = without_paths_of_jsonl(std::move(lines).str());
  return {std::move(name), gzip({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()})};
}

}  // namespace

bool write_steps_page(const homework::Homework& given, const homework::Assessment& all, const GradeOptions& options) {
  const homework::Graded* const wrong = homework::first_to_mend(all);
  if (!wrong || wrong->from_picture) return false;
  const homework::Runs runs =
      homework::runs_of(given, *wrong->task, wrong->file,
                        wrong->left_out.empty() ? homework::Look::at_all : homework::Look::at_what_is_there);
  const std::filesystem::path empty_page = page_without_run(options.site);
  const std::vector<std::uint8_t> empty = read_file(empty_page);
  const std::vector<PublishedFile> files = {file_in_page("expected.jsonl", *runs.reference),
                                            file_in_page("yours.jsonl", runs.submission)};
  const std::vector<std::string> words = {"diff", files[0].name, files[1].name, "--view"};
  const std::string page = published({empty.begin(), empty.end()}, empty_page.string(), words, files);
  write_file(options.steps_page, {reinterpret_cast<const std::uint8_t*>(page.data()), page.size()});
  return true;
}

}  // namespace zstep::cli
