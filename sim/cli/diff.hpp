// zstep diff: what its printed text, its JSON and its page say of two runs, or of a run and a picture.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/cli/run_options.hpp"
#include "sim/cli/show.hpp"
#include "traces/image/png.hpp"
#include "traces/diff/buffers.hpp"
#include "traces/diff/diff.hpp"
#include "traces/file/trace.hpp"

namespace zstep::cli {

struct DiffOptions {
  std::string a, b, page;
  bool all = false, json = false, view = false;
  ShowOptions show;
  RunOptions run;  ///< of the scene beside which a picture is held
};

/// One run's side of a cause.
struct CauseSide {
  std::int64_t step = 0;            ///< 0: the run has no such step
  std::string where;                ///< "run.jsonl:12, printed at raster.cpp:417"
  std::string at;                   ///< "raster.cpp:417"; empty where the run does not say
  std::vector<std::string> fields;  ///< of each field that parts: "dx_dy = (x_1 − x_0)/(y_1 − y_0) = … = 1.5"
  std::string command;              ///< that opens the viewer there; empty of standard input
};
struct CauseText {
  std::string step, subject;  ///< "insert_edge", "edge e1 (1–2)"
  std::string what;           ///< in one line, why it is a cause
  std::string follows;        ///< what follows from it; may be empty
  CauseSide a, b;
};

/// Two pictures, and where they differ.
struct PicturePair {
  diff::BufferDifference difference;
  Image a, b, map;  ///< the top row first; the map: white where nothing differs, the darker the more
};

struct DiffText {
  std::string name_a, name_b;
  std::vector<std::string> notes;  ///< what the runs do not share
  std::vector<CauseText> causes;
  std::string pictures;  ///< one sentence
  /// Where causes do not tell it: which polygons are seen otherwise, and how that came.
  std::vector<std::string> seen = {};
  std::vector<std::string> likely = {};  ///< the mistake that B goes wrong by, as likely_in_words() says it
};

/// All of it in words.
DiffText diff_text(const Trace& a, const Trace& b, const DiffOptions& options, const diff::DiffReport& report,
                   const diff::BufferDifference& pictures);
std::string pictures_text(const diff::BufferDifference& found);
/// What both runs did at pixels at which they end with different polygons.
std::vector<std::string> seen_text(const Trace& a, const Picture& end_a, const Trace& b, const Picture& end_b);
void print_diff(const DiffText& text, const diff::DiffReport& report, const diff::BufferDifference& pictures, bool all);
void print_diff_json(const DiffText& text, const diff::DiffReport& report, const diff::BufferDifference& pictures);

/// Two runs in one window: matched first, with progress on the terminal.
int view_against(const std::string& a, const std::string& b, const ShowOptions& show);

/// Does its name end as a picture's, or as that of a table of depths or polygons?
bool is_picture(const std::string& path);
/// A run against the picture of another program; returns the exit code.
int diff_with_picture(const DiffOptions& options);
/// A picture against its scene alone, as it should be drawn and as the known mistakes would draw it; likewise.
int diff_of_picture(const DiffOptions& options);
/// Throws InputError unless both are of one size.
void check_sizes(std::int32_t width_a, std::int32_t height_a, std::int32_t width_b, std::int32_t height_b,
                 const std::string& b);

/// One page with all of it, without anything from elsewhere.
std::string diff_page(const DiffText& text, const diff::DiffReport& report, const PicturePair& pictures);
/// Writes it to where the options have it, and says so.
void write_diff_page(const DiffOptions& options, const DiffText& text, const diff::DiffReport& report,
                     const PicturePair& pictures);

}  // namespace zstep::cli
