// What Ctrl+P finds: places, stops of the lesson, polygons and bookmarks, what can be opened, commands, and the next
// step that fulfils a condition.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace zstep::viewer {

class App;

struct Found {
  std::string title;
  std::string beside;  ///< what kind of thing it is, where it is, or its keys
  std::function<void(App&)> go;
};

class Finder {
 public:
  /// What has all the words that are typed in it, the likeliest first: what is named exactly, then what has it in its
  /// name. Of nothing typed, every command.
  const std::vector<Found>& find(App& app);

 private:
  std::vector<Found> found_;
  std::uint64_t found_for_ = 0;  ///< as the session was then
};

}  // namespace zstep::viewer
