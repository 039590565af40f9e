// What is painted over the frame for each pixel: how often it was written, who wrote it last, … Follows the reader's
// step, and catches up a little each frame.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "sim/answers/pixel_counts.hpp"
#include "sim/viewer/model/inquiry.hpp"
#include "sim/viewer/model/session.hpp"

namespace zstep::viewer {

class PixelOverlay {
 public:
  /// The session must outlive it.
  explicit PixelOverlay(Session& session) : session_(session) {}

  std::optional<answers::Count> shown() const { return shown_; }
  void show(std::optional<answers::Count> count);
  /// The next one of them, with none between the last and the first.
  void turn(int direction);
  /// Is the picture of this step not whole yet?
  bool counts() const { return shown_ && painted_at_ != session_.position(); }
  /// Counts on for some milliseconds. True when there is a picture to take.
  bool look_on();
  /// Into `shown`, whose memory is used again.
  void take_picture(std::optional<HeatMap>& shown);
  /// How far it is behind the reader, for who watches; empty when it is not.
  std::string behind() const;

  /// "overdraw", and what it says in a few words.
  static std::string name(answers::Count count);
  static std::string meaning(answers::Count count);

 private:
  void paint();
  Session& session_;
  std::unique_ptr<answers::PixelCounts> counts_;  // made when first shown
  std::optional<answers::Count> shown_;
  HeatMap picture_;
  std::int64_t painted_at_ = -1;
};

}  // namespace zstep::viewer
