// A keyboard and a mouse before the window: what a person does, as events, and as lines for xdotool.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "sim/viewer/stage.hpp"
#include "tests/viewer/drive.hpp"
#include "tests/viewer/hands/task.hpp"

namespace zstep::test {

/// What a task is begun from, as `zstep` opens it, and the hands that do it.
class Hands {
 public:
  static constexpr int width = 1280, height = 720;

  explicit Hands(const HandStart& start);

  /// "Ctrl+E", "type theta = 40", "click Change", "click pixel 7 4 in frame", ...; throws std::runtime_error for a step
  /// that cannot be done.
  void by_keys(const std::string& step);
  void by_mouse(const std::string& step);
  /// The mouse to where nothing is told of it, and all that moves has come to rest.
  void rest();

  /// Whether "step 301", "sees words", "says words", ... holds.
  bool holds(const std::string& check);
  /// All of a reader's state that a picture may not show.
  std::string state();
  Bytes picture() { return test::picture(stage_->app()); }
  viewer::App& app() { return stage_->app(); }
  /// For xdotool, one command a line.
  const std::vector<std::string>& real() const { return real_; }

 private:
  void serve();
  void press(const std::string& chord, bool goes_up);
  struct Found {
    int x, y;
  };
  Found words(std::string text);
  Found pixel(const std::string& of);
  void drag(const std::string& what);
  Found target(const std::string& what);

  std::unique_ptr<Opened> opened_;
  std::unique_ptr<ViewerOptions> options_;
  std::unique_ptr<viewer::Stage> stage_;
  std::vector<std::string> real_;
  std::string clipboard_, saved_;
  bool quit_ = false, full_screen_ = false;
};

}  // namespace zstep::test
