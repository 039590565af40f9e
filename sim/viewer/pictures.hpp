// Pictures of the viewer without a window: of all of it or of one pane, and sheets of several for paper.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/classroom/lesson.hpp"
#include "traces/image/png.hpp"
#include "sim/viewer/viewer.hpp"
#include "sim/words/judged.hpp"
#include "traces/file/trace.hpp"

namespace zstep {

struct PictureOptions {
  int width = 1280, height = 720;
  bool dark = false, presenter = false, embed = false;
  bool notes = false;                   ///< the speaker's notes in place of the window
  std::string pane;                     ///< "frame", "depth", …; empty: the window with all of them
  const Lesson* lesson = nullptr;       ///< already resolved
  const CheckedRun* checked = nullptr;  ///< as in ViewerOptions
  const AgainstRun* against = nullptr;  ///< likewise
  std::optional<Trace::Pixel> pixel{};  ///< to be selected
  std::string lead{};                   ///< as in ViewerOptions
  bool finished = false;                ///< as in ViewerOptions
  std::optional<RaceAsked> race{};      ///< in place of the panes; needs run_by
  /// ViewerOptions::run_changed; with it the title offers to change and to race, as the window's does
  std::function<OtherRun(const Trace&, const std::string&, const std::vector<Change>&)> run_by{};
  std::function<std::vector<Offer>()> offers{};  ///< as in ViewerOptions: the title's words offer others
};

/// The panes that a trace has, by the names that PictureOptions takes.
std::vector<std::string> pane_names(const Trace& trace, bool with_lesson = false);

namespace viewer {
class Session;
}
/// Goes to a step that was asked for by its number. Throws InputError where one before it cannot be.
void go_to_or_throw(viewer::Session& session, std::int64_t position);

class Pictures {
 public:
  /// The trace must outlive it. Throws InputError where it has no such pane.
  Pictures(const Trace& trace, const PictureOptions& options);
  ~Pictures();
  Pictures(const Pictures&) = delete;
  Pictures& operator=(const Pictures&) = delete;

  /// At this position; below 0: at the lesson's first stop, or the beginning. The same one always gives the same
  /// picture. Where a step on the way cannot be: `before_impossible`, the window before that step, which says so.
  Image at(std::int64_t position, bool before_impossible = false);
  /// At this stop of the lesson, counted from 0.
  Image at_stop(int stop);
  /// What a caption says of it: "step 316 · compare", and a sentence.
  struct Caption {
    std::string place, sentence;
  };
  Caption caption(std::int64_t position);

 private:
  Image settled();

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Of the step where a reader stands.
Pictures::Caption caption_of(const viewer::Session& session);

/// Pictures of these positions with captions, in rows of so many, under a title.
Image contact_sheet(const Trace& trace, const std::vector<std::int64_t>& positions, const PictureOptions& options,
                    int columns);

}  // namespace zstep
